// OpenGL 4.5 core contexts behind one interface: OSMesa (software, no window system), EGL (a GPU or llvmpipe
// without a display) and GLFW (a window). createContext leaves the context current, glad loaded and the
// engine's conventions set: lower-left origin with [0,1] clip depth, GL_FRAMEBUFFER_SRGB off, seamless cube
// maps, pixel store alignment 1. glad's function pointers are one set per process, so one process uses one
// backend at a time; every GL call goes through them and never through symbols of a linked libGL or
// libOSMesa.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/text/diagnostic.h"

namespace weft::gl {

enum class Backend : std::uint8_t { automatic, osmesa, egl, glfw };

// "auto", "osmesa", "egl", "glfw".
const char* nameOf(Backend backend);
std::optional<Backend> findBackend(std::string_view name);

struct ContextOptions {
  // automatic, for headless use: an EGL device if it is hardware, else OSMesa, else any EGL. OSMesa goes
  // before a software EGL because it needs no device files or vendor configuration: with both on llvmpipe, it
  // has fewer ways to fail and the same pixels.
  Backend backend = Backend::automatic;
  std::string title = "weft";                // GLFW
  std::uint32_t width = 1280, height = 720;  // GLFW: window size in screen coordinates
  bool visible = false;                      // GLFW
  bool vsync = true;                         // GLFW
  bool debug = true;                         // a debug context with its messages in debugLog()
};

struct DeviceInfo {
  std::string vendor, renderer, version;
  Backend backend = Backend::osmesa;  // never automatic
  std::string platform;   // how it was opened: "OSMesa", "EGL device 0 (/dev/dri/renderD128)", "GLFW"
  bool software = false;  // llvmpipe, softpipe, swrast: timer queries are not to be believed
  bool hasProgramBinaries = false;
  bool hasTimerQueries = false;  // hardware with timestamp counters of at least 30 bits
  std::int32_t uniformOffsetAlignment = 256;
  std::int32_t computeGroups[3] = {};  // that a dispatch may have
  std::string driverKey;  // 16 hex digits over vendor, renderer, version and backend: keys caches on disk
};

struct Size {
  std::uint32_t width = 0, height = 0;
};

class DebugLog;

class Context {
 public:
  virtual ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  // GLFWwindow* of the GLFW backend, else null. Owned by the context.
  virtual void* window() const { return nullptr; }
  // Pixels of the window's framebuffer 0; 0 without a window.
  virtual Size framebufferSize() const { return {}; }
  // Screen scale for the UI, 1 when there is no screen.
  virtual float contentScale() const { return 1.0f; }

  const DeviceInfo& device() const { return device_; }
  DebugLog& debugLog() { return *debugLog_; }
  // Adds a W120 for each message of the driver that is new since the last call.
  void drainMessages(text::Diagnostics& diagnostics);

 protected:
  Context();
  DeviceInfo device_;
  std::unique_ptr<DebugLog> debugLog_;
  friend std::unique_ptr<Context> createContext(const ContextOptions& options,
                                                text::Diagnostics& diagnostics);
};

// A current context, or null with a W110 diagnostic that lists every platform that was tried and why it
// failed. Destroy GL objects before the context.
std::unique_ptr<Context> createContext(const ContextOptions& options, text::Diagnostics& diagnostics);

}  // namespace weft::gl
