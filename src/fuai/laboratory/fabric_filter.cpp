// Filters fabrics.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/fabric_filter.h"

#include <algorithm>

#include "fuai/io/fabric_fields.h"
#include "fuai/laboratory/fabric_numbers.h"

namespace fuai {
namespace {

/// Latin capitals as small letters; other bytes stay.
std::string small(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string all_text(const Fabric& fabric) {
  std::string text = fabric.id + "\n" + fabric.name + "\n" + fabric.composition + "\n" + fabric.note;
  Fabric copy = fabric;
  for (const FabricField& field : fabric_fields(copy)) {
    if (field.value->has_value()) text += "\n" + field.value->provenance.source;
  }
  return small(std::move(text));
}

}  // namespace

bool passes(const FabricFilter& filter, const Fabric& fabric) {
  const double mass = fabric.areal_mass.value;
  if (!(mass >= filter.least_mass) || !(mass <= filter.most_mass)) return false;
  const std::vector<std::string> blocks = measured_blocks(fabric);
  const bool measured = std::ranges::all_of(filter.measured, [&](const std::string& block) {
    return std::ranges::find(blocks, block) != blocks.end();
  });
  if (!measured) return false;
  const std::string text = all_text(fabric);
  return std::ranges::all_of(
      filter.words, [&](const std::string& word) { return text.find(small(word)) != std::string::npos; });
}

}  // namespace fuai
