#include "app/view/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <utility>

#include "app/ui/overlay.h"
#include "app/view/key_bindings.h"

namespace weft::app {

WindowInput& WindowInput::of(GLFWwindow* window) {
  return *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
}

WindowInput::WindowInput(GLFWwindow* window) {
  glfwSetWindowUserPointer(window, this);
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) { of(w).onKey(key, action); });
  glfwSetMouseButtonCallback(
      window, [](GLFWwindow* w, int button, int action, int) { of(w).onButton(button, action); });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) { of(w).onMove(x, y); });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double dy) {
    WindowInput& in = of(w);
    if (!(in.overlay_ && in.overlay_->wantsMouse())) in.mouse_.wheel += dy;
  });
}

void WindowInput::onKey(int key, int action) {
  if (action != GLFW_PRESS || (overlay_ && overlay_->wantsKeys())) return;
  if (const std::string_view name = actionOf(key); !name.empty()) actions_.push_back(name);
}

void WindowInput::onButton(int button, int action) {
  if (button == GLFW_MOUSE_BUTTON_LEFT)
    dragging_ = action == GLFW_PRESS && !(overlay_ && overlay_->wantsMouse());
}

void WindowInput::onMove(double x, double y) {
  if (dragging_) {
    mouse_.turnX += x - lastX_;
    mouse_.turnY += y - lastY_;
  }
  lastX_ = x;
  lastY_ = y;
}

WindowInput::Mouse WindowInput::takeMouse() {
  return std::exchange(mouse_, {});
}

std::vector<std::string_view> WindowInput::takeActions() {
  return std::exchange(actions_, {});
}

}  // namespace weft::app
