// The commands that print: check, dot, plan, bench, schema, types.
#include "app/commands/commands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/bench/edit_bench.h"
#include "app/bench/frame_bench.h"
#include "app/bench/task_bench.h"
#include "app/bench/workload_bench.h"
#include "app/session/device_session.h"
#include "app/session/session.h"
#include "app/session/standard_streams.h"
#include "engine/base/printable.h"
#include "engine/graph/language/enough.h"
#include "engine/graph/language/schema.h"
#include "engine/graph/print/dot.h"
#include "engine/graph/print/json.h"
#include "engine/graph/print/text.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/imports/registry.h"
#include "engine/runtime/prepare/program_check.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app {

namespace {

std::shared_ptr<const graph::Plan> planFor(const Options& options, base::Diagnostics& diagnostics) {
  const auto world = loadWorld(options, diagnostics);
  return makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
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
    const std::uint32_t combinations = 1u << runtime::conditionCount(plan.graph->specs[step.pass]);
    for (std::uint32_t conditions = 0; conditions < combinations; ++conditions) {
      const auto request = runtime::programRequestOf(*plan.graph, plan, step.pass, type, conditions);
      const auto variant = device.programs.get(request, diagnostics);
      if (!variant ||
          !runtime::checkProgram(plan, step.pass, *variant, session->context->device().limits, diagnostics))
        break;
    }
  }
}

// A graph that cannot be compiled has no variants; its shader files are read all the same, so that a misspelt
// path or include is reported together with the graph's own mistakes. Needs no OpenGL.
void checkShaderFiles(const Options& options, const graph::GraphDesc& desc, gl::SourceLoader& sources,
                      base::Diagnostics& diagnostics) {
  const passes::PassRegistry types = passes::PassRegistry::builtin();
  for (const graph::PassDesc& pass : desc.passes) {
    if (graph::enoughErrors(diagnostics)) return;
    if (pass.include && pass.include->graph)
      checkShaderFiles(options, *pass.include->graph, sources, diagnostics);
    const passes::PassType* type = pass.shader.empty() ? nullptr : types.find(pass.type);
    if (!type) continue;
    std::vector<std::string> files = {pass.shader};
    if (!pass.vertexShader.empty())
      files.push_back(pass.vertexShader);
    else if (type->reflect().shader == graph::ShaderShape::draw)
      files = {pass.shader + ".vert.glsl", pass.shader + ".frag.glsl"};
    for (const std::string& file : files) sources.load(file, diagnostics, pass.shaderPlace);
  }
}

}  // namespace

int runCheck(const Options& options) {
  base::Diagnostics diagnostics;
  const auto plan = planFor(options, diagnostics);
  if (plan && options.shaders) checkShaders(options, *plan, diagnostics);
  base::Diagnostics again;
  // Beyond a limit nothing that follows can be trusted, and there may be very much of it.
  const bool over = diagnostics.contains(base::Code::limitExceeded);
  if (const auto desc = plan || over ? nullptr : graph::readGraph(options.graph, options.presets, again)) {
    gl::SourceLoader sources(runtime::shaderRootsOf(options.graph, dataFolder()));
    checkShaderFiles(options, *desc, sources, diagnostics);
  }
  const int code = report(diagnostics);
  if (code == 0)
    print(fmt::format("{}: {} passes, {} run, {} textures share {} of {} declared bytes\n",
                      base::printable(options.graph), plan->graph->passes.size(), plan->steps.size(),
                      plan->storages.size(), plan->bytesAllocated, plan->bytesDeclared));
  return code;
}

int runDot(const Options& options) {
  if (options.tasks) return runTaskDot(options);
  base::Diagnostics diagnostics;
  if (const auto plan = planFor(options, diagnostics)) print(graph::dumpDot(*plan));
  return report(diagnostics);
}

int runPlan(const Options& options) {
  base::Diagnostics diagnostics;
  if (const auto plan = planFor(options, diagnostics))
    print(options.format == "json" ? graph::dumpJson(*plan, options.explain)
                                   : graph::dumpText(*plan, options.explain));
  return report(diagnostics);
}

int runBench(const Options& options) {
  base::Diagnostics diagnostics;
  if (!options.frameGraph.empty()) {
    Options frame = options;
    frame.graph = options.frameGraph;
    const auto text = benchFrame(frame, diagnostics);
    if (text) print(*text + "\n");
    return report(diagnostics);
  }
  if (!options.editGraph.empty()) {
    Options edit = options;
    edit.graph = options.editGraph;
    const auto text = benchEdits(edit, diagnostics);
    if (text) print(*text + "\n");
    return report(diagnostics);
  }
  if (options.tasks) {
    const auto text = benchTasks(options, diagnostics);
    if (text) print(*text + "\n");
    return report(diagnostics);
  }
  WorkloadBenchOptions wanted;
  wanted.files = options.workloads;
  const auto text = options.workloads.size() == 1 ? benchWorkload(options.workloads[0], diagnostics)
                                                  : benchWorkloads(wanted, diagnostics);
  if (text) print(*text + "\n");
  return report(diagnostics);
}

int runSchema(const Options&) {
  print(graph::graphSchema());
  return 0;
}

// What a graph may name, from the registry itself.
int runTypes(const Options&) {
  const graph::Registry registry = runtime::makeRegistry({}, {});
  print("pass types\n");
  for (const graph::PassType& type : registry.passTypes) {
    print(fmt::format("  {}\n    {}\n", type.name, type.doc));
    if (!type.keys.empty()) print(fmt::format("    keys: {}\n", fmt::join(type.keys, ", ")));
    for (const graph::FixedSlot& slot : type.fixedSlots)
      print(fmt::format("    slot {}: {}\n", slot.name, slot.doc));
  }
  print("\nimports\n");
  for (const graph::ImportType& type : registry.imports) {
    print(fmt::format("  @{}\n    {}\n", type.name, type.doc));
    for (const graph::ImportArgument& argument : type.arguments)
      print(fmt::format("    {} (default {}): {}\n", argument.name, graph::toText(argument.initial),
                        argument.doc));
    for (const graph::TableColumn& column : type.columns)
      print(fmt::format("    .{} {}{}{}\n", column.name, column.type, column.doc.empty() ? "" : ": ",
                        column.doc));
  }
  return 0;
}

}  // namespace weft::app
