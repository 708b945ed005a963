// The fabrics one can choose from: found by words, sorted by a number that tells them apart.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fuai/fabric/provenance.h"
#include "fuai/units/kes.h"

namespace fuai {

/// What the list can be sorted by.
enum class ChoiceColumn : std::uint8_t { kName, kWeight, kBending, kShear };
/// Columns with numbers, after the name.
inline constexpr std::size_t kChoiceNumbers = 3;
/// The quantity behind a column with numbers: W, B (mean of warp and weft), G. Thread class: any.
const KesQuantity& choice_quantity(std::size_t number);

/// A fabric of the list.
struct FabricChoice {
  std::string id;  ///< as load_fabric() takes it
  std::string name, composition;
  std::array<double, kChoiceNumbers> numbers{};  ///< [SI]; NaN: unknown
  std::array<bool, kChoiceNumbers> assumed{};    ///< not of this very cloth
};

/// @throws Error as load_fabric(). Thread class: set-up.
FabricChoice make_fabric_choice(const std::string& id);

/// Numbers of those whose id, name or composition has every word of the text, whatever the case of its Latin
/// letters, in an order: by name, or by a number, unknown ones last. Thread class: any.
std::vector<std::size_t> choose_fabrics(const std::vector<FabricChoice>& all, const std::string& text,
                                        ChoiceColumn by, bool descending);

}  // namespace fuai
