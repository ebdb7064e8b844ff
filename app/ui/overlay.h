// Dear ImGui over framebuffer 0 of a GLFW window. Installs its callbacks behind those that the window has, which go on being
// called; they ask wantsMouse() and wantsKeys() whether an event is theirs. Draws with state of its own and puts back what it
// found.
#pragma once

#include <memory>
#include <optional>
#include <utility>

struct GLFWwindow;

namespace weft::app::ui {

class Overlay {
 public:
  // `window` must be current, have its callbacks, and outlive this. Null when there is no OpenGL loader for
  // it.
  static std::unique_ptr<Overlay> create(GLFWwindow* window, float scale);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  // Panels are made between the two; end() draws them. Framebuffer 0 must be bound. begin() takes the events that have come:
  // wantsMouse() knows of them from then on. It does nothing between the two; without panels, call skip() instead of end().
  void begin();
  void end();
  void skip();
  // Sizes of text and widgets, 1 at 96 dots an inch. Between frames.
  void setScale(float scale);
  // Off: panels ignore the mouse, wherever it is (it is captured).
  void setMouseEnabled(bool enabled);

  // Where the left button was let go, in pixels of the window, as panels between begin() and end() saw it.
  std::optional<std::pair<int, int>> releasedMouse() const;

  bool wantsMouse() const;
  bool wantsKeys() const;  // a text field has the keyboard

 private:
  Overlay() = default;

  bool begun_ = false;  // between begin() and end()
};

}  // namespace weft::app::ui
