// The text over a picture of cloth: caption, colour bar, labels of arrows, directions of the yarns, grid
// size.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/picture/cloth_picture.h"
#include "fuai/picture/image.h"

namespace fuai {

/// The image with the picture's text drawn over it. Thread class: set-up.
Image draw_overlay(const Image& image, const ClothPicture& picture);

}  // namespace fuai
