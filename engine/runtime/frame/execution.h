// Execution: runs a Plan on the GPU, frame after frame. Each part has one job: ResourcePool has the storage, PreparedPass
// knows what a step binds, VariantChoice chooses its variant, UniformValues and UniformArena have its uniforms,
// FrameCadence decides what runs, Publications decides what other passes see, StepRunner makes the GL calls.
// A new plan is prepared beside the running one, and takes over persistent storage only when it has no error.
// Does not: read files, decide the order (the plan has it), or own the context. A frame of an unchanged plan allocates
// nothing on the heap.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/cadence/cadence.h"
#include "engine/runtime/frame/device.h"
#include "engine/runtime/frame/publications.h"
#include "engine/runtime/frame/read_back.h"
#include "engine/runtime/frame/step_runner.h"
#include "engine/runtime/frame/uniform_arena.h"
#include "engine/runtime/frame/uniform_values.h"
#include "engine/runtime/frame/variant_choice.h"
#include "engine/runtime/prepare/pass_keeper.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/resource_pool.h"

namespace weft::runtime {

struct FrameReport {
  std::uint32_t passesRun = 0, passesSkipped = 0, barriers = 0;
  bool whole = true;  // false: FrameInput::obsolete left passes out, and the picture must not be shown
  std::uint32_t slowRun = 0;  // how many of passesRun are not `always`
};

// Whether shader files are read again for passes that do not change.
enum class ShaderFiles : std::uint8_t { read, keep };

class Execution {
 public:
  // Prepares `plan`. A pass that differs from those of `before` (which may be null) is prepared whole; of an equal pass
  // only what has other storage now. Null after errors; then `before` is as it was. Otherwise `before` has given up its
  // storage and must not run again.
  static std::unique_ptr<Execution> create(Device& device, std::shared_ptr<const graph::Plan> plan,
                                           Execution* before, ShaderFiles files,
                                           base::Diagnostics& diagnostics);

  // The values of the plan's parameters, parallel to FlatGraph::parameters: those of the plan, or those that
  // setParameter() has set since.
  std::span<const graph::Value> parameters() const { return values_.parameters(); }
  // Sets a live parameter for the next frame. False when that takes another plan; then nothing has changed, and making
  // that plan says what is wrong with the value, if anything. See UniformValues::set().
  bool setParameter(std::string_view path, const graph::Value& value) {
    return values_.set(path, value, arena_);
  }
  // The bytes of all uniform blocks, with the changes that setParameter() made since the last frame. For tests.
  std::span<const std::byte> uniformBytes() const { return arena_.bytes(); }

  FrameReport frame(const World& world, const FrameInput& input, base::Diagnostics& diagnostics);

  // Whether a frame may depend on the frames before it: by a live history, or by results that are kept and were made of
  // something that moves. If not, headless frame n may be the first to run.
  bool remembers(const World& world) const;

  // Whether a draw list that it draws can stand elsewhere in another frame of the world of the last one, in view or not.
  bool drawsMotion();

  // Whether a pass reads an import that follows the mouse.
  bool followsPointer() const { return followsPointer_; }

  const graph::Plan& plan() const { return *plan_; }
  // How many passes were prepared for this plan; the others were taken over.
  std::uint32_t passesPrepared() const { return passesPrepared_; }
  // The presented level and layer of a texture; id 0 when the graph presents nothing.
  gl::TextureRef presented();
  // The whole presented texture, with all its levels.
  gl::TextureRef presentedWhole();
  // The current texture or buffer of a resource by its name in the graph ("hdr", "ibl.brdf"), for tests and inspectors:
  // the last version of that name, or nothing when it is not live.
  gl::TextureRef texture(std::string_view resource);
  gl::TextureRef texture(std::uint32_t resource,
                         std::uint32_t history = 0);  // by its index in the graph; alive
  BufferRef buffer(std::string_view resource, std::uint64_t& offset);
  BufferRef buffer(std::uint32_t resource, std::uint64_t& offset, std::uint32_t history = 0);
  // The graph's live "outputs", with the latest values that have arrived, of a frame or a few ago. frame() renews them, and
  // between frames collectOutputs(), which never waits. finishReadBack() waits for those of the last frame. output() is
  // null when there is none of that name.
  std::span<const Output> outputs() const { return readBack_.outputs(); }
  const Output* output(std::string_view name) const;
  void collectOutputs() { readBack_.collect(); }
  void finishReadBack() { readBack_.finish(); }
  // Sets a watch over the steps of every frame. `before` is called right before a step that runs, when its barriers are issued
  // and its clears are not yet made; `after` right after a step, also when it was skipped, while its results are still in their
  // storage (later steps may put other resources there). Both may read, copy and draw into textures of their own; they do not
  // change the plan or what runs. Work that time-sliced groups do ahead of a headless frame is not watched. There is one watch
  // at a time, and none in a new execution. An empty watch removes it.
  struct StepWatch {
    std::function<void(std::uint32_t step)> before{}, after{};
    std::uint32_t only = graph::kNone;  // the one step that is watched; kNone: each
  };
  void watch(StepWatch watch) { watch_ = std::move(watch); }
  bool watched() const { return watch_.before || watch_.after; }
  bool ran(std::string_view pass) const;                                        // in the last frame
  SliceRange slices(std::size_t step) const { return cadence_->slices(step); }  // of a step that ran in it

 private:
  Execution(Device& device, std::shared_ptr<const graph::Plan> plan);
  // Preparing, beside the running execution.
  bool prepare(Execution* before, ShaderFiles files, base::Diagnostics& diagnostics);
  using Variants = std::vector<std::shared_ptr<const gl::Variant>>;  // per step
  bool findVariants(const Execution* before, const PassKeeper* keeper, ShaderFiles files, Variants& variants,
                    base::Diagnostics& diagnostics);
  bool createPool(Execution* before, base::Diagnostics& diagnostics);
  bool preparePasses(Execution* before, const PassKeeper* keeper, const Variants& variants,
                     base::Diagnostics& diagnostics);
  bool readsPointer() const;
  bool isSettled(std::size_t step) const;
  void takeOver(Execution& before);

  // The parts of a frame.
  void beginFrame(const World& world, const FrameInput& input);
  void publishFinished(base::Diagnostics& diagnostics);
  void decide(base::Diagnostics& diagnostics);
  bool runs(std::size_t step) const { return cadence_->runs(step) && !passes_[step].idle; }
  void runSteps(FrameReport& report, base::Diagnostics& diagnostics);
  void endFrame(FrameReport& report, base::Diagnostics& diagnostics);
  void runAhead(FrameReport& report, base::Diagnostics& diagnostics);
  void chooseVariants(bool alwaysOnly, base::Diagnostics& diagnostics);
  void layOutUniforms(base::Diagnostics& diagnostics);
  void refreshUniforms(bool alwaysOnly);
  void refreshHashes();
  void refreshSlices();
  void lookAtMeshes();
  void look(const std::function<void(std::uint32_t step)>& watcher, std::size_t step);
  graph::Cadence cadenceOf(std::size_t step) const {
    return plan_->graph->passes[plan_->steps[step].pass].cadence;
  }

  Device& device_;
  std::shared_ptr<const graph::Plan> plan_;
  std::unique_ptr<ResourcePool> pool_;
  std::vector<PreparedPass> passes_;  // per step, of the variant whose conditions hold
  std::uint32_t passesPrepared_ = 0;
  bool followsPointer_ = false;
  std::unique_ptr<FrameCadence> cadence_;
  UniformArena arena_;
  UniformValues values_;
  std::optional<Publications> publications_;
  std::optional<VariantChoice> variants_;
  std::optional<StepRunner> runner_;
  ReadBack readBack_;
  FrameInput input_;
  std::vector<std::uint64_t>
      hashes_;                     // per step: hash of its program, parameters and storage, for the cadence
  std::vector<std::uint8_t> ran_;  // per step, this frame
  std::vector<std::uint8_t> lasting_;    // per step: runs in an obsolete frame too
  std::vector<scene::MeshView*> views_;  // of passes that draw meshes in this round
  StepWatch watch_;
  bool ahead_ = false;  // a round of runAhead()
};

}  // namespace weft::runtime
