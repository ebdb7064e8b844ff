// What the viewer can do, by name.
#include "app/view/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <utility>

#include "app/view/key_bindings.h"

namespace weft::app {

Viewer::Viewer(const ViewOptions& options, DeviceSession& session, LiveGraph& live, text::Diagnostics said)
    : options_(options),
      session_(session),
      window_(static_cast<GLFWwindow*>(session.context->window())),
      renderer_(session.renderer),
      live_(live),
      input_(window_),
      panels_(live, session.renderer, log_),
      diagnostics_(std::move(said)),
      renderScale_(options.renderScale),
      vsync_(options.vsync),
      idle_(options.idle) {
  uiScale_ = options.uiScale > 0 ? static_cast<float>(options.uiScale) : session.context->contentScale();
  if (options.ui) overlay_ = ui::Overlay::create(window_, uiScale_);
  input_.setOverlay(overlay_.get());
  addActions();
  renderer_.device().timers.setEnabled(options.profile);
  for (const std::string& panel : options.panels) panels_.toggle(panel);
}

void Viewer::addActions() {
  gl::PassTimers& timers = renderer_.device().timers;
  actions_ = {{"help", [this] { help_ = !help_; }},
              {"panels", [this] { panels_.visible = !panels_.visible; }},
              {"profile", [&timers] { timers.setEnabled(!timers.enabled()); }},
              {"fly", [this] { toggleFlight(); }},
              {"head_bob", [this] { rig_.headBob = !rig_.headBob; }},
              {"reset_camera", [this] { lookThrough(0); }},
              {"next_environment", [this] { live_.stepEnvironment(1); }},
              {"previous_environment", [this] { live_.stepEnvironment(-1); }},
              {"vsync", [this] { glfwSwapInterval((vsync_ = !vsync_) ? 1 : 0); }},
              {"idle", [this] { idle_ = !idle_; }},
              {"render_scale_down", [this] { scaleRendering(-1); }},
              {"render_scale_up", [this] { scaleRendering(1); }},
              {"record", [this] { toggleRecording(); }},
              {"write_back", [this] { panels_.writeBack(diagnostics_); }},
              {"screenshot", [this] { screenshot_ = ".png"; }},
              {"screenshot_exr", [this] { screenshot_ = ".exr"; }},
              {"close", [this] {
                 if (input_.captured())
                   toggleFlight();
                 else
                   glfwSetWindowShouldClose(window_, GLFW_TRUE);
               }}};
  for (std::size_t i = 0; i < 9; ++i)
    actions_[fmt::format("camera_{}", i + 1)] = [this, i] { lookThrough(i); };
  for (const std::string& panel : ui::Panels::names())
    actions_["panel_" + panel] = [this, panel] { panels_.toggle(panel); };
  for ([[maybe_unused]] const KeyBinding& binding : keyBindings())
    assert((binding.how != KeyBinding::How::press || actions_.contains(binding.action)) &&
           "every key does something");
}

const scene::Camera* Viewer::sceneCamera() const {
  const scene::Camera* named = scene::findCamera(live_.world().scene(), cameraName_);
  return named ? named : scene::findCamera(live_.world().scene(), "");
}

void Viewer::lookThrough(std::size_t camera) {
  const auto cameras = live_.world().scene().cameras.rows();
  if (camera >= cameras.size()) return;
  if (rig_.mode() == CameraRig::Mode::fly) toggleFlight();
  cameraName_ = camera == 0 ? "" : cameras[camera].name;
  rig_.jumpTo(scene::poseAt(cameras[camera], clock_.last().time));
}

void Viewer::toggleFlight() {
  const bool fly = rig_.mode() != CameraRig::Mode::fly;
  rig_.setMode(fly ? CameraRig::Mode::fly : CameraRig::Mode::orbit);
  input_.capture(fly);
}

void Viewer::scaleRendering(int steps) {
  static constexpr std::array kScales = {0.25, 0.5, 0.75, 1.0, 1.5, 2.0};
  if (steps > 0) {
    const auto next = std::ranges::upper_bound(kScales, renderScale_);
    if (next != kScales.end()) renderScale_ = *next;
  } else {
    const auto here = std::ranges::lower_bound(kScales, renderScale_);
    if (here != kScales.begin()) renderScale_ = *(here - 1);
  }
}

void Viewer::toggleRecording() {
  if (recorder_.active()) {
    recorder_.stop(diagnostics_);
    clock_.fix(0);
  } else if (recorder_.start(options_.record, diagnostics_)) {
    clock_.fix(options_.fps);
  }
}

}  // namespace weft::app
