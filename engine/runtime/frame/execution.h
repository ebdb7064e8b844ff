// Execution: a Plan happening on the GPU, frame after frame. Each part has one job: ResourcePool the storage, PreparedPass what
// a step binds, VariantChoice which variant of it, UniformValues and UniformArena its uniforms, FrameCadence what runs,
// Publications what others see of it, StepRunner the GL calls. This strings them together.
// A new plan is prepared beside the running one and takes over its persistent storage only once it is known to be good.
// Does not: read files, decide what runs in which order (the plan did), or own the context. An unchanged plan's frame
// allocates nothing on the heap.
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
  bool whole = true;          // false: FrameInput::obsolete said so, and what is presented is nothing to show
  std::uint32_t slowRun = 0;  // of passesRun: those that are not `always`
};

// Whether shader files are looked at again for passes that stay as they are.
enum class ShaderFiles : std::uint8_t { read, keep };

class Execution {
 public:
  // Prepares `plan`: of passes that differ from those of `before` (may be null) everything, of the others what lies in
  // other storage now. Null after errors, and `before` is untouched then; otherwise `before` has given up its storage
  // and must not run again.
  static std::unique_ptr<Execution> create(Device& device, std::shared_ptr<const graph::Plan> plan,
                                           Execution* before, ShaderFiles files,
                                           base::Diagnostics& diagnostics);

  // The values of the plan's parameters, parallel to FlatGraph::parameters: as the plan was made, and since then as
  // setParameter() set them.
  std::span<const graph::Value> parameters() const { return values_.parameters(); }
  // Sets a live parameter, for the next frame. False, and nothing has changed, when that takes another plan, which may
  // also say why not. As UniformValues::set().
  bool setParameter(std::string_view path, const graph::Value& value) {
    return values_.set(path, value, arena_);
  }
  // Of all uniform blocks, as the last frame had them and setParameter() changed them; for tests.
  std::span<const std::byte> uniformBytes() const { return arena_.bytes(); }

  FrameReport frame(const World& world, const FrameInput& input, base::Diagnostics& diagnostics);

  // Whether a frame may differ by which frames ran before it: a live history, or something kept that was made of what moves.
  // If not, headless frame n may be the first to run.
  bool remembers(const World& world) const;

  const graph::Plan& plan() const { return *plan_; }
  // Passes that were prepared when this was made; the others came prepared.
  std::uint32_t passesPrepared() const { return passesPrepared_; }
  // What is presented: level and layer of a texture; id 0 when the graph presents nothing.
  gl::TextureRef presented();
  // The whole texture behind it, with all its levels.
  gl::TextureRef presentedWhole();
  // The current texture or buffer of a resource by its name in the graph ("hdr", "ibl.brdf"), for tests and inspectors:
  // the last version of that name, or nothing when it is not alive.
  gl::TextureRef texture(std::string_view resource);
  gl::TextureRef texture(std::uint32_t resource,
                         std::uint32_t history = 0);  // by its index in the graph; alive
  BufferRef buffer(std::string_view resource, std::uint64_t& offset);
  BufferRef buffer(std::uint32_t resource, std::uint64_t& offset, std::uint32_t history = 0);
  // The graph's live "outputs" with the latest that has arrived, of a frame or a few ago; null: there is none of that name.
  // They are renewed by frame(), or between frames by collectOutputs(), which never waits, and finishReadBack(), which does:
  // then they are of the last frame.
  std::span<const Output> outputs() const { return readBack_.outputs(); }
  const Output* output(std::string_view name) const;
  void collectOutputs() { readBack_.collect(); }
  void finishReadBack() { readBack_.finish(); }
  // A tap into the frame: `look` is called right after `step` in every frame, run or kept, while what the step wrote is
  // still in its storage (later steps may put other resources there). It may read, copy and draw into textures of its own;
  // the plan and what runs stay the same. An empty function ends it; one tap at a time, none in a new execution.
  void tap(std::uint32_t step, std::function<void()> look);
  bool tapped() const { return tapStep_ != graph::kNone; }
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
  void lookThroughTap(std::size_t step, const FrameReport& report);
  graph::Cadence cadenceOf(std::size_t step) const {
    return plan_->graph->passes[plan_->steps[step].pass].cadence;
  }

  Device& device_;
  std::shared_ptr<const graph::Plan> plan_;
  std::unique_ptr<ResourcePool> pool_;
  std::vector<PreparedPass> passes_;  // per step, of the variant whose conditions hold
  std::uint32_t passesPrepared_ = 0;
  std::unique_ptr<FrameCadence> cadence_;
  UniformArena arena_;
  UniformValues values_;
  std::optional<Publications> publications_;
  std::optional<VariantChoice> variants_;
  std::optional<StepRunner> runner_;
  ReadBack readBack_;
  FrameInput input_;
  std::vector<std::uint64_t> hashes_;  // per step: what it is made of, for the cadence
  std::vector<std::uint8_t> ran_;      // per step, this frame
  std::vector<std::uint8_t> lasting_;  // per step: runs in an obsolete frame too
  std::size_t tapStep_ = graph::kNone;
  std::function<void()> tap_;
};

}  // namespace weft::runtime
