#include "engine/runtime/uniforms/uniform_values.h"

#include <algorithm>
#include <string>
#include <utility>

#include "engine/graph/expand/names/settings.h"

namespace weft::runtime {

namespace {

double trialAge(std::uint32_t) {
  return graph::kTrialAge;
}

}  // namespace

UniformValues::UniformValues(const graph::FlatGraph& graph) : graph_(graph) {
  for (const graph::ParameterSpec& parameter : graph.parameters) {
    parameterOf_.emplace(parameter.path, static_cast<std::uint32_t>(parameters_.size()));
    parameters_.push_back(parameter.value);
  }
}

// The value of a uniform without age().
graph::Value UniformValues::valueOf(const graph::UniformSpec& uniform) const {
  return uniform.dynamic.live() ? uniform.dynamic.evaluateFolded(trialAge, parameters_) : uniform.value;
}

void UniformValues::fill(std::span<PreparedPass> passes, UniformArena& arena) {
  readers_.clear();
  readersOf_.assign(parameters_.size(), {});
  for (PreparedPass& pass : passes) {
    fillPass(pass, arena);
    listReaders(pass);
  }
  std::size_t most = 0;
  for (const auto& readers : readersOf_) most = std::max(most, readers.size());
  results_.resize(most);
}

void UniformValues::fillPass(PreparedPass& pass, UniformArena& arena) const {
  pass.dynamics.clear();
  if (!pass.parametersBlock) return;
  for (const graph::UniformSpec& uniform : pass.context.spec->uniforms) {
    const gl::BlockMember* member = pass.parametersBlock->find(uniform.name);
    if (!member) continue;
    if (uniform.dynamic.dynamic())
      pass.dynamics.push_back({*member, uniform.dynamic});
    else
      arena.write(pass.parametersOffset, *member, valueOf(uniform));
  }
}

void UniformValues::listReaders(const PreparedPass& pass) {
  if (!pass.parametersBlock) return;
  for (const graph::UniformSpec& uniform : pass.context.spec->uniforms) {
    if (!uniform.dynamic.live()) continue;
    const gl::BlockMember* member = pass.parametersBlock->find(uniform.name);
    if (!member) continue;
    for (const std::uint32_t key : uniform.dynamic.parameterKeys())
      readersOf_[key].push_back(static_cast<std::uint32_t>(readers_.size()));
    readers_.push_back({member, &uniform.dynamic, pass.parametersOffset});
  }
}

void UniformValues::refresh(const PreparedPass& pass, const std::function<double(std::uint32_t)>& ageOf,
                            UniformArena& arena) const {
  for (const DynamicUniform& uniform : pass.dynamics)
    arena.write(pass.parametersOffset, uniform.member, uniform.expr.evaluateFolded(ageOf, parameters_));
}

bool UniformValues::set(std::string_view path, const graph::Value& value, UniformArena& arena) {
  const auto found = parameterOf_.find(path);
  if (found == parameterOf_.end()) return false;
  const graph::ParameterSpec& parameter = graph_.parameters[found->second];
  if (parameter.structural || !graph::takesValue(parameter.desc, value)) return false;
  graph::Value& mine = parameters_[found->second];
  graph::Value before = std::exchange(mine, value);
  const std::vector<std::uint32_t>& readers = readersOf_[found->second];
  std::string unexpected;
  for (std::size_t i = 0; i < readers.size(); ++i) {
    const Reader& reader = readers_[readers[i]];
    results_[i] = reader.expr->evaluateFolded(trialAge, parameters_);
    if (memberTakes(*reader.member, results_[i], unexpected)) continue;
    mine = std::move(before);
    return false;
  }
  for (std::size_t i = 0; i < readers.size(); ++i) {
    const Reader& reader = readers_[readers[i]];
    if (!reader.expr->dynamic()) arena.write(reader.block, *reader.member, results_[i]);
  }
  return true;
}

}  // namespace weft::runtime
