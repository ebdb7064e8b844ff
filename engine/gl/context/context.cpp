#include "engine/gl/context/context.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glad/gl.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>

#include "engine/gl/context/context_backends.h"
#include "engine/gl/context/debug.h"
#include "engine/text/chars.h"
#include "engine/text/hash.h"
#include "gl_sentences.h"

namespace weft::gl {

namespace {

constexpr std::array<const char*, 4> kBackends = {"auto", "osmesa", "egl",
                                                  "glfw"};  // in the order of the enum

std::string textOf(GLenum name) {
  const auto* text = reinterpret_cast<const char*>(glGetString(name));
  return text ? text : "";
}

bool isSoftware(const std::string& renderer) {
  constexpr const char* kNames[] = {"llvmpipe", "softpipe", "swrast", "software rasterizer", "swiftshader"};
  return std::ranges::any_of(kNames, [lower = text::lowered(renderer)](const char* name) {
    return lower.find(name) != std::string::npos;
  });
}

DeviceInfo describeDevice(Backend backend, const std::string& platform) {
  DeviceInfo d;
  d.vendor = textOf(GL_VENDOR);
  d.renderer = textOf(GL_RENDERER);
  d.version = textOf(GL_VERSION);
  d.backend = backend;
  d.platform = platform;
  d.software = isSoftware(d.renderer);
  d.hasProgramBinaries = integerOf(GL_NUM_PROGRAM_BINARY_FORMATS) > 0;
  GLint bits = 0;
  glGetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  d.hasTimerQueries = !d.software && bits >= 30;
  d.uniformOffsetAlignment = integerOf(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT);
  for (GLuint axis = 0; axis < 3; ++axis)
    glGetIntegeri_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &d.computeGroups[axis]);
  // The backend is in the key because of binaries-per-backend (workarounds.md).
  const std::string all = fmt::format("{}\n{}\n{}\n{}\n{}", d.vendor, d.renderer, d.version,
                                      textOf(GL_SHADING_LANGUAGE_VERSION), nameOf(backend));
  d.driverKey = fmt::format("{:016x}", text::hashBytes(all));
  return d;
}

void setConventions() {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_DITHER);
  glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
}

struct Attempt {
  Backend backend;
  bool hardwareOnly = false;
};

std::vector<Attempt> attemptsFor(Backend backend) {
  if (backend == Backend::automatic) return {{Backend::egl, true}, {Backend::osmesa}, {Backend::egl, false}};
  return {{backend}};
}

// cache-on-a-full-disk (workarounds.md). The folder is the one that Mesa takes, or the nearest above that is there.
void checkRoomForCache() {
  constexpr std::uintmax_t kRoom = 16 << 20;
  namespace fs = std::filesystem;
  fs::path folder;
  for (const auto& [variable, below] :
       {std::pair{"MESA_SHADER_CACHE_DIR", ""}, {"XDG_CACHE_HOME", ""}, {"HOME", ".cache"}})
    if (const char* value = std::getenv(variable); value && folder.empty()) folder = fs::path(value) / below;
  std::error_code ec;
  folder = fs::absolute(folder.empty() ? "." : folder, ec);
  while (!fs::exists(folder, ec) && folder != folder.parent_path()) folder = folder.parent_path();
  const fs::space_info room = fs::space(folder, ec);
  if (!ec && room.available < kRoom) ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
}

OpenedContext open(const Attempt& attempt, const ContextOptions& options,
                   std::vector<std::string>& failures) {
  if (attempt.backend == Backend::osmesa) return openOsmesa(options, failures);
  if (attempt.backend == Backend::glfw) return openGlfw(options, failures);
  return openEgl(options, attempt.hardwareOnly, failures);
}

}  // namespace

Context::Context() : debugLog_(std::make_unique<DebugLog>()) {}

Context::~Context() = default;

void Context::drainMessages(text::Diagnostics& diagnostics) {
  debugLog_->drain(diagnostics);
}

const char* nameOf(Backend backend) {
  return kBackends[static_cast<std::size_t>(backend)];
}

std::optional<Backend> findBackend(std::string_view name) {
  const auto found = std::ranges::find(kBackends, name);
  if (found == kBackends.end()) return std::nullopt;
  return static_cast<Backend>(found - kBackends.begin());
}

std::unique_ptr<Context> createContext(const ContextOptions& options, text::Diagnostics& diagnostics) {
  [[maybe_unused]] static const bool checked = (checkRoomForCache(), true);
  std::vector<std::string> failures;
  for (const Attempt& attempt : attemptsFor(options.backend)) {
    OpenedContext opened = open(attempt, options, failures);
    if (!opened.context) continue;
    const int version = gladLoadGL(opened.load);
    if (GLAD_VERSION_MAJOR(version) * 10 + GLAD_VERSION_MINOR(version) < 45) {
      failures.push_back(fmt::format("{}: gives OpenGL {}.{}, not 4.5", opened.platform,
                                     GLAD_VERSION_MAJOR(version), GLAD_VERSION_MINOR(version)));
      continue;
    }
    opened.context->device_ = describeDevice(attempt.backend, opened.platform);
    if (attempt.hardwareOnly && opened.context->device_.software) {
      failures.push_back(fmt::format("{}: is a software rasterizer", opened.platform));
      continue;
    }
    if (options.debug) opened.context->debugLog_->install();
    setConventions();
    return std::move(opened.context);
  }
  diagnostics.error(
      say::noContext, {}, nameOf(options.backend), fmt::join(failures, "; "),
      options.backend == Backend::glfw
          ? "start it in a graphical session or under `xvfb-run -a`; `weft render` needs no display"
          : "install libosmesa6 for the software backend, or the GPU's EGL driver");
  return nullptr;
}

}  // namespace weft::gl
