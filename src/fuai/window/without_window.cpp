// What the viewer says where it was built without a window.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/core/error.h"
#include "fuai/window/viewer.h"

namespace fuai {

bool has_display() { return false; }

ViewerResult run_viewer(const ViewerOptions& /*options*/) {
  throw Error(ErrorKind::kNoDevice, "this fuai was built without the viewer", {},
              "install libglfw3-dev, libimgui-dev and libfontconfig-dev, and build again");
}

}  // namespace fuai
