// A linked shader program and its uniforms.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <span>

#include "fuai/picture/colour_map.h"
#include "fuai/picture/gl_object.h"

namespace fuai {

/// Compiles and links on construction; throws Error kNoDevice with the driver's log when it refuses.
/// Setters act on the program in use. Thread class: set-up, on the context's thread.
class GlProgram {
 public:
  GlProgram(const char* vertex_source, const char* fragment_source);
  void use() const { glUseProgram(program_.name()); }
  void set(const char* name, int value) const { glUniform1i(at(name), value); }
  void set(const char* name, double value) const { glUniform1f(at(name), static_cast<float>(value)); }
  void set(const char* name, const Vec2& v) const;
  void set(const char* name, const Vec3& v) const;
  void set(const char* name, const Eigen::Vector4d& v) const;
  void set(const char* name, const Eigen::Matrix4d& m) const;
  void set(const char* name, std::span<const Eigen::Vector4f> values) const;
  /// The colour without alpha, in linear light.
  void set_colour(const char* name, const Colour& colour) const;

 private:
  GLint at(const char* name) const { return glGetUniformLocation(program_.name(), name); }
  GlProgramName program_;
};

}  // namespace fuai
