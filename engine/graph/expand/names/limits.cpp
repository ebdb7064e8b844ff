#include "engine/graph/expand/names/limits.h"

#include <fmt/format.h>

#include <utility>

namespace weft::graph::expansion {

namespace {

// Operators of expressions nested in each other through definitions; fits the smallest usual stack several
// times.
constexpr std::uint32_t kMostHeight = 3000;
// The part of the greatest height that a definition adds by itself.
constexpr int kOwnHeight = 4;
constexpr std::uint64_t kVersionsPerUse = 10;

}  // namespace

void stopAt(Model& model, Limit limit, Where place, const Called& message) {
  if (!std::exchange(model.effort.stopped, true))
    base::reportLimit(model.diagnostics, limit, std::move(place), message.text());
  model.incomplete = true;
}

bool lookAt(Model& model, std::uint64_t count, const Place& place) {
  model.effort.looked += count;
  return !exceeds(model, Limit::alternatives, model.effort.looked, place,
                  "the lists of alternatives of the graph lead to each other in too many ways");
}

StanzaCost costOf(const PassDesc& desc, const std::string& declared) {
  StanzaCost cost;
  cost.uses = desc.slots.size() + desc.parameters.size() + desc.defines.size();
  cost.bytes = sizeof(PassSpec) + sizeof(FlatPass) + 2 * declared.size() + desc.type.size() +
               desc.shader.size() + desc.vertexShader.size() + desc.list.size() + desc.geometry.size() +
               8 * desc.geometryArguments.size();
  const auto evaluated = [&](const Expr& expr) { cost.terms += expr.terms(); };
  for (const SlotDesc& slot : desc.slots) {
    cost.bytes += sizeof(SlotSpec) + sizeof(FlatUse) + sizeof(WriteRecord) + slot.name.size();
    if (slot.ref.sampler.wrap == Wrap::border) cost.bytes += sizeof(BorderColor);
    evaluated(slot.ref.condition);
    for (const std::optional<SpanDesc>* span : {&slot.ref.mip, &slot.ref.layer, &slot.ref.face})
      if (*span) {
        evaluated((*span)->first);
        evaluated((*span)->last);
      }
    if (slot.ref.element) evaluated(*slot.ref.element);
  }
  for (const PassParameterDesc& parameter : desc.parameters) {
    cost.bytes += sizeof(UniformSpec) + 3 * parameter.name.size() + declared.size();
    evaluated(parameter.value);
    if (parameter.declared)
      for (const std::string& choice : parameter.declared->choices)
        cost.bytes += sizeof(DefineSpec) + parameter.name.size() + choice.size();
  }
  for (const NamedExpr& define : desc.defines) {
    cost.bytes += sizeof(DefineSpec) + define.name.size();
    evaluated(define.expr);
  }
  for (const NamedExpr& state : desc.state) evaluated(state.expr);
  for (const Expr* expr : {&desc.enabled, &desc.slices, &desc.threads, &desc.instances}) evaluated(*expr);
  for (const Expr& argument : desc.geometryArguments) evaluated(argument);
  return cost;
}

bool mayExpand(Model& model, const StanzaCost& cost, const Place& place, const std::string& declared) {
  Effort& effort = model.effort;
  effort.uses += cost.uses;
  effort.bytes += cost.bytes;
  effort.terms += cost.terms;
  const auto tooMuch = [&](Limit limit, std::uint64_t count, const char* words) {
    return exceeds(model, limit, count, place, {words, declared});
  };
  return !tooMuch(Limit::uses, effort.uses,
                  "with pass '{}' the graph has too many slots, parameters and defines") &&
         !tooMuch(Limit::graph_bytes, effort.bytes, "with pass '{}' the graph takes too much memory") &&
         !tooMuch(Limit::terms, effort.terms, "with pass '{}' the graph evaluates too many expressions");
}

bool mayUse(Model& model, std::uint32_t index, const FlatUse& rect, std::uint32_t elements,
            const Place& place) {
  const Entity& entity = model.entities[index];
  const bool split = !entity.elements.empty() && model.versions.isSplit(entity.elements[0].resource);
  const std::uint64_t parts = split ? subresourceCount(rect, entity.shape) : 1;
  return !exceeds(model, Limit::uses, model.graph.uses.size() + elements, place,
                  "the passes of the graph use too many textures and buffers") &&
         compare(model, parts * elements, place) &&
         !exceeds(model, Limit::uses, model.graph.links.runs.size() / kVersionsPerUse, place,
                  "the passes of the graph read too many versions of sub-resources");
}

Descent::Descent(Model& model, int height, const Place& place, std::string_view label, bool definition)
    : effort_(model.effort),
      height_(static_cast<std::uint32_t>(height + kOwnHeight)),
      depth_(definition ? 1 : 0) {
  effort_.depth += depth_;
  effort_.height += height_;
  const bool deep = effort_.depth > base::limitOf(Limit::definition_depth);
  good_ = !deep && effort_.height <= kMostHeight;
  if (good_) return;
  model.incomplete = true;
  if (std::exchange(effort_.tooDeep, true)) return;
  auto& d = base::reportLimit(
      model.diagnostics, Limit::definition_depth, place,
      fmt::format("definitions depend on each other in too long a row, which ends at '{}'", label));
  if (deep) return;
  d.expected = fmt::format(
      "at most {} operators nested in each other, those of the definitions they use counted", kMostHeight);
  d.found = fmt::format("{}", effort_.height);
  d.hint = "write some of the expressions flatter, or let them use fewer definitions";
}

Descent::~Descent() {
  effort_.depth -= depth_;
  effort_.height -= height_;
}

}  // namespace weft::graph::expansion
