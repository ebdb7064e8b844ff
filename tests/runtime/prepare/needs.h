// What a program asks of a device: varyings, samplers, and images, storage blocks and outputs together. From the interfaces of its
// stages, so that it is known without a device, and of a program that does not link. What main() cannot reach counts for nothing;
// what a driver drops besides does count. The least that OpenGL 4.5 gives is kMinDevice (core, tables 23.55 to 23.64).
// Does not: count uniforms, attributes or uniform blocks.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "engine/gl/programs/program.h"

namespace weft::gl::test {

struct StageNeeds {
  std::uint32_t locations = 0, components = 0;  // inputs of a fragment shader, outputs of a vertex shader
  std::uint32_t samplers = 0;
  std::uint32_t images = 0, storageBlocks = 0, outputs = 0;  // outputs: of a fragment shader
};
StageNeeds needsOf(const StageSource& stage, std::span<const glsl::Define> defines);

struct ProgramNeeds {
  std::uint32_t locations = 0, components = 0;  // between the stages
  std::uint32_t samplers = 0;                   // of the stage that has most
  std::uint32_t together = 0;  // images, storage blocks and outputs of the stage that has most
};
ProgramNeeds needsOf(std::span<const StageSource> stages, std::span<const glsl::Define> defines);

// MAX_VARYING_VECTORS, MAX_VARYING_COMPONENTS, MAX_TEXTURE_IMAGE_UNITS, MAX_COMBINED_SHADER_OUTPUT_RESOURCES.
inline constexpr ProgramNeeds kMinDevice{.locations = 15, .components = 60, .samplers = 16, .together = 8};

// The first figure of `needs` that is above that of `limits`.
struct Excess {
  const char* what = "";  // "locations of varyings"
  std::uint32_t needed = 0, allowed = 0;
  const char* hint = "";
};
std::optional<Excess> excessOf(const ProgramNeeds& needs, const ProgramNeeds& limits);

}  // namespace weft::gl::test
