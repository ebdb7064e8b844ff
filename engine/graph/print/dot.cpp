#include "engine/graph/print/dot.h"

#include <set>

#include "engine/base/printable.h"
#include "engine/graph/print/explain.h"
#include "engine/graph/print/shared.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : base::printable(text)) {
    if (c == '"' || c == '\\') out.push_back('\\');
    out.push_back(c);
  }
  return out;
}

std::string passNode(std::uint32_t pass) {
  return "p" + std::to_string(pass);
}
std::string resourceNode(std::uint32_t resource) {
  return "r" + std::to_string(resource);
}

std::string passLine(const Plan& plan, std::uint32_t p) {
  const FlatGraph& graph = *plan.graph;
  std::string label = escaped(graph.passNames[p]), style;
  if (plan.stepOf[p] == kNone) {
    style = ", style=\"filled\", fillcolor=\"gray93\", color=\"gray70\", fontcolor=\"gray55\"";
  } else {
    const Step& step = plan.steps[plan.stepOf[p]];
    label = std::to_string(plan.stepOf[p]) + " " + label;
    if (graph.passes[p].cadence != Cadence::always)
      label += std::string("\\n") + nameOf(graph.passes[p].cadence);
    if (const int mask = step.barriers | step.barriersAfterClears; mask != 0)
      label += "\\nbarrier: " + barrierText(static_cast<std::uint16_t>(mask));
    style = graph.passes[p].sideEffect ? ", style=\"filled,bold\", fillcolor=\"moccasin\""
                                       : ", style=\"filled\", fillcolor=\"moccasin\"";
  }
  return "  " + passNode(p) + " [shape=box, label=\"" + label + "\"" + style + "];\n";
}

std::string resourceLine(const Plan& plan, std::uint32_t r) {
  const FlatGraph& graph = *plan.graph;
  const FlatResource& resource = graph.resources[r];
  std::string label = escaped(graph.resourceNames[r]);
  if (isBuffer(resource)) {
    label += "\\n" + std::to_string(resource.bytes) + " bytes";
    if (plan.bufferOffsetOf[r] != Plan::kNoOffset) label += " at " + std::to_string(plan.bufferOffsetOf[r]);
  } else {
    label += std::string("\\n") + infoOf(resource.format).name + " " + std::to_string(resource.width) + "x" +
             std::to_string(resource.height);
    if (plan.storageOf[r] != kNone) label += "\\nstorage " + std::to_string(plan.storageOf[r]);
  }
  std::string style = ", style=\"filled\", fillcolor=\"lightblue\"";
  if (isImported(resource))
    style = ", style=\"filled\", fillcolor=\"palegreen\"";
  else if (plan.firstStep[r] == kNone)
    style = ", style=\"filled\", fillcolor=\"gray93\", color=\"gray70\", fontcolor=\"gray55\"";
  else if (plan.persistent[r] != 0)
    style = ", style=\"filled\", fillcolor=\"lightsteelblue\", peripheries=2";
  return "  " + resourceNode(r) + " [shape=ellipse, label=\"" + label + "\"" + style + "];\n";
}

}  // namespace

std::string dumpDot(const Plan& plan) {
  const FlatGraph& graph = *plan.graph;
  std::string text = "digraph \"" + escaped(graph.name.empty() ? "plan" : graph.name) +
                     "\" {\n  rankdir=LR;\n  node [fontname=\"sans-serif\", fontsize=10];\n  edge "
                     "[fontname=\"sans-serif\", fontsize=8];\n";
  std::set<std::uint32_t> used;
  for (const FlatUse& use : graph.uses) used.insert(use.resource);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) text += passLine(plan, p);
  for (const std::uint32_t r : used) text += resourceLine(plan, r);
  const std::vector<std::string> slots = slotNames(graph);
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p)
    for (std::uint32_t u = graph.passes[p].firstUse; u < graph.passes[p].firstUse + graph.passes[p].useCount;
         ++u) {
      const FlatUse& use = graph.uses[u];
      const bool reads = use.access == Access::read;
      std::string label = slots[u];
      const std::string whole = textOf(graph, use);
      if (whole != graph.resourceNames[use.resource])
        label += (label.empty() ? "" : " ") + whole.substr(graph.resourceNames[use.resource].size());
      std::string style = "label=\"" + escaped(label) + "\"";
      if (use.history > 0) style += ", style=dashed, constraint=false";
      if (plan.attached[u] == 0) style += ", color=\"gray70\", fontcolor=\"gray55\"";
      if (use.access == Access::modify) style += ", dir=both";
      text += "  " + (reads ? resourceNode(use.resource) : passNode(p)) + " -> " +
              (reads ? passNode(p) : resourceNode(use.resource)) + " [" + style + "];\n";
    }
  if (graph.present.resource != kNone) {
    text += "  present [shape=doublecircle, label=\"present\"];\n";
    text += "  " + resourceNode(graph.present.resource) + " -> present;\n";
  }
  for (std::size_t i = 0; i < graph.outputs.size(); ++i) {
    const std::string node = "o" + std::to_string(i);
    text += "  " + node + " [shape=note, label=\"" +
            escaped(i < graph.outputNames.size() ? graph.outputNames[i] : node) + "\"];\n";
    text += "  " + resourceNode(graph.outputs[i].resource) + " -> " + node + " [style=dotted];\n";
  }
  return text + "}\n";
}

}  // namespace weft::graph
