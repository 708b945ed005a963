// What a drape test leaves behind: shadow, pictures, mesh, tables.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "fuai/experiments/html_page.h"
#include "fuai/laboratory/drape_test.h"
#include "fuai/picture/cloth_picture.h"
#include "fuai/picture/image.h"
#include "fuai/picture/plot.h"

namespace fuai {

/// The shadow of a drape as a drawing in millimetres: specimen, disc, shadow, crests. Thread class: set-up.
std::string shadow_svg(const DrapeGeometry& geometry, const DrapeShadow& shadow, const std::string& title);
/// The same as pixels, two a pixel of the raster. Thread class: set-up.
Image shadow_image(const DrapeGeometry& geometry, const DrapeShadow& shadow);

/// The drape on its disc. Thread class: set-up.
/// @param from_above parallel view from above; else from the side
ClothPicture drape_picture(const DrapeTest& test, const DrapeSample& sample, const std::string& caption,
                           bool from_above);

/// One row a specimen: seed, DC, nodes, amplitude, residual, time. Thread class: set-up.
HtmlTable specimen_table(const DrapeTest& test);
/// One row a spacing. Thread class: set-up.
HtmlTable convergence_table(const DrapeConvergence& convergence);
/// DC of every specimen and their mean over the spacing. Thread class: set-up.
Plot convergence_plot(const DrapeConvergence& convergence, const std::string& title);

/// shadow.svg, specimens.csv, outline.csv and mesh.obj of the typical specimen; convergence.csv when there is
/// one. Needs no graphics. @param convergence may have no tests. Thread class: set-up.
std::vector<OutputFile> drape_files(const DrapeTest& test, const DrapeConvergence& convergence,
                                    const std::string& fabric_name);
/// shadow.png, top.png, side.png, and convergence.png and .svg when there is one.
/// @throws Error (kNoDevice) when built without pictures or no driver renders. Thread class: set-up.
std::vector<OutputFile> drape_pictures(const DrapeTest& test, const DrapeConvergence& convergence,
                                       const std::string& fabric_name);

}  // namespace fuai
