// The shader programs of the cloth pictures (GLSL 3.30).
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai::shaders {

/// Most directions of the soft light; the size of the uniform array in the shaders.
inline constexpr int kMaxAmbientDirections = 64;

extern const char* const kDepthVertex;      ///< depth seen along one light direction
extern const char* const kDepthFragment;    ///< nothing but depth
extern const char* const kSurfaceVertex;    ///< soft light by vertex
extern const char* const kSurfaceFragment;  ///< cloth, obstacles, arrows, ground

}  // namespace fuai::shaders
