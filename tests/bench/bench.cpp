// `./run bench`: what frames and edits cost, as JSON. Times depend on the machine and are not judged.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <limits>

#include "app/live/live_graph.h"
#include "app/output/standard_streams.h"
#include "app/session/command_line.h"
#include "app/trials/shot.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/graph/language/names.h"
#include "engine/runtime/inspection/frame_profiler.h"

namespace weft::app {

namespace {

using graph::ParameterDesc;
using graph::Value;
using runtime::FrameProfiler;
using Json = nlohmann::ordered_json;

constexpr int kRounds = 9;

// Milliseconds: the wall's, of all threads of the process, of this thread without what it waits for on the GPU.
struct Cost {
  double wall = std::numeric_limits<double>::infinity(), process = wall, thread = wall;
};

double clockNow(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

// What `work` takes, with what it asks the GPU for.
template <class Work>
Cost measure(const Work& work) {
  glFinish();
  const double wall = gl::steadyMs(), process = clockNow(CLOCK_PROCESS_CPUTIME_ID),
               thread = clockNow(CLOCK_THREAD_CPUTIME_ID);
  work();
  const double worked = clockNow(CLOCK_THREAD_CPUTIME_ID) - thread;
  glFinish();
  return {gl::steadyMs() - wall, clockNow(CLOCK_PROCESS_CPUTIME_ID) - process, worked};
}

void keepLeast(Cost& least, const Cost& cost) {
  least.wall = std::min(least.wall, cost.wall);
  least.process = std::min(least.process, cost.process);
}

double rounded(double x, double steps) {
  return std::round(x * steps) / steps;
}

Json headOf(const Options& options, const gl::Context& context) {
  return {{"graph", options.graph},
          {"device", context.device().renderer},
          {"size", {options.width, options.height}}};
}

// ---- edits ----

// A value beside `value` that the parameter takes too; none for a word or a path.
std::optional<Value> neighborOf(const ParameterDesc& desc, Value value) {
  using Type = ParameterDesc::Type;
  if (desc.type == Type::boolean) return Value::boolean(!value.truth());
  if (desc.type == Type::choice || desc.type == Type::file) return std::nullopt;
  double step = desc.type == Type::integer ? 1 : 0.01;
  if (desc.type != Type::integer && desc.min && desc.max) step = (*desc.max - *desc.min) / 128;
  for (std::size_t i = 0; i < value.count; ++i)
    value.v[i] += desc.max && value.v[i] + step > *desc.max ? -step : step;
  return value;
}

// The median in microseconds of what the edits take, one after another; all of them together change nothing.
double timeOf(const std::vector<std::function<void()>>& edits) {
  std::vector<double> times;
  double once = 0;
  for (const auto& edit : edits) edit();  // compiles what is not compiled yet
  for (const auto& edit : edits) once += measure(edit).thread;
  const int repeats = once < 0.2 * static_cast<double>(edits.size()) ? 32 : 1;
  for (int round = 0; round < kRounds; ++round) {
    if (repeats == 1) {
      for (const auto& edit : edits) times.push_back(measure(edit).thread * 1e3);
      continue;
    }
    const Cost all = measure([&] {
      for (int i = 0; i < repeats; ++i)
        for (const auto& edit : edits) edit();
    });
    times.push_back(all.thread * 1e3 / (repeats * static_cast<double>(edits.size())));
  }
  return FrameProfiler::medianOf(times);
}

// What an edit costs until the next frame may start, as the viewer makes it (app/live/live_graph.h), in CPU time of the calling
// thread with every program cached: a live parameter, a structural boolean on and off, a save (all files of the graph are read again).
// "worst" is the largest of the medians. Empty after errors.
std::optional<Json> benchEdits(const Options& options, DeviceSession& session, runtime::World& world,
                               text::Diagnostics& diagnostics) {
  runtime::Renderer& renderer = session.renderer;
  LiveGraph live(options, renderer, std::move(world),
                 settingsOf(options, session.context->device().software));
  if (!live.load(diagnostics)) return std::nullopt;
  for (std::uint32_t frame = 0; frame < 2; ++frame)
    drawFrame(renderer, live.world(), options, frame, diagnostics);
  const std::vector<graph::ParameterSpec> parameters = renderer.execution()->plan().graph->parameters;
  std::vector<double> lives{0}, toggles{0};
  std::uint64_t livePlans = 0;
  std::string worst;
  for (const graph::ParameterSpec& parameter : parameters) {
    const auto other = neighborOf(parameter.desc, parameter.value);
    if (!other || (parameter.structural && parameter.desc.type != ParameterDesc::Type::boolean)) continue;
    const auto set = [&](const Value& value) { live.setParameter(parameter.path, value, diagnostics); };
    const std::uint64_t before = renderer.plansBuilt();
    const double us = timeOf({[&] { set(*other); }, [&] { set(parameter.value); }});
    if (diagnostics.hasErrors()) return std::nullopt;
    if (!parameter.structural) livePlans += renderer.plansBuilt() - before;
    if (parameter.structural && us > std::ranges::max(toggles)) worst = parameter.path;
    (parameter.structural ? toggles : lives).push_back(us);
  }
  const double save = timeOf({[&] { live.load(diagnostics); }});
  if (diagnostics.hasErrors()) return std::nullopt;
  const auto add = [&](Json& out, const std::string& name, std::vector<double>& all) {
    all.erase(all.begin());
    out[name + "_us"] = rounded(FrameProfiler::medianOf(all), 100);
    out[name + "_worst_us"] = rounded(all.empty() ? 0 : std::ranges::max(all), 100);
  };
  Json out = headOf(options, *session.context);
  out["live_parameters"] = lives.size() - 1;
  add(out, "live", lives);
  out["live_plans_built"] = livePlans;
  out["toggles"] = toggles.size() - 1;
  add(out, "toggle", toggles);
  out["toggle_worst"] = worst;
  out["save_us"] = rounded(save, 100);
  return out;
}

// ---- frames ----

// The named effects, as far as the graph has parameters that end in these names.
graph::Settings settingsWith(const Options& options, const graph::FlatGraph& graph, bool software,
                             std::string_view variant) {
  graph::Settings settings = settingsOf(options, software);
  for (const char* effect : {"bloom", "dof", "auto_exposure", "motion_blur", "fxaa"})
    if (variant != "default" && std::ranges::any_of(graph.parameters, [&](const graph::ParameterSpec& each) {
          return graph::hasSuffix(each.path, effect);
        }))
      settings.sets.emplace_back(effect,
                                 variant == "all" || effect == std::string_view("fxaa") ? "true" : "false");
  return settings;
}

// Costs of a graph's frame in full-screen copies (graphs/bench_copy.json), both measured in turns, so that the ratio means something on a
// busy machine: the least of all rounds; on software also in CPU time. Variants: "plain" (effects off but fxaa), "default", and "all".
std::optional<Json> benchFrame(const std::vector<std::string>& names, const Options& options,
                               DeviceSession& session, const runtime::World& world,
                               text::Diagnostics& diagnostics) {
  gl::Context& context = *session.context;
  const bool software = context.device().software;
  const auto whole = makePlan(options, world.facts(), software, diagnostics);
  if (!whole) return std::nullopt;
  const auto frameOf = [&](runtime::Renderer& renderer, std::uint32_t frame) {
    drawFrame(renderer, world, options, frame, diagnostics);
  };
  const runtime::Renderer::Options uncached{.dataFolder = dataFolder(), .cacheFolder = ""};
  runtime::Renderer copy(context, dataFolder() + "/graphs/bench_copy.json", uncached);
  if (!copy.load({.screenWidth = options.width, .screenHeight = options.height, .software = software}, world,
                 diagnostics))
    return std::nullopt;
  for (std::uint32_t frame = 0; frame < 2; ++frame) frameOf(copy, frame);
  Json out = headOf(options, context), variants = Json::array();
  Cost unit;
  std::vector<Cost> costs;
  for (const std::string& variant : names) {
    runtime::Renderer renderer(context, options.graph, uncached);
    if (!renderer.load(settingsWith(options, *whole->graph, software, variant), world, diagnostics))
      return std::nullopt;
    std::uint32_t frame = 0;
    const auto next = [&] { frameOf(renderer, frame++); };
    const Cost first = measure(next);
    next();
    Cost& least = costs.emplace_back();
    for (int round = 0; round < kRounds; ++round) {
      keepLeast(unit, measure([&] { frameOf(copy, 2); }));
      keepLeast(least, measure(next));
    }
    const std::vector<double> times = measureSteps(renderer, world, options, frame, 3, diagnostics);
    const graph::Plan& plan = renderer.execution()->plan();
    if (diagnostics.hasErrors()) return std::nullopt;
    Json row = {{"name", variant},
                {"first_frame_ms", rounded(first.wall, 1000)},
                {"frame_ms", rounded(least.wall, 1000)},
                {"passes", Json::array()}};
    for (std::size_t step = 0; step < times.size(); ++step)
      if (times[step] > 0)
        row["passes"].push_back(
            {{"pass", plan.graph->passNames[plan.steps[step].pass]}, {"ms", rounded(times[step], 1000)}});
    variants.push_back(std::move(row));
  }
  out["copy_ms"] = rounded(unit.wall, 1000);
  if (software) out["copy_cpu_ms"] = rounded(unit.process, 1000);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    variants[i]["copies"] = rounded(costs[i].wall / unit.wall, 1000);
    if (software) variants[i]["cpu_copies"] = rounded(costs[i].process / unit.process, 1000);
    for (Json& pass : variants[i]["passes"])
      pass["copies"] = rounded(pass["ms"].get<double>() / unit.wall, 1000);
  }
  out["variants"] = std::move(variants);
  return out;
}

struct BenchOptions : Options {
  std::string frameGraph, editGraph;
  std::vector<std::string> variants = {"plain", "default", "all"};
};

// Of the graphs that are named; of graphs/studio.json both, when none is.
int runBench(BenchOptions& options) {
  const bool both = options.frameGraph.empty() && options.editGraph.empty();
  if (both) options.frameGraph = options.editGraph = dataFolder() + "/graphs/studio.json";
  Json out;
  int code = 0;
  const auto run = [&](const char* name, const std::string& graph, const auto& bench) {
    if (code != 0 || graph.empty()) return;
    Options one = options;
    one.graph = graph;
    code = runOnDevice({&one}, 1, [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
      if (const auto found = bench(one, *session, world, diagnostics)) out[name] = *found;
      return 0;
    });
  };
  run("edit", options.editGraph, benchEdits);
  run("frame", options.frameGraph, std::bind_front(benchFrame, options.variants));
  if (code == 0) print(text::dumpJson(both ? out : *out.begin()) + "\n");
  return code;
}

}  // namespace

}  // namespace weft::app

int main(int argc, char** argv) {
  using namespace weft::app;
  if (argc > 1 && argv[1] == std::string_view(weft::gl::kTrialWord)) weft::gl::runTrial(argc - 1, argv + 1);
  prepareStreams();
  CommandLine line;
  const auto [command, options] = line.add("bench", "measure; prints JSON", runBench);
  addPath(command, "--frame", options.frameGraph, "graph file: its frame in full-screen copies");
  addPath(command, "--edit", options.editGraph, "graph file: what a changed parameter and a saved file cost")
      ->excludes("--frame");
  command.add_option("--variant", options.variants, "of --frame, where not all three; repeatable")
      ->check(CLI::IsMember(options.variants));
  options.addWorld(command);
  options.addBackend(command);
  return finishStreams(line.run(argc, argv));
}
