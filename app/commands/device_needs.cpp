#include "app/commands/device_needs.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/glsl/interface.h"

namespace weft::app {

using glsl::Role;

void DeviceNeeds::note(const std::string& what, std::uint32_t needed, const std::string& pass) {
  const auto found = std::ranges::find(all_, what, &DeviceNeed::what);
  if (needed <= found->needed) return;
  found->needed = needed;
  found->pass = pass;
}

void DeviceNeeds::add(const std::string& pass, std::span<const gl::StageSource> stages,
                      std::span<const glsl::Define> defines, const gl::Reflection& linked) {
  std::uint32_t stores = 0;
  for (const gl::StageSource& stage : stages) {
    const glsl::Interface& shader = stage.source->interfaceWith(defines);
    const auto count = [&](Role role) {
      std::uint32_t sum = 0;
      for (const glsl::Declaration& each : shader.declarations)
        if (each.role == role && (role == Role::output || shader.isLive(each)))
          sum += std::max(1u, each.elements);
      return sum;
    };
    const char* const name = stage.stage == GL_VERTEX_SHADER     ? "vertex"
                             : stage.stage == GL_FRAGMENT_SHADER ? "fragment"
                                                                 : "compute";
    const std::uint32_t images = count(Role::image), blocks = count(Role::storage_block);
    const std::uint32_t outputs = stage.stage == GL_FRAGMENT_SHADER ? count(Role::output) : 0;
    note(fmt::format("{} samplers", name), count(Role::sampler), pass);
    note(fmt::format("{} images", name), images, pass);
    note(fmt::format("{} uniform blocks", name), count(Role::uniform_block), pass);
    note(fmt::format("{} storage blocks", name), blocks, pass);
    note("outputs", outputs, pass);
    stores += images + blocks + outputs;
  }
  note("images, storage blocks and outputs", stores, pass);
  const auto& group = linked.workGroup;
  note("threads of a work group", group[0] * group[1] * group[2], pass);
  note("threads of a work group along z", group[2], pass);
  for (const gl::Block& block : linked.uniformBlocks) note("bytes of a uniform block", block.bytes, pass);
}

std::string DeviceNeeds::text() const {
  std::string text = "what OpenGL 4.5 guarantees, and what passes need at most:\n";
  for (const DeviceNeed& need : all_)
    if (need.needed > 0)
      text += fmt::format("  {:>6} {:<36} {:>6} in '{}'{}\n", need.guaranteed, need.what, need.needed,
                          need.pass, need.needed > need.guaranteed ? ", beyond" : "");
  return text;
}

}  // namespace weft::app
