// GLFW: a window on the screen, the only backend with a framebuffer 0.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

#include "engine/gl/context/context_backends.h"

namespace weft::gl {

namespace {

std::string lastError() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "no reason given";
}

int g_windows = 0;  // glfwTerminate with the last one

class GlfwContext final : public Context {
 public:
  explicit GlfwContext(GLFWwindow* window) : window_(window) { ++g_windows; }
  ~GlfwContext() override {
    glfwDestroyWindow(window_);
    if (--g_windows == 0) glfwTerminate();
  }

  void* window() const override { return window_; }
  Size framebufferSize() const override {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window_, &width, &height);
    return {static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height)};
  }
  float contentScale() const override {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    return std::max({x, y, 0.25f});
  }

 private:
  GLFWwindow* window_;
};

}  // namespace

OpenedContext openGlfw(const ContextOptions& options, std::vector<std::string>& failures) {
  if (!glfwInit()) {
    failures.push_back(fmt::format("GLFW: {}", lastError()));
    return {};
  }
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, options.debug ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_VISIBLE, options.visible ? GLFW_TRUE : GLFW_FALSE);
  glfwWindowHint(GLFW_DEPTH_BITS, 0);
  glfwWindowHint(GLFW_STENCIL_BITS, 0);
  glfwWindowHintString(GLFW_X11_CLASS_NAME, "weft");  // by which taskbars group windows
  glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "weft");
  GLFWwindow* window = glfwCreateWindow(std::max(1, static_cast<int>(options.width)),
                                        std::max(1, static_cast<int>(options.height)), options.title.c_str(),
                                        nullptr, nullptr);
  if (!window) {
    failures.push_back(fmt::format("GLFW: {}", lastError()));
    if (g_windows == 0) glfwTerminate();
    return {};
  }
  auto context = std::make_unique<GlfwContext>(window);
  glfwMakeContextCurrent(window);
  if (glfwGetCurrentContext() != window) {
    failures.push_back(fmt::format("GLFW: the window's context cannot be made current: {}", lastError()));
    return {};
  }
  glfwSwapInterval(options.vsync ? 1 : 0);
  return {std::move(context), [](const char* name) { return glfwGetProcAddress(name); }, "GLFW"};
}

}  // namespace weft::gl
