// A fabric with the factors of its sliders applied, as numbers that a file can hold.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fuai/viewer/view_setup.h"

namespace fuai {

/// Blocks without a factor stay as measured. Of a changed block the curve is left out, and its numbers are
/// read off the changed law as the instrument would read them; they are marked as assumed.
/// @throws Error as make_view_laws(). Thread class: set-up.
Fabric scaled_fabric(const ViewFabric& fabric);

}  // namespace fuai
