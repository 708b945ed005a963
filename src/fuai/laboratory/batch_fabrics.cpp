// The fabrics that a batch manifest names.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/laboratory/batch_fabrics.h"

#include <algorithm>
#include <filesystem>

#include "fuai/core/hash.h"
#include "fuai/io/curve_csv.h"
#include "fuai/io/fabric_fields.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/fabric_library.h"
#include "fuai/io/nearest_name.h"
#include "fuai/io/text_file.h"

namespace fuai {
namespace {

namespace fs = std::filesystem;

std::string hash_of(const std::string& path) {
  StateHash hash;
  const auto add = [&](const std::string& text) { hash.add(text.data(), text.size()); };
  try {
    Fabric fabric = load_fabric(path);
    add(format_fabric(fabric));
    for (const FabricCurveField& field : fabric_curve_fields(fabric))
      if (*field.curve) add(format_curve_csv((*field.curve)->curve));
  } catch (const Error&) {
    // The case itself will say what is wrong with the file.
    std::error_code code;
    if (fs::is_regular_file(path, code)) add(read_bytes(path));
  }
  return hash.hex();
}

bool is_path(const std::string& word) {
  return word.find('/') != std::string::npos || word.ends_with(".toml");
}

/// Fabric files of a folder, by name.
std::vector<std::string> files_of(const fs::path& folder, const BatchValue& word) {
  std::error_code code;
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, code)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".fabric.toml") && !name.starts_with('.')) names.push_back(name);
  }
  if (code)
    throw Error(ErrorKind::kBadInput,
                "the folder '" + folder.string() + "' cannot be read: " + code.message(), word.where,
                "correct the path; it begins at the manifest's folder");
  if (names.empty())
    throw Error(ErrorKind::kBadInput, "there is no fabric file in '" + folder.string() + "'", word.where,
                "fabric files end in .fabric.toml");
  std::ranges::sort(names);
  return names;
}

}  // namespace

std::vector<BatchFabric> find_batch_fabrics(const std::vector<BatchValue>& words,
                                            const std::string& manifest) {
  const std::vector<std::string> bundled = bundled_fabric_ids();
  const fs::path beside = fs::path(manifest).parent_path();
  std::vector<BatchFabric> fabrics;
  const auto add = [&](const std::string& name, const std::string& path) {
    fabrics.push_back({name, path, fabric_id_of(path), hash_of(path)});
  };
  for (const BatchValue& value : words) {
    const std::string& word = value.words.front();
    if (word == "bundled") {
      for (const std::string& id : bundled) add(id, id);
    } else if (!is_path(word)) {
      if (std::ranges::find(bundled, word) == bundled.end()) {
        const std::vector<std::string> nearest = nearest_names(word, bundled);
        throw Error(ErrorKind::kBadInput, "no bundled fabric is called '" + word + "'", value.where,
                    (nearest.empty() ? "" : "did you mean " + nearest.front() + "? ") +
                        std::string("`fuai fabrics` lists them; a file needs its path, such as ./") + word +
                        ".fabric.toml");
      }
      add(word, word);
    } else if (word.ends_with('/')) {
      for (const std::string& name : files_of(beside / word, value))
        add(word + name, (beside / word / name).string());
    } else {
      const std::string path = (beside / word).string();
      std::error_code code;
      if (!fs::is_regular_file(path, code))
        throw Error(ErrorKind::kBadInput, "the fabric file '" + path + "' does not exist", value.where,
                    "correct the path; it begins at the manifest's folder");
      add(word, path);
    }
  }
  return fabrics;
}

}  // namespace fuai
