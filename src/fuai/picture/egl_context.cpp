// Opens the surfaceless EGL platform and makes contexts on it.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/picture/egl_context.h"

#include <epoxy/egl.h>

#include <cstdio>
#include <string>

#include "fuai/core/error.h"

namespace fuai {
namespace {

[[noreturn]] void fail(const std::string& what) {
  char code[16];
  std::snprintf(code, sizeof code, "0x%04x", static_cast<unsigned>(eglGetError()));
  throw Error(ErrorKind::kNoDevice,
              "no graphics driver without a display: " + what + " (EGL error " + code + ")", {},
              "install the Debian packages libegl-mesa0 and libgl1-mesa-dri");
}

/// The display of the surfaceless platform. EGL has one for the process, which all contexts share. It stays
/// open until the process ends: closing it unloads the driver, and each new loading costs time and a little
/// memory that the driver never gives back. Throws when it cannot be opened; the next call tries again.
EGLDisplay open_display() {
  static const EGLDisplay opened = [] {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (extensions == nullptr ||
        std::string(extensions).find("EGL_MESA_platform_surfaceless") == std::string::npos)
      fail(std::string("EGL offers no surfaceless platform, only: ") +
           (extensions != nullptr ? extensions : "nothing"));
    // Not eglGetPlatformDisplay: libepoxy aborts on a 1.5 entry point before there is a display.
    const EGLDisplay display =
        eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display == EGL_NO_DISPLAY) fail("eglGetPlatformDisplayEXT");
    if (eglInitialize(display, nullptr, nullptr) == EGL_FALSE) fail("eglInitialize");
    return display;
  }();
  return opened;
}

}  // namespace

EglContext::EglContext() : display_(open_display()), context_(EGL_NO_CONTEXT) {
  if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail("eglBindAPI(EGL_OPENGL_API)");
  const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION_KHR,
                           3,
                           EGL_CONTEXT_MINOR_VERSION_KHR,
                           3,
                           EGL_CONTEXT_OPENGL_PROFILE_MASK_KHR,
                           EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT_KHR,
                           EGL_NONE};
  context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
  if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext for OpenGL 3.3 core");
  try {
    make_current();
  } catch (...) {
    eglDestroyContext(display_, context_);
    throw;
  }
}

EglContext::~EglContext() {
  eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_, context_);
}

void EglContext::make_current() const {
  if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) fail("eglMakeCurrent");
}

}  // namespace fuai
