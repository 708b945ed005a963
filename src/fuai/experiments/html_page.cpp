// Composes HTML pages.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/experiments/html_page.h"

#include <algorithm>

#include "fuai/core/error.h"
#include "fuai/io/delimited.h"

namespace fuai {
namespace {

constexpr std::string_view kStyle = R"(
body { font: 16px/1.55 system-ui, "Noto Sans", "Noto Sans CJK JP", sans-serif; color: #1c1f24; margin: 0 auto; max-width: 72rem; padding: 1.5rem; }
h1 { font-size: 1.7rem; line-height: 1.25; } h2 { margin-top: 2.6rem; border-bottom: 1px solid #d5d9df; padding-bottom: .2rem; } h3 { margin-top: 1.6rem; }
figure { margin: 1.2rem 0; } figure img { max-width: 100%; height: auto; border: 1px solid #e3e6ea; }
figcaption { color: #444b55; font-size: .93rem; margin-top: .35rem; }
.gallery { display: grid; grid-template-columns: repeat(auto-fit, minmax(15rem, 1fr)); gap: .7rem; }
.gallery div { font-size: .9rem; text-align: center; } .gallery img { width: 100%; }
table { border-collapse: collapse; margin: 1rem 0; font-size: .93rem; } caption { text-align: left; color: #444b55; padding-bottom: .3rem; }
th, td { border-bottom: 1px solid #dfe3e8; padding: .25rem 1.1rem .25rem 0; text-align: right; vertical-align: top; }
td { white-space: nowrap; }
th:first-child, td:first-child { text-align: left; } th { border-bottom: 2px solid #9aa3ad; }
.wide { overflow-x: auto; } code { background: #f2f4f6; padding: 0 .25rem; }
pre { background: #f2f4f6; padding: .6rem .8rem; font-size: .85rem; white-space: pre-wrap; overflow-wrap: anywhere; }
@page { size: A4; margin: 14mm; }
@media print {
  body { max-width: none; padding: 0; font-size: 10.5pt; } h2, h3 { break-after: avoid; } figure, tr { break-inside: avoid; }
  table { font-size: 9pt; } th, td { padding-right: .5rem; } td { white-space: normal; } .wide { overflow-x: visible; } pre { font-size: 8pt; }
}
)";

std::string cell(std::string_view tag, std::string_view text) {
  return "<" + std::string(tag) + ">" + escape_html(text) + "</" + std::string(tag) + ">";
}

void check_table(const HtmlTable& table) {
  for (const auto& row : table.rows) {
    if (row.size() == table.header.size()) continue;
    throw Error(ErrorKind::kCheckFailed, "a table has " + std::to_string(table.header.size()) +
                                             " headings and a row of " + std::to_string(row.size()) +
                                             " cells");
  }
}

}  // namespace

std::string escape_html(std::string_view text) {
  std::string safe;
  for (char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

void HtmlPage::heading(std::string_view text, std::string_view anchor) {
  body_ += "<h2" + (anchor.empty() ? "" : " id=\"" + escape_html(anchor) + "\"") + ">" + escape_html(text) +
           "</h2>\n";
}

std::string data_uri(std::string_view type, std::string_view bytes) {
  constexpr const char* kSigns = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text = "data:" + std::string(type) + ";base64,";
  // Three bytes are four signs of six bits; the last group is filled with '='.
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned word = 0;
    for (std::size_t k = 0; k < 3; ++k)
      word = (word << 8) | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kSigns[(word >> (18 - 6 * k)) & 63U] : '=';
  }
  return text;
}

void HtmlPage::subheading(std::string_view text) { body_ += cell("h3", text) + "\n"; }

void HtmlPage::listing(std::string_view text) { body_ += cell("pre", text) + "\n"; }

void HtmlPage::paragraph(std::string_view text) { body_ += cell("p", text) + "\n"; }

void HtmlPage::list(const std::vector<std::string>& items) {
  body_ += "<ul>\n";
  for (const std::string& item : items) body_ += cell("li", item) + "\n";
  body_ += "</ul>\n";
}

void HtmlPage::table(const HtmlTable& table) {
  check_table(table);
  body_ += "<div class=\"wide\"><table>\n";
  if (!table.caption.empty()) body_ += cell("caption", table.caption) + "\n";
  body_ += "<thead><tr>";
  for (const std::string& text : table.header) body_ += cell("th", text);
  body_ += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    body_ += "<tr>";
    for (const std::string& text : row) body_ += cell("td", text);
    body_ += "</tr>\n";
  }
  body_ += "</tbody></table></div>\n";
}

void HtmlPage::figure(std::string_view file, std::string_view caption, std::string_view alternative) {
  body_ += "<figure><img src=\"" + escape_html(file) + "\" alt=\"" + escape_html(alternative) + "\">" +
           cell("figcaption", caption) + "</figure>\n";
}

void HtmlPage::gallery(const std::vector<std::pair<std::string, std::string>>& file_and_label,
                       std::string_view caption) {
  body_ += "<figure><div class=\"gallery\">\n";
  for (const auto& [file, label] : file_and_label) {
    const bool linked = !file.starts_with("data:");
    body_ += "<div>" + (linked ? "<a href=\"" + escape_html(file) + "\">" : std::string());
    body_ += "<img src=\"" + escape_html(file) + "\" alt=\"" + escape_html(label) + "\">";
    body_ += (linked ? "</a>" : "") + escape_html(label) + "</div>\n";
  }
  body_ += "</div>" + cell("figcaption", caption) + "</figure>\n";
}

std::string HtmlPage::html() const {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
         cell("title", title_) + "\n<style>" + std::string(kStyle) + "</style>\n</head>\n<body>\n" +
         cell("h1", title_) + "\n" + body_ + "</body>\n</html>\n";
}

std::string to_csv(const HtmlTable& table) {
  check_table(table);
  std::string text = csv_row(table.header);
  for (const auto& row : table.rows) text += csv_row(row);
  return text;
}

}  // namespace fuai
