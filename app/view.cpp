// weft view: a graph in a window, with an orbiting camera; files that change on disk take effect at once.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/device_session.h"
#include "app/key_bindings.h"
#include "app/live_graph.h"
#include "app/orbit_camera.h"
#include "app/session.h"
#include "app/ui/overlay.h"
#include "app/ui/panels.h"

namespace weft::app {

namespace {

struct Input {
  OrbitCamera camera;
  double lastX = 0, lastY = 0;
  bool dragging = false;
  std::vector<Action> actions;             // of keys, until the loop has done them
  const ui::Overlay* overlay = nullptr;    // takes events that are meant for a panel
};

Input& inputOf(GLFWwindow* window) { return *static_cast<Input*>(glfwGetWindowUserPointer(window)); }

void install(GLFWwindow* window, Input& input) {
  glfwSetWindowUserPointer(window, &input);
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    Input& in = inputOf(w);
    if (button == GLFW_MOUSE_BUTTON_LEFT)
      in.dragging = action == GLFW_PRESS && !(in.overlay && in.overlay->wantsMouse());
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    Input& in = inputOf(w);
    if (in.dragging) in.camera.turn(x - in.lastX, y - in.lastY);
    in.lastX = x;
    in.lastY = y;
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double dy) {
    Input& in = inputOf(w);
    if (!(in.overlay && in.overlay->wantsMouse())) in.camera.zoom(dy);
  });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    Input& in = inputOf(w);
    if (action != GLFW_PRESS || (in.overlay && in.overlay->wantsKeys())) return;
    if (const Action wanted = actionOf(key); wanted == Action::close) glfwSetWindowShouldClose(w, GLFW_TRUE);
    else if (wanted != Action::none) in.actions.push_back(wanted);
  });
}

void saveScreenshot(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics) {
  if (const auto image = renderer.readPresented8())
    if (assets::savePng8(path, image->width, image->height, image->channels, image->texels, diagnostics))
      fmt::print("wrote {}\n", path);
}

// What is wrong with the files or with a change made here is told, and does not count against the program.
void tell(base::Diagnostics& diagnostics, std::vector<base::Diagnostic>& list) {
  report(diagnostics);
  list = diagnostics.items();
  diagnostics.clear();
}

}  // namespace

int runView(const Options& options) {
  base::Diagnostics diagnostics;
  auto world = loadWorld(options, diagnostics);
  if (!world || diagnostics.hasErrors()) return report(diagnostics);
  auto session = openDevice(options, diagnostics);
  if (!session) {
    report(diagnostics);
    return 3;
  }
  auto* window = static_cast<GLFWwindow*>(session->context->window());
  if (!window) {
    fmt::print(stderr, "weft view needs a window: use --backend glfw, or `weft render` without a display\n");
    return 2;
  }
  graph::Settings settings = settingsOf(options, session->context->device().software);
  gl::Size size = session->context->framebufferSize();
  settings.screenWidth = std::max(1u, size.width);
  settings.screenHeight = std::max(1u, size.height);
  runtime::Renderer& renderer = session->renderer;
  LiveGraph live(options, renderer, std::move(*world), std::move(settings));
  if (!live.load(diagnostics)) return report(diagnostics);

  Input input{OrbitCamera(runtime::headlessFrame(live.world(), 0, 60).pose)};
  install(window, input);
  const auto overlay = options.ui ? ui::Overlay::create(window, session->context->contentScale()) : nullptr;
  input.overlay = overlay.get();
  ui::Log log;
  ui::Panels panels(live, renderer, log);
  renderer.device().timers.setEnabled(options.profile);
  scene::CameraPose previous = input.camera.pose();
  const double start = glfwGetTime();
  double lastTime = 0;
  bool broken = false, screenshot = false;
  for (std::uint32_t frame = 0; !glfwWindowShouldClose(window); ++frame) {
    glfwPollEvents();
    size = session->context->framebufferSize();
    if (size.width == 0 || size.height == 0) {  // minimised: nothing to draw
      glfwWaitEventsTimeout(0.1);
      continue;
    }
    if (live.resize(size.width, size.height, diagnostics)) tell(diagnostics, log.change);
    if (live.poll(glfwGetTime(), diagnostics)) tell(diagnostics, log.files);
    for (const Action action : input.actions) switch (action) {
        case Action::help: panels.help = !panels.help; break;
        case Action::toggleUi: panels.visible = !panels.visible; break;
        case Action::resetCamera: input.camera = OrbitCamera(runtime::headlessFrame(live.world(), 0, 60).pose); break;
        case Action::toggleProfile: renderer.device().timers.setEnabled(!renderer.device().timers.enabled()); break;
        case Action::screenshot: screenshot = true; break;
        default: break;
      }
    input.actions.clear();
    const double time = glfwGetTime() - start;
    runtime::FrameInput in;
    in.frame = frame;
    in.time = time;
    in.deltaTime = time - lastTime;
    in.pose = input.camera.pose();
    in.previousPose = previous;
    in.headless = false;
    const runtime::FrameReport done = renderer.frame(live.world(), in, diagnostics);
    renderer.present(size.width, size.height);
    if (std::exchange(screenshot, false)) saveScreenshot(renderer, fmt::format("weft_{:05}.png", frame), diagnostics);
    session->context->debugLog().drain(diagnostics);
    if (!diagnostics.empty()) {
      log.addPast(diagnostics);
      broken |= report(diagnostics) != 0;
      diagnostics.clear();
    }
    const bool last = options.maxFrames && frame + 1 >= options.maxFrames;
    if (last && !options.screenshot.empty()) saveScreenshot(renderer, options.screenshot, diagnostics);
    if (overlay) {
      const std::uint64_t before = live.changes();
      overlay->begin();
      panels.draw(done, diagnostics);
      overlay->end();
      if (live.changes() != before) tell(diagnostics, log.change);
    }
    session->context->swapBuffers();
    if (last) break;
    previous = in.pose;
    lastTime = time;
  }
  return report(diagnostics) || broken || !live.good() ? 1 : 0;
}

}  // namespace weft::app
