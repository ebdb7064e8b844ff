// Dear ImGui over framebuffer 0 of a GLFW window, with state of its own. Installs no callbacks: events are handed over, so that each
// layout of the panels sees at most one change of each key and button (Dear ImGui 1.86 looks at states alone).
#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>

struct GLFWwindow;

namespace weft::app::ui {

// What a callback of GLFW said.
struct WindowEvent {
  enum class Kind : std::uint8_t { move, leave, button, wheel, key, character } kind = Kind::move;
  int key = 0, scancode = 0, action = 0, mods = 0;  // of a key or a button
  unsigned codepoint = 0;
  double x = 0, y = 0;
};

class Overlay {
 public:
  // `window` must be current and outlive this. Null when there is no OpenGL loader for it.
  static std::unique_ptr<Overlay> create(GLFWwindow* window, float scale);
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  // Before begin().
  void take(const WindowEvent& event);

  // Panels are made between the two; end() draws them on framebuffer 0. begin() shows the panels the events that were taken: wantsMouse()
  // knows of them from then on. Without a picture of the panels, call skip() instead of end().
  void begin();
  void end();
  void skip();
  static float textSize(float scale) { return std::round(14 * scale); }  // pixels
  // Sizes of text and widgets, 1 at 96 dots an inch. Between frames.
  void setScale(float scale);
  // Off: panels ignore the mouse, wherever it is (it is captured).
  void setMouseEnabled(bool enabled);

  // Where the left button was let go, in pixels of the window, as panels between begin() and end() saw it.
  std::optional<std::pair<int, int>> releasedMouse() const;

  bool wantsMouse() const;
  bool wantsKeys() const;  // a text field has the keyboard
  bool listOpen() const;   // or a menu
  // Closes the list or menu that is open, between begin() and end(). False when there is none.
  bool closePopup();

 private:
  explicit Overlay(GLFWwindow* window) : window_(window) {}

  GLFWwindow* window_;
  float x_ = 0, y_ = 0;
  bool inside_ = false, down_[3] = {};
  bool begun_ = false;  // between begin() and end()
};

}  // namespace weft::app::ui
