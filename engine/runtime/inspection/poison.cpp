// Declared in step_record.h.
#include <limits>

#include "engine/graph/subresource.h"
#include "engine/runtime/inspection/step_record.h"
#include "engine/runtime/storage/resource_pool.h"

namespace weft::runtime {

namespace {

double valueFor(graph::Format format, PoisonPattern pattern) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  // By TexelKind; "nan" and "large" of each.
  constexpr double kValues[][2] = {{1, 0},  {1, 0},   {kNan, 30000}, {4294967295.0, 7},
                                   {-1, 7}, {1, 0.5}, {1, 0.5}};
  const bool large = pattern == PoisonPattern::large;
  if (format == graph::Format::rgb9_e5 && !large) return 60000;  // has no NaN
  return kValues[static_cast<std::size_t>(graph::infoOf(format).kind)][large];
}

}  // namespace

void fillWithPoison(Execution& execution, std::uint32_t step, PoisonPattern pattern) {
  constexpr GLbitfield kTransfer =
      GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;
  const graph::Plan& plan = execution.plan();
  glMemoryBarrier(kTransfer);
  for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
    const graph::FlatResource& desc = plan.graph->resources[r];
    if (plan.firstStep[r] != step || plan.persistent[r] || graph::isImported(desc)) continue;
    if (desc.kind == graph::ResourceKind::buffer) {
      std::uint64_t offset = 0;
      const BufferRef buffer = execution.buffer(r, offset);
      const double value = pattern == PoisonPattern::nan ? std::numeric_limits<double>::quiet_NaN() : 30000;
      if (buffer.id) clearBuffer(buffer.id, offset, buffer.bytes, graph::Value::number(value));
      continue;
    }
    const gl::TextureRef texture = execution.texture(r);
    if (texture.id == 0) continue;
    const graph::Value value = graph::Value::number(valueFor(desc.format, pattern));
    for (std::uint32_t mip = 0; mip < desc.mips; ++mip)
      clearTexture(texture, desc.format, mip, 0, desc.layers, value);
  }
  glMemoryBarrier(kTransfer | GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace weft::runtime
