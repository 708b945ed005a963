// The cases of a batch: every fabric of a manifest with every setting, each one command line.
// SPDX-License-Identifier: Apache-2.0
//
// The command line is the identity of a case, written as the manifest says it: paths of fabrics as they
// stand there, files without their folder. Neither the place of the manifest nor the order of its lines
// changes it.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "fuai/io/batch_manifest.h"

namespace fuai {

/// An option of a command.
struct BatchOption {
  enum class Kind { kText, kInteger, kFlag, kFile };
  std::string name;  ///< without dashes
  Kind kind = Kind::kText;
};

/// A command that can make cases.
struct BatchCommand {
  std::string name;
  std::vector<std::string> words;  ///< at their places, such as "test" and "fabric"
  std::vector<BatchOption> options;
};

/// What command lines there are.
struct BatchGrammar {
  std::vector<BatchCommand> commands;
  /// What is wrong with the words after the program's name; empty when the parser takes them.
  std::function<std::string(const std::vector<std::string>&)> problem;
};

/// One case.
struct BatchCase {
  std::string id;                                             ///< "drape-wool-tropical-<16 digits>"
  std::vector<std::string> words;                             ///< after the program's name: its identity
  std::vector<std::string> line;                              ///< the same to be run from here
  std::string input_hash;                                     ///< of the fabric, curves included
  std::vector<std::pair<std::string, std::string>> settings;  ///< "fabric", then what the manifest sets
  std::string file_folder;  ///< where its files go; empty when it writes none
  Where where;              ///< of its command in the manifest
};

/// The cases, in the order of the manifest: fabrics, then variants, then the settings as they stand there,
/// the last one running fastest.
struct BatchCases {
  std::vector<BatchCase> cases;
  int repeated = 0;  ///< command lines that came up again and were left out
};

/// Most cases of one manifest.
inline constexpr std::size_t kMostBatchCases = 100000;

/// Makes the cases. Seed 0 and one thread unless the manifest says otherwise: what runs side by side needs
/// no more. A fabric may also be "bundled" (all of them) or a folder that ends in '/' (its fabric files).
/// @param folder of the results; files of a case go to its files/<id>/
/// @throws Error (kBadInput) with the place in the manifest: unknown command, setting or fabric (with the
/// nearest), a value of the wrong kind, what the parser refuses. Thread class: set-up.
BatchCases make_batch_cases(const BatchManifest& manifest, const BatchGrammar& grammar,
                            const std::string& folder);

}  // namespace fuai
