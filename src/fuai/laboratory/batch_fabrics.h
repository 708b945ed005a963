// The fabrics that a batch manifest names.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/io/batch_manifest.h"

namespace fuai {

/// One fabric of a batch.
struct BatchFabric {
  std::string name;  ///< as the manifest says it; for the files of a folder, the folder's words and theirs
  std::string path;  ///< to load from here; a bundled name stays as it is
  std::string id;    ///< "wool-tropical"
  std::string hash;  ///< of everything the file and its curves hold; of its bytes when it cannot be read
};

/// What the words of a manifest name: bundled fabrics, fabric files beside the manifest or at absolute
/// paths, "bundled" for all, folders that end in '/'.
/// @throws Error (kBadInput) with the place of the word: a name that is not bundled, a file or folder that
/// does not exist, a folder without fabric files. Thread class: set-up.
std::vector<BatchFabric> find_batch_fabrics(const std::vector<BatchValue>& words,
                                            const std::string& manifest);

}  // namespace fuai
