#include "app/view/window_input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>

namespace weft::app {

WindowInput& WindowInput::of(GLFWwindow* window) {
  WindowInput& input = *static_cast<WindowInput*>(glfwGetWindowUserPointer(window));
  ++input.events_;
  return input;
}

WindowInput::WindowInput(GLFWwindow* window, const KeyTable& keys) : window_(window), keys_(keys) {
  using Kind = ui::WindowEvent::Kind;
  glfwSetWindowUserPointer(window, this);
  glfwSetInputMode(window, GLFW_STICKY_KEYS,
                   GLFW_TRUE);  // a key that is tapped between two frames counts as held in one
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int scancode, int action, int mods) {
    of(w).queue_.push_back(
        {.kind = Kind::key, .key = key, .scancode = scancode, .action = action, .mods = mods});
  });
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int mods) {
    of(w).queue_.push_back({.kind = Kind::button, .key = button, .action = action, .mods = mods});
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    of(w).queue_.push_back({.kind = Kind::move, .x = x, .y = y});
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double x, double y) {
    of(w).queue_.push_back({.kind = Kind::wheel, .x = x, .y = y});
  });
  glfwSetCharCallback(window, [](GLFWwindow* w, unsigned codepoint) {
    of(w).queue_.push_back({.kind = Kind::character, .codepoint = codepoint});
  });
  glfwSetCursorEnterCallback(window, [](GLFWwindow* w, int entered) {
    WindowInput& input = of(w);
    if (!entered) input.queue_.push_back({.kind = Kind::leave});
  });
  glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
    of(w).dropped_.insert(of(w).dropped_.end(), paths, paths + count);
  });
  glfwSetWindowFocusCallback(window, [](GLFWwindow* w, int focused) {
    WindowInput& input = of(w);
    if (!focused) input.capture(false);
  });
  // These events are only counted: a window that was covered or resized needs its picture again.
  glfwSetWindowRefreshCallback(window, [](GLFWwindow* w) { of(w); });
  glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { of(w); });
  glfwSetWindowContentScaleCallback(window, [](GLFWwindow* w, float, float) { of(w); });
}

bool WindowInput::hand(bool oneClick) {
  using Kind = ui::WindowEvent::Kind;
  std::optional<Kind> last;  // that is no movement
  bool moved = false;
  while (!queue_.empty()) {
    const ui::WindowEvent event = queue_.front();
    const bool moves = event.kind == Kind::move || event.kind == Kind::leave;
    // Letters go together, and so do steps of the wheel.
    const bool joins = last == event.kind && (event.kind == Kind::character || event.kind == Kind::wheel);
    // What is dragged is seen at its last place before it is let go.
    const bool lets = moved && event.kind == Kind::button && event.action == GLFW_RELEASE;
    if ((last && !joins) || lets) return true;
    if (oneClick && clicked_ && graphHasButton_ && event.kind == Kind::button && event.action == GLFW_PRESS)
      return false;
    queue_.pop_front();
    if (event.kind == Kind::move) onMove(event);
    if (event.kind == Kind::button) onButton(event);
    if (event.kind == Kind::wheel) fresh_.wheel += event.y;
    if (event.kind == Kind::key) onKey(event);
    if (overlay_) overlay_->take(event);
    moved |= moves;
    if (!moves) last = event.kind;
  }
  return false;
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

// A key has the letter that it has on the user's keyboard, wherever that is; digits are also those keys that have them with Shift.
void WindowInput::onKey(const ui::WindowEvent& event) {
  if (event.action != GLFW_PRESS || (overlay_ && overlay_->wantsKeys())) return;
  const WithKey shift = event.mods & GLFW_MOD_SHIFT ? WithKey::shift : WithKey::nothing;
  const char* letter = glfwGetKeyName(event.key, event.scancode);
  const int written = letter && letter[0] && !letter[1] ? std::toupper(letter[0]) : event.key;
  // Ctrl may be held for the mouse.
  const bool digit = event.key >= GLFW_KEY_0 && event.key <= GLFW_KEY_9;
  const KeyBinding* row = nullptr;
  for (const WithKey with : {WithKey::control, shift}) {
    if (with == WithKey::control && !(event.mods & GLFW_MOD_CONTROL)) continue;
    if (!row) row = keys_.find(written, with);
    if (!row && digit) row = keys_.find(event.key, with);
  }
  if (row && (row->name == "close" || !overlay_ || !overlay_->listOpen())) actions_.push_back(row);
}

void WindowInput::onButton(const ui::WindowEvent& event) {
  const bool down = event.action == GLFW_PRESS && !captured_;
  pressed_ |= down;
  if (event.key == GLFW_MOUSE_BUTTON_RIGHT || event.key == GLFW_MOUSE_BUTTON_MIDDLE) panning_ = down;
  if (event.key != GLFW_MOUSE_BUTTON_LEFT) return;
  const bool graph = graphHasButton_ && (event.mods & GLFW_MOD_CONTROL) == 0;
  turning_ = down && !graph;
  held_ = down && graph;
  if (held_) press_ = place();
  if (!held_) down_ = false;
}

void WindowInput::onMove(const ui::WindowEvent& event) {
  const glm::dvec2 at(event.x, event.y);
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
  // The middle of the pixel that is pointed at; a drag may lead out of the picture.
  const glm::dvec2 at = (last_ + 0.5) / size;
  return glm::clamp((glm::dvec2(at.x, 1 - at.y) - corner_) / size_, 0.0, 1.0);
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
  // Asked in any case, so that no tap of before waits for a flight. The keys of flight are places.
  const auto down = [&](int key) { return glfwGetKey(window_, key) == GLFW_PRESS ? 1.0 : 0.0; };
  const glm::dvec3 move = {down(GLFW_KEY_D) - down(GLFW_KEY_A), down(GLFW_KEY_E) - down(GLFW_KEY_Q),
                           down(GLFW_KEY_W) - down(GLFW_KEY_S)};
  const bool fast = down(GLFW_KEY_LEFT_SHIFT) > 0;
  if (!captured_ || (overlay_ && overlay_->wantsKeys())) return input;
  input.move = move;
  input.fast = fast;
  return input;
}

}  // namespace weft::app
