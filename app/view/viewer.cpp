#include "app/view/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <cassert>
#include <utility>
#include <vector>

#include "app/session.h"
#include "app/view/capture.h"
#include "app/view/key_bindings.h"

namespace weft::app {

namespace {

// What is wrong with the files or with a change made here is told, and does not count against the program.
void tell(base::Diagnostics& diagnostics, std::vector<base::Diagnostic>& list) {
  report(diagnostics);
  list = diagnostics.items();
  diagnostics.clear();
}

}  // namespace

Viewer::Viewer(const Options& options, DeviceSession& session, LiveGraph& live, base::Diagnostics said)
    : options_(options),
      session_(session),
      window_(static_cast<GLFWwindow*>(session.context->window())),
      renderer_(session.renderer),
      live_(live),
      input_(window_),
      panels_(live, session.renderer, log_),
      camera_(sceneCamera()),
      previousPose_(camera_.pose()),
      diagnostics_(std::move(said)),
      start_(glfwGetTime()) {
  if (options.ui) overlay_ = ui::Overlay::create(window_, session.context->contentScale());
  input_.setOverlay(overlay_.get());
  addActions();
  renderer_.device().timers.setEnabled(options.profile);
}

void Viewer::addActions() {
  actions_.add("help", [this] { panels_.help = !panels_.help; });
  actions_.add("panels", [this] { panels_.visible = !panels_.visible; });
  actions_.add("reset_camera", [this] { camera_ = OrbitCamera(sceneCamera()); });
  actions_.add("next_environment", [this] { live_.stepEnvironment(1); });
  actions_.add("previous_environment", [this] { live_.stepEnvironment(-1); });
  actions_.add("profile",
               [this] { renderer_.device().timers.setEnabled(!renderer_.device().timers.enabled()); });
  actions_.add("screenshot", [this] { screenshot_ = true; });
  actions_.add("close", [this] { glfwSetWindowShouldClose(window_, GLFW_TRUE); });
  for ([[maybe_unused]] const KeyBinding& binding : keyBindings())
    assert((!*binding.action || actions_.has(binding.action)) && "every key does something");
}

scene::CameraPose Viewer::sceneCamera() const {
  return runtime::headlessFrame(live_.world(), 0, 60).pose;
}

int Viewer::run() {
  while (!glfwWindowShouldClose(window_)) {
    glfwPollEvents();
    const gl::Size size = session_.context->framebufferSize();
    if (size.width == 0 || size.height == 0) {  // minimised: nothing to draw
      glfwWaitEventsTimeout(0.1);
      continue;
    }
    if (live_.resize(size.width, size.height, diagnostics_)) tell(diagnostics_, log_.change);
    if (live_.poll(glfwGetTime(), diagnostics_)) tell(diagnostics_, log_.files);
    if (live_.pollEnvironment(diagnostics_)) tell(diagnostics_, log_.environment);
    for (const std::string_view action : input_.takeActions()) actions_.run(action);
    const WindowInput::Mouse mouse = input_.takeMouse();
    camera_.turn(mouse.turnX, mouse.turnY);
    if (mouse.wheel != 0) camera_.zoom(mouse.wheel);
    frame(size);
    if (options_.maxFrames && frame_ >= options_.maxFrames) break;
  }
  return report(diagnostics_) || broken_ || !live_.good() ? 1 : 0;
}

void Viewer::frame(gl::Size size) {
  const double time = glfwGetTime() - start_;
  runtime::FrameInput in;
  in.frame = frame_;
  in.time = time;
  in.deltaTime = time - lastTime_;
  in.pose = camera_.pose();
  in.previousPose = previousPose_;
  in.headless = false;
  const runtime::FrameReport done = renderer_.frame(live_.world(), in, diagnostics_);
  renderer_.present(size.width, size.height);
  if (std::exchange(screenshot_, false))
    saveScreenshot(renderer_, fmt::format("weft_{:05}.png", frame_), diagnostics_);
  session_.context->debugLog().drain(diagnostics_);
  if (!diagnostics_.empty()) {
    log_.addPast(diagnostics_);
    broken_ |= report(diagnostics_) != 0;
    diagnostics_.clear();
  }
  ++frame_;
  if (frame_ == options_.maxFrames && !options_.screenshot.empty())
    saveScreenshot(renderer_, options_.screenshot, diagnostics_);
  drawUi(done);
  session_.context->swapBuffers();
  previousPose_ = in.pose;
  lastTime_ = time;
}

void Viewer::drawUi(const runtime::FrameReport& done) {
  if (!overlay_) return;
  const std::uint64_t before = live_.changes();
  overlay_->begin();
  panels_.draw(done, diagnostics_);
  overlay_->end();
  if (live_.changes() != before) tell(diagnostics_, log_.change);
}

}  // namespace weft::app
