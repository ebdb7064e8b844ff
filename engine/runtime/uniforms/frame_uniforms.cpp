#include "engine/runtime/uniforms/frame_uniforms.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "engine/graph/expand/names/settings.h"
#include "engine/passes/compute/work_groups.h"
#include "engine/runtime/storage/block_writer.h"
#include "engine/text/hash.h"

namespace weft::runtime {

namespace {

double trialAge(std::uint32_t) {
  return graph::kTrialAge;
}

}  // namespace

FrameUniforms::FrameUniforms(const graph::Plan& plan, Imports& imports, std::uint32_t alignment)
    : plan_(plan), imports_(imports), alignment_(alignment) {
  for (const graph::ParameterSpec& parameter : plan.graph->parameters) {
    indexOf_.emplace(parameter.path, parameters_.size());
    parameters_.push_back(parameter.value);
  }
  for (const graph::WatchedValue& each : plan.graph->watched) parameters_.push_back(each.shape);
  generations_.resize(plan.graph->watched.size());
}

bool FrameUniforms::layOut(std::span<PreparedPass> passes, text::Diagnostics& diagnostics) {
  std::uint32_t end = 0;
  const auto place = [&](const gl::Block* block, std::uint32_t& offset) {
    offset = end;
    if (block) end += (block->bytes + alignment_ - 1) / alignment_ * alignment_;
  };
  for (PreparedPass& pass : passes) {
    place(pass.parametersBlock, pass.parametersOffset);
    place(pass.viewBlock, pass.viewOffset);
    place(pass.sliceBlock, pass.sliceOffset);
  }
  bytes_.assign(end, std::byte{0});
  if (end > 0 && !gl::remake(buffer_, end, GL_DYNAMIC_STORAGE_BIT, "uniforms", diagnostics)) return false;
  readersOf_.resize(parameters_.size());
  for (PreparedPass& pass : passes) fill(pass);
  std::size_t most = 0;
  for (const auto& readers : readersOf_) most = std::max(most, readers.size());
  results_.resize(most);
  return true;
}

// Writes what does not change with time, and lists what does and who reads live parameters.
void FrameUniforms::fill(PreparedPass& pass) {
  pass.dynamics.clear();
  if (!pass.parametersBlock) return;
  for (const graph::UniformSpec& uniform : pass.context.spec->uniforms) {
    const gl::BlockMember* member = pass.parametersBlock->find(uniform.name);
    const auto field = member ? fieldFor(*member, uniform) : std::nullopt;
    if (!field) continue;
    const bool live = uniform.dynamic.live();
    if (uniform.dynamic.dynamic())
      pass.dynamics.push_back({*field, uniform.dynamic});
    else
      write(pass.parametersOffset, *field,
            live ? uniform.dynamic.evaluateFolded(trialAge, parameters_) : uniform.value);
    if (!live) continue;
    for (const std::uint32_t key : uniform.dynamic.parameterKeys())
      readersOf_[key].push_back({*field, &uniform.dynamic, pass.parametersOffset});
  }
}

// Evaluates what reads values of imports that are others than in the frame before.
void FrameUniforms::followImports() {
  const graph::FlatGraph& graph = *plan_.graph;
  imports::Numbers numbers;
  for (std::size_t i = 0; i < generations_.size(); ++i) {
    const graph::WatchedValue& asked = graph.watched[i];
    const graph::ImportSpec& import = graph.imports[asked.import];
    // A view has more than its generation counts: the jitter.
    const bool view = import.kind == graph::ImportKind::view;
    const std::uint64_t generation = view ? 0 : imports_.generation(import);
    if (!view && std::exchange(generations_[i], generation) == generation) continue;
    const imports::ViewPart part{graph.screenWidth, graph.screenHeight,
                                 static_cast<std::uint16_t>(asked.row)};
    if (!imports_.of(import).value(imports_.frame(), part, asked.column, numbers)) continue;
    const std::size_t key = graph.parameters.size() + i;
    graph::Value value = asked.shape;
    const bool column = asked.part != graph::kWholeValue;
    std::copy_n(numbers.begin() + (column ? 4 * asked.part : 0), value.count, value.v.begin());
    if (value == parameters_[key]) continue;
    parameters_[key] = value;
    for (const Reader& reader : readersOf_[key])
      if (!reader.expr->dynamic())
        write(reader.block, reader.field, reader.expr->evaluateFolded(trialAge, parameters_));
  }
}

void FrameUniforms::refresh(std::span<PreparedPass> passes, const std::function<double(std::uint32_t)>& ageOf,
                            bool alwaysOnly) {
  const graph::FlatGraph& graph = *plan_.graph;
  followImports();
  for (std::size_t step = 0; step < passes.size(); ++step) {
    PreparedPass& pass = passes[step];
    const graph::Cadence cadence = graph.passes[plan_.steps[step].pass].cadence;
    const bool timeless = cadence == graph::Cadence::on_change || cadence == graph::Cadence::once;
    if (alwaysOnly && timeless) continue;
    for (const DynamicUniform& uniform : pass.dynamics)
      write(pass.parametersOffset, uniform.field, uniform.expr.evaluateFolded(ageOf, parameters_));
    if (const graph::Expr& timed = pass.context.spec->timedInstances; timed.present())
      pass.context.instances = instancesAt(timed, ageOf);
    if (!pass.viewBlock) continue;
    writeView(bytes_.data() + pass.viewOffset, *pass.viewBlock,
              imports_.view(graph, *pass.context.spec, pass.width, pass.height),
              {static_cast<float>(pass.width), static_cast<float>(pass.height)}, timeless);
    changed_ = true;
  }
}

void FrameUniforms::setSlices(PreparedPass& pass, const SliceRange& range) {
  pass.context.slice = range.first;
  pass.context.sliceCount = range.count;
  pass.context.slices = range.of;
  if (!pass.sliceBlock) return;
  const passes::WorkGroups groups = passes::workGroupsOf(pass.context);
  for (const gl::BlockMember& member : pass.sliceBlock->members) {
    graph::Value value{graph::Value::Type::list, 3, {}, {}};
    for (std::size_t axis = 0; axis < 3; ++axis)
      value.v[axis] = groups.first[axis] * (member.name == "first_group" ? 1u : pass.context.groupSize[axis]);
    if (const auto field = fieldFor(member, {.value = value})) write(pass.sliceOffset, *field, value);
  }
}

bool FrameUniforms::set(std::string_view path, const graph::Value& value) {
  const auto found = indexOf_.find(path);
  if (found == indexOf_.end()) return false;
  const std::size_t index = found->second;
  const graph::ParameterSpec& parameter = plan_.graph->parameters[index];
  if (parameter.structural || !graph::takesValue(parameter.desc, value)) return false;
  graph::Value& mine = parameters_[index];
  graph::Value before = std::exchange(mine, value);
  const std::vector<Reader>& readers = readersOf_[index];
  for (std::size_t i = 0; i < readers.size(); ++i) {
    results_[i] = readers[i].expr->evaluateFolded(trialAge, parameters_);
    if (readers[i].field.takes(results_[i])) continue;
    mine = std::move(before);
    return false;
  }
  for (std::size_t i = 0; i < readers.size(); ++i)
    if (!readers[i].expr->dynamic()) write(readers[i].block, readers[i].field, results_[i]);
  return true;
}

void FrameUniforms::write(std::uint32_t block, const Field& field, const graph::Value& value) {
  changed_ |= writeValue(bytes_.data() + block, field, value);
}

std::uint64_t FrameUniforms::hash(std::uint32_t block, const gl::Block* layout, std::uint64_t seed) const {
  if (!layout) return seed;
  const auto* bytes = reinterpret_cast<const char*>(bytes_.data() + block);
  return text::hashBytes({bytes, layout->bytes}, seed);
}

void FrameUniforms::upload() {
  if (!changed_ || bytes_.empty()) return;
  gl::uploadBuffer(buffer(), 0, bytes_);
  changed_ = false;
}

}  // namespace weft::runtime
