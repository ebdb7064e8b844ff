// weft view: a graph in a window, with an orbiting camera.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/glm.hpp>

#include "app/commands.h"
#include "app/device_session.h"
#include "app/session.h"

namespace weft::app {

namespace {

// Orbit around the target: left drag turns, wheel moves nearer and farther.
class OrbitCamera {
 public:
  explicit OrbitCamera(const scene::CameraPose& pose) : pose_(pose) {
    const glm::dvec3 offset = pose.position - pose.target;
    distance_ = glm::length(offset);
    yaw_ = std::atan2(offset.x, offset.z);
    pitch_ = std::asin(std::clamp(offset.y / distance_, -1.0, 1.0));
  }
  void turn(double dx, double dy) {
    yaw_ -= dx * 0.005;
    pitch_ = std::clamp(pitch_ + dy * 0.005, -1.55, 1.55);
  }
  void zoom(double steps) { distance_ = std::clamp(distance_ * std::pow(0.9, steps), pose_.nearPlane * 2, 1e5); }
  scene::CameraPose pose() const {
    scene::CameraPose pose = pose_;
    const glm::dvec3 direction(std::cos(pitch_) * std::sin(yaw_), std::sin(pitch_), std::cos(pitch_) * std::cos(yaw_));
    pose.position = pose.target + direction * distance_;
    return pose;
  }

 private:
  scene::CameraPose pose_;
  double yaw_ = 0, pitch_ = 0, distance_ = 1;
};

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
  if (!renderer.load(settings, *world, diagnostics)) return report(diagnostics);

  Input input{OrbitCamera(runtime::headlessFrame(*world, 0, 60).pose)};
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
    if (size.width != settings.screenWidth || size.height != settings.screenHeight) {
      settings.screenWidth = size.width;
      settings.screenHeight = size.height;
      if (!renderer.load(settings, *world, diagnostics)) broken = true;
    }
    const double time = glfwGetTime() - start;
    runtime::FrameInput in;
    in.frame = frame;
    in.time = time;
    in.deltaTime = time - lastTime;
    in.pose = input.camera.pose();
    in.previousPose = previous;
    in.headless = false;
    renderer.frame(*world, in, diagnostics);
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
  return report(diagnostics) || broken ? 1 : 0;
}

}  // namespace weft::app
