// Names of OpenGL objects that delete themselves; the context that made them must be current then.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <epoxy/gl.h>

#include <utility>

namespace fuai {

/// Owner of one OpenGL name. Thread class: set-up, on the context's thread.
template <auto kMake, auto kDelete>
class GlObject {
 public:
  GlObject() : name_(kMake()) {}
  ~GlObject() {
    if (name_ != 0) kDelete(name_);
  }
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_;
};

namespace gl {
// libepoxy's functions are macros over pointers, so each gets a function of its own.
#define FUAI_GL_PAIR(Name, Make, Delete) \
  inline GLuint make_##Name() {          \
    GLuint name = 0;                     \
    Make(1, &name);                      \
    return name;                         \
  }                                      \
  inline void delete_##Name(GLuint name) { Delete(1, &name); }
FUAI_GL_PAIR(buffer, glGenBuffers, glDeleteBuffers)
FUAI_GL_PAIR(vertex_array, glGenVertexArrays, glDeleteVertexArrays)
FUAI_GL_PAIR(texture, glGenTextures, glDeleteTextures)
FUAI_GL_PAIR(framebuffer, glGenFramebuffers, glDeleteFramebuffers)
FUAI_GL_PAIR(renderbuffer, glGenRenderbuffers, glDeleteRenderbuffers)
#undef FUAI_GL_PAIR
inline GLuint make_program() { return glCreateProgram(); }
inline void delete_program(GLuint name) { glDeleteProgram(name); }
}  // namespace gl

using GlBuffer = GlObject<gl::make_buffer, gl::delete_buffer>;
using GlVertexArray = GlObject<gl::make_vertex_array, gl::delete_vertex_array>;
using GlTexture = GlObject<gl::make_texture, gl::delete_texture>;
using GlFramebuffer = GlObject<gl::make_framebuffer, gl::delete_framebuffer>;
using GlRenderbuffer = GlObject<gl::make_renderbuffer, gl::delete_renderbuffer>;
using GlProgramName = GlObject<gl::make_program, gl::delete_program>;

}  // namespace fuai
