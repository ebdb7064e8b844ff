// EGL without a display: every device that the device platform lists. Needs no X, no Wayland and no DRM master, so that a GPU
// of a headless machine works.
#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "engine/gl/context/context_backends.h"

namespace weft::gl {

namespace {

bool hasExtension(const char* list, const std::string& name) {
  return list && (" " + std::string(list) + " ").find(" " + name + " ") != std::string::npos;
}

std::string errorText() {
  return fmt::format("EGL error 0x{:04X}", eglGetError());
}

class EglContext final : public Context {
 public:
  EglContext(EGLDisplay display, EGLContext context) : display_(display), context_(context) {}
  ~EglContext() override {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
    eglTerminate(display_);
    eglReleaseThread();
  }

  bool makeCurrent() {
    return eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
  }

 private:
  EGLDisplay display_;
  EGLContext context_;
};

// A current context on `display`, or null with the reason in `why`. Terminates the display on failure.
std::unique_ptr<Context> openOn(EGLDisplay display, const ContextOptions& options, std::string& why) {
  EGLint major = 0, minor = 0;
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, &major, &minor)) {
    why = fmt::format("eglInitialize failed ({})", display == EGL_NO_DISPLAY ? "no display" : errorText());
    return nullptr;
  }
  const auto fail = [&](std::string reason) {
    why = std::move(reason);
    eglTerminate(display);
    return nullptr;
  };
  if (major * 10 + minor < 15) return fail(fmt::format("EGL {}.{} is older than 1.5", major, minor));
  if (!eglBindAPI(EGL_OPENGL_API)) return fail("it has no desktop OpenGL");
  const char* extensions = eglQueryString(display, EGL_EXTENSIONS);
  if (!hasExtension(extensions, "EGL_KHR_surfaceless_context"))
    return fail("EGL_KHR_surfaceless_context is missing");
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) {
    if (!hasExtension(extensions, "EGL_KHR_no_config_context")) return fail("no configuration for OpenGL");
    config = EGL_NO_CONFIG_KHR;
  }
  // clang-format off
  const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5,
                               EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                               EGL_CONTEXT_OPENGL_DEBUG, options.debug ? EGL_TRUE : EGL_FALSE, EGL_NONE};
  // clang-format on
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT)
    return fail(fmt::format("gives no OpenGL 4.5 core context ({})", errorText()));
  auto opened = std::make_unique<EglContext>(display, context);
  if (!opened->makeCurrent()) {
    why = fmt::format("eglMakeCurrent failed ({})", errorText());
    return nullptr;
  }
  return opened;
}

struct Device {
  EGLDeviceEXT handle;
  bool software;
  std::string name;
};

template <class Function>
Function load(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// Hardware first, otherwise in the driver's order. Empty with a reason in `failures` when devices cannot be
// listed.
std::vector<Device> listDevices(const char* client, std::vector<std::string>& failures) {
  const auto query = load<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto text = load<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (!hasExtension(client, "EGL_EXT_platform_device") || !query) {
    failures.emplace_back("EGL devices: EGL_EXT_platform_device is missing");
    return {};
  }
  EGLDeviceEXT handles[32];
  EGLint count = 0;
  if (!query(32, handles, &count) || count == 0) {
    failures.emplace_back("EGL devices: none are listed");
    return {};
  }
  std::vector<Device> devices;
  for (EGLint i = 0; i < count; ++i) {
    const char* extensions = text ? text(handles[i], EGL_EXTENSIONS) : nullptr;
    const bool software = hasExtension(extensions, "EGL_MESA_device_software");
    const char* file =
        hasExtension(extensions, "EGL_EXT_device_drm") ? text(handles[i], EGL_DRM_DEVICE_FILE_EXT) : nullptr;
    devices.push_back({handles[i], software,
                       fmt::format("EGL device {} ({})", i,
                                   software ? "software"
                                   : file   ? file
                                            : "no file")});
  }
  std::stable_partition(devices.begin(), devices.end(), [](const Device& d) { return !d.software; });
  return devices;
}

}  // namespace

OpenedContext openEgl(const ContextOptions& options, bool hardwareOnly, std::vector<std::string>& failures) {
  const GlLoader loader = [](const char* name) { return eglGetProcAddress(name); };
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto display = load<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!client || !display) {
    failures.emplace_back("EGL: the library has no platform extensions");
    return {};
  }
  std::string why;
  bool seenHardware = false;
  for (const Device& device : listDevices(client, failures)) {
    if (hardwareOnly && device.software) continue;
    seenHardware |= !device.software;
    if (auto context = openOn(display(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr), options, why))
      return {std::move(context), loader, device.name};
    failures.push_back(fmt::format("{}: {}", device.name, why));
  }
  if (hardwareOnly && !seenHardware) failures.emplace_back("EGL: no hardware device");
  return {};
}

}  // namespace weft::gl
