// What a card or a report shows of one fabric: its numbers, its laws and its drape, and the pictures of them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/core/progress.h"
#include "fuai/fabric/fabric.h"
#include "fuai/fabric/laws.h"
#include "fuai/laboratory/drape_test.h"
#include "fuai/laboratory/fabric_numbers.h"
#include "fuai/picture/image.h"
#include "fuai/picture/offscreen_renderer.h"

namespace fuai {

/// One fabric, examined.
struct FabricStudy {
  Fabric fabric;
  FabricLaws laws;
  std::vector<FabricNumber> numbers;
  DrapeTest drape;
};

/// Lists the numbers and runs the drape test. @throws Error as make_fabric_laws(), run_drape_test(). Thread
/// class: set-up.
FabricStudy run_fabric_study(const Fabric& fabric, const DrapeTestOptions& options,
                             const Progress& progress = {});

/// The specimen nearest to the mean: from the side, from above, and its shadow.
struct StudyPictures {
  Image side, top, shadow;
};
/// @throws Error (kNoDevice) when the driver fails. Thread class: as the renderer.
StudyPictures draw_study(const FabricStudy& study, OffscreenRenderer& renderer);

/// "drape coefficient 51.4 ± 1.2 % (5 specimens), 5.2 nodes; 47.1 to 54.2 % with what was assumed". Thread
/// class: any.
std::string drape_in_words(const DrapeTest& test);
/// "disc 18 cm, specimen 30 cm, spacing 5 mm, seeds 0 to 4". Thread class: any.
std::string drape_setting_in_words(const DrapeTest& test);
/// "measured: 49.8 %, 5 nodes (tester not stated)"; empty where nobody measured. Thread class: any.
std::string measured_drape_in_words(const Fabric& fabric);

/// The name where it is short enough for a column or a legend, else the id, cut if need be. Thread class:
/// any.
std::string short_name(const Fabric& fabric);

/// "0.067", four digits; "-" for NaN. Thread class: any.
std::string shown_number(double value);

}  // namespace fuai
