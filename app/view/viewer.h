// The viewer: a LiveGraph in a window, a camera, panels over the picture, and the loop that brings them
// together, frame after frame. Each part is a file beside this one; what it can do on a key is an action.
// Does not: open the window, read files.
#pragma once

#include <cstdint>
#include <memory>

#include "app/device_session.h"
#include "app/live_graph.h"
#include "app/ui/overlay.h"
#include "app/ui/panels.h"
#include "app/view/actions.h"
#include "app/view/orbit_camera.h"
#include "app/view/window_input.h"

namespace weft::app {

class Viewer {
 public:
  // `session` has a window, and outlives this; `live` has loaded, and said `said`.
  Viewer(const Options& options, DeviceSession& session, LiveGraph& live, base::Diagnostics said);
  Viewer(const Viewer&) = delete;
  Viewer& operator=(const Viewer&) = delete;

  // Until the window is closed. The exit code.
  int run();

 private:
  void addActions();
  scene::CameraPose sceneCamera() const;
  void frame(gl::Size size);
  void drawUi(const runtime::FrameReport& done);

  const Options& options_;
  DeviceSession& session_;
  GLFWwindow* window_;
  runtime::Renderer& renderer_;
  LiveGraph& live_;
  Actions actions_;
  WindowInput input_;
  std::unique_ptr<ui::Overlay> overlay_;  // null with --no-ui
  ui::Log log_;
  ui::Panels panels_;
  OrbitCamera camera_;
  scene::CameraPose previousPose_;
  base::Diagnostics diagnostics_;  // of what the loop is doing
  std::uint32_t frame_ = 0;
  double start_ = 0, lastTime_ = 0;  // seconds
  bool broken_ = false, screenshot_ = false;
};

}  // namespace weft::app
