// The values of uniforms while a plan runs: what they are at first, and live parameters that are set.
#include <algorithm>
#include <utility>

#include "engine/graph/expand/names/parameter_check.h"
#include "engine/runtime/frame/execution.h"

namespace weft::runtime {

namespace {

double trialAge(std::uint32_t) {
  return graph::kTrialAge;
}

}  // namespace

// Of a uniform without age().
graph::Value Execution::valueOf(const graph::UniformSpec& uniform) const {
  return uniform.dynamic.live() ? uniform.dynamic.evaluateFolded(trialAge, parameters_) : uniform.value;
}

// Those with age() are written by every frame.
void Execution::fillUniforms() {
  const auto fill = [&](PreparedPass& pass) {
    pass.dynamics.clear();
    if (!pass.parametersBlock) return;
    for (const graph::UniformSpec& uniform : pass.context.spec->uniforms) {
      if (uniform.define) continue;
      const gl::BlockMember* member = pass.parametersBlock->find(uniform.name);
      if (!member) continue;
      if (uniform.dynamic.dynamic())
        pass.dynamics.push_back({*member, uniform.dynamic});
      else
        writeValue(uniformBytes_.data() + pass.parametersOffset, *member, valueOf(uniform));
    }
  };
  for (PreparedPass& pass : passes_) fill(pass);
  for (Parked& parked : parked_) fill(parked.pass);
}

void Execution::listReaders() {
  liveUniforms_.clear();
  readers_.assign(parameters_.size(), {});
  const auto list = [&](const PreparedPass& pass) {
    if (!pass.parametersBlock) return;
    for (const graph::UniformSpec& uniform : pass.context.spec->uniforms) {
      if (uniform.define || !uniform.dynamic.live()) continue;
      const gl::BlockMember* member = pass.parametersBlock->find(uniform.name);
      if (!member) continue;
      for (const std::uint32_t key : uniform.dynamic.parameterKeys())
        readers_[key].push_back(static_cast<std::uint32_t>(liveUniforms_.size()));
      liveUniforms_.push_back({member, &uniform.dynamic, pass.parametersOffset});
    }
  };
  for (const PreparedPass& pass : passes_) list(pass);
  for (const Parked& parked : parked_) list(parked.pass);
  std::size_t most = 0;
  for (const auto& readers : readers_) most = std::max(most, readers.size());
  results_.resize(most);
}

bool Execution::setParameter(std::string_view path, const graph::Value& value) {
  const auto found = parameterOf_.find(path);
  if (found == parameterOf_.end()) return false;
  const graph::ParameterSpec& parameter = plan_->graph->parameters[found->second];
  if (parameter.structural || !graph::takesValue(parameter.desc, value)) return false;
  graph::Value& mine = parameters_[found->second];
  graph::Value before = std::exchange(mine, value);
  const std::vector<std::uint32_t>& readers = readers_[found->second];
  std::string unexpected;
  for (std::size_t i = 0; i < readers.size(); ++i) {
    const LiveUniform& uniform = liveUniforms_[readers[i]];
    results_[i] = uniform.expr->evaluateFolded(trialAge, parameters_);
    if (memberTakes(*uniform.member, results_[i], unexpected)) continue;
    mine = std::move(before);
    return false;
  }
  for (std::size_t i = 0; i < readers.size(); ++i) {
    const LiveUniform& uniform = liveUniforms_[readers[i]];
    if (!uniform.expr->dynamic())
      writeValue(uniformBytes_.data() + uniform.block, *uniform.member, results_[i]);
  }
  uniformsDirty_ |= !readers.empty();
  return true;
}

}  // namespace weft::runtime
