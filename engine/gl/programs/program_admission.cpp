#include "engine/gl/programs/program_admission.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "engine/base/limits.h"
#include "engine/gl/programs/shader_trial.h"

namespace weft::gl {

using base::Code;
using base::Diagnostics;
using base::Limit;

ProgramSize measureProgram(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                           Diagnostics& diagnostics) {
  ProgramSize program;
  for (const StageSource& stage : stages) {
    program.stages.push_back(glsl::measureShader(*stage.source, defines));
    glsl::checkShaderSize(program.stages.back(), *stage.source, diagnostics);
    program.unusual |= glsl::isUnusual(program.stages.back());
  }
  return program;
}

bool survivesTrial(std::span<const std::string> command, const DeviceInfo& device,
                   std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                   std::span<const std::string> outputs, const ProgramSize& size, TrialTime& time,
                   Diagnostics& diagnostics) {
  // A window's driver without its window.
  const Backend backend = device.backend != Backend::glfw ? device.backend
                          : device.software               ? Backend::osmesa
                                                          : Backend::egl;
  const auto all = static_cast<double>(base::limitOf(Limit::shader_seconds));
  TrialResult result{
      .survived = false, .what = "unusual shaders before it took all of it", .during = "", .bytes = 0};
  if (const double left = all - time.spent; left > 0) {
    result =
        tryProgram(command, backend, stages, defines, outputs, static_cast<std::uint64_t>(std::ceil(left)));
    time.spent += result.seconds;
    if (result.survived) return true;
  }
  std::size_t largest = 0;
  for (std::size_t i = 1; i < stages.size(); ++i)
    if (glsl::largestShare(size.stages[i]).share >= glsl::largestShare(size.stages[largest]).share)
      largest = i;
  const glsl::ShaderShare share = glsl::largestShare(size.stages[largest]);
  base::Diagnostic& error = diagnostics.error(
      Code::driverDied, {stages[largest].source->file, 0, 0},
      result.during.empty() ? "there is no time left to try this shader"
                            : fmt::format("the driver did not survive {} this shader", result.during));
  error.expected = fmt::format("at most {} s of processor time for all unusual shaders ({}) and {} MiB ({})",
                               base::limitOf(Limit::shader_seconds), base::nameOf(Limit::shader_seconds),
                               base::limitOf(Limit::shader_memory) >> 20, base::nameOf(Limit::shader_memory));
  error.found = result.during.empty() ? result.what
                                      : fmt::format("{}, after {:.1f} s of processor time and with {} MiB",
                                                    result.what, result.seconds, result.bytes >> 20);
  error.hint = fmt::format(
      "make it smaller: it has {:.0f} % of what {} allows by default; or raise {} on a slow or busy machine",
      100 * share.share, base::nameOf(share.limit), base::nameOf(Limit::shader_seconds));
  return false;
}

void placeCircles(std::span<const StageSource> stages, const ProgramSize& size, Diagnostics& log) {
  const auto isAbout = [](const base::Diagnostic& d) {
    return d.severity == base::Severity::error && d.message.find("recursion") != std::string::npos;
  };
  Diagnostics placed;
  bool told = false;
  for (base::Diagnostic d : log.items()) {
    for (std::size_t i = 0; i < stages.size() && isAbout(d); ++i) {
      const glsl::ShaderSize& stage = size.stages[i];
      if (stage.circle.empty()) continue;
      if (!told) {
        base::Diagnostic& circle = placed.error(
            d.code, stages[i].source->placeOf(stage.circleAt.line, stage.circleAt.column),
            fmt::format("functions call each other in a circle: {}", fmt::join(stage.circle, " -> ")));
        circle.expected = "functions that call others only, as GLSL has no recursion";
        circle.hint = "write it as a loop";
      }
      told = true;
      d.message.clear();
    }
    if (!d.message.empty()) placed.add(std::move(d));
  }
  log = std::move(placed);
}

}  // namespace weft::gl
