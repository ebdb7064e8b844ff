#include "app/bench/frame_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <limits>
#include <nlohmann/json.hpp>

#include "app/output/standard_streams.h"
#include "app/session/device_session.h"
#include "app/session/session.h"
#include "engine/graph/read/read.h"

namespace weft::app {

namespace {

constexpr int kRounds = 9;

struct Cost {
  double wall = std::numeric_limits<double>::infinity();  // ms
  double cpu = std::numeric_limits<double>::infinity();   // ms of the process, all threads
};

double cpuNow() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) * 1e3 + static_cast<double>(t.tv_nsec) * 1e-6;
}

double wallNow() {
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

template <class Work>
void measure(Cost& least, Work work) {
  glFinish();
  const double wall = wallNow(), cpu = cpuNow();
  work();
  glFinish();
  least.wall = std::min(least.wall, wallNow() - wall);
  least.cpu = std::min(least.cpu, cpuNow() - cpu);
}

// The named effects, as far as the graph has parameters that end in these names.
graph::Settings settingsWith(const Options& options, const graph::GraphDesc& desc, bool software,
                             const char* variant) {
  graph::Settings settings = settingsOf(options, software);
  if (std::string_view(variant) == "default") return settings;
  const bool all = std::string_view(variant) == "all";
  std::vector<std::string> names;
  const auto collect = [&](const auto& self, const graph::GraphDesc& each) -> void {
    for (const graph::ParameterDesc& parameter : each.parameters) names.push_back(parameter.name);
    for (const graph::PassDesc& pass : each.passes)
      if (pass.include && pass.include->graph) self(self, *pass.include->graph);
  };
  collect(collect, desc);
  for (const char* effect : {"bloom", "dof", "auto_exposure", "motion_blur", "fxaa"})
    if (std::ranges::find(names, effect) != names.end())
      settings.sets.emplace_back(effect, all || std::string_view(effect) == "fxaa" ? "true" : "false");
  return settings;
}

}  // namespace

std::optional<std::string> benchFrame(const Options& options, base::Diagnostics& diagnostics) {
  auto world = loadWorld(options, diagnostics);
  if (!world || diagnostics.hasErrors()) return std::nullopt;
  auto session = openDevice(options, diagnostics);
  if (!session) return std::nullopt;
  const bool software = session->context->device().software;
  const auto desc = graph::readGraph(options.graph, diagnostics);
  if (!desc || diagnostics.hasErrors()) return std::nullopt;

  runtime::Renderer copy(*session->context, dataFolder() + "/graphs/bench_copy.json",
                         {.dataFolder = dataFolder(), .cacheFolder = ""});
  const graph::Settings plain{
      .screenWidth = options.width, .screenHeight = options.height, .software = software};
  if (!copy.load(plain, *world, diagnostics)) return std::nullopt;
  for (std::uint32_t frame = 0; frame < 2; ++frame)
    copy.frame(*world, runtime::headlessFrame(*world, frame, 60), diagnostics);

  nlohmann::ordered_json out;
  out["graph"] = options.graph;
  out["device"] = session->context->device().renderer;
  out["size"] = {options.width, options.height};
  Cost unit;
  nlohmann::ordered_json variants = nlohmann::ordered_json::array();
  struct Row {
    Cost frame;
    double first = 0;
    std::vector<std::pair<std::string, double>> passes;
  };
  std::vector<Row> rows;
  const char* kVariants[] = {"plain", "default", "all"};
  for (const char* variant : kVariants) {
    runtime::Renderer renderer(*session->context, options.graph,
                               {.dataFolder = dataFolder(), .cacheFolder = ""});
    if (!renderer.load(settingsWith(options, *desc, software, variant), *world, diagnostics))
      return std::nullopt;
    Row row;
    Cost first;
    std::uint32_t frame = 0;
    const auto next = [&] {
      renderer.frame(*world, runtime::headlessFrame(*world, frame++, 60), diagnostics);
    };
    measure(first, next);
    row.first = first.wall;
    next();
    for (int round = 0; round < kRounds; ++round) {
      measure(unit, [&] { copy.frame(*world, runtime::headlessFrame(*world, 2, 60), diagnostics); });
      measure(row.frame, next);
    }
    gl::PassTimers& timers = renderer.device().timers;
    timers.setEnabled(true);
    for (int round = 0; round < 3; ++round) {
      next();
      timers.finish();
      const graph::Plan& plan = renderer.execution()->plan();
      if (row.passes.empty())
        row.passes.resize(plan.steps.size(), {"", std::numeric_limits<double>::infinity()});
      for (std::size_t step = 0; step < timers.results().size() && step < row.passes.size(); ++step) {
        if (!timers.results()[step].ran) continue;
        row.passes[step].first = plan.graph->passNames[plan.steps[step].pass];
        row.passes[step].second = std::min(row.passes[step].second, timers.results()[step].gpu);
      }
    }
    rows.push_back(std::move(row));
    if (diagnostics.hasErrors()) return std::nullopt;
  }
  const auto rounded = [](double x) {
    return static_cast<double>(static_cast<std::int64_t>(x * 1000 + 0.5)) / 1000;
  };
  out["copy_ms"] = rounded(unit.wall);
  if (software) out["copy_cpu_ms"] = rounded(unit.cpu);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    nlohmann::ordered_json passes = nlohmann::ordered_json::array();
    for (const auto& [name, ms] : rows[i].passes)
      if (!name.empty())
        passes.push_back({{"pass", name}, {"ms", rounded(ms)}, {"copies", rounded(ms / unit.wall)}});
    nlohmann::ordered_json row;
    row["name"] = kVariants[i];
    row["first_frame_ms"] = rounded(rows[i].first);
    row["frame_ms"] = rounded(rows[i].frame.wall);
    row["copies"] = rounded(rows[i].frame.wall / unit.wall);
    if (software) row["cpu_copies"] = rounded(rows[i].frame.cpu / unit.cpu);
    row["passes"] = std::move(passes);
    variants.push_back(std::move(row));
  }
  out["variants"] = std::move(variants);
  return dumpJson(out);
}

}  // namespace weft::app
