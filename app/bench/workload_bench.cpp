#include "app/bench/workload_bench.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/base/files/text_file.h"
#include "engine/base/printable.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/compile/scratch.h"
#include "engine/graph/plan.h"
#include "engine/graph/workload/link_flat.h"
#include "engine/graph/workload/neutral.h"

namespace weft::app {

namespace {

using nlohmann::ordered_json;

double threadTime() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

// The median of `repetitions` runs, in nanoseconds of this thread.
template <class F>
double medianTime(int repetitions, F&& f) {
  std::vector<double> times;
  for (int i = 0; i < std::max(1, repetitions); ++i) {
    const double start = threadTime();
    f();
    times.push_back(threadTime() - start);
  }
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  return times[times.size() / 2];
}

// One form of one workload. nullopt after errors.
std::optional<ordered_json> measure(const std::string& text, const std::string& name, bool compute,
                                    int repetitions, base::Diagnostics& diagnostics) {
  const graph::NeutralOptions neutral{.everySecondCompute = compute};
  std::optional<graph::FlatGraph> read = graph::readNeutral(text, name, neutral, diagnostics);
  if (!read || !graph::linkFlat(*read, diagnostics)) return std::nullopt;
  const auto flat = std::make_shared<graph::FlatGraph>(std::move(*read));
  const auto passes = static_cast<double>(std::max<std::size_t>(1, flat->passes.size()));

  const int heavy = std::max(3, repetitions / 3);
  const double readTime = medianTime(heavy, [&] {
    base::Diagnostics ignored;
    graph::readNeutral(text, name, neutral, ignored);
  });
  const double linkTime = medianTime(heavy, [&] {
    base::Diagnostics ignored;
    graph::linkFlat(*flat, ignored);
  });
  graph::CompileScratch scratch;
  graph::Plan plan;
  // Short workloads repeat within one timing, so that the clock's own cost does not show.
  const int inner = static_cast<int>(std::max(1.0, 20000 / passes));
  const double compileTime = medianTime(repetitions,
                                        [&] {
                                          for (int i = 0; i < inner; ++i)
                                            plan = graph::compile(flat, {}, scratch);
                                        }) /
                             inner;

  std::size_t barriers = 0, bits = 0;
  const auto count = [&](unsigned mask) {
    barriers += mask != 0 ? 1 : 0;
    for (; mask != 0; mask &= mask - 1) ++bits;
  };
  for (const graph::Step& step : plan.steps) {
    count(step.barriers);
    count(step.barriersAfterClears);
  }
  count(plan.finalBarriers);
  const auto perPass = [&](double time) { return std::round(time / passes * 10) / 10; };
  return ordered_json{{"passes", flat->passes.size()},
                      {"passes_kept", plan.steps.size()},
                      {"uses", flat->uses.size()},
                      {"read_ns_per_pass", perPass(readTime)},
                      {"validate_ns_per_pass", perPass(linkTime)},
                      {"compile_ns_per_pass", perPass(compileTime)},
                      {"barriers", barriers},
                      {"barrier_bits", bits},
                      {"bytes_declared", plan.bytesDeclared},
                      {"bytes_allocated", plan.bytesAllocated},
                      {"bytes_lower_bound", plan.bytesLowerBound}};
}

std::optional<ordered_json> measureText(const std::string& text, const std::string& name, int repetitions,
                                        base::Diagnostics& diagnostics) {
  auto plain = measure(text, name, false, repetitions, diagnostics);
  if (!plain) return std::nullopt;
  auto compute = measure(text, name, true, repetitions, diagnostics);
  if (!compute) return std::nullopt;
  const double parse = medianTime(std::max(3, repetitions / 3), [&] {
    const auto document = nlohmann::json::parse(text, nullptr, false);
    if (document.is_discarded()) std::abort();  // readNeutral took it
  });
  ordered_json result{{"name", name}};
  result.update(*plain);
  result["nlohmann_parse_ns_per_pass"] =
      std::round(parse / static_cast<double>(std::max<std::size_t>(1, (*plain)["passes"])) * 10) / 10;
  result["compute"] = *compute;
  return result;
}

// A file's name may be no UTF-8.
std::string dumped(const ordered_json& json) {
  return base::printableJson(json.dump(2, ' ', false, ordered_json::error_handler_t::replace)) + "\n";
}

}  // namespace

std::optional<std::string> benchWorkloads(const WorkloadBenchOptions& options,
                                          base::Diagnostics& diagnostics) {
  ordered_json workloads = ordered_json::array();
  for (const std::string& file : options.files) {
    const auto text = base::readTextFile(file, diagnostics);
    if (!text) return std::nullopt;
    auto result = measureText(*text, file, options.repetitions, diagnostics);
    if (!result) return std::nullopt;
    (*result)["name"] = std::filesystem::path(file).stem().string();
    workloads.push_back(std::move(*result));
  }
  std::vector<std::pair<double, double>> growth, growthCompute;  // passes, nanoseconds
  for (const std::size_t passes : options.generated) {
    const std::string text = graph::neutralText(graph::NeutralShape::layered, passes);
    auto result =
        measureText(text, "layered_generated_" + std::to_string(passes), options.repetitions, diagnostics);
    if (!result) return std::nullopt;
    const auto n = static_cast<double>(passes);
    growth.emplace_back(n, n * (*result)["compile_ns_per_pass"].get<double>());
    growthCompute.emplace_back(n, n * (*result)["compute"]["compile_ns_per_pass"].get<double>());
    workloads.push_back(std::move(*result));
  }
  if (options.files.size() == 1 && options.generated.empty()) return dumped(workloads[0]);
  ordered_json all{{"workloads", workloads}};
  const auto exponent = [](std::vector<std::pair<double, double>> points) {
    const auto [low, high] = std::minmax_element(points.begin(), points.end());
    return std::round(std::log(high->second / low->second) / std::log(high->first / low->first) * 1000) /
           1000;
  };
  if (growth.size() > 1) {
    all["growth"] = exponent(growth);
    all["growth_compute"] = exponent(growthCompute);
  }
  return dumped(all);
}

std::optional<std::string> benchWorkload(const std::string& path, base::Diagnostics& diagnostics) {
  WorkloadBenchOptions options;
  options.files = {path};
  options.generated.clear();
  return benchWorkloads(options, diagnostics);
}

}  // namespace weft::app
