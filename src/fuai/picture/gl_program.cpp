// Compiles shaders and sets uniforms.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/gl_program.h"

#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

constexpr const char* kCure = "a driver with OpenGL 3.3 is needed, e.g. the Debian package libgl1-mesa-dri";

void attach_shader(GLuint program, GLenum kind, const char* source) {
  const GLuint shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  // The program keeps an attached shader alive.
  glAttachShader(program, shader);
  glDeleteShader(shader);
  if (compiled == 0) throw Error(ErrorKind::kNoDevice, "a shader does not compile: " + log, {}, kCure);
}

}  // namespace

GlProgram::GlProgram(const char* vertex_source, const char* fragment_source) {
  attach_shader(program_.name(), GL_VERTEX_SHADER, vertex_source);
  attach_shader(program_.name(), GL_FRAGMENT_SHADER, fragment_source);
  glLinkProgram(program_.name());
  GLint linked = 0;
  glGetProgramiv(program_.name(), GL_LINK_STATUS, &linked);
  if (linked != 0) return;
  std::string log(4096, '\0');
  GLsizei length = 0;
  glGetProgramInfoLog(program_.name(), static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  throw Error(ErrorKind::kNoDevice, "a shader program does not link: " + log, {}, kCure);
}

void GlProgram::set(const char* name, const Vec2& v) const {
  const Eigen::Vector2f f = v.cast<float>();
  glUniform2fv(at(name), 1, f.data());
}

void GlProgram::set(const char* name, const Vec3& v) const {
  const Eigen::Vector3f f = v.cast<float>();
  glUniform3fv(at(name), 1, f.data());
}

void GlProgram::set(const char* name, const Eigen::Vector4d& v) const {
  const Eigen::Vector4f f = v.cast<float>();
  glUniform4fv(at(name), 1, f.data());
}

void GlProgram::set(const char* name, const Eigen::Matrix4d& m) const {
  const Eigen::Matrix4f f = m.cast<float>();
  glUniformMatrix4fv(at(name), 1, GL_FALSE, f.data());
}

void GlProgram::set(const char* name, std::span<const Eigen::Vector4f> values) const {
  glUniform4fv(at(name), static_cast<GLsizei>(values.size()), values.front().data());
}

void GlProgram::set_colour(const char* name, const Colour& c) const {
  set(name, Vec3(srgb_to_linear(c.red), srgb_to_linear(c.green), srgb_to_linear(c.blue)));
}

}  // namespace fuai
