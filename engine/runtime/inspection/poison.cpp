#include "engine/runtime/inspection/poison.h"

#include <limits>

#include "engine/graph/subresource.h"
#include "engine/runtime/storage/resource_pool.h"

namespace weft::runtime {

namespace {

double valueFor(graph::Format format, PoisonPattern pattern) {
  const bool nan = pattern == PoisonPattern::nan;
  switch (graph::infoOf(format).kind) {
    case graph::TexelKind::floating:
      if (format == graph::Format::rgb9_e5) return nan ? 60000 : 30000;  // has no NaN
      return nan ? std::numeric_limits<double>::quiet_NaN() : 30000;
    case graph::TexelKind::depth:
    case graph::TexelKind::depth_stencil:
      return nan ? 1 : 0.5;
    case graph::TexelKind::unsigned_integer:
      return nan ? 4294967295.0 : 7;
    case graph::TexelKind::signed_integer:
      return nan ? -1 : 7;
    default:
      return nan ? 1 : 0;
  }
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
