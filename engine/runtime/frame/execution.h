// Execution: runs a Plan on the GPU, frame after frame. Each part has one job: PreparedPlan has the storage, and knows what
// each step binds; FrameCadence chooses the steps that run; FrameUniforms has their uniforms; Publications decides what other
// passes see; StepRunner makes the GL calls; ReadBack brings outputs to the CPU. A new execution is made beside the running
// one and shares with it the storage that both have, so the running one goes on when the new one has an error. A frame of an
// unchanged plan allocates nothing on the heap.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/cadence/cadence.h"
#include "engine/runtime/frame/device.h"
#include "engine/runtime/frame/publications.h"
#include "engine/runtime/frame/read_back.h"
#include "engine/runtime/frame/step_runner.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/runtime/uniforms/frame_uniforms.h"

namespace weft::runtime {

struct FrameReport;  // renderer.h

// Whether shader files are read again for passes that do not change.
enum class ShaderFiles : std::uint8_t { read, keep };

// A plan that can run on a device: its storage, and for each step what runs it.
struct PreparedPlan {
  std::shared_ptr<const graph::Plan> plan;
  std::unique_ptr<ResourcePool> pool;
  std::vector<PreparedPass> passes;  // per step, of the variant in use; at first the one for large ages
  std::uint32_t passesPrepared = 0;  // how many were prepared for this plan; the others were kept
};

// Prepares a plan beside the one that runs, and shares with it storage that fits and passes that are the same. A pass that
// differs from those of `before` (which may be null), or has other storage, is prepared. Empty after errors.
std::optional<PreparedPlan> preparePlan(Device& device, std::shared_ptr<const graph::Plan> plan,
                                        const PreparedPlan* before, ShaderFiles files,
                                        text::Diagnostics& diagnostics);

// Functions that are called around the steps of a frame while it runs, to look at results: `before` right before a step that
// runs, when its barriers are issued and its clears are not yet made; `after` right after a step, also when it was skipped,
// while its results are still in their storage (later steps may put other resources there). Both may read, copy and draw
// into textures of their own, and leave other GL state; they do not change the plan or what runs.
struct StepWatch {
  using Look = std::function<void(std::uint32_t step)>;
  Look before{}, after{};
};

// The hash of what a pass that is not `always` is made of, besides the generations of what it reads: program, uniforms, and
// ownHashOf().
std::uint64_t hashOf(const PreparedPass& pass, graph::Cadence cadence, ResourcePool& pool, Imports& imports,
                     const FrameUniforms& uniforms);
// What is a term of it and says something in this process only: where the storage is, and the generation of the draw list.
std::uint64_t ownHashOf(const PreparedPass& pass, graph::Cadence cadence, const ResourcePool& pool,
                        Imports& imports);

class Execution {
 public:
  // Prepares `plan`, see preparePlan(), and goes on where `before` (which may be null) has stopped. Null after errors.
  // Otherwise `before` must not run again: its storage is shared.
  static std::unique_ptr<Execution> create(Device& device, std::shared_ptr<const graph::Plan> plan,
                                           Execution* before, ShaderFiles files,
                                           text::Diagnostics& diagnostics);

  FrameReport frame(const World& world, const FrameInput& input, text::Diagnostics& diagnostics);

  const graph::Plan& plan() const { return *prepared_.plan; }
  // How many passes were prepared for this plan; the others were kept.
  std::uint32_t passesPrepared() const { return prepared_.passesPrepared; }
  // The parameters. Live ones can be set between two frames.
  FrameUniforms& uniforms() { return uniforms_; }
  const FrameUniforms& uniforms() const { return uniforms_; }
  // The graph's live "outputs" with the latest values that have arrived, which are one or a few frames old. frame() renews them.
  ReadBack& readBack() { return readBack_; }
  const ReadBack& readBack() const { return readBack_; }
  // What ran in the last frame.
  const FrameCadence& steps() const { return steps_; }

  // Whether a frame may differ by which frames ran before it: by a live history, by an import that remembers, or by results
  // that are kept and were made of something that moves. If not, headless frame n may be the first to run.
  bool remembers(const World& world) const;
  // Whether anything in the draw lists that are drawn can have another place in another frame of the last frame's world, in view or not.
  bool drawsMotion() const;
  // Whether a pass reads an import that follows the mouse.
  bool followsPointer() const;

  // The presented level and layer of a texture; id 0 when the graph presents nothing.
  gl::TextureRef presented();
  // The current texture or buffer of a resource that is alive.
  gl::TextureRef texture(std::uint32_t resource, std::uint32_t history = 0);
  BufferRef buffer(std::uint32_t resource, std::uint64_t& offset, std::uint32_t history = 0);

  // Fills every copy of a resource of the graph's own.
  void fill(std::uint32_t resource, const graph::Value& value) {
    text::Diagnostics ignored;
    prepared_.pool->fill(plan(), resource, value, ignored);
  }

  // Reports the imports that remember, and the textures that must be kept and cannot be read, because they have samples. False:
  // there are some, and save() must not be called.
  bool canSave(const World& world, text::Diagnostics& diagnostics) const;
  // After a frame: all of it that the frames to come depend on. Equal states are equal bytes, in any process of one build, on one
  // driver. Nothing while an import shows an older texture than its newest.
  std::optional<std::string> save(text::Diagnostics& diagnostics);
  // In place of all frames up to `last`, when none has run. False: the bytes are no state of this plan, and this must not run.
  bool restore(std::string_view state, const World& world, const FrameInput& last,
               text::Diagnostics& diagnostics);

  // Sets a watch over the steps of every frame. Work that time-sliced groups do ahead of a headless frame is not watched.
  // There is one watch at a time, and none in a new execution. An empty watch removes it.
  void watch(StepWatch watch) { watch_ = std::move(watch); }
  bool watched() const { return watch_.before || watch_.after; }

 private:
  Execution(Device& device, PreparedPlan prepared, const Execution* before);

  // The parts of a frame.
  void beginFrame(const World& world, const FrameInput& input);
  void publishFinished(text::Diagnostics& diagnostics);
  void runAhead(FrameReport& report, text::Diagnostics& diagnostics);
  void chooseSteps();
  void runSteps(const StepWatch& watch, FrameReport& report, text::Diagnostics& diagnostics);
  void endFrame(FrameReport& report, text::Diagnostics& diagnostics);

  void carry(StateStream& state, text::Diagnostics& diagnostics);
  void lookAtMeshes();

  Device& device_;
  PreparedPlan prepared_;
  FrameUniforms uniforms_;
  FrameCadence steps_;
  std::vector<std::uint64_t> hashes_;  // per step, hashOf()
  Publications publications_;
  StepRunner runner_;
  ReadBack readBack_;
  FrameInput input_;
  StepWatch watch_;
  std::vector<scene::MeshView*> meshViews_;  // of passes that draw meshes in this round
};

}  // namespace weft::runtime
