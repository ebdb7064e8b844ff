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
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double dy) { of(w).onScroll(dy); });
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
  turning_ = panning_ = undecided_ = moved_ = down_ = false;
  waiting_ = {};
  waitingPress_.reset();
  fresh_ = true;  // the cursor is put elsewhere: that is no movement
  glfwSetInputMode(window_, GLFW_CURSOR, on ? GLFW_CURSOR_DISABLED : GLFW_CURSOR_NORMAL);
  if (glfwRawMouseMotionSupported())
    glfwSetInputMode(window_, GLFW_RAW_MOUSE_MOTION, on ? GLFW_TRUE : GLFW_FALSE);
  if (overlay_) overlay_->setMouseEnabled(!on);
}

void WindowInput::onKey(int key, int action, int mods) {
  if (action != GLFW_PRESS || (overlay_ && overlay_->wantsKeys())) return;
  const std::string_view name = actionOf(key, (mods & GLFW_MOD_SHIFT) != 0);
  if (!name.empty()) actions_.push_back(name);
}

void WindowInput::waitIfUnknown() {
  if (!captured_ && (moved_ || !actions_.empty())) undecided_ = true;
}

void WindowInput::onButton(int button, int action, int mods) {
  if (action == GLFW_PRESS) waitIfUnknown();
  const bool panels = !undecided_ && overlay_ && overlay_->wantsMouse();
  const bool down = action == GLFW_PRESS && !captured_ && !panels;
  if (button == GLFW_MOUSE_BUTTON_LEFT) {
    const bool graph = graphHasButton_ && (mods & GLFW_MOD_CONTROL) == 0;
    turning_ = down && !graph;
    if (action == GLFW_RELEASE) down_ = waitingDown_ = false;
    if (down && graph && undecided_) {
      waitingPress_ = place();
      waitingDown_ = true;
    } else if (down && graph) {
      press(place());
    }
  }
  if (button == GLFW_MOUSE_BUTTON_RIGHT || button == GLFW_MOUSE_BUTTON_MIDDLE) panning_ = down;
}

void WindowInput::onMove(double x, double y) {
  const glm::dvec2 at(x, y);
  if (!std::exchange(fresh_, false)) {
    CameraInput& input = undecided_ ? waiting_ : camera_;
    if (captured_ || turning_)
      input.turn += at - last_;
    else if (panning_)
      input.pan += at - last_;
  }
  last_ = at;
  moved_ = !captured_;
  // A mouse that only points is looked at when panels were drawn: then it is known whether one of them is under it.
  if (!captured_ && (!overlay_ || down_)) point();
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

void WindowInput::press(glm::dvec2 at) {
  position_ = dragged_ = pressed_ = at;
  down_ = clicked_ = true;
}

imports::Pointer WindowInput::pointer(std::uint32_t width, std::uint32_t height) const {
  const glm::dvec2 size(width, height);
  imports::Pointer pointer;
  pointer.position = position_ * size;
  pointer.dragged = dragged_ * size;
  pointer.pressed = pressed_ * size;
  pointer.clicked = clicked_;
  pointer.down = down_ || clicked_;  // a click that ended between two frames is seen in one
  return pointer;
}

void WindowInput::onScroll(double steps) {
  waitIfUnknown();
  if (undecided_)
    waiting_.wheel += steps;
  else if (captured_ || !(overlay_ && overlay_->wantsMouse()))
    camera_.wheel += steps;
}

bool WindowInput::held(std::string_view action) const {
  if (overlay_ && overlay_->wantsKeys()) return false;
  for (const KeyBinding& binding : keyBindings())
    if (binding.how == KeyBinding::How::held && action == binding.action &&
        glfwGetKey(window_, binding.key) == GLFW_PRESS)
      return true;
  return false;
}

void WindowInput::panelsDrawn() {
  const bool panels = overlay_ && overlay_->wantsMouse();
  if (std::exchange(moved_, false) && !panels && !captured_ && !waitingPress_) point();
  if (!std::exchange(undecided_, false)) return;
  const CameraInput input = std::exchange(waiting_, {});
  const std::optional<glm::dvec2> pressed = std::exchange(waitingPress_, {});
  if (panels) {
    turning_ = panning_ = false;
    return;
  }
  if (pressed) {
    press(*pressed);
    down_ = waitingDown_;
    if (down_) point();
  }
  camera_.turn += input.turn;
  camera_.pan += input.pan;
  camera_.wheel += input.wheel;
}

bool WindowInput::movesCamera() const {
  return camera_.any();
}

CameraInput WindowInput::takeCamera() {
  CameraInput input = std::exchange(camera_, {});
  if (!captured_) return input;
  const auto axis = [&](std::string_view plus, std::string_view minus) {
    return (held(plus) ? 1.0 : 0.0) - (held(minus) ? 1.0 : 0.0);
  };
  input.move = {axis("right", "left"), axis("up", "down"), axis("forward", "back")};
  input.fast = held("fast");
  return input;
}

std::vector<std::string_view> WindowInput::takeActions() {
  return std::exchange(actions_, {});
}

}  // namespace weft::app
