#include "engine/runtime/inspection/step_watches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "engine/graph/pick/pick.h"
#include "engine/graph/subresource.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/text/hash.h"

namespace weft::runtime {

namespace {

std::uint64_t hashOf(const void* data, std::size_t bytes, std::uint64_t hash) {
  const auto* at = static_cast<const unsigned char*>(data);
  for (; bytes >= 8; bytes -= 8, at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, at, 8);
    hash = text::hashCombine(hash, word);
  }
  std::uint64_t rest = 0;
  std::memcpy(&rest, at, bytes);
  return text::hashCombine(hash, rest + bytes);
}

// Of one resource, over all that the step wrote of it.
struct RecordSum {
  std::uint64_t hash = text::kHashSeed;
  std::size_t texels = 0, broken = 0;

  // As floats, or as whole numbers of 32 bits.
  void add(std::span<const std::byte> values, const gl::ClientFormat& client) {
    hash = hashOf(values.data(), values.size(), hash);
    const std::size_t size = client.channels * sizeof(float);
    texels += values.size() / size;
    for (std::size_t at = 0; client.type == GL_FLOAT && at < values.size(); at += size) {
      std::array<float, 4> texel{};
      std::memcpy(texel.data(), &values[at], size);
      broken += std::ranges::all_of(texel, [](float v) { return std::isfinite(v); }) ? 0 : 1;
    }
  }
};

// The mean of the samples, through a texture of one sample.
std::vector<std::byte> readSamples(const gl::TextureRef& texture, const gl::ClientFormat& client) {
  text::Diagnostics ignored;
  const auto resolved = gl::Texture::create(
      {.format = texture.desc.format, .width = texture.desc.width, .height = texture.desc.height}, "record",
      ignored);
  if (!resolved || !gl::resolveSamples(texture, resolved->id())) return {};
  return gl::readTexture(resolved->ref(), 0, 0, client.format, client.type);
}

void addWrite(Execution& execution, const graph::FlatUse& use, RecordSum& sum) {
  const graph::FlatResource& desc = execution.plan().graph->resources[use.resource];
  if (desc.kind == graph::ResourceKind::buffer) {
    std::uint64_t offset = 0;
    const BufferRef buffer = execution.buffer(use.resource, offset);
    if (buffer.id == 0) return;
    const std::vector<std::byte> bytes = gl::readBuffer(buffer.id, offset, buffer.bytes);
    sum.hash = hashOf(bytes.data(), bytes.size(), sum.hash);
    return;
  }
  const gl::TextureRef texture = execution.texture(use.resource);
  if (texture.id == 0) return;
  const gl::ClientFormat client = gl::clientFormatOf(texture.desc.format);
  for (std::uint32_t mip = use.mip; mip < use.mip + use.mips; ++mip) {
    const bool volume = desc.target == graph::Target::texture_3d;
    const std::uint32_t first = volume ? 0 : use.layer,
                        count = volume ? gl::extentOf(texture.desc, mip).layers : use.layers;
    for (std::uint32_t layer = first; layer < first + count; ++layer)
      sum.add(texture.desc.target == GL_TEXTURE_2D_MULTISAMPLE
                  ? readSamples(texture, client)
                  : gl::readTexture(texture, mip, layer, client.format, client.type),
              client);
  }
}

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

void StepRecorder::prepare(Execution& execution, std::uint32_t step) {
  const graph::FlatGraph& graph = *execution.plan().graph;
  bool filled = false;
  execution.plan().forEachWrite(step, [&](const graph::FlatUse& use) {
    if (use.access != graph::Access::write ||
        graph.resources[use.resource].kind != graph::ResourceKind::buffer)
      return;
    std::uint64_t offset = 0;
    const BufferRef buffer = execution.buffer(use.resource, offset);
    if (buffer.id == 0) return;
    if (!filled) glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    filled = true;
    clearBuffer(buffer.id, offset, buffer.bytes, graph::Value::number(0));
  });
  if (filled) glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

// What shaders stored must be visible to the read-back. The plan knows nothing of it, so it issues a barrier of its own.
void StepRecorder::look(Execution& execution, std::uint32_t step) {
  if (!execution.steps().hasResults(step)) return;
  const graph::Plan& plan = execution.plan();
  const graph::FlatGraph& graph = *plan.graph;
  const std::uint32_t index = plan.steps[step].pass;
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  std::vector<std::pair<std::string, RecordSum>> sums;  // in the order of the slots
  plan.forEachWrite(step, [&](const graph::FlatUse& use) {
    const std::string name(graph::sharedName(graph.resourceNames[use.resource]));
    auto sum = std::ranges::find(sums, name, &std::pair<std::string, RecordSum>::first);
    if (sum == sums.end()) sum = sums.emplace(sums.end(), name, RecordSum{});
    addWrite(execution, use, sum->second);
  });
  for (const auto& [name, sum] : sums)
    records_.push_back({.pass = graph.passNames[index],
                        .resource = name,
                        .hash = sum.hash,
                        .broken = static_cast<double>(sum.broken) /
                                  static_cast<double>(std::max<std::size_t>(1, sum.texels))});
}

void fillWithPoison(Execution& execution, std::uint32_t step, PoisonPattern pattern) {
  constexpr GLbitfield kTransfer =
      GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;
  const graph::Plan& plan = execution.plan();
  glMemoryBarrier(kTransfer);
  for (std::uint32_t r = 0; r < plan.graph->resources.size(); ++r) {
    const graph::FlatResource& desc = plan.graph->resources[r];
    if (plan.firstStep[r] != step || plan.persistent[r] || graph::isImported(desc)) continue;
    const bool buffer = desc.kind == graph::ResourceKind::buffer;
    execution.fill(r, graph::Value::number(valueFor(buffer ? graph::Format::r32f : desc.format, pattern)));
  }
  glMemoryBarrier(kTransfer | GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                  GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace weft::runtime
