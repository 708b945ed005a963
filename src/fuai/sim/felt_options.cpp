// Options of felt cloth.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/sim/felt_options.h"

namespace fuai {

ImplicitOptions make_felt_options(const ImplicitOptions& scene) noexcept {
  ImplicitOptions options = scene;
  options.linearisations = 8;
  options.relinearise = 0.002;
  options.implicitness = kFeltImplicitness;
  return options;
}

}  // namespace fuai
