// Understands the headers of KES sheets, English and Japanese: quantity, direction, unit.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/kes_header.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "fuai/core/error.h"
#include "fuai/io/header_cell.h"

namespace fuai {
namespace {

using Words = std::vector<std::string>;

struct Alias {
  Words words;
  SheetRole role = SheetRole::kQuantity;
  Kes quantity = Kes::kW;
};

/// Further names besides symbol, English and Japanese name of the table of quantities. "@0.5" and "@5" stand
/// for the shear angle in brackets.
constexpr std::pair<std::string_view, Kes> kMoreNames[] = {
    {"引張直線性", Kes::kLT},
    {"引張リニアリティ", Kes::kLT},
    {"tensile energy", Kes::kWT},
    {"引張仕事量", Kes::kWT},
    {"引張エネルギー", Kes::kWT},
    {"引張レジリエンス", Kes::kRT},
    {"引張回復性", Kes::kRT},
    {"EM", Kes::kEMT},
    {"elongation", Kes::kEMT},
    {"伸び率", Kes::kEMT},
    {"最大伸び率", Kes::kEMT},
    {"伸長率", Kes::kEMT},
    {"shear stiffness", Kes::kG},
    {"剪断剛性", Kes::kG},
    {"せん断かたさ", Kes::kG},
    {"2HG0.5", Kes::k2HG},
    {"2HG @0.5", Kes::k2HG},
    {"shear hysteresis @0.5", Kes::k2HG},
    {"せん断ヒステリシス @0.5", Kes::k2HG},
    {"2HG @5", Kes::k2HG5},
    {"shear hysteresis @5", Kes::k2HG5},
    {"せん断ヒステリシス @5", Kes::k2HG5},
    {"bending stiffness", Kes::kB},
    {"曲げかたさ", Kes::kB},
    {"曲げ硬さ", Kes::kB},
    {"compression energy", Kes::kWC},
    {"圧縮エネルギー", Kes::kWC},
    {"圧縮回復性", Kes::kRC},
    {"friction coefficient", Kes::kMIU},
    {"摩擦係数", Kes::kMIU},
    {"摩擦係数の変動", Kes::kMMD},
    {"roughness", Kes::kSMD},
    {"surface roughness", Kes::kSMD},
    {"表面粗さ", Kes::kSMD},
    {"thickness", Kes::kT},
    {"T0", Kes::kT},
    {"To", Kes::kT},
    {"厚み", Kes::kT},
    {"weight", Kes::kW},
    {"mass", Kes::kW},
    {"areal density", Kes::kW},
    {"重さ", Kes::kW},
    {"重量", Kes::kW},
    {"目付", Kes::kW},
    {"目付け", Kes::kW},
    {"質量", Kes::kW},
};

constexpr std::pair<std::string_view, SheetRole> kOtherNames[] = {
    {"name", SheetRole::kName},
    {"fabric name", SheetRole::kName},
    {"sample name", SheetRole::kName},
    {"名称", SheetRole::kName},
    {"試料名", SheetRole::kName},
    {"布名", SheetRole::kName},
    {"生地名", SheetRole::kName},
    {"fabric", SheetRole::kCode},
    {"sample", SheetRole::kCode},
    {"specimen", SheetRole::kCode},
    {"id", SheetRole::kCode},
    {"試料", SheetRole::kCode},
    {"布", SheetRole::kCode},
    {"生地", SheetRole::kCode},
    {"composition", SheetRole::kComposition},
    {"composition weave", SheetRole::kComposition},
    {"material", SheetRole::kComposition},
    {"組成", SheetRole::kComposition},
    {"素材", SheetRole::kComposition},
    {"混用率", SheetRole::kComposition},
    {"node count", SheetRole::kNodeCount},
    {"nodes", SheetRole::kNodeCount},
    {"ノード数", SheetRole::kNodeCount},
};

/// Names that fit more than one quantity, with those quantities.
constexpr std::pair<std::string_view, std::string_view> kAmbiguous[] = {
    {"hysteresis", "2HB, 2HG or 2HG5"},
    {"ヒステリシス", "2HB, 2HG or 2HG5"},
    {"2h", "2HB, 2HG or 2HG5"},
    {"shear hysteresis", "2HG or 2HG5"},
    {"せん断ヒステリシス", "2HG or 2HG5"},
    {"linearity", "LT or LC"},
    {"直線性", "LT or LC"},
    {"resilience", "RT or RC"},
    {"レジリエンス", "RT or RC"},
    {"energy", "WT or WC"},
    {"仕事量", "WT or WC"},
    {"rigidity", "B or G"},
    {"stiffness", "B or G"},
    {"剛性", "B or G"},
};

constexpr std::pair<std::string_view, Direction> kDirectionWords[] = {
    {"warp", Direction::kWarp},     {"たて", Direction::kWarp},     {"タテ", Direction::kWarp},
    {"経", Direction::kWarp},       {"縦", Direction::kWarp},       {"経糸", Direction::kWarp},
    {"経方向", Direction::kWarp},   {"たて方向", Direction::kWarp}, {"weft", Direction::kWeft},
    {"よこ", Direction::kWeft},     {"ヨコ", Direction::kWeft},     {"緯", Direction::kWeft},
    {"横", Direction::kWeft},       {"緯糸", Direction::kWeft},     {"緯方向", Direction::kWeft},
    {"よこ方向", Direction::kWeft}, {"bias", Direction::kBias},     {"バイアス", Direction::kBias},
};

constexpr std::array<std::string_view, 4> kMeanWords = {"mean", "average", "ave", "平均"};

/// Full-width ASCII (U+FF01 to U+FF5E) becomes ASCII, the ideographic space a blank.
std::string to_half_width(std::string_view text) {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = [&](std::size_t k) {
      return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0;
    };
    if (byte(0) == 0xE3 && byte(1) == 0x80 && byte(2) == 0x80) {
      result += ' ';
      i += 2;
    } else if (byte(0) == 0xEF && byte(1) == 0xBC && byte(2) >= 0x81 && byte(2) <= 0xBF) {
      result += static_cast<char>(byte(2) - 0x81 + 0x21);
      i += 2;
    } else if (byte(0) == 0xEF && byte(1) == 0xBD && byte(2) >= 0x80 && byte(2) <= 0x9E) {
      result += static_cast<char>(byte(2) - 0x80 + 0x60);
      i += 2;
    } else {
      result += text[i];
    }
  }
  return result;
}

std::optional<Direction> direction_of(std::string_view word) {
  const std::string lower = ascii_lower(word);
  for (const auto& [name, direction] : kDirectionWords) {
    if (lower == name) return direction;
  }
  return std::nullopt;
}

bool is_mean_word(std::string_view word) {
  return std::find(kMeanWords.begin(), kMeanWords.end(), ascii_lower(word)) != kMeanWords.end();
}

/// "@0.5" or "@5" of "0.5°", "5 deg" and the like; empty for anything else.
std::string angle_word(std::string group) {
  group.erase(std::remove(group.begin(), group.end(), ' '), group.end());
  for (const std::string_view degree : {"°", "deg", "度"}) {
    if (!group.ends_with(degree)) continue;
    const std::string number = group.substr(0, group.size() - degree.size());
    if (number == "0.5") return "@0.5";
    if (number == "5" || number == "5.0") return "@5";
  }
  return {};
}

/// The words of a name with the angle in its brackets, if any.
Words alias_words(std::string_view name) {
  const HeaderParts parts = split_header(name);
  Words words = split_words(parts.name);
  for (const std::string& group : parts.groups) {
    if (const std::string angle = angle_word(group); !angle.empty()) words.push_back(angle);
  }
  return words;
}

const std::vector<Alias>& aliases() {
  static const std::vector<Alias> kAliases = [] {
    std::vector<Alias> list;
    for (const KesQuantity& q : kes_quantities()) {
      for (const std::string_view name : {q.symbol, q.name_en, q.name_ja})
        list.push_back({alias_words(name), SheetRole::kQuantity, q.id});
    }
    for (const auto& [name, id] : kMoreNames) list.push_back({alias_words(name), SheetRole::kQuantity, id});
    for (const auto& [name, role] : kOtherNames) list.push_back({alias_words(name), role, Kes::kW});
    return list;
  }();
  return kAliases;
}

/// Symbols are told apart by case ("T" is the thickness, "t" may be a time); names are not.
bool same_word(const std::string& a, const std::string& b) {
  constexpr std::size_t kLongestSymbol = 4;
  return a == b || (a.size() > kLongestSymbol && ascii_lower(a) == ascii_lower(b)) ||
         (a.size() == kLongestSymbol && ascii_lower(a) == b);
}

/// The alias with the most words that the words start with.
const Alias* match(const Words& words) {
  const Alias* best = nullptr;
  for (const Alias& alias : aliases()) {
    const Words& a = alias.words;
    const bool starts =
        a.size() <= words.size() &&
        std::equal(a.begin(), a.end(), words.begin(),
                   [](const std::string& x, const std::string& y) { return same_word(y, x); });
    if (starts && (!best || a.size() > best->words.size())) best = &alias;
  }
  return best;
}

/// Cuts a direction off one word: "B-1", "B1", "B-warp", "経B", "Bたて". False when there is none.
bool cut_direction(std::string& word, SheetHeader& header) {
  for (const auto& [name, direction] : kDirectionWords) {
    const bool ascii = name.front() >= 'a' && name.front() <= 'z';
    const std::string lower = ascii_lower(word);
    if (word.size() <= name.size() + (ascii ? 1 : 0)) continue;
    if (lower.ends_with(name) && (!ascii || word[word.size() - name.size() - 1] == '-')) {
      word.resize(word.size() - name.size() - (ascii ? 1 : 0));
    } else if (lower.starts_with(name) && (!ascii || word[name.size()] == '-')) {
      word.erase(0, name.size() + (ascii ? 1 : 0));
    } else {
      continue;
    }
    header.direction = direction;
    return true;
  }
  if (word.size() < 2 || (word.back() != '1' && word.back() != '2')) return false;
  std::string symbol = word.substr(0, word.size() - 1);
  if (symbol.ends_with('-')) symbol.pop_back();
  const std::optional<Kes> id = find_kes(symbol);
  if (!id) return false;
  header.direction = word.back() == '1' ? Direction::kWarp : Direction::kWeft;
  header.numbered = true;
  word = symbol;
  return true;
}

[[noreturn]] void fail(std::string_view header, const std::string& what, const std::string& cure) {
  throw Error(ErrorKind::kUsage, "the header '" + std::string(header) + "' " + what, {}, cure);
}

/// Takes direction, mean and number out of the words behind the name; what remains is the unit.
Words take_direction(Words rest, SheetHeader& header) {
  Words unit_words;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    const bool numbered = i == 0 && (rest[i] == "1" || rest[i] == "2" || rest[i] == "-1" || rest[i] == "-2");
    if (const auto direction = direction_of(rest[i])) {
      header.direction = direction;
    } else if (is_mean_word(rest[i])) {
      header.is_mean = true;
    } else if (numbered) {
      header.direction = rest[i].back() == '1' ? Direction::kWarp : Direction::kWeft;
      header.numbered = true;
    } else {
      unit_words.push_back(rest[i]);
    }
  }
  return unit_words;
}

/// Sorts the brackets into direction, mean, angle (appended to the words) and unit; returns those not
/// understood.
Words read_groups(const Words& groups, Words& words, SheetHeader& header) {
  Words unknown;
  for (const std::string& group : groups) {
    if (const auto direction = direction_of(group)) {
      header.direction = direction;
    } else if (is_mean_word(group)) {
      header.is_mean = true;
    } else if (const std::string angle = angle_word(group); !angle.empty()) {
      words.push_back(angle);
    } else if (const auto unit = try_parse_unit(group); unit && !header.unit) {
      header.unit = unit;
    } else {
      unknown.push_back(group);
    }
  }
  return unknown;
}

}  // namespace

SheetHeader read_sheet_header(std::string_view text) {
  SheetHeader header;
  const HeaderParts parts = split_header(to_half_width(text));
  Words words = split_words(parts.name);
  const Words unknown = read_groups(parts.groups, words, header);
  if (words.empty()) return header;
  if (const auto direction = direction_of(words[0]); direction && words.size() > 1) {
    header.direction = direction;
    words.erase(words.begin());
  }
  const Alias* alias = match(words);
  if (!alias && cut_direction(words[0], header)) alias = match(words);
  std::string name;
  for (const std::string& word : words) name += (name.empty() ? "" : " ") + ascii_lower(word);
  for (const auto& [ambiguous, candidates] : kAmbiguous) {
    if (name == ambiguous) fail(text, "is ambiguous", "write the symbol: " + std::string(candidates));
  }
  if (!alias) return SheetHeader{};
  const Words rest =
      take_direction({words.begin() + static_cast<std::ptrdiff_t>(alias->words.size()), words.end()}, header);
  if (!rest.empty()) {
    const std::optional<Unit> unit = unit_from_words(rest);
    if (!unit) return SheetHeader{};  // some other column that begins like a quantity
    if (header.unit) fail(text, "states two units", "keep one of them");
    header.unit = unit;
  }
  header.role = alias->role;
  header.quantity = alias->quantity;
  if (header.role == SheetRole::kQuantity && !unknown.empty()) {
    fail(text, "has '" + unknown.front() + "' in brackets, which is neither a known unit nor a direction",
         "write warp or weft for a direction, a unit like gf·cm²/cm otherwise");
  }
  return header;
}

std::optional<Unit> read_sheet_unit(std::string_view cell) {
  const HeaderParts parts = split_header(to_half_width(cell));
  if (parts.name.empty() && parts.groups.size() == 1) return try_parse_unit(parts.groups[0]);
  return try_parse_unit(cell);
}

bool has_direction(Kes quantity) {
  const std::string_view block = kes_quantity(quantity).block;
  return block == "bending" || block == "tensile";
}

}  // namespace fuai
