// The window by GLFW, and the host without a display by EGL.
// SPDX-License-Identifier: Apache-2.0
#include "fuai/window/viewer_host.h"

#include <epoxy/gl.h>
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

#include "fuai/core/error.h"
#include "fuai/picture/egl_context.h"
#include "fuai/window/viewer.h"

namespace fuai {
namespace {

constexpr const char* kGlsl = "#version 330 core";

class WindowHost final : public ViewerHost {
 public:
  WindowHost(int width, int height, const std::string& title) {
    glfwSetErrorCallback([](int, const char* text) { last_error() = text; });
    if (glfwInit() != GLFW_TRUE) fail("no display can be opened");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    window_ = glfwCreateWindow(width, height, title.c_str(), nullptr, nullptr);
    if (window_ == nullptr) {
      glfwTerminate();
      fail("no window with OpenGL 3.3 can be opened");
    }
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
      auto* self = static_cast<WindowHost*>(glfwGetWindowUserPointer(window));
      for (int i = 0; i < count; ++i) self->dropped_.emplace_back(paths[i]);
    });
    // ImGui's callbacks call the ones that were there before.
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
      if (action == GLFW_RELEASE) return;
      auto* self = static_cast<WindowHost*>(glfwGetWindowUserPointer(window));
      self->keys_.push_back(
          {key, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0, action == GLFW_REPEAT});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
      auto* self = static_cast<WindowHost*>(glfwGetWindowUserPointer(window));
      if (button != GLFW_MOUSE_BUTTON_LEFT || action != GLFW_PRESS) return;
      ++self->left_presses_;
      self->press_place_ = self->cursor_;
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
      static_cast<WindowHost*>(glfwGetWindowUserPointer(window))->cursor_ = {x, y};
    });
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init(kGlsl);
  }
  ~WindowHost() override {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  void begin_frame() override {
    glfwPollEvents();
    glfwGetFramebufferSize(window_, &width_, &height_);
    ImGui_ImplOpenGL3_NewFrame();
    ImGui_ImplGlfw_NewFrame();
  }
  void show(const ScreenTarget& target) override {
    target.show(width_, height_);
    glfwSwapBuffers(window_);
  }
  bool closing() const override { return glfwWindowShouldClose(window_) != 0; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  float scale() const override {
    float x = 1.0F, y = 1.0F;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max(std::max(x, y), 0.5F);
  }
  double clock() const override { return glfwGetTime(); }
  void toggle_full_screen() override {
    if (glfwGetWindowMonitor(window_) != nullptr) {
      glfwSetWindowMonitor(window_, nullptr, place_[0], place_[1], place_[2], place_[3], 0);
      return;
    }
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return;
    glfwGetWindowPos(window_, &place_[0], &place_[1]);
    glfwGetWindowSize(window_, &place_[2], &place_[3]);
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
  }
  int take_left_presses() override { return std::exchange(left_presses_, 0); }
  std::array<double, 2> press_place() const override { return press_place_; }
  std::vector<KeyPress> take_keys() override { return std::exchange(keys_, {}); }
  std::vector<std::string> take_dropped() override { return std::exchange(dropped_, {}); }

 private:
  static std::string& last_error() {
    static std::string text;
    return text;
  }
  [[noreturn]] static void fail(const std::string& what) {
    throw Error(ErrorKind::kNoDevice, what + (last_error().empty() ? "" : ": " + last_error()), {},
                "set DISPLAY, or add --headless --seconds 2 --screenshot FILE");
  }

  GLFWwindow* window_ = nullptr;
  int width_ = 0, height_ = 0;
  int place_[4] = {0, 0, 0, 0};
  std::vector<std::string> dropped_;
  std::vector<KeyPress> keys_;
  int left_presses_ = 0;
  std::array<double, 2> cursor_{}, press_place_{};
};

class HeadlessHost final : public ViewerHost {
 public:
  HeadlessHost(int width, int height) : width_(width), height_(height) {
    context_.make_current();
    ImGui_ImplOpenGL3_Init(kGlsl);
  }
  ~HeadlessHost() override { ImGui_ImplOpenGL3_Shutdown(); }

  void begin_frame() override {
    ImGui_ImplOpenGL3_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    io.DisplaySize = {static_cast<float>(width_), static_cast<float>(height_)};
    io.DeltaTime = static_cast<float>(kFrame);
    clock_ += kFrame;
  }
  void show(const ScreenTarget& /*target*/) override {}
  bool closing() const override { return false; }
  int width() const override { return width_; }
  int height() const override { return height_; }
  float scale() const override { return 1.0F; }
  double clock() const override { return clock_; }

 private:
  static constexpr double kFrame = 1.0 / 60.0;
  EglContext context_;
  int width_, height_;
  double clock_ = 0.0;
};

}  // namespace

bool has_display() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0';
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

std::unique_ptr<ViewerHost> make_window_host(int width, int height, const std::string& title) {
  return std::make_unique<WindowHost>(width, height, title);
}

std::unique_ptr<ViewerHost> make_headless_host(int width, int height) {
  return std::make_unique<HeadlessHost>(width, height);
}

}  // namespace fuai
