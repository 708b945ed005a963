// An OpenGL context without a window, a display server or a screen (EGL, surfaceless platform of Mesa).
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace fuai {

/// OpenGL 3.3 core. Thread class: set-up; a context is used on the thread that made it.
class EglContext {
 public:
  /// Throws Error kNoDevice with the driver's text and the packages that mend it.
  EglContext();
  ~EglContext();
  EglContext(EglContext&&) = delete;
  EglContext& operator=(EglContext&&) = delete;

  void make_current() const;

 private:
  void* display_;  // EGLDisplay, of the process
  void* context_;  // EGLContext
};

}  // namespace fuai
