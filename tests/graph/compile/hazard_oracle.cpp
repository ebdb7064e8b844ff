#include "tests/graph/compile/hazard_oracle.h"

#include <algorithm>
#include <map>
#include <random>
#include <tuple>

#include "engine/graph/subresource.h"

namespace weft::graph::oracle {

namespace {

// The bits of glMemoryBarrier by their values in the specification's header.
enum Gl : std::uint32_t {
  kVertexAttribArray = 0x1,
  kElementArray = 0x2,
  kUniform = 0x4,
  kTextureFetch = 0x8,
  kShaderImageAccess = 0x20,
  kCommand = 0x40,
  kTextureUpdate = 0x100,
  kBufferUpdate = 0x200,
  kFramebuffer = 0x400,
  kShaderStorage = 0x2000,
};

std::uint32_t toGl(std::uint16_t mask) {
  const std::pair<BarrierBit, std::uint32_t> names[] = {{kBarrierUniform, kUniform},
                                                        {kBarrierTexture, kTextureFetch},
                                                        {kBarrierImage, kShaderImageAccess},
                                                        {kBarrierCommand, kCommand},
                                                        {kBarrierTextureUpdate, kTextureUpdate},
                                                        {kBarrierBufferUpdate, kBufferUpdate},
                                                        {kBarrierFramebuffer, kFramebuffer},
                                                        {kBarrierStorage, kShaderStorage}};
  std::uint32_t gl = 0;
  for (const auto& [bit, value] : names)
    if ((mask & bit) != 0) gl |= value;
  return gl;
}

// What the GL does, in the terms of 7.12.2.
enum class Op { texture_fetch, image, uniform, storage, command, attachment, blit, clear, buffer_copy };

Op opOf(const FlatUse& use, bool buffer) {
  switch (use.kind) {
    case Kind::sampled:
      return Op::texture_fetch;
    case Kind::image:
      return Op::image;
    case Kind::uniform:
      return Op::uniform;
    case Kind::storage:
      return Op::storage;
    case Kind::indirect:
      return Op::command;
    case Kind::color:
    case Kind::depth:
      return Op::attachment;
    case Kind::copy:
      return buffer ? Op::buffer_copy : Op::blit;
  }
  return Op::blit;
}

// "… after the barrier will reflect data written by shaders prior to the barrier": one line per bit of the
// section.
std::uint32_t bitToSeeShaderWrites(Op op, bool buffer) {
  switch (op) {
    case Op::uniform:
      return kUniform;  // shader uniforms sourced from buffer objects
    case Op::texture_fetch:
      return kTextureFetch;  // texture fetches from shaders, buffer textures included
    case Op::image:
      return kShaderImageAccess;  // image load, store and atomic functions
    case Op::command:
      return kCommand;  // command data sourced by *Indirect commands
    case Op::clear:
      return buffer ? kBufferUpdate    // Clear*Data "reads or writes via … Buffer*SubData, or copy"
                    : kTextureUpdate;  // writes via Tex(Sub)Image*, ClearTex*Image
    case Op::buffer_copy:
      return kBufferUpdate;  // Copy*SubData, Get*SubData
    case Op::attachment:
    case Op::blit:
      return kFramebuffer;  // reads and writes via framebuffer object attachments
    case Op::storage:
      return kShaderStorage;  // accesses through shader buffer variables
  }
  return 0;
}

// A unit of physical memory: (space, which, copy, sub-resource). Spaces: 0 storage, 1 a resource's own, 2
// arena.
using Unit = std::tuple<int, std::uint32_t, std::uint32_t, std::uint64_t>;

struct Past {
  std::int64_t store = -1, access = -1;  // clock of the latest
  std::string storeBy, accessBy;
};

class Replay {
 public:
  explicit Replay(const Plan& plan)
      : plan_(plan), graph_(*plan.graph), published_(graph_.resources.size(), 0) {}

  std::string run(const Schedule& schedule) {
    for (std::size_t frame = 0; frame < schedule.size(); ++frame) {
      const std::vector<bool>& runs = schedule[frame];
      rotate(runs);
      for (const Step& step : plan_.steps) {
        barrier(step.barriers);
        const std::string& name = graph_.passNames[step.pass];
        if (runs[step.pass]) {
          for (std::uint32_t c = step.firstClear; c < step.firstClear + step.clearCount; ++c) {
            begin("clear before " + name, frame);
            // Through the pass's framebuffer, if the plan says so: then the pass must attach just that.
            const std::uint32_t attachment = plan_.clears[c].attachment;
            if (attachment != kNone && !attaches(step.pass, attachment, plan_.clears[c].use))
              return "the clear before " + name + " names an attachment that is none";
            touch(plan_.clears[c].use, attachment != kNone ? Op::attachment : Op::clear, false, step.pass);
            if (std::string found = commit(); !found.empty()) return found;
          }
        }
        barrier(step.barriersAfterClears);
        if (!runs[step.pass]) continue;
        begin(name, frame);
        const FlatPass& pass = graph_.passes[step.pass];
        for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
          if (plan_.attached[u] == 0) continue;
          const FlatUse& use = graph_.uses[u];
          const Op op = opOf(use, isBuffer(graph_.resources[use.resource]));
          touch(use, op, use.access != Access::read && (op == Op::image || op == Op::storage), step.pass);
          // What the pass type does to the range besides.
          for (const Op more : {Op::texture_fetch, Op::image, Op::attachment, Op::clear})
            if (!isBuffer(graph_.resources[use.resource]) &&
                (toGl(pass.touches) & bitToSeeShaderWrites(more, false)) != 0)
              touch(use, more, false, step.pass);
          // Texture barriers order rendering with fetches of it, not shader stores with fetches.
          if (use.feedback) touch(use, Op::texture_fetch, false, step.pass);
        }
        if (std::string found = commit(); !found.empty()) return found;
      }
      barrier(plan_.finalBarriers);
      begin("the end of the frame", frame);
      if (graph_.present.resource != kNone && plan_.firstStep[graph_.present.resource] != kNone)
        touch(graph_.present, Op::blit, false, kNone);
      for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
        if (plan_.outputLive[i] != 0)
          touch(graph_.outputs[i],
                isBuffer(graph_.resources[graph_.outputs[i].resource]) ? Op::buffer_copy : Op::blit, false,
                kNone);
      if (std::string found = commit(); !found.empty()) return found;
    }
    return "";
  }

 private:
  bool attaches(std::uint32_t pass, std::uint32_t index, const FlatUse& range) const {
    const FlatPass& p = graph_.passes[pass];
    if (index < p.firstUse || index >= p.firstUse + p.useCount || plan_.attached[index] == 0) return false;
    const FlatUse& use = graph_.uses[index];
    return (use.kind == Kind::color || use.kind == Kind::depth) && use.resource == range.resource &&
           use.history == 0 && use.mip == range.mip && use.mips == range.mips && use.layer == range.layer &&
           use.layers == range.layers && use.planes == range.planes;
  }

  // x becomes x@-1 at the start of every frame in which a writer of x runs; of a time-sliced group, in which it
  // publishes.
  void rotate(const std::vector<bool>& runs) {
    std::vector<bool> rotates(graph_.resources.size(), false);
    for (const Step& step : plan_.steps) {
      if (!runs[step.pass]) continue;
      const FlatPass& pass = graph_.passes[step.pass];
      for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
        if (plan_.attached[u] != 0 && graph_.uses[u].access != Access::read)
          rotates[graph_.uses[u].resource] = true;
    }
    for (std::uint32_t r = 0; r < rotates.size(); ++r) {
      const std::uint32_t group = plan_.groups.slicedWriterOf(r);
      if (group == kNone ? rotates[r] : runs[graph_.passes.size() + group]) ++published_[r];
    }
  }

  void barrier(std::uint16_t mask) {
    ++clock_;
    for (std::uint32_t gl = toGl(mask); gl != 0; gl &= gl - 1) issued_[gl & (~gl + 1)] = clock_;
    ++clock_;
  }

  void begin(const std::string& name, std::size_t frame) {
    now_ = name + " in frame " + std::to_string(frame);
    pending_.clear();
    hazard_.clear();
    ++clock_;
  }

  // Passes of a time-sliced group see the copy that is being written, one ahead of the latest publication.
  void touch(const FlatUse& use, Op op, bool store, std::uint32_t pass) {
    const FlatResource& r = graph_.resources[use.resource];
    const std::uint32_t group = plan_.groups.slicedWriterOf(use.resource);
    const std::uint32_t copies = r.history + (group == kNone ? 1u : 2u);
    const bool inside = group != kNone && pass != kNone && plan_.groups.groupOf(pass) == group;
    const auto copy = static_cast<std::uint32_t>(
        (published_[use.resource] + (inside ? 1 : 0) + copies - use.history) % copies);
    const auto visit = [&](const Unit& unit) {
      const Past& past = memory_[unit];
      const std::uint32_t see = bitToSeeShaderWrites(op, isBuffer(r));
      if (past.store >= 0 && issued_[see] < past.store) report(use, past.storeBy, "stored to it", see);
      // "image stores and atomics / assignments to buffer variables after the barrier will not execute until
      // all memory accesses initiated prior to the barrier complete"
      const std::uint32_t wait = op == Op::storage ? kShaderStorage : kShaderImageAccess;
      if (store && past.access >= 0 && issued_[wait] < past.access)
        report(use, past.accessBy, "accessed it", wait);
      pending_.emplace_back(unit, store);
    };
    if (plan_.bufferOffsetOf[use.resource] != Plan::kNoOffset) {
      const std::uint64_t from = plan_.bufferOffsetOf[use.resource];
      for (std::uint64_t at = from / 256; at * 256 < from + std::max<std::uint64_t>(1, r.bytes); ++at)
        visit({2, 0, 0, at});
      return;
    }
    const std::uint32_t storage = plan_.storageOf[use.resource];
    forEachSubresource(use, r, [&](std::uint32_t s) {
      visit(storage != kNone ? Unit{0, storage, copy, s} : Unit{1, use.resource, copy, s});
    });
  }

  void report(const FlatUse& use, const std::string& before, const char* did, std::uint32_t bit) {
    if (!hazard_.empty()) return;
    hazard_ = now_ + " uses '" + graph_.resourceNames[use.resource] + "' after " + before + " " + did +
              " without barrier bit " + std::to_string(bit);
  }

  // The accesses of one command are judged against what came before it, then become the past.
  std::string commit() {
    for (const auto& [unit, store] : pending_) {
      Past& past = memory_[unit];
      past.access = clock_;
      past.accessBy = now_;
      if (!store) continue;
      past.store = clock_;
      past.storeBy = now_;
    }
    ++clock_;
    return hazard_;
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  std::vector<std::uint64_t> published_;
  std::map<Unit, Past> memory_;
  std::map<std::uint32_t, std::int64_t> issued_;
  std::vector<std::pair<Unit, bool>> pending_;
  std::int64_t clock_ = 0;
  std::string now_, hazard_;
};

constexpr std::size_t kMoreSamples = 2000;  // for the few bits that are not needed while everything runs

}  // namespace

std::string findHazard(const Plan& plan, const Schedule& schedule) {
  return Replay(plan).run(schedule);
}

Schedule everythingRuns(const Plan& plan) {
  std::size_t deepest = 0;
  for (const FlatResource& r : plan.graph->resources) deepest = std::max<std::size_t>(deepest, r.history);
  return Schedule(3 + 2 * deepest,
                  std::vector<bool>(plan.graph->passes.size() + plan.groups.sliced.size(), true));
}

std::vector<Schedule> cadenceSchedules(const Plan& plan, std::uint64_t seed, std::size_t samples) {
  const FlatGraph& graph = *plan.graph;
  std::vector<std::uint32_t> optional;
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    if (plan.stepOf[p] != kNone && graph.passes[p].cadence != Cadence::always) optional.push_back(p);
  const std::size_t frames = 3, bits = optional.size() * frames;
  const bool all = bits <= 6;
  const std::size_t count = optional.empty() ? 1 : all ? std::size_t{1} << bits : samples;
  std::mt19937_64 random(seed);
  std::vector<Schedule> schedules;
  for (std::size_t i = 0; i < count; ++i) {
    Schedule schedule(frames, std::vector<bool>(graph.passes.size() + plan.groups.sliced.size(), true));
    std::size_t k = 0;
    for (auto& frame : schedule)
      for (const std::uint32_t p : optional) {
        frame[p] = all ? (i >> k & 1) != 0 : (random() & 1) != 0;
        ++k;
      }
    for (auto& frame : schedule)
      for (std::size_t group = 0; group < plan.groups.sliced.size(); ++group)
        frame[graph.passes.size() + group] = (random() & 1) != 0;
    schedules.push_back(std::move(schedule));
  }
  return schedules;
}

std::vector<Plan> withoutOneBit(const Plan& plan) {
  std::vector<Plan> mutants;
  const auto each = [&](auto&& maskOf) {
    for (int bit = 0; bit < 16; ++bit) {
      Plan mutant = plan;
      std::uint16_t& mask = maskOf(mutant);
      if ((mask >> bit & 1) == 0) continue;
      mask = static_cast<std::uint16_t>(mask & ~(1u << bit));
      mutants.push_back(std::move(mutant));
    }
  };
  for (std::size_t t = 0; t < plan.steps.size(); ++t) {
    if (plan.steps[t].barriers != 0) each([t](Plan& p) -> std::uint16_t& { return p.steps[t].barriers; });
    if (plan.steps[t].barriersAfterClears != 0)
      each([t](Plan& p) -> std::uint16_t& { return p.steps[t].barriersAfterClears; });
  }
  if (plan.finalBarriers != 0) each([](Plan& p) -> std::uint16_t& { return p.finalBarriers; });
  return mutants;
}

Verdict judgeBarriers(const Plan& plan, std::uint64_t seed, std::size_t samples) {
  Verdict verdict;
  const Schedule full = everythingRuns(plan);
  const std::vector<Schedule> schedules = cadenceSchedules(plan, seed, samples);
  std::vector<Schedule> more;
  const auto hazardUnder = [](const Plan& p, const std::vector<Schedule>& all) {
    for (const Schedule& schedule : all)
      if (std::string found = findHazard(p, schedule); !found.empty()) return found;
    return std::string();
  };
  if (std::string found = findHazard(plan, full); !found.empty()) verdict.problem = "hazard: " + found;
  if (std::string found = hazardUnder(plan, schedules); !found.empty())
    verdict.problem = "hazard by cadence: " + found;
  for (const Plan& mutant : withoutOneBit(plan)) {
    ++verdict.bits;
    if (!findHazard(mutant, full).empty()) continue;
    if (more.empty()) more = cadenceSchedules(plan, ~seed, kMoreSamples);
    if (!hazardUnder(mutant, schedules).empty() || !hazardUnder(mutant, more).empty()) {
      ++verdict.byCadenceOnly;
      continue;
    }
    verdict.problem = "redundant bit at the end of the frame";
    for (std::size_t t = 0; t < plan.steps.size(); ++t) {
      const int spare = (plan.steps[t].barriers ^ mutant.steps[t].barriers) |
                        (plan.steps[t].barriersAfterClears ^ mutant.steps[t].barriersAfterClears);
      if (spare != 0)
        verdict.problem = "redundant bit " + std::string(barrierName(static_cast<BarrierBit>(spare))) +
                          " before " + plan.graph->passNames[plan.steps[t].pass];
    }
  }
  return verdict;
}

}  // namespace weft::graph::oracle
