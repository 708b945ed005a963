// `fuai fabric compare`.
// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "fabric_text.h"
#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/fabric_comparison.h"

namespace fuai_app {
namespace {

using namespace fuai;

constexpr int kValueColumns = 11, kDifferenceColumns = 14;

std::string bracketed(std::size_t i) { return "[" + std::to_string(i + 1) + "]"; }

std::string head_of(const FabricNumber& n) {
  return "  " + padded(n.section, 13) + padded(std::string(n.definition().symbol), 6);
}

void print_values(const Console& console, const FabricComparison& comparison) {
  std::string line = "  " + padded("section", 13) + padded("", 6);
  for (std::size_t i = 0; i < comparison.fabrics.size(); ++i) line += padded(bracketed(i), kValueColumns);
  console.line(line + "unit");
  for (const ComparedNumber& number : comparison.numbers) {
    line = head_of(number.first());
    for (const FabricNumber& n : number.each) {
      const bool known = n.known.has_value();
      const std::string mark = known ? " " + std::string(1, to_string(n.known.provenance.kind)[0]) : "";
      line += padded((known ? format_number(n.in_kes_units()) : "-") + mark, kValueColumns);
    }
    console.line(line + std::string(number.first().definition().kes_unit));
  }
  console.line("  m measured, c computed from a measured curve, f fitted, s statistic of many, a assumed");
}

/// "-72 % (-6.3)", "-72 %", "-".
std::string difference_text(double change, double jnd) {
  char percent[32] = "-", steps[32] = "";
  if (!std::isnan(change)) std::snprintf(percent, sizeof percent, "%+.0f %%", 100.0 * change);
  if (!std::isnan(jnd)) std::snprintf(steps, sizeof steps, " (%+.1f)", jnd);
  return std::string(percent) + steps;
}

void print_differences(const Console& console, const FabricComparison& comparison) {
  console.line("Difference from [1], in brackets in just-noticeable differences where one is known");
  std::string line = "  " + padded("section", 13) + padded("", 6);
  for (std::size_t i = 1; i < comparison.fabrics.size(); ++i)
    line += padded(bracketed(i), kDifferenceColumns);
  console.line(line + "threshold");
  int left_out = 0;
  for (const ComparedNumber& number : comparison.numbers) {
    line = head_of(number.first());
    bool any = false;
    for (std::size_t i = 1; i < number.each.size(); ++i) {
      any = any || !std::isnan(number.change[i]) || !std::isnan(number.jnd[i]);
      line += padded(difference_text(number.change[i], number.jnd[i]), kDifferenceColumns);
    }
    left_out += any ? 0 : 1;
    if (any) console.line(line + (number.threshold ? number.threshold->in_words : "-"));
  }
  if (left_out > 0) {
    print_wrapped(console, "  ",
                  std::to_string(left_out) +
                      " more have no difference: one side is assumed or unknown, or they were read at other "
                      "settings (another load, tension or tester)",
                  2);
  }
  for (const Threshold& t : comparison.thresholds) {
    if (!t.quantities.empty())
      print_wrapped(console, "  " + t.in_words + ": ", t.what + " (" + t.remark + ")", 4);
  }
}

JsonValue number_or_null(double value, double factor) {
  return std::isnan(value) ? JsonValue() : JsonValue(factor * value);
}

JsonValue json_of(const ComparedNumber& number) {
  JsonValue values{JsonValue::Array{}}, kinds{JsonValue::Array{}}, sources{JsonValue::Array{}};
  JsonValue conditions{JsonValue::Array{}}, percents{JsonValue::Array{}}, jnds{JsonValue::Array{}};
  for (std::size_t i = 0; i < number.each.size(); ++i) {
    const FabricNumber& n = number.each[i];
    const bool known = n.known.has_value();
    values.push(known ? JsonValue(n.in_kes_units()) : JsonValue());
    kinds.push(known ? JsonValue(to_string(n.known.provenance.kind)) : JsonValue());
    sources.push(known ? JsonValue(n.known.provenance.source) : JsonValue());
    conditions.push(n.condition.empty() ? JsonValue() : JsonValue(n.condition));
    percents.push(number_or_null(number.change[i], 100.0));
    jnds.push(number_or_null(number.jnd[i], 1.0));
  }
  const KesQuantity& q = number.first().definition();
  JsonValue json;
  json.set("unit", std::string(q.kes_unit)).set("si_unit", std::string(q.si_unit)).set("si_factor", q.to_si);
  json.set("values", values).set("kinds", kinds).set("sources", sources).set("conditions", conditions);
  json.set("difference_percent", percents).set("difference_jnd", jnds);
  return json.set("threshold", number.threshold ? JsonValue(number.threshold->in_words) : JsonValue());
}

JsonValue json_of(const FabricComparison& comparison) {
  JsonValue fabrics{JsonValue::Array{}}, numbers{JsonValue::Object{}}, thresholds{JsonValue::Array{}};
  for (const Fabric& fabric : comparison.fabrics) {
    JsonValue entry;
    fabrics.push(entry.set("id", fabric.id).set("name", fabric.name).set("composition", fabric.composition));
  }
  for (const ComparedNumber& number : comparison.numbers) numbers.set(number.first().path(), json_of(number));
  for (const Threshold& t : comparison.thresholds) {
    JsonValue entry, symbols{JsonValue::Array{}};
    for (const Kes quantity : t.quantities) symbols.push(std::string(kes_quantity(quantity).symbol));
    entry.set("quantities", symbols).set("threshold", t.in_words).set("what", t.what);
    entry.set("condition", t.condition).set("remark", t.remark).set("source", t.source);
    thresholds.push(entry);
  }
  JsonValue json;
  json.set("fabrics", fabrics).set("reference", comparison.fabrics.front().id);
  return json.set("numbers", numbers).set("thresholds", thresholds);
}

int run_compare(const Console& console, const std::vector<std::string>& names) {
  check_compared_count(names.size());
  std::vector<Fabric> fabrics;
  for (const std::string& name : names) {
    fabrics.push_back(load_fabric(name));
    for (const std::string& warning : fabrics.back().warnings) console.warn(warning);
  }
  const FabricComparison comparison = compare_fabrics(fabrics, bundled_thresholds());
  for (std::size_t i = 0; i < fabrics.size(); ++i) {
    console.line(bracketed(i) + " " + fabrics[i].name + " (" + fabrics[i].id +
                 (fabrics[i].composition.empty() ? "" : "; " + fabrics[i].composition) + ")");
  }
  print_values(console, comparison);
  print_differences(console, comparison);
  console.result(json_of(comparison));
  return 0;
}

}  // namespace

void declare_compare(const Command& parent) {
  const auto names = std::make_shared<std::vector<std::string>>();
  const Command command = parent.command(
      "compare", "Two to six fabrics side by side, differences in just-noticeable differences");
  command
      .option("FABRIC", *names,
              "Two to six bundled names or paths of fabric files; the first is compared with")
      .required();
  command.examples({"fuai fabric compare wool-tropical polyester-faille",
                    "fuai --json fabric compare graded-1 graded-3 graded-6 graded-10"});
  command.body([names](const Console& console) { return run_compare(console, *names); });
}

}  // namespace fuai_app
