#include "app/view/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <utility>

#include "app/ui/overlay.h"
#include "app/view/key_bindings.h"

namespace weft::app {

WindowInput& WindowInput::of(GLFWwindow* window) {
  WindowInput& input = *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
  ++input.events_;
  return input;
}

WindowInput::WindowInput(GLFWwindow* window) : window_(window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(
      window, [](GLFWwindow* w, int key, int, int action, int mods) { of(w).onKey(key, action, mods); });
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* w, int button, int action, int mods) { of(w).onButton(button, action, mods); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).onMove(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double dy) { of(w).fresh_.wheel += dy; });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    WindowInput& input = of(w);
    if (!focused) input.capture(false);
  });
  // These events are only counted: a window that was covered or resized needs its picture again.
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned) { of(w); });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int) { of(w); });
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w); });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { of(w); });
}

void WindowInput::capture(bool on) {
  if (on == captured_) return;
  captured_ = on;
  turning_ = panning_ = moved_ = pressed_ = held_ = down_ = false;
  fresh_ = {};
  press_.reset();
  known_ = false;  // the cursor is put elsewhere: that is no movement
  glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  if (glfwRawMouseMotionSupported())
    glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, on ? GLFW_TRUE : GLFW_FALSE);
  if (overlay_) overlay_->setMouseEnabled(!on);
}

void WindowInput::onKey(int key, int action, int mods) {
  if (action != GLFW_PRESS || (overlay_ && overlay_->wantsKeys())) return;
  std::string name = actionOf(key, (mods & GLFW_MOD_SHIFT) != 0);
  if (!name.empty()) actions_.push_back(std::move(name));
}

void WindowInput::onButton(int button, int action, int mods) {
  const bool down = action == GLFW_PRESS && !captured_;
  pressed_ |= down;
  if (button == GLFW_MOUSE_BUTTON_RIGHT || button == GLFW_MOUSE_BUTTON_MIDDLE) panning_ = down;
  if (button != GLFW_MOUSE_BUTTON_LEFT) return;
  const bool graph = graphHasButton_ && (mods & GLFW_MOD_CONTROL) == 0;
  turning_ = down && !graph;
  held_ = down && graph;
  if (held_) press_ = place();
  if (!held_) down_ = false;
}

void WindowInput::onMove(double x, double y) {
  const glm::dvec2 at(x, y);
  if (std::exchange(known_, true)) {
    if (captured_ || turning_)
      fresh_.turn += at - last_;
    else if (panning_)
      fresh_.pan += at - last_;
  }
  last_ = at;
  moved_ = !captured_;
  if (down_) point();
}

glm::dvec2 WindowInput::place() const {
  int width = 0, height = 0;
  glfwGetWindowSize(window_, &width, &height);
  const glm::dvec2 size(std::max(width, 1), std::max(height, 1));
  // The middle of the pixel that is pointed at; a drag may lead out of the window.
  const glm::dvec2 at = glm::clamp((last_ + 0.5) / size, 0.0, 1.0);
  return {at.x, 1 - at.y};
}

void WindowInput::point() {
  position_ = place();
  if (down_) dragged_ = position_;
}

imports::Pointer WindowInput::pointer(std::uint32_t width, std::uint32_t height) const {
  const glm::dvec2 size(width, height);
  return {.position = position_ * size,
          .dragged = dragged_ * size,
          .pressed = pressedAt_ * size,
          .down = down_ || clicked_,  // a click that ended between two frames is seen in one
          .clicked = clicked_};
}

void WindowInput::decide(bool panels) {
  const CameraInput input = std::exchange(fresh_, {});
  const std::optional<glm::dvec2> press = std::exchange(press_, {});
  const bool moved = std::exchange(moved_, false), pressed = std::exchange(pressed_, false);
  if (panels && pressed) turning_ = panning_ = held_ = false;
  if (!panels || !pressed) {
    camera_.turn += input.turn;
    camera_.pan += input.pan;
  }
  if (panels) return;
  camera_.wheel += input.wheel;
  if (press) {
    position_ = dragged_ = pressedAt_ = *press;
    clicked_ = true;
    down_ = held_;
  }
  if (moved && (!press || held_)) point();
}

CameraInput WindowInput::takeCamera() {
  CameraInput input = std::exchange(camera_, {});
  if (!captured_ || (overlay_ && overlay_->wantsKeys())) return input;
  const auto down = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS ? 1.0 : 0.0; };
  input.move = {down(GLFW_KEY_D) - down(GLFW_KEY_A), down(GLFW_KEY_E) - down(GLFW_KEY_Q),
                down(GLFW_KEY_W) - down(GLFW_KEY_S)};
  input.fast = down(GLFW_KEY_LEFT_SHIFT) > 0;
  return input;
}

}  // namespace weft::app
