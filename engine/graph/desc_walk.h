// Visits every expression and every reference that a graph file writes, except what its includes bind.
#pragma once

#include <optional>

#include "engine/graph/desc.h"

namespace weft::graph {

// Calls onExpr(expr) for each expression, absent ones too, and onRef(ref) for each reference, after the expressions in it.
template <class OnExpr, class OnRef>
void visitRef(const RefDesc& ref, OnExpr&& onExpr, OnRef&& onRef) {
  onExpr(ref.condition);
  for (const std::optional<SpanDesc>* span : {&ref.element, &ref.mip, &ref.layer, &ref.face})
    if (*span) {
      onExpr((*span)->first);
      onExpr((*span)->last);
    }
  onRef(ref);
}

// onValue(expr) in place of onExpr for what is the value of a parameter of a pass.
template <class OnExpr, class OnRef, class OnValue>
void visitPass(const PassDesc& pass, OnExpr&& onExpr, OnRef&& onRef, OnValue&& onValue) {
  for (const Expr* expr : {&pass.enabled, &pass.slices, &pass.threads, &pass.instances, &pass.period,
                           &pass.draws, &pass.raster, &pass.samples, &pass.screen})
    onExpr(*expr);
  if (pass.include) onExpr(pass.include->screen);
  for (const RangeDesc& range : pass.repeat)
    for (const Expr* expr : {&range.first, &range.last, &range.step}) onExpr(*expr);
  for (const SlotDesc& slot : pass.slots) visitRef(slot.ref, onExpr, onRef);
  for (const PassParameterDesc& parameter : pass.parameters)
    for (const Expr& value : parameter.values()) onValue(value);
  for (const NamedExpr& define : pass.defines) onExpr(define.expr);
  for (const NamedExpr& state : pass.state) onExpr(state.expr);
  for (const Expr& argument : pass.geometryArguments) onExpr(argument);
  if (pass.view) visitRef(*pass.view, onExpr, onRef);
}

// Also onValue(expr) in place of onExpr for a "let".
template <class OnExpr, class OnRef, class OnValue>
void visitMentions(const GraphDesc& desc, OnExpr&& onExpr, OnRef&& onRef, OnValue&& onValue) {
  for (const NamedExpr& let : desc.lets) onValue(let.expr);
  for (const ResourceDesc& resource : desc.resources) {
    for (const Expr* expr :
         {&resource.size, &resource.mips, &resource.layers, &resource.array, &resource.samples,
          &resource.bytes, &resource.clear, &resource.history, &resource.first, &resource.format})
      onExpr(*expr);
    for (const Expr& value : resource.resetValues) onExpr(value);
    for (const NamedExpr& argument : resource.import.arguments) onExpr(argument.expr);
    if (resource.firstRef) visitRef(*resource.firstRef, onExpr, onRef);
    for (const RefDesc& ref : resource.resetRefs) visitRef(ref, onExpr, onRef);
    for (const RefDesc& ref : resource.alternatives) visitRef(ref, onExpr, onRef);
  }
  for (const PassDesc& pass : desc.passes) visitPass(pass, onExpr, onRef, onValue);
  if (desc.present) visitRef(*desc.present, onExpr, onRef);
  for (const OutputDesc& output : desc.outputs) visitRef(output.ref, onExpr, onRef);
}
template <class OnExpr, class OnRef>
void visitMentions(const GraphDesc& desc, OnExpr&& onExpr, OnRef&& onRef) {
  visitMentions(desc, onExpr, onRef, onExpr);
}

}  // namespace weft::graph
