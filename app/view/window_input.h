// The events of a GLFW window, queued and handed over a few at a time, however long a frame takes: to the panels, and here as rows of
// the table of keys, held keys, what the mouse did over the picture (what it did over a panel is the panel's), and the captured mouse of flight.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "app/ui/overlay.h"
#include "app/view/camera_rig.h"
#include "app/view/key_bindings.h"
#include "engine/imports/world.h"

namespace weft::app {

class WindowInput {
 public:
  // Installs callbacks. `window` and `keys` must outlive this.
  WindowInput(GLFWwindow* window, const KeyTable& keys);
  WindowInput(const WindowInput&) = delete;
  WindowInput& operator=(const WindowInput&) = delete;

  void setOverlay(ui::Overlay* overlay) { overlay_ = overlay; }
  // Where in the window the picture is: shares of it, from its lower left corner.
  void setPicture(glm::dvec2 corner, glm::dvec2 size) {
    corner_ = corner;
    size_ = size;
  }

  // Hands over the events that have come, up to the first that changes a key or button. True when more are waiting: for a layout of
  // the panels that has seen these. `oneClick`: a click that the graph has not seen yet is not followed by another.
  bool hand(bool oneClick);
  bool waiting() const { return !queue_.empty(); }

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
  glm::dvec2 place() const;  // where the mouse is: 0 to 1 of the picture from its lower left corner
  // The left button is the graph's, and turns the camera with Ctrl only.
  void giveButton(bool toGraph) { graphHasButton_ = toGraph; }
  // To be called after each hand(), when the overlay has seen the events. `panels`: the mouse is theirs, and so is what it did,
  // but for a drag that began over the picture.
  void decide(bool panels);
  std::vector<const KeyBinding*> takeActions() { return std::exchange(actions_, {}); }
  std::vector<std::string> takeDropped() { return std::exchange(dropped_, {}); }  // paths of files
  // Counts every event of any kind: whether anything happened at all.
  std::uint64_t events() const { return events_; }

 private:
  static WindowInput& of(GLFWwindow* window);
  void onKey(const ui::WindowEvent& event);
  void onButton(const ui::WindowEvent& event);
  void onMove(const ui::WindowEvent& event);
  void point();

  GLFWwindow* window_;
  const KeyTable& keys_;
  ui::Overlay* overlay_ = nullptr;
  std::deque<ui::WindowEvent> queue_;
  std::vector<const KeyBinding*> actions_;
  std::vector<std::string> dropped_;
  glm::dvec2 corner_{0}, size_{1};
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
