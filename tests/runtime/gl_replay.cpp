#include "tests/runtime/gl_replay.h"

#include <fmt/format.h>

#include <string_view>

#include "engine/graph/registry.h"

namespace weft::runtime::test {

GLbitfield barrierBitsOf(std::uint16_t bits) {
  GLbitfield gl = 0;
  const auto take = [&](graph::BarrierBit mine, GLbitfield theirs) {
    gl |= (bits & mine) != 0 ? theirs : 0u;
  };
  take(graph::kBarrierUniform, GL_UNIFORM_BARRIER_BIT);
  take(graph::kBarrierTexture, GL_TEXTURE_FETCH_BARRIER_BIT);
  take(graph::kBarrierImage, GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
  take(graph::kBarrierCommand, GL_COMMAND_BARRIER_BIT);
  take(graph::kBarrierTextureUpdate, GL_TEXTURE_UPDATE_BARRIER_BIT);
  take(graph::kBarrierBufferUpdate, GL_BUFFER_UPDATE_BARRIER_BIT);
  take(graph::kBarrierFramebuffer, GL_FRAMEBUFFER_BARRIER_BIT);
  take(graph::kBarrierStorage, GL_SHADER_STORAGE_BARRIER_BIT);
  return gl;
}

GlReplay::GlReplay(const graph::Plan& plan) : plan_(plan) {
  for (std::size_t step = 0; step < plan.steps.size(); ++step) {
    steps_[plan.graph->specs[plan.steps[step].pass].name] = step;
    if (plan.steps[step].barriers != 0)
      wanted_.push_back({step, false, barrierBitsOf(plan.steps[step].barriers)});
    if (plan.steps[step].barriersAfterClears != 0)
      wanted_.push_back({step, true, barrierBitsOf(plan.steps[step].barriersAfterClears)});
  }
}

void GlReplay::fail(std::string what) {
  if (problem_.empty()) problem_ = fmt::format("walk {}: {}", walks_, what);
}

void GlReplay::beginWalk() {
  ++walks_;
  next_ = 0;
  last_ = kNoStep;
}

std::size_t GlReplay::issuedBefore(std::size_t step) const {
  std::size_t count = 0;
  for (const Barrier& barrier : wanted_)
    count += barrier.step < step || (barrier.step == step && !barrier.afterClears);
  return count;
}

void GlReplay::beginStep(std::size_t step) {
  // Skipped steps issue their barriers too, so a step follows in this walk when just these stand before it.
  const std::size_t before = issuedBefore(step);
  const bool follows = (last_ == kNoStep || step > last_) && next_ == before;
  if (!follows && next_ == wanted_.size()) beginWalk();
  const std::string& name = plan_.graph->specs[plan_.steps[step].pass].name;
  if (next_ != before)
    fail(fmt::format("{} barriers were issued before '{}', the plan has {}", next_, name, before));
  ran_.insert(name);
  last_ = open_ = step;
  feedback_ = false;
}

void GlReplay::endStep() {
  if (open_ == kNoStep) return;
  const graph::FlatGraph& graph = *plan_.graph;
  const std::uint32_t p = plan_.steps[open_].pass;
  const graph::FlatPass& pass = graph.passes[p];
  bool wanted = false;
  for (std::uint32_t use = pass.firstUse; use < pass.firstUse + pass.useCount; ++use)
    wanted = wanted || graph.uses[use].feedback;
  if (wanted != feedback_)
    fail(fmt::format("'{}' has {} texture barrier", graph.specs[p].name, feedback_ ? "a" : "no"));
  open_ = kNoStep;
}

void GlReplay::issue(GLbitfield bits) {
  ++barriers_;
  if (next_ == wanted_.size()) beginWalk();
  if (next_ == wanted_.size()) return fail("a barrier that the plan does not have");
  const Barrier& wanted = wanted_[next_++];
  if (wanted.bits != bits)
    fail(fmt::format("barrier {:#x} at step {}, the plan has {:#x}", bits, wanted.step, wanted.bits));
  // Inside a step stands the one after its own clears; a step that does not run issues it too.
  const bool inside = open_ != kNoStep, itsOwn = wanted.afterClears && last_ == wanted.step;
  if (inside != itsOwn) fail(fmt::format("the barrier of step {} is not where the plan has it", wanted.step));
}

std::string GlReplay::judge(const std::vector<GlCall>& calls) {
  ran_.clear();
  problem_.clear();
  open_ = kNoStep;
  walks_ = barriers_ = textureBarriers_ = 0;
  beginWalk();
  std::size_t end = calls.size();  // of the walks: the barriers at the end of the frame are the last
  if (plan_.finalBarriers != 0) {
    while (end > 0 && calls[end - 1].kind != GlCall::Kind::barrier) --end;
    if (end == 0 || calls[end - 1].bits != barrierBitsOf(plan_.finalBarriers))
      fail("the frame does not end with the plan's last barriers");
    end = end == 0 ? 0 : end - 1;
    ++barriers_;
  }
  for (std::size_t i = 0; i < calls.size(); ++i) {
    const GlCall& call = calls[i];
    switch (call.kind) {
      case GlCall::Kind::group:
        if (open_ != kNoStep) {
          ++inner_;
        } else if (const auto step = steps_.find(call.name); step != steps_.end()) {
          beginStep(step->second);
        }
        break;
      case GlCall::Kind::group_end:
        if (inner_ > 0) {
          --inner_;
        } else {
          endStep();
        }
        break;
      case GlCall::Kind::barrier:
        if (i != end) issue(call.bits);
        break;
      case GlCall::Kind::texture_barrier:
        if (open_ == kNoStep || feedback_) fail("a texture barrier that no pass needs");
        feedback_ = true;
        ++textureBarriers_;
        break;
      case GlCall::Kind::copy:
        if (open_ != kNoStep && call.name == "glCopyImageSubData")
          fail("a copy for which the plan has no bits");
    }
  }
  if (next_ != wanted_.size()) fail(fmt::format("ends after {} barriers of {}", next_, wanted_.size()));
  return problem_;
}

}  // namespace weft::runtime::test
