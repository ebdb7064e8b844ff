// What the two ends of a trial say to each other (shader_trial.h). Not for others.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gl/programs/program.h"

namespace weft::gl {

// Steps behind the trial, one character each.
constexpr char kTrialOpened = 'o', kTrialCompiled = 'c', kTrialLinked = 'l', kTrialDrawn = 'd';

struct TrialProgram {
  std::vector<std::pair<GLenum, std::string>> stages;
  std::vector<std::string> outputs;
};

std::string writeTrial(std::span<const StageSource> stages, std::span<const glsl::Define> defines,
                       std::span<const std::string> outputs);
// Nothing when it is no such text.
std::optional<TrialProgram> readTrial(std::string_view text);

}  // namespace weft::gl
