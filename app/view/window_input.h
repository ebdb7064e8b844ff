// The events of a GLFW window, kept until the loop asks for them: names of actions, and what the mouse did
// over the picture (what it did over a panel is the panel's). Does not: act, or know cameras.
#pragma once

#include <string_view>
#include <vector>

struct GLFWwindow;

namespace weft::app {

namespace ui {
class Overlay;
}

class WindowInput {
 public:
  // Installs callbacks; before the overlay installs its own. `window` must outlive this.
  explicit WindowInput(GLFWwindow* window);
  WindowInput(const WindowInput&) = delete;
  WindowInput& operator=(const WindowInput&) = delete;

  void setOverlay(const ui::Overlay* overlay) { overlay_ = overlay; }

  // Since they were asked for last.
  struct Mouse {
    double turnX = 0, turnY = 0;  // pixels dragged with the left button
    double wheel = 0;             // steps
  };
  Mouse takeMouse();
  std::vector<std::string_view> takeActions();

 private:
  static WindowInput& of(GLFWwindow* window);
  void onKey(int key, int action);
  void onButton(int button, int action);
  void onMove(double x, double y);

  const ui::Overlay* overlay_ = nullptr;
  std::vector<std::string_view> actions_;
  Mouse mouse_;
  double lastX_ = 0, lastY_ = 0;
  bool dragging_ = false;
};

}  // namespace weft::app
