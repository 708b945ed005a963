// Finds and sorts fabrics.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/fabric_choice.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>

#include "fuai/io/fabric_library.h"
#include "fuai/laboratory/fabric_numbers.h"

namespace fuai {
namespace {

constexpr Kes kQuantities[kChoiceNumbers] = {Kes::kW, Kes::kB, Kes::kG};

std::string lower(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x80) c = static_cast<char>(std::tolower(c));
  return text;
}

bool fits(const FabricChoice& fabric, const std::string& text) {
  const std::string all = lower(fabric.id + "\n" + fabric.name + "\n" + fabric.composition);
  std::istringstream words(lower(text));
  for (std::string word; words >> word;)
    if (all.find(word) == std::string::npos) return false;
  return true;
}

}  // namespace

const KesQuantity& choice_quantity(std::size_t number) { return kes_quantity(kQuantities[number]); }

FabricChoice make_fabric_choice(const std::string& id) {
  const Fabric fabric = load_fabric(id);
  FabricChoice choice{id, fabric.name, fabric.composition, {}, {}};
  const std::vector<FabricNumber> numbers = fabric_numbers(fabric, make_fabric_laws(fabric));
  for (std::size_t i = 0; i < kChoiceNumbers; ++i) {
    double sum = 0.0;
    int count = 0;
    for (const FabricNumber& number : numbers) {
      if (number.quantity != kQuantities[i] || number.section.ends_with(".bias") || !number.known.has_value())
        continue;
      sum += number.known.value;
      ++count;
      if (!is_evidence(number.known.provenance)) choice.assumed[i] = true;
    }
    choice.numbers[i] = count > 0 ? sum / count : std::numeric_limits<double>::quiet_NaN();
  }
  return choice;
}

std::vector<std::size_t> choose_fabrics(const std::vector<FabricChoice>& all, const std::string& text,
                                        ChoiceColumn by, bool descending) {
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (fits(all[i], text)) chosen.push_back(i);
  const auto before = [&](std::size_t a, std::size_t b) {
    if (by == ChoiceColumn::kName) return descending ? all[b].name < all[a].name : all[a].name < all[b].name;
    const auto column = static_cast<std::size_t>(by) - 1;
    const double x = all[a].numbers[column], y = all[b].numbers[column];
    if (!std::isfinite(x) || !std::isfinite(y)) return std::isfinite(x) && !std::isfinite(y);
    return descending ? y < x : x < y;
  };
  std::stable_sort(chosen.begin(), chosen.end(), before);
  return chosen;
}

}  // namespace fuai
