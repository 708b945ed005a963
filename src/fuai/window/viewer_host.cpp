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
#include <cmath>
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
    set_callbacks();
    glfwGetCursorPos(window_, &cursor_[0], &cursor_[1]);
    rate_ = fastest_rate();
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init(kGlsl);
  }
  ~WindowHost() override {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    glfwDestroyWindow(window_);
    glfwTerminate();
  }

  void wait(double seconds) override { glfwWaitEventsTimeout(seconds); }
  bool take_happened() override { return std::exchange(happened_, false); }
  bool visible() const override {
    return glfwGetWindowAttrib(window_, GLFW_ICONIFIED) == 0 &&
           glfwGetWindowAttrib(window_, GLFW_VISIBLE) != 0;
  }
  double rate() const override { return rate_; }
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
    const float told = std::max(std::max(x, y), 0.5F);
    GLFWmonitor* monitor = glfwGetPrimaryMonitor();
    const GLFWvidmode* mode = monitor != nullptr ? glfwGetVideoMode(monitor) : nullptr;
    if (mode == nullptr) return told;
    int wide = 0, high = 0;  // [mm]
    glfwGetMonitorPhysicalSize(monitor, &wide, &high);
    return fitting_scale(told, mode->width, wide);
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
  std::array<ButtonTrail, kMouseButtons> take_buttons() override { return std::exchange(buttons_, {}); }
  std::vector<KeyPress> take_keys() override { return std::exchange(keys_, {}); }
  std::vector<std::string> take_dropped() override { return std::exchange(dropped_, {}); }

 private:
  static WindowHost& host_of(GLFWwindow* window) {
    auto* self = static_cast<WindowHost*>(glfwGetWindowUserPointer(window));
    self->happened_ = true;
    return *self;
  }

  /// ImGui's callbacks call the ones that were there before.
  void set_callbacks() {
    glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
      for (int i = 0; i < count; ++i) host_of(window).dropped_.emplace_back(paths[i]);
    });
    glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int, int action, int mods) {
      WindowHost& self = host_of(window);
      if (action == GLFW_RELEASE) return;
      self.keys_.push_back(
          {key, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_SHIFT) != 0, action == GLFW_REPEAT});
    });
    glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int) {
      host_of(window).note_button(button, action == GLFW_PRESS);
    });
    glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
      host_of(window).cursor_ = {x, y};
    });
    glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double) { host_of(window); });
    glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned) { host_of(window); });
    glfwSetCursorEnterCallback(window_, [](GLFWwindow* window, int) { host_of(window); });
    glfwSetWindowFocusCallback(window_, [](GLFWwindow* window, int) { host_of(window); });
    glfwSetWindowIconifyCallback(window_, [](GLFWwindow* window, int) { host_of(window); });
    glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { host_of(window); });
    glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { host_of(window); });
    glfwSetWindowContentScaleCallback(window_, [](GLFWwindow* window, float, float) { host_of(window); });
  }

  void note_button(int button, bool down) {
    if (button < 0 || button >= static_cast<int>(kMouseButtons)) return;
    ButtonTrail& trail = buttons_[static_cast<std::size_t>(button)];
    trail.let_go = !down;
    (down ? trail.pressed_at : trail.let_go_at) = cursor_;
    if (down) ++trail.presses;
  }

  /// Of all screens: which of them shows the window may change.
  static double fastest_rate() {
    int count = 0;
    GLFWmonitor** monitors = glfwGetMonitors(&count);
    int fastest = 0;
    for (int i = 0; i < count; ++i)
      if (const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]))
        fastest = std::max(fastest, mode->refreshRate);
    constexpr int kLeast = 24;  // drivers without a screen tell anything
    return fastest >= kLeast ? fastest : kUsualRate;
  }

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
  std::array<ButtonTrail, kMouseButtons> buttons_;
  std::array<double, 2> cursor_{};
  bool happened_ = true;
  double rate_ = kUsualRate;
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
  static constexpr double kFrame = 1.0 / kUsualRate;
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

float fitting_scale(float told, int pixels, int millimetres) {
  // Of screens between a small notebook's and a television's; others tell an aspect ratio, or nothing.
  constexpr int kLeastWidth = 200, kMostWidth = 2000;  // [mm]
  constexpr float kUsual = 96.0F, kFine = 140.0F;      // [dpi]
  constexpr float kInch = 25.4F;                       // [mm]
  if (told != 1.0F || millimetres < kLeastWidth || millimetres > kMostWidth) return told;
  const float dpi = kInch * static_cast<float>(pixels) / static_cast<float>(millimetres);
  if (dpi < kFine) return told;
  return std::min(0.25F * std::round(4.0F * dpi / kUsual), 3.0F);
}

std::unique_ptr<ViewerHost> make_window_host(int width, int height, const std::string& title) {
  return std::make_unique<WindowHost>(width, height, title);
}

std::unique_ptr<ViewerHost> make_headless_host(int width, int height) {
  return std::make_unique<HeadlessHost>(width, height);
}

}  // namespace fuai
