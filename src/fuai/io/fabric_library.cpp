// Finds and loads the fabrics that come with fuai.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/io/fabric_library.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "fuai/core/error.h"
#include "fuai/io/fabric_file.h"
#include "fuai/io/nearest_name.h"

namespace fuai {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kEnding = ".fabric.toml";

bool is_folder(const fs::path& path) {
  std::error_code code;
  return fs::is_directory(path, code);
}

/// Letters as letters, runs of digits as numbers: graded-3 before graded-10.
bool natural_less(const std::string& a, const std::string& b) {
  const auto digits = [](const std::string& text, std::size_t at) {
    return std::min(text.find_first_not_of("0123456789", at), text.size()) - at;
  };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const std::size_t m = digits(a, i), n = digits(b, j);
    if (m > 0 && n > 0) {
      // Without leading zeros the longer run is the larger number, and equal lengths compare as text.
      const std::string x = a.substr(i, m), y = b.substr(j, n);
      const std::string p = x.substr(std::min(x.find_first_not_of('0'), x.size()));
      const std::string q = y.substr(std::min(y.find_first_not_of('0'), y.size()));
      if (p.size() != q.size()) return p.size() < q.size();
      if (p != q) return p < q;
      i += m, j += n;
    } else if (a[i] != b[j]) {
      return a[i] < b[j];
    } else {
      ++i, ++j;
    }
  }
  if (i == a.size() && j == b.size()) return a < b;  // "a-01" and "a-1": any fixed order
  return i == a.size();
}

}  // namespace

std::string data_folder() {
  if (const char* stated = std::getenv("FUAI_DATA"); stated && *stated) {
    if (!is_folder(stated)) {
      throw Error(ErrorKind::kBadInput, "FUAI_DATA names a folder that does not exist",
                  Where{stated, 0, 0, {}}, "correct or unset the environment variable");
    }
    return stated;
  }
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  const fs::path installed = program.parent_path().parent_path() / "share" / "fuai";
  if (!program.empty() && is_folder(installed)) return installed.string();
  if (is_folder(FUAI_SOURCE_DATA)) return FUAI_SOURCE_DATA;
  throw Error(ErrorKind::kBadInput, "the bundled data are not found", Where{installed.string(), 0, 0, {}},
              "install fuai, or set the environment variable FUAI_DATA to its data folder");
}

std::vector<std::string> bundled_fabric_ids() {
  std::vector<std::string> ids;
  std::error_code code;
  for (const auto& entry : fs::directory_iterator(fs::path(data_folder()) / "fabrics", code)) {
    const std::string file = entry.path().filename().string();
    if (file.size() > kEnding.size() && file.ends_with(kEnding)) ids.push_back(fabric_id_of(file));
  }
  std::sort(ids.begin(), ids.end(), natural_less);
  return ids;
}

Fabric load_fabric(std::string_view name_or_path) {
  const std::string name(name_or_path);
  if (name.find('/') != std::string::npos || name.ends_with(".toml")) return read_fabric_file(name);
  const std::vector<std::string> ids = bundled_fabric_ids();
  if (std::find(ids.begin(), ids.end(), name) != ids.end())
    return read_fabric_file((fs::path(data_folder()) / "fabrics" / (name + std::string(kEnding))).string());
  constexpr int kSuggestions = 3;
  const std::vector<std::string> nearest = nearest_names(name, ids, kSuggestions);
  throw Error(ErrorKind::kBadInput, "there is no bundled fabric '" + name + "'", {},
              ids.empty() ? "there are none in " + data_folder() + "; give the path of a fabric file"
              : nearest.empty()
                  ? "the bundled fabrics are " + either(ids) + "; or give the path of a fabric file"
                  : "did you mean " + either(nearest) + "? Or give the path of a fabric file");
}

}  // namespace fuai
