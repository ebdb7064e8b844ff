// weft plan: the compiled plan in one of its views.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/graph/print/print.h"
#include "engine/text/json/layout.h"

namespace weft::app {

namespace {

struct PlanOptions : Options {
  std::string format = "text";
  bool explain = false;
};

std::string viewOf(const graph::Plan& plan, const PlanOptions& options) {
  if (options.format == "dot") return graph::dumpDot(plan);
  if (options.format == "json") return graph::dumpJson(plan, options.explain);
  if (options.format == "expanded")
    return text::layoutJson(graph::graphFileOf(plan),
                            {.packed = {"set"}, .starts = {"read", "write", "modify"}});
  return graph::dumpText(plan, options.explain);
}

int runPlan(PlanOptions& options) {
  text::Diagnostics diagnostics;
  if (const auto plan = planOf(options, diagnostics)) print(viewOf(*plan, options));
  return report(diagnostics);
}

}  // namespace

void addPlan(CommandLine& line) {
  const auto [plan, options] =
      line.add("plan", "print the compiled plan: order, barriers, storage, bytes", runPlan);
  options.addGraph(plan);
  addChoice(
      plan, "--format", options.format,
      "text, json, dot for Graphviz, or expanded: a graph file without includes, repeats and conditions "
      "that gives the same plan",
      {"text", "json", "dot", "expanded"});
  plan.add_flag("--explain", options.explain, "say why: passes, barrier bits, shared storage");
}

}  // namespace weft::app
