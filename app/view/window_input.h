// The events of a GLFW window, kept until the loop asks for them: names of actions, held keys, what the mouse did over the
// picture (what it did over a panel is the panel's), and the captured mouse of flight.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string_view>
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
  bool movesCamera() const;
  // The mouse over a picture of this size, for graphs that read it: where it is, whether its left button is held, and
  // whether that went down since pointerShown(). What it does over a panel does not count.
  imports::Pointer pointer(std::uint32_t width, std::uint32_t height) const;
  void pointerShown() { clicked_ = false; }
  // The left button is the graph's, and turns the camera with Ctrl only.
  void giveButton(bool toGraph) { graphHasButton_ = toGraph; }
  // To be called when panels were drawn. A button or wheel that came behind a key or a movement waits until
  // then: the key may show or hide the panel under the mouse, and the movement may end over another.
  void panelsDrawn();
  std::vector<std::string_view> takeActions();
  // Whether a key bound as `held` to this action is down.
  bool held(std::string_view action) const;
  // Counts every event of any kind: whether anything happened at all.
  std::uint64_t events() const { return events_; }

 private:
  static WindowInput& of(GLFWwindow* window);
  void onKey(int key, int action, int mods);
  void onButton(int button, int action, int mods);
  void onMove(double x, double y);
  // A button or wheel comes: notes when the panels do not know yet whether it is theirs.
  void waitIfUnknown();
  glm::dvec2 place() const;  // where the mouse is: 0 to 1 of the window from its lower left corner
  void point();
  void press(glm::dvec2 at);
  void onScroll(double steps);

  GLFWwindow* window_;
  ui::Overlay* overlay_ = nullptr;
  std::vector<std::string_view> actions_;
  CameraInput camera_;
  CameraInput waiting_;     // what the mouse did since `undecided_`
  bool undecided_ = false;  // whether a panel or the picture has the mouse
  glm::dvec2 last_{0};
  bool moved_ = false;  // since panels were drawn
  bool turning_ = false, panning_ = false, captured_ = false, fresh_ = true;
  // As Pointer has them, in places.
  glm::dvec2 position_{0}, dragged_{0}, pressed_{0};
  bool down_ = false, clicked_ = false, graphHasButton_ = false;
  std::optional<glm::dvec2> waitingPress_;  // a press since `undecided_`, and whether it is still held
  bool waitingDown_ = false;
  std::uint64_t events_ = 0;
};

}  // namespace weft::app
