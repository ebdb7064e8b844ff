// weft view: a graph in a window, with an orbiting camera; files that change on disk take effect at once.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "app/commands.h"
#include "app/device_session.h"
#include "app/live_graph.h"
#include "app/orbit_camera.h"
#include "app/session.h"

namespace weft::app {

namespace {

struct Input {
  OrbitCamera camera;
  double lastX = 0, lastY = 0;
  bool dragging = false, screenshot = false;
};

Input& inputOf(GLFWwindow* window) { return *static_cast<Input*>(glfwGetWindowUserPointer(window)); }

void install(GLFWwindow* window, Input& input) {
  glfwSetWindowUserPointer(window, &input);
  glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) {
    if (button == GLFW_MOUSE_BUTTON_LEFT) inputOf(w).dragging = action == GLFW_PRESS;
  });
  glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
    Input& in = inputOf(w);
    if (in.dragging) in.camera.turn(x - in.lastX, y - in.lastY);
    in.lastX = x;
    in.lastY = y;
  });
  glfwSetScrollCallback(window, [](GLFWwindow* w, double, double dy) { inputOf(w).camera.zoom(dy); });
  glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int) {
    if (action != GLFW_PRESS) return;
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(w, GLFW_TRUE);
    if (key == GLFW_KEY_F12) inputOf(w).screenshot = true;
  });
}

void saveScreenshot(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics) {
  if (const auto image = renderer.readPresented8())
    if (assets::savePng8(path, image->width, image->height, image->channels, image->texels, diagnostics))
      fmt::print("wrote {}\n", path);
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
  scene::CameraPose previous = input.camera.pose();
  const double start = glfwGetTime();
  double lastTime = 0;
  bool broken = false;
  for (std::uint32_t frame = 0; !glfwWindowShouldClose(window); ++frame) {
    glfwPollEvents();
    size = session->context->framebufferSize();
    if (size.width == 0 || size.height == 0) {  // minimised: nothing to draw
      glfwWaitEventsTimeout(0.1);
      continue;
    }
    live.resize(size.width, size.height, diagnostics);
    live.poll(glfwGetTime(), diagnostics);
    if (!diagnostics.empty()) {  // of files: told, not counted against the program
      report(diagnostics);
      diagnostics.clear();
    }
    const double time = glfwGetTime() - start;
    runtime::FrameInput in;
    in.frame = frame;
    in.time = time;
    in.deltaTime = time - lastTime;
    in.pose = input.camera.pose();
    in.previousPose = previous;
    in.headless = false;
    renderer.frame(live.world(), in, diagnostics);
    renderer.present(size.width, size.height);
    session->context->debugLog().drain(diagnostics);
    if (!diagnostics.empty()) {
      broken |= report(diagnostics) != 0;
      diagnostics.clear();
    }
    if (input.screenshot) {
      saveScreenshot(renderer, fmt::format("weft_{:05}.png", frame), diagnostics);
      input.screenshot = false;
    }
    const bool last = options.maxFrames && frame + 1 >= options.maxFrames;
    if (last && !options.screenshot.empty()) saveScreenshot(renderer, options.screenshot, diagnostics);
    session->context->swapBuffers();
    if (last) break;
    previous = in.pose;
    lastTime = time;
  }
  return report(diagnostics) || broken || !live.good() ? 1 : 0;
}

}  // namespace weft::app
