#include "engine/gl/programs/program_admission.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "engine/gl/programs/shader_trial.h"
#include "engine/glsl/bounds.h"

namespace weft::gl {

using base::Code;
using base::Diagnostics;

bool checkProgramSize(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                      Diagnostics& diagnostics) {
  bool good = true;
  for (const StageSource& stage : stages)
    good &= glsl::checkShaderSize(stage.source->interfaceWith(defines).size, *stage.source, diagnostics);
  return good;
}

bool isUnusual(std::span<const StageSource> stages, std::span<const glsl::Define> defines) {
  return std::ranges::any_of(stages, [&](const StageSource& stage) {
    return glsl::isUnusual(stage.source->interfaceWith(defines));
  });
}

bool survivesTrial(std::span<const std::string> command, const DeviceInfo& device,
                   std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                   std::span<const std::string> outputs, TrialTime& time, Diagnostics& diagnostics) {
  // A window's driver without its window.
  const Backend backend = device.backend != Backend::glfw ? device.backend
                          : device.software               ? Backend::osmesa
                                                          : Backend::egl;
  TrialResult result{
      .survived = false, .what = "unusual shaders before it took all of it", .during = "", .bytes = 0};
  if (const double left = time.all - time.spent; left > 0) {
    result =
        tryProgram(command, backend, stages, defines, outputs, static_cast<std::uint64_t>(std::ceil(left)));
    time.spent += result.seconds;
    if (result.survived) return true;
  }
  const auto tokensOf = [&](const StageSource& stage) {
    return stage.source->interfaceWith(defines).size.inlined;
  };
  const StageSource& largest = *std::ranges::max_element(stages, {}, tokensOf);
  base::Diagnostic& error = diagnostics.error(
      Code::driverDied, {largest.source->file, 0, 0},
      result.during.empty() ? "there is no time left to try this shader"
                            : fmt::format("the driver did not survive {} this shader", result.during));
  error.expected = fmt::format("at most {} s of processor time for all unusual shaders and {} MiB", time.all,
                               kMostTrialBytes >> 20);
  error.found = result.during.empty() ? result.what
                                      : fmt::format("{}, after {:.1f} s of processor time and with {} MiB",
                                                    result.what, result.seconds, result.bytes >> 20);
  error.hint = "make it smaller, or give it more time with --limit 2 on a slow or busy machine";
  return false;
}

void placeCircles(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                  Diagnostics& log) {
  const auto circles = [&](const StageSource& stage) {
    return !stage.source->interfaceWith(defines).size.circle.empty();
  };
  const auto stage = std::ranges::find_if(stages, circles);
  const auto isUnplaced = [](const base::Diagnostic& d) { return d.place.line == 0; };
  if (stage == stages.end() || std::ranges::none_of(log.items(), isUnplaced)) return;
  const glsl::ShaderSize& size = stage->source->interfaceWith(defines).size;
  Diagnostics placed;
  base::Diagnostic& circle =
      placed.error(log.items().front().code, stage->source->placeOf(size.circleAt.line, size.circleAt.column),
                   fmt::format("functions call each other in a circle: {}", fmt::join(size.circle, " -> ")));
  circle.expected = "functions that call others only, as GLSL has no recursion";
  circle.hint = "write it as a loop";
  for (const base::Diagnostic& d : log.items())
    if (!isUnplaced(d)) placed.add(d);
  log = std::move(placed);
}

}  // namespace weft::gl
