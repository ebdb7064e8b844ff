// The commands that print: check, dot, plan, bench, schema, types.
#include "app/commands.h"

#include <fmt/format.h>

#include <cstdio>

#include "app/device_session.h"
#include "app/session.h"
#include "engine/runtime/prepared_pass.h"

namespace weft::app {

namespace {

std::shared_ptr<const graph::Plan> planFor(const Options& options, base::Diagnostics& diagnostics) {
  const auto world = loadWorld(options, diagnostics);
  return makePlan(options, world ? world->facts() : runtime::WorldFacts{}, true, diagnostics);
}

// Compiles the variant of every live pass and holds it against its slots and parameters.
void checkShaders(const Options& options, const graph::Plan& plan, base::Diagnostics& diagnostics) {
  base::Diagnostics environment;
  Options headless = options;
  headless.backend = "auto";
  auto session = openDevice(headless, environment);
  if (!session) {
    diagnostics.append(environment);
    return;
  }
  runtime::Device& device = session->renderer.device();
  for (const graph::Step& step : plan.steps) {
    const graph::PassType type = device.passTypes.find(plan.graph->specs[step.pass].type)->reflect();
    if (type.shader == graph::ShaderShape::none) continue;
    const auto request = runtime::programRequestOf(*plan.graph, plan, step.pass, type);
    if (const auto variant = device.programs.get(request, diagnostics))
      runtime::checkProgram(plan, step.pass, *variant, diagnostics);
  }
}

}  // namespace

int runCheck(const Options& options) {
  base::Diagnostics diagnostics;
  const auto plan = planFor(options, diagnostics);
  if (plan && options.shaders) checkShaders(options, *plan, diagnostics);
  const int code = report(diagnostics);
  if (code == 0)
    fmt::print("{}: {} passes, {} run, {} textures share {} of {} declared bytes\n", options.graph,
               plan->graph->passes.size(), plan->steps.size(), plan->storages.size(), plan->bytesAllocated, plan->bytesDeclared);
  return code;
}

int runDot(const Options&) { return 2; }
int runPlan(const Options&) { return 2; }
int runBench(const Options&) { return 2; }
int runSchema(const Options&) { return 2; }
int runTypes(const Options&) { return 2; }

}  // namespace weft::app
