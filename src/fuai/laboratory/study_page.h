// The parts of an HTML page about a fabric that the card and the report share.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/experiments/html_page.h"
#include "fuai/laboratory/fabric_study.h"

namespace fuai {

/// Sources in the order of their first use, each with a number that tables quote.
class SourceList {
 public:
  /// @param brief of the remarks on quality only the first clause
  explicit SourceList(bool brief = false) : brief_(brief) {}

  /// "[2]". @param provenance its source and quality are the text of the entry
  std::string number_of(const Provenance& provenance);
  const std::vector<std::string>& entries() const { return entries_; }

 private:
  bool brief_;
  std::vector<std::string> entries_;
};

/// Every number that is known: KES units, SI, kind, condition, source. Thread class: set-up.
HtmlTable number_table(const FabricStudy& study, SourceList& sources);

/// Side, top and shadow with what came of the test. Thread class: set-up.
void add_drape(HtmlPage& page, const FabricStudy& study, const StudyPictures& pictures);

/// The loops of bending, shear and tension over the measured points. Thread class: set-up.
void add_loops(HtmlPage& page, const FabricStudy& study);

/// What each law was made from, and every assumption. Thread class: set-up.
void add_assumptions(HtmlPage& page, const FabricStudy& study);

/// The numbered list. Thread class: set-up.
void add_sources(HtmlPage& page, const SourceList& sources);

/// Name, composition, mass and what was measured, in a sentence or two. Thread class: set-up.
std::string introduction(const Fabric& fabric);

}  // namespace fuai
