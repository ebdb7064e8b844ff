// Whether a program may be handed to the driver: its stages held against their bounds, tried in a process of
// its own when they are unusual, and functions that call each other in a circle reported with their place. Parts
// of ProgramCache, not for others.
#pragma once

#include <span>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/gl/context/context.h"
#include "engine/gl/programs/program.h"

namespace weft::gl {

// False after errors (W203) for what is beyond a bound.
bool checkProgramSize(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                      base::Diagnostics& diagnostics);
// Whether the driver may not survive the program, or must work long.
bool isUnusual(std::span<const StageSource> stages, std::span<const glsl::Define> defines);

// Processor time that trials have taken since a graph began to load, and that all of them together have.
struct TrialTime {
  double spent = 0, all = 0;
};

// False after an error (W204): the driver did not survive the program, or no time is left to try it.
bool survivesTrial(std::span<const std::string> command, const DeviceInfo& device,
                   std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                   std::span<const std::string> outputs, TrialTime& time, base::Diagnostics& diagnostics);

// Drivers say that there is recursion, and not where.
void placeCircles(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                  base::Diagnostics& log);

}  // namespace weft::gl
