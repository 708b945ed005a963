// Composes a self-explaining HTML page of headings, paragraphs, tables and pictures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace fuai {

/// A file that an experiment made; the caller writes it.
struct OutputFile {
  std::string name;  ///< relative to the output folder
  std::string bytes;
};

/// Text with &, <, > and quotes made safe for HTML.
std::string escape_html(std::string_view text);

/// An address that holds the file itself, so that a page needs no other file: "data:image/png;base64,...".
/// @param type of the content, "image/png". Thread class: any.
std::string data_uri(std::string_view type, std::string_view bytes);

/// A table: header and rows of plain text; columns after the first are aligned to the right.
struct HtmlTable {
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  std::string caption;
};

/// Builds the page top-down. Text is plain and escaped; `raw` is not.
class HtmlPage {
 public:
  explicit HtmlPage(std::string title) : title_(std::move(title)) {}

  void heading(std::string_view text, std::string_view anchor = {});
  void subheading(std::string_view text);
  void paragraph(std::string_view text);
  /// Text with its line ends, in letters of equal width: command lines, files.
  void listing(std::string_view text);
  void list(const std::vector<std::string>& items);
  void table(const HtmlTable& table);
  /// A picture with its caption; `file` is relative to the page, or a data_uri().
  void figure(std::string_view file, std::string_view caption, std::string_view alternative);
  /// Several pictures side by side under one caption; those that are files are links to them.
  void gallery(const std::vector<std::pair<std::string, std::string>>& file_and_label,
               std::string_view caption);
  void raw(std::string_view html) { body_ += html; }

  /// The whole document.
  std::string html() const;

 private:
  std::string title_, body_;
};

/// Both this and HtmlPage::table() throw Error (kCheckFailed) when a row has not as many cells as the header.
/// A table as CSV text: commas, quotes where needed, one line a row.
std::string to_csv(const HtmlTable& table);

}  // namespace fuai
