#include "tests/runtime/prepare/needs.h"

#include <algorithm>
#include <map>
#include <string_view>

#include "engine/glsl/interface.h"

namespace weft::gl::test {

StageNeeds needsOf(const StageSource& stage, std::span<const glsl::Define> defines) {
  using glsl::Role;
  struct Locations {
    std::uint32_t locations = 0, components = 0;
  };
  std::map<std::string_view, Locations> structures;
  const auto extentOf = [&](std::string_view name) -> Locations {
    if (const auto known = structures.find(name); known != structures.end()) return known->second;
    const GlslType* type = findGlslType(name);
    if (!type || type->kind != GlslType::Kind::value) return {};
    return {type->columns, type->columns * type->rows};
  };
  const auto add = [&](std::uint32_t& locations, std::uint32_t& components, const glsl::Declaration& each) {
    const Locations one = extentOf(each.type);
    const std::uint32_t elements = std::max(1u, each.elements);
    locations += one.locations * elements;
    components += one.components * elements;
  };
  const glsl::Interface& interface = stage.source->interfaceWith(defines);
  const bool fragment = stage.stage == GL_FRAGMENT_SHADER;
  const Role varying = fragment ? Role::input : Role::output;
  StageNeeds needs;
  for (const glsl::Declaration& each : interface.declarations) {
    const std::uint32_t elements = std::max(1u, each.elements);
    if (each.role == Role::field) {
      Locations& whole = structures[each.owner];
      add(whole.locations, whole.components, each);
    } else if (each.role == Role::storage_block) {
      if (interface.isLive(each)) needs.storageBlocks += elements;
    } else if (each.name.starts_with("gl_") || !interface.isLive(each)) {
      continue;
    } else if (each.role == Role::sampler) {
      needs.samplers += elements;
    } else if (each.role == Role::image) {
      needs.images += elements;
    } else if (each.role == varying && stage.stage != GL_COMPUTE_SHADER) {
      add(needs.locations, needs.components, each);
    } else if (each.role == Role::output && fragment) {
      needs.outputs += elements;
    }
  }
  return needs;
}

ProgramNeeds needsOf(std::span<const StageSource> stages, std::span<const glsl::Define> defines) {
  ProgramNeeds all;
  for (const StageSource& stage : stages) {
    const StageNeeds one = needsOf(stage, defines);
    if (stage.stage == GL_FRAGMENT_SHADER) {
      all.locations = one.locations;
      all.components = one.components;
    }
    all.samplers = std::max(all.samplers, one.samplers);
    all.together = std::max(all.together, one.images + one.storageBlocks + one.outputs);
  }
  return all;
}

std::optional<Excess> excessOf(const ProgramNeeds& needs, const ProgramNeeds& limits) {
  constexpr const char* kFetch =
      "pass the number of the instance as one `flat` input, and read what belongs to it in the fragment "
      "shader";
  for (const Excess& each : {Excess{"locations of varyings", needs.locations, limits.locations, kFetch},
                             Excess{"components of varyings", needs.components, limits.components, kFetch},
                             Excess{"samplers in one stage", needs.samplers, limits.samplers,
                                    "put textures of one size into the layers of one"},
                             Excess{"images, storage blocks and outputs in one stage", needs.together,
                                    limits.together, "merge blocks, or write in two passes"}})
    if (each.needed > each.allowed) return each;
  return std::nullopt;
}

}  // namespace weft::gl::test
