// EGL without a display: every device that the device platform lists. Needs no X, no Wayland and no DRM master, so that a GPU
// of a headless machine works. libEGL is loaded when the first context is made, as OSMesa is.
#define EGL_NO_X11
#include <fmt/format.h>
#include <glad/egl.h>

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

 private:
  EGLDisplay display_;
  EGLContext context_;
};

// A current context on `display`, or null with the reason in `why`. Terminates the display on failure.
std::unique_ptr<Context> openOn(EGLDisplay display, const ContextOptions& options, std::string& why) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
    why = fmt::format("eglInitialize failed ({})", display == EGL_NO_DISPLAY ? "no display" : errorText());
    return nullptr;
  }
  const auto fail = [&](std::string reason) {
    why = std::move(reason);
    eglTerminate(display);
    return nullptr;
  };
  gladLoaderLoadEGL(display);  // what this one has
  if (!GLAD_EGL_VERSION_1_5) return fail("its EGL is older than 1.5");
  if (!eglBindAPI(EGL_OPENGL_API)) return fail("it has no desktop OpenGL");
  if (!GLAD_EGL_KHR_surfaceless_context) return fail("EGL_KHR_surfaceless_context is missing");
  const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wanted, &config, 1, &count) || count == 0) {
    if (!GLAD_EGL_KHR_no_config_context) return fail("no configuration for OpenGL");
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
  if (!eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) {
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

// Hardware first, otherwise in the driver's order. Empty with a reason in `failures` when devices cannot be listed.
std::vector<Device> listDevices(std::vector<std::string>& failures) {
  EGLDeviceEXT handles[32];
  EGLint count = 0;
  if (!eglQueryDevicesEXT(32, handles, &count) || count == 0) {
    failures.emplace_back("EGL devices: none are listed");
    return {};
  }
  std::vector<Device> devices;
  for (EGLint i = 0; i < count; ++i) {
    const char* extensions = eglQueryDeviceStringEXT(handles[i], EGL_EXTENSIONS);
    const bool software = hasExtension(extensions, "EGL_MESA_device_software");
    const char* file = hasExtension(extensions, "EGL_EXT_device_drm")
                           ? eglQueryDeviceStringEXT(handles[i], EGL_DRM_DEVICE_FILE_EXT)
                           : nullptr;
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
  if (!gladLoaderLoadEGL(EGL_NO_DISPLAY) || !GLAD_EGL_EXT_platform_device || !eglQueryDevicesEXT ||
      !eglQueryDeviceStringEXT) {
    failures.emplace_back("EGL: libEGL is missing, or has no EGL_EXT_platform_device");
    return {};
  }
  std::string why;
  bool seenHardware = false;
  for (const Device& device : listDevices(failures)) {
    if (hardwareOnly && device.software) continue;
    seenHardware |= !device.software;
    if (auto context =
            openOn(eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device.handle, nullptr), options, why))
      return {std::move(context), loader, device.name};
    failures.push_back(fmt::format("{}: {}", device.name, why));
  }
  if (hardwareOnly && !seenHardware) failures.emplace_back("EGL: no hardware device");
  return {};
}

}  // namespace weft::gl
