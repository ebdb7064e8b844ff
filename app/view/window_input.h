// The events of a GLFW window, kept until the loop asks for them: names of actions, held keys, what the mouse did over the
// picture (what it did over a panel is the panel's), and the captured mouse of flight.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/camera_rig.h"
#include "engine/imports/world.h"

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

  void setOverlay(ui::Overlay* overlay) { overlay_ = overlay; }

  // While it is captured the cursor is gone, every movement turns, panels get none of it, and it moves
  // unaccelerated where the system can. Losing the focus lets go of it.
  void capture(bool on);
  bool captured() const { return captured_; }

  // What was done for the camera since it was asked last. Held keys count only while the mouse is captured.
  CameraInput takeCamera();
  // Whether there is any of it, the mouse's.
  bool movesCamera() const { return camera_.any(); }
  // The mouse over a picture of this size, for graphs that read it: where it is, whether its left button is held, and
  // whether that went down since pointerShown(). What it does over a panel does not count.
  imports::Pointer pointer(std::uint32_t width, std::uint32_t height) const;
  void pointerShown() { clicked_ = false; }
  // The left button is the graph's, and turns the camera with Ctrl only.
  void giveButton(bool toGraph) { graphHasButton_ = toGraph; }
  // To be called when the events of a frame have come and the overlay has seen them. `panels`: the mouse is theirs, and so is
  // what it did, but for a drag that began over the picture.
  void decide(bool panels);
  std::vector<std::string> takeActions() { return std::exchange(actions_, {}); }
  // Counts every event of any kind: whether anything happened at all.
  std::uint64_t events() const { return events_; }

 private:
  static WindowInput& of(GLFWwindow* window);
  void onKey(int key, int action, int mods);
  void onButton(int button, int action, int mods);
  void onMove(double x, double y);
  glm::dvec2 place() const;  // where the mouse is: 0 to 1 of the window from its lower left corner
  void point();

  GLFWwindow* window_;
  ui::Overlay* overlay_ = nullptr;
  std::vector<std::string> actions_;
  CameraInput camera_;
  CameraInput fresh_;  // of the mouse, since decide()
  glm::dvec2 last_{0};
  bool known_ = false;                    // whether last_ is where the mouse was
  bool moved_ = false, pressed_ = false;  // since decide(): the mouse, one of its buttons
  bool turning_ = false, panning_ = false, captured_ = false;
  bool graphHasButton_ = false, held_ = false;  // the left button is the graph's; and is held
  bool down_ = false, clicked_ = false;         // as Pointer has them, and these in places
  glm::dvec2 position_{0}, dragged_{0}, pressedAt_{0};
  std::optional<glm::dvec2> press_;  // of the graph's button, since decide()
  std::uint64_t events_ = 0;
};

}  // namespace weft::app
