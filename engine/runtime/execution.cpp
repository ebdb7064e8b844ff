// The frame loop: what changed, what runs. One step of it stands in execution_step.cpp, preparing in
// execution_prepare.cpp.
#include "engine/runtime/execution.h"

#include <algorithm>
#include <cstring>
#include <limits>

#include "engine/base/hash.h"
#include "engine/runtime/formats.h"

namespace weft::runtime {

using graph::Access;
using graph::FlatUse;
using graph::kNone;

FrameReport Execution::frame(const World& world, const FrameInput& input, base::Diagnostics& diagnostics) {
  world_ = &world;
  input_ = input;
  device_.imports.beginFrame(world, input);
  refreshImports(diagnostics);
  resetHistories(diagnostics);
  refreshUniforms();
  refreshOwnHashes();
  generationsBefore_ = generations_;
  cadence_->decide(own_, generations_);
  if (uniformsDirty_ && !uniformBytes_.empty()) {
    gl::uploadBuffer(uniforms_.id(), 0, uniformBytes_);
    uniformsDirty_ = false;
  }
  std::fill(rotated_.begin(), rotated_.end(), std::uint8_t{0});
  FrameReport report;
  device_.timers.beginFrame(static_cast<std::uint32_t>(passes_.size()));
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const graph::Step& planned = plan_->steps[step];
    if (planned.barriers) {
      GLbitfield bits = glBarriersOf(planned.barriers);
      // The plan counts a clear as a texture update; a clear of an attachment goes through the framebuffer instead.
      if (planned.barriers & graph::kBarrierTextureUpdate) bits |= GL_FRAMEBUFFER_BARRIER_BIT;
      // The specification names no bit for glGenerateTextureMipmap; drivers fetch, render or copy: order all three.
      if (passes_[step].fromSource)
        bits |= GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT;
      glMemoryBarrier(bits);
      ++report.barriers;
    }
    if (!cadence_->runs(step) || !passes_[step].usable) {
      if (planned.barriersAfterClears) glMemoryBarrier(glBarriersOf(planned.barriersAfterClears));
      ++report.passesSkipped;
      continue;
    }
    runStep(step, diagnostics);
    ++report.passesRun;
  }
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (cadence_->runs(step) && passes_[step].usable) cadence_->remember(step, own_[step], generationsBefore_, generations_);
  device_.timers.endFrame();
  if (plan_->finalBarriers) {
    glMemoryBarrier(glBarriersOf(plan_->finalBarriers));
    ++report.barriers;
  }
  ++framesRun_;
  return report;
}

void Execution::refreshImports(base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t r = 0; r < graph.resources.size(); ++r) {
    const graph::FlatResource& desc = graph.resources[r];
    if (desc.import == kNone) continue;
    const graph::ImportSpec& import = graph.imports[desc.import];
    if (desc.kind == graph::ResourceKind::imported_texture) (*pool_)[r].imported = device_.imports.texture(import, diagnostics);
    generations_[r] = device_.imports.generation(import);
  }
}

void Execution::resetHistories(base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t h = 0; h < graph.histories.size(); ++h) {
    const graph::HistorySpec& history = graph.histories[h];
    std::uint64_t state = base::kHashSeed;
    for (const std::uint32_t import : history.resetImports)
      state = base::hashCombine(state, device_.imports.generation(graph.imports[import]));
    for (const std::uint32_t resource : history.resetResources) state = base::hashCombine(state, generations_[resource]);
    for (const graph::Value& value : history.resetValues)
      for (const double x : value.v) state = base::hashCombine(state, std::bit_cast<std::uint64_t>(x));
    const bool changed = framesRun_ > 0 && state != resetState_[h];
    resetState_[h] = state;
    if (!changed) continue;
    GpuResource& resource = (*pool_)[history.resource];
    resource.publications = 0;
    const graph::FlatResource& desc = graph.resources[history.resource];
    for (std::uint32_t copy = 0; copy < resource.copies; ++copy) {
      if (resource.texture) {
        const FlatUse all{.resource = history.resource, .mips = desc.mips, .layers = desc.layers};
        const gl::TextureRef ref = pool_->view(*plan_, all, copy, 0, diagnostics);
        for (std::uint32_t mip = 0; mip < desc.mips; ++mip)
          clearTexture(ref, desc.format, mip, 0, desc.layers, history.first);
      } else if (copy < resource.buffers.size()) {
        clearBuffer(resource.buffers[copy], resource.offset, resource.bytes, history.first);
      }
    }
  }
}

void Execution::refreshUniforms() {
  const graph::FlatGraph& graph = *plan_->graph;
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    PreparedPass& pass = passes_[step];
    if (!pass.usable) continue;
    const bool timeless = graph.passes[plan_->steps[step].pass].cadence != graph::Cadence::always;
    for (const DynamicUniform& uniform : pass.dynamics) {
      const graph::Value value = uniform.expr.evaluateFolded([this](std::uint32_t key) {
        const GpuResource& resource = (*pool_)[key];
        // Not published yet: about to be. A headless run publishes everything before its frame 0.
        if (resource.publications == 0)
          return input_.headless && framesRun_ == 0 ? std::numeric_limits<double>::infinity() : 0.0;
        return std::max(0.0, input_.time - resource.publishedAt);
      });
      std::byte* at = uniformBytes_.data() + pass.parametersOffset;
      std::byte before[32];
      std::memcpy(before, at + uniform.member.offset, 16);
      writeValue(at, uniform.member, value);
      uniformsDirty_ |= std::memcmp(before, at + uniform.member.offset, 16) != 0;
    }
    if (pass.viewBlock) {
      const graph::PassSpec& spec = *pass.context.spec;
      const graph::ImportSpec* import = spec.view == kNone ? nullptr : &graph.imports[spec.view];
      const scene::ViewData& view = device_.imports.view(import, graph.screenWidth, graph.screenHeight);
      writeView(uniformBytes_.data() + pass.viewOffset, *pass.viewBlock, view,
                {static_cast<float>(pass.width), static_cast<float>(pass.height)}, timeless);
      uniformsDirty_ = true;
    }
  }
}

void Execution::refreshOwnHashes() {
  for (std::size_t step = 0; step < passes_.size(); ++step) {
    const PreparedPass& pass = passes_[step];
    if (plan_->graph->passes[plan_->steps[step].pass].cadence == graph::Cadence::always) continue;
    std::uint64_t own = pass.programHash;
    const auto mix = [&](std::uint32_t offset, const gl::Block* block) {
      if (!block) return;
      const auto* bytes = reinterpret_cast<const char*>(uniformBytes_.data() + offset);
      own = base::hashBytes({bytes, block->bytes}, own);
    };
    mix(pass.parametersOffset, pass.parametersBlock);
    mix(pass.viewOffset, pass.viewBlock);
    for (const std::uint32_t resource : pass.written) own = base::hashCombine(own, (*pool_)[resource].serial);
    for (const std::uint32_t axis : pass.context.spec->threads) own = base::hashCombine(own, axis);
    own_[step] = own;
  }
}

// The first running writer of a resource in a frame turns its history by one and publishes.
void Execution::rotateWritten(const PreparedPass& pass) {
  for (const std::uint32_t r : pass.written) {
    generations_[r] = nextGeneration_++;
    if (rotated_[r]) continue;
    rotated_[r] = 1;
    GpuResource& resource = (*pool_)[r];
    if (resource.copies > 1) resource.current = (resource.current + 1) % resource.copies;
    ++resource.publications;
    const bool beforeFirst = input_.headless && framesRun_ == 0;
    resource.publishedAt = beforeFirst ? -std::numeric_limits<double>::infinity() : input_.time;
  }
}

}  // namespace weft::runtime
