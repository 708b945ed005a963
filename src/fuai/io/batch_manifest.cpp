// Reads the manifest of a batch (fuai-batch/1).
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/batch_manifest.h"

#include <algorithm>
#include <cmath>

#include "fuai/io/nearest_name.h"
#include "fuai/io/number_text.h"
#include "fuai/io/text_file.h"
#include "fuai/io/toml_tree.h"

namespace fuai {
namespace {

constexpr std::string_view kFormat = "fuai-batch/1";

/// Members in the order of the file.
std::vector<const TomlMember*> in_order(const TomlNode& table) {
  std::vector<const TomlMember*> members;
  for (const TomlMember& member : table.members) members.push_back(&member);
  std::ranges::stable_sort(members, [](const TomlMember* a, const TomlMember* b) {
    return a->line != b->line ? a->line < b->line : a->column < b->column;
  });
  return members;
}

/// Walks over the tree of one manifest.
class ManifestReader {
 public:
  explicit ManifestReader(const std::string& path) : path_(path) {}

  BatchManifest read(const TomlNode& root) const {
    check_format(root);
    check_top_level(root);
    const TomlNode* fabrics = root.find("fabrics");
    const std::vector<BatchValue> common =
        fabrics ? fabrics_of(*fabrics, "fabrics") : std::vector<BatchValue>();
    const TomlNode* cases = root.find("cases");
    if (!cases)
      throw Error(ErrorKind::kBadInput, "there are no cases", {path_, 0, 0, "cases"},
                  "write [[cases]] and below it command = \"drape\"");
    if (!cases->is_list() || cases->items.empty())
      fail(*cases, "cases", "a list of tables is expected",
           "write [[cases]], with two brackets on each side");
    BatchManifest manifest;
    manifest.path = path_;
    for (std::size_t i = 0; i < cases->items.size(); ++i)
      manifest.blocks.push_back(read_block(cases->items[i], "cases[" + std::to_string(i) + "]", common));
    return manifest;
  }

 private:
  template <class Placed>
  Where place(const Placed& at, const std::string& key) const {
    return {path_, at.line, at.column, key};
  }

  template <class Placed>
  [[noreturn]] void fail(const Placed& at, const std::string& key, const std::string& what,
                         const std::string& cure) const {
    throw Error(ErrorKind::kBadInput, what, place(at, key), cure);
  }

  void check_format(const TomlNode& root) const {
    const std::string cure = "write format = \"" + std::string(kFormat) + "\" at the top of the file";
    const TomlNode* format = root.find("format");
    if (!format) throw Error(ErrorKind::kBadInput, "'format' is missing", {path_, 0, 0, "format"}, cure);
    if (!format->is_text() || format->text != kFormat)
      fail(*format, "format", "the format is '" + format->text.substr(0, 40) + "'", cure);
  }

  void check_top_level(const TomlNode& root) const {
    const std::vector<std::string> known{"format", "fabrics", "cases"};
    for (const TomlMember* member : in_order(root)) {
      if (std::ranges::find(known, member->key) != known.end()) continue;
      const std::vector<std::string> nearest = nearest_names(member->key, known);
      fail(*member, member->key, "unknown key",
           nearest.empty()
               ? "settings stand below a [[cases]], the top has " + either(known)
               : "the nearest known key is " + nearest.front() + "; settings stand below a [[cases]]");
    }
  }

  /// Texts, or one text.
  std::vector<BatchValue> fabrics_of(const TomlNode& node, const std::string& key) const {
    std::vector<BatchValue> fabrics = values_of(node, key);
    for (const BatchValue& fabric : fabrics) {
      if (fabric.kind == BatchValue::Kind::kText && fabric.words.size() == 1 && !fabric.words.front().empty())
        continue;
      throw Error(ErrorKind::kBadInput, "a fabric is a text", fabric.where,
                  "write the name of a bundled fabric or the path of a fabric file in quotes");
    }
    return fabrics;
  }

  BatchBlock read_block(const TomlNode& node, const std::string& key,
                        const std::vector<BatchValue>& common) const {
    if (!node.is_table())
      fail(node, key, "a table is expected", "write [[cases]], with two brackets on each side");
    BatchBlock block;
    block.fabrics = common;
    const TomlNode* command = node.find("command");
    if (!command || !command->is_text())
      fail(node, key + ".command", "there is no command", "write command = \"drape\"");
    block.command = command->text;
    block.where = place(*command, key + ".command");
    for (const TomlMember* member : in_order(node)) {
      const std::string path = key + "." + member->key;
      if (member->key == "command") continue;
      if (member->key == "fabrics") {
        block.fabrics = fabrics_of(member->value, path);
      } else if (member->key == "variants") {
        block.variants = variants_of(member->value, path);
      } else {
        block.settings.push_back(setting_of(*member, path));
      }
    }
    check_once(block);
    return block;
  }

  std::vector<std::vector<BatchSetting>> variants_of(const TomlNode& node, const std::string& key) const {
    const char* const cure = R"(write [{ disc = "18cm", specimen = "30cm" }, { disc = ... }])";
    if (!node.is_list() || node.items.empty()) fail(node, key, "a list of tables is expected", cure);
    std::vector<std::vector<BatchSetting>> variants;
    for (const TomlNode& item : node.items) {
      if (!item.is_table()) fail(item, key, "a table is expected", cure);
      std::vector<BatchSetting>& variant = variants.emplace_back();
      for (const TomlMember* member : in_order(item)) {
        variant.push_back(setting_of(*member, key + "." + member->key));
        if (variant.back().values.size() != 1)
          fail(*member, key + "." + member->key, "a variant has one value a setting",
               "write a table for each, or move the list out of the variants");
      }
    }
    return variants;
  }

  /// What varies by itself cannot belong to a variant.
  static void check_once(const BatchBlock& block) {
    for (const auto& variant : block.variants) {
      for (const BatchSetting& setting : variant) {
        if (std::ranges::find(block.settings, setting.name, &BatchSetting::name) == block.settings.end())
          continue;
        throw Error(ErrorKind::kBadInput, "'" + setting.name + "' stands in the variants and beside them",
                    setting.where, "write it in one of the two places");
      }
    }
  }

  BatchSetting setting_of(const TomlMember& member, const std::string& key) const {
    return {member.key, values_of(member.value, key), place(member, key)};
  }

  std::vector<BatchValue> values_of(const TomlNode& node, const std::string& key) const {
    std::vector<BatchValue> values;
    if (!node.is_list()) return {value_of(node, key)};
    if (node.items.empty())
      fail(node, key, "the list is empty", "write at least one value, or remove the key");
    for (const TomlNode& item : node.items) values.push_back(value_of(item, key));
    return values;
  }

  BatchValue value_of(const TomlNode& node, const std::string& key) const {
    BatchValue value;
    value.where = place(node, key);
    if (node.kind == TomlNode::Kind::kBoolean) {
      value.kind = BatchValue::Kind::kBoolean;
      value.boolean = node.boolean;
    } else if (node.is_list() && !node.items.empty()) {
      for (const TomlNode& item : node.items) value.words.push_back(word_of(item, key));
    } else {
      value.words = {word_of(node, key)};
      if (node.is_number()) value.kind = BatchValue::Kind::kNumber;
    }
    return value;
  }

  std::string word_of(const TomlNode& node, const std::string& key) const {
    if (node.is_number() && !std::isfinite(node.number))
      fail(node, key, "the number is not finite", "write a finite number");
    if (node.is_text()) return checked(node, key);
    if (node.kind == TomlNode::Kind::kInteger) return std::to_string(node.integer);
    if (node.kind == TomlNode::Kind::kNumber) return number_text(node.number);
    fail(node, key, "a text, a number, true or false is expected",
         R"(write one such as "5mm", or a list of them)");
  }

  std::string checked(const TomlNode& node, const std::string& key) const {
    if (node.text.find('\0') != std::string::npos) fail(node, key, "there is a NUL character", "remove it");
    return node.text;
  }

  const std::string& path_;
};

}  // namespace

BatchManifest parse_batch_manifest(std::string_view text, const std::string& path) {
  return ManifestReader(path).read(parse_toml(text, path));
}

BatchManifest read_batch_manifest(const std::string& path) {
  return parse_batch_manifest(read_text_file(path, kLargestManifest), path);
}

}  // namespace fuai
