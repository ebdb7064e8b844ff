// A plan as a Graphviz graph. Declared in print.h.
#include <fmt/format.h>

#include <iterator>
#include <set>

#include "engine/graph/print/explain.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"
#include "engine/text/printable.h"

namespace weft::graph {

namespace {

constexpr const char* kGray =
    ", style=\"filled\", fillcolor=\"gray93\", color=\"gray70\", fontcolor=\"gray55\"";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text::printable(text)) {
    if (c == '"' || c == '\\') out.push_back('\\');
    out.push_back(c);
  }
  return out;
}

std::string passLine(const Plan& plan, std::uint32_t p) {
  const FlatGraph& graph = *plan.graph;
  const FlatPass& pass = graph.passes[p];
  std::string label = escaped(graph.passNames[p]), style = kGray;
  if (plan.stepOf[p] != kNone) {
    const Step& step = plan.steps[plan.stepOf[p]];
    label = fmt::format("{} {}", plan.stepOf[p], label);
    if (pass.cadence != Cadence::always) label += fmt::format("\\n{}", nameOf(pass.cadence));
    const auto mask = static_cast<std::uint16_t>(step.barriers | step.barriersAfterClears);
    if (mask != 0) label += "\\nbarrier: " + barrierText(mask);
    style = fmt::format(", style=\"filled{}\", fillcolor=\"moccasin\"", pass.sideEffect ? ",bold" : "");
  }
  return fmt::format("  p{} [shape=box, label=\"{}\"{}];\n", p, label, style);
}

std::string resourceLine(const Plan& plan, std::uint32_t r) {
  const FlatResource& resource = plan.graph->resources[r];
  std::string label = escaped(plan.graph->resourceNames[r]) + "\\n" + shapeText(resource);
  if (plan.bufferOffsetOf[r] != Plan::kNoOffset) label += fmt::format(" at {}", plan.bufferOffsetOf[r]);
  if (plan.storageOf[r] != kNone) label += fmt::format("\\nstorage {}", plan.storageOf[r]);
  const char* const style = isImported(resource)         ? ", style=\"filled\", fillcolor=\"palegreen\""
                            : plan.firstStep[r] == kNone ? kGray
                            : plan.persistent[r] != 0
                                ? ", style=\"filled\", fillcolor=\"lightsteelblue\", peripheries=2"
                                : ", style=\"filled\", fillcolor=\"lightblue\"";
  return fmt::format("  r{} [shape=ellipse, label=\"{}\"{}];\n", r, label, style);
}

}  // namespace

std::string dumpDot(const Plan& plan) {
  const FlatGraph& graph = *plan.graph;
  std::string text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "digraph \"{}\" {{\n  rankdir=LR;\n  node [fontname=\"sans-serif\", fontsize=10];\n  edge "
                 "[fontname=\"sans-serif\", fontsize=8];\n",
                 escaped(graph.name.empty() ? "plan" : graph.name));
  std::set<std::uint32_t> used;
  for (const FlatUse& use : graph.uses) used.insert(use.resource);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) text += passLine(plan, p);
  for (const std::uint32_t r : used) text += resourceLine(plan, r);
  const std::vector<std::string> slots = slotNames(graph);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (std::uint32_t u = graph.passes[p].firstUse; u < graph.passes[p].firstUse + graph.passes[p].useCount;
         ++u) {
      const FlatUse& use = graph.uses[u];
      const std::string part = textOf(graph, use).substr(graph.resourceNames[use.resource].size());
      const std::string label = escaped(slots[u] + (slots[u].empty() || part.empty() ? "" : " ") + part);
      const std::string pass = fmt::format("p{}", p), resource = fmt::format("r{}", use.resource);
      const bool reads = use.access == Access::read;
      fmt::format_to(out, "  {} -> {} [label=\"{}\"{}{}{}];\n", reads ? resource : pass,
                     reads ? pass : resource, label,
                     use.history > 0 ? ", style=dashed, constraint=false" : "",
                     plan.attached[u] == 0 ? ", color=\"gray70\", fontcolor=\"gray55\"" : "",
                     use.access == Access::modify ? ", dir=both" : "");
    }
  if (graph.present.resource != kNone)
    fmt::format_to(out, "  present [shape=doublecircle, label=\"present\"];\n  r{} -> present;\n",
                   graph.present.resource);
  for (std::size_t i = 0; i < graph.outputs.size(); ++i)
    fmt::format_to(out, "  o{} [shape=note, label=\"{}\"];\n  r{} -> o{} [style=dotted];\n", i,
                   escaped(graph.outputNames[i]), graph.outputs[i].resource, i);
  return text + "}\n";
}

}  // namespace weft::graph
