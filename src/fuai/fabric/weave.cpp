// Words that tell a structure, and the rule for what is missing.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/fabric/weave.h"

#include <algorithm>
#include <string>

#include "fuai/fabric/assumptions.h"

namespace fuai {
namespace {

struct StructureWord {
  const char* word;  // in small letters
  WeaveStructure structure;
};

// The first that is found counts: "knitted satin" is a knit.
constexpr StructureWord kWords[] = {
    {"knit", WeaveStructure::kKnit},    {"jersey", WeaveStructure::kKnit},
    {"編", WeaveStructure::kKnit},      {"ニット", WeaveStructure::kKnit},
    {"satin", WeaveStructure::kSatin},  {"sateen", WeaveStructure::kSatin},
    {"朱子", WeaveStructure::kSatin},   {"繻子", WeaveStructure::kSatin},
    {"サテン", WeaveStructure::kSatin}, {"twill", WeaveStructure::kTwill},
    {"denim", WeaveStructure::kTwill},  {"gabardine", WeaveStructure::kTwill},
    {"serge", WeaveStructure::kTwill},  {"綾", WeaveStructure::kTwill},
    {"ツイル", WeaveStructure::kTwill}, {"デニム", WeaveStructure::kTwill},
    {"plain", WeaveStructure::kPlain},  {"faille", WeaveStructure::kPlain},
    {"poplin", WeaveStructure::kPlain}, {"taffeta", WeaveStructure::kPlain},
    {"平織", WeaveStructure::kPlain},
};

std::optional<WeaveStructure> told_by_words(const Fabric& fabric) {
  std::string text = fabric.composition + "\n" + fabric.name + "\n" + fabric.id;
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  const auto* found = std::ranges::find_if(
      kWords, [&](const StructureWord& w) { return text.find(w.word) != std::string::npos; });
  return found == std::end(kWords) ? std::nullopt : std::optional(found->structure);
}

}  // namespace

Weave weave_of(const Fabric& fabric) {
  const WeaveMeasurement& known = fabric.weave;
  const std::optional<WeaveStructure> structure = known.structure ? known.structure : told_by_words(fabric);
  Weave weave;
  weave.structure = structure.value_or(WeaveStructure::kPlain);
  weave.structure_assumed = !structure;
  weave.threads_assumed = !known.warp_threads.has_value() && !known.weft_threads.has_value();
  const double usual =
      weave.structure == WeaveStructure::kKnit ? assumed::kKnitLoops : assumed::kWovenThreads;
  const auto first_known = [&](const Known& own, const Known& other) {
    return own.has_value() ? own.value : other.has_value() ? other.value : usual;
  };
  weave.warp_pitch = 1.0 / first_known(known.warp_threads, known.weft_threads);
  weave.weft_pitch = 1.0 / first_known(known.weft_threads, known.warp_threads);
  return weave;
}

}  // namespace fuai
