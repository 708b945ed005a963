// The fabric card: one page with drape, loops, numbers in KES units and SI, and where each comes from.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "fuai/laboratory/fabric_study.h"
#include "fuai/picture/sheet.h"

namespace fuai {

/// The card as a page to draw, for PNG and SVG. Thread class: set-up.
/// @param version of the program, "0.1.0"
Sheet card_sheet(const FabricStudy& study, const StudyPictures& pictures, const std::string& version);

/// The card as a self-contained HTML page. @throws Error (kNoDevice) when built without pictures. Thread
/// class: set-up.
std::string card_html(const FabricStudy& study, const StudyPictures& pictures, const std::string& version);

}  // namespace fuai
