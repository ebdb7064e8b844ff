#include "engine/runtime/frame/step_choice.h"

#include <string_view>
#include <unordered_map>

#include "engine/text/hash.h"

namespace weft::runtime {

using graph::kNone;

StepChoice::StepChoice(const graph::Plan& plan, ResourcePool& pool, Imports& imports,
                       const std::vector<PreparedPass>& passes, const StepChoice* before)
    : plan_(plan),
      pool_(pool),
      imports_(imports),
      passes_(passes),
      cadence_(plan),
      hashes_(plan.steps.size()),
      lasting_(findLastingSteps(plan)),
      ran_(plan.steps.size()) {
  if (!before) return;
  std::unordered_map<std::string_view, std::size_t> stepOf;
  for (std::size_t step = 0; step < before->passes_.size(); ++step)
    stepOf[before->passes_[step].context.spec->name] = step;
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (const auto old = stepOf.find(passes_[step].context.spec->name); old != stepOf.end())
      cadence_.memories()[step] = before->cadence_.memories()[old->second];
}

void StepChoice::refreshHashes(const FrameUniforms& uniforms) {
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (!isAlways(step)) hashes_[step] = hashOf(passes_[step], uniforms);
}

std::uint64_t StepChoice::hashOf(const PreparedPass& pass, const FrameUniforms& uniforms) {
  std::uint64_t hash = pass.programHash;
  hash = uniforms.hash(pass.parametersOffset, pass.parametersBlock, hash);
  hash = uniforms.hash(pass.viewOffset, pass.viewBlock, hash);
  for (const std::uint32_t resource : pass.written)
    hash = text::hashCombine(hash, pool_[resource].serial + (pool_[resource].resets << 40));
  // Adds the imports that this pass sees later than they change.
  for (const std::uint32_t resource : pass.read)
    if (const std::uint32_t publisher = pool_[resource].publisher;
        publisher != kNone && publisher != pass.group)
      hash = text::hashCombine(hash, pool_[resource].shows);
  for (const std::uint32_t axis : pass.context.spec->threads) hash = text::hashCombine(hash, axis);
  if (pass.list >= 0)
    hash = text::hashCombine(
        hash, imports_.generation(static_cast<scene::DrawList>(pass.list), pass.meshes != nullptr));
  return hash;
}

}  // namespace weft::runtime
