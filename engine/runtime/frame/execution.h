// Execution: a Plan happening on the GPU, frame after frame. Owns the plan's storage, prepared passes, framebuffers and
// uniform bytes; issues barriers, clears, bindings and pass executions; keeps cadence, history and publication times.
// A new plan is prepared beside the running one and takes over its persistent storage only once it is known to be good.
// Does not: read files, decide what runs in which order (the plan did), or own the context. An unchanged plan's frame
// allocates nothing on the heap.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/context/state_cache.h"
#include "engine/gl/objects/timers.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"
#include "engine/runtime/cadence/cadence.h"
#include "engine/runtime/frame/read_back.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/pass_keeper.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/framebuffer_cache.h"
#include "engine/runtime/storage/resource_pool.h"

namespace weft::runtime {

// GL things that outlive a plan.
struct Device {
  // `trial` as in gl::ProgramCache::Options.
  Device(gl::Context& context, std::vector<std::string> shaderRoots, std::string cacheFolder,
         std::vector<std::string> trial = {});
  gl::Context& context;
  gl::SourceLoader sources;
  gl::ProgramCache programs;
  Geometries geometries;
  Imports imports;
  passes::PassRegistry passTypes = passes::PassRegistry::builtin();
  gl::PassTimers timers;
  GLuint sampler(const graph::Sampler& sampler, bool mipmapped, graph::Compare compare);

 private:
  struct CachedSampler {
    gl::SamplerDesc desc;
    gl::SamplerObject object;
  };
  std::vector<CachedSampler> samplers_;
};

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

  // The values of the plan's parameters, parallel to FlatGraph::parameters: as the plan was made, and since then
  // as setParameter() set them.
  std::span<const graph::Value> parameters() const { return parameters_; }
  // Sets a live parameter: evaluates what reads it, and writes the bytes, which the next frame uploads. False, and
  // nothing has changed, when that takes another plan, which may also say why not: the parameter is structural or
  // unknown, it does not take the value, or an expression has no result with it. Allocates nothing for numbers,
  // booleans and lists.
  bool setParameter(std::string_view path, const graph::Value& value);
  // Of all uniform blocks, as the last frame had them and setParameter() changed them; for tests.
  std::span<const std::byte> uniformBytes() const { return uniformBytes_; }

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
  Execution(Device& device, std::shared_ptr<const graph::Plan> plan)
      : device_(device), plan_(std::move(plan)) {}
  bool prepare(Execution* before, ShaderFiles files, base::Diagnostics& diagnostics);
  void layoutUniforms(base::Diagnostics& diagnostics);
  bool isSettled(std::size_t step) const;
  bool preparePasses(Execution* before, const std::vector<std::shared_ptr<const gl::Variant>>& variants,
                     const PassKeeper* keeper, base::Diagnostics& diagnostics);
  void fillUniforms();
  void listReaders();
  graph::Value valueOf(const graph::UniformSpec& uniform) const;
  void carryOver(Execution& before);
  void refreshImports(base::Diagnostics& diagnostics);
  void viewImports(base::Diagnostics& diagnostics);
  void publishImports(std::uint32_t job);
  void releaseImports();
  double ageOf(std::uint32_t resource) const;
  void choosePasses(bool alwaysOnly, base::Diagnostics& diagnostics);
  bool choosePass(std::size_t step, std::uint32_t conditions, base::Diagnostics& diagnostics);
  void holdFading();
  void adoptStandIns(Execution& before);
  void followWhole(base::Diagnostics& diagnostics);
  PrepareContext prepareContext(base::Diagnostics& diagnostics);
  void findMakers();
  void refreshUniforms(bool alwaysOnly);
  void refreshOwnHashes();
  bool resetHistories(base::Diagnostics& diagnostics);
  void finishSlices(FrameReport& report, base::Diagnostics& diagnostics);
  void refreshSlices();
  void runDecided(FrameReport& report, base::Diagnostics& diagnostics);
  bool publishFinished();
  void publish(std::uint32_t resource);
  void runStep(std::size_t step, base::Diagnostics& diagnostics);
  void lookThroughTap(std::size_t step, const FrameReport& report);
  void rotateWritten(const PreparedPass& pass);
  void bind(PreparedPass& pass, base::Diagnostics& diagnostics);
  GLuint framebufferOf(PreparedPass& pass, base::Diagnostics& diagnostics);
  std::uint32_t lastVersionOf(std::string_view name) const;

  Device& device_;
  std::shared_ptr<const graph::Plan> plan_;
  std::unique_ptr<ResourcePool> pool_;
  std::uint32_t passesPrepared_ = 0;
  std::vector<PreparedPass> passes_;  // per step, of the variant whose conditions hold
  struct Parked {
    std::size_t step = 0;
    PreparedPass pass;
  };
  std::vector<Parked> parked_;  // variants that ran under other conditions
  std::vector<std::uint8_t>
      publishing_;  // per resource: a pass that is not `always` publishes it in this frame
  std::unique_ptr<FrameCadence> cadence_;
  FramebufferCache framebuffers_;
  gl::StateCache states_;
  std::vector<gl::Attachment> attachmentScratch_;
  gl::Buffer uniforms_;
  std::vector<std::byte> uniformBytes_;
  bool uniformsDirty_ = true;
  std::vector<graph::Value> parameters_;                             // parallel to FlatGraph::parameters
  std::unordered_map<std::string_view, std::uint32_t> parameterOf_;  // by path, which the plan's graph holds
  // A uniform that reads live parameters, of a pass or a parked one.
  struct LiveUniform {
    const gl::BlockMember* member = nullptr;
    const graph::Expr* expr = nullptr;
    std::uint32_t block = 0;  // offset of its block in uniformBytes_
  };
  std::vector<LiveUniform> liveUniforms_;
  std::vector<std::vector<std::uint32_t>> readers_;  // per parameter: into liveUniforms_
  std::vector<graph::Value> results_;                // scratch of setParameter()
  std::vector<std::uint64_t> generations_;           // per resource
  std::vector<std::uint64_t> generationsBefore_;     // as they were when the frame was decided
  std::uint64_t nextGeneration_ = 1;
  std::vector<std::uint64_t> own_;         // per step
  std::vector<std::uint8_t> rotated_;      // per resource, this frame
  std::vector<std::uint8_t> ran_;          // per step, this frame
  std::vector<std::uint8_t> made_;         // per resource: the world's, or some step writes it
  std::vector<std::uint8_t> lasting_;      // per step: runs in an obsolete frame too
  std::vector<std::uint64_t> resetState_;  // per history: hash of what resets it
  ReadBack readBack_;
  FrameInput input_;
  const World* world_ = nullptr;
  std::uint64_t framesRun_ = 0;
  std::size_t tapStep_ = graph::kNone;
  std::function<void()> tap_;
};

}  // namespace weft::runtime
