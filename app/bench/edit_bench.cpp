#include "app/bench/edit_bench.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
#include <vector>

#include "app/live/live_graph.h"
#include "app/session/allocation_counter.h"
#include "app/session/device_session.h"
#include "app/session/session.h"

namespace weft::app {

namespace {

using graph::ParameterDesc;
using graph::Value;
using Type = ParameterDesc::Type;

constexpr int kEditRounds = 9;
constexpr double kShort = 200;  // us: what takes less is repeated within one timing
constexpr int kRepeats = 64;    // an even number: afterwards the value is what it was

double threadTime() {  // us
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

double median(std::vector<double> all) {
  if (all.empty()) return 0;
  const auto middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

struct EditCost {
  double us = 0;
  std::size_t allocations = 0;
  std::uint64_t plans = 0;
};

// A value beside `value` that the parameter takes too; none for a word or a path.
std::optional<Value> neighbourOf(const ParameterDesc& desc, Value value) {
  if (desc.type == Type::boolean) return Value::boolean(!value.truth());
  if (desc.type == Type::choice || desc.type == Type::file) return std::nullopt;
  double step = desc.type == Type::integer ? 1 : 0.01;
  if (desc.type != Type::integer && desc.min && desc.max) step = (*desc.max - *desc.min) / 128;
  for (std::size_t i = 0; i < value.count; ++i)
    value.v[i] += desc.max && value.v[i] + step > *desc.max ? -step : step;
  return value;
}

class EditBench {
 public:
  EditBench(LiveGraph& live, runtime::Renderer& renderer, base::Diagnostics& diagnostics)
      : live_(live), renderer_(renderer), diagnostics_(diagnostics) {}

  // The cost of one change, there and back again.
  EditCost measureChange(const std::string& path, const Value& now, const Value& other) {
    const auto there = [&] { set(path, other); };
    const auto back = [&] { set(path, now); };
    there();  // compiles what neither side has compiled yet
    back();
    const double once = time(there) + time(back);
    const int repeats = once < 2 * kShort ? kRepeats : 1;
    std::vector<double> times;
    for (int round = 0; round < kEditRounds; ++round) {
      const auto repeat = [&](const auto& one, const auto& two) {
        return time([&] {
                 for (int i = 0; i < repeats; ++i) i % 2 == 0 ? one() : two();
               }) /
               repeats;
      };
      times.push_back(repeat(there, back));
      if (repeats == 1) times.push_back(repeat(back, there));
    }
    EditCost cost;
    cost.us = median(std::move(times));
    count(cost, there);
    back();
    return cost;
  }

  EditCost measureSave() {
    const auto save = [this] { live_.load(diagnostics_); };
    save();
    std::vector<double> times;
    for (int round = 0; round < kEditRounds; ++round) times.push_back(time(save));
    EditCost cost;
    cost.us = median(std::move(times));
    count(cost, save);
    return cost;
  }

 private:
  void set(const std::string& path, const Value& value) { live_.setParameter(path, value, diagnostics_); }

  template <class Work>
  static double time(const Work& work) {
    glFinish();
    const double start = threadTime();
    work();
    return threadTime() - start;
  }

  template <class Work>
  void count(EditCost& cost, const Work& work) {
    const std::uint64_t before = renderer_.plansBuilt();
    const AllocationCount allocations;
    work();
    cost.allocations = allocations.taken().value_or(0);
    cost.plans = renderer_.plansBuilt() - before;
  }

  LiveGraph& live_;
  runtime::Renderer& renderer_;
  base::Diagnostics& diagnostics_;
};

double rounded(double us) {
  return std::round(us * 100) / 100;
}

}  // namespace

std::optional<std::string> benchEdits(const Options& options, base::Diagnostics& diagnostics) {
  auto world = loadWorld(options, diagnostics);
  if (!world || diagnostics.hasErrors()) return std::nullopt;
  auto session = openDevice(options, diagnostics);
  if (!session) return std::nullopt;
  runtime::Renderer& renderer = session->renderer;
  LiveGraph live(options, renderer, std::move(*world),
                 settingsOf(options, session->context->device().software));
  if (!live.load(diagnostics)) return std::nullopt;
  for (std::uint32_t frame = 0; frame < 2; ++frame)
    renderer.frame(live.world(), runtime::headlessFrame(live.world(), frame, 60), diagnostics);

  EditBench bench(live, renderer, diagnostics);
  const std::vector<graph::ParameterSpec> parameters = renderer.execution()->plan().graph->parameters;
  std::vector<double> liveTimes, toggleTimes, toggleAllocations;
  EditCost worstLive, worstToggle;
  std::string worst;
  for (const graph::ParameterSpec& parameter : parameters) {
    const auto other = neighbourOf(parameter.desc, parameter.value);
    if (!other || (parameter.structural && parameter.desc.type != Type::boolean)) continue;
    const EditCost cost = bench.measureChange(parameter.path, parameter.value, *other);
    if (diagnostics.hasErrors()) return std::nullopt;
    if (parameter.structural) {
      toggleTimes.push_back(cost.us);
      toggleAllocations.push_back(static_cast<double>(cost.allocations));
      if (cost.us > worstToggle.us) worst = parameter.path;
      worstToggle.us = std::max(worstToggle.us, cost.us);
    } else {
      liveTimes.push_back(cost.us);
      worstLive.us = std::max(worstLive.us, cost.us);
      worstLive.allocations = std::max(worstLive.allocations, cost.allocations);
      worstLive.plans = std::max(worstLive.plans, cost.plans);
    }
  }
  const EditCost save = bench.measureSave();
  if (diagnostics.hasErrors()) return std::nullopt;

  nlohmann::ordered_json out;
  out["graph"] = options.graph;
  out["device"] = session->context->device().renderer;
  out["size"] = {options.width, options.height};
  out["live_parameters"] = liveTimes.size();
  out["live_us"] = rounded(median(liveTimes));
  out["live_worst_us"] = rounded(worstLive.us);
  out["live_allocations"] = worstLive.allocations;
  out["live_plans_built"] = worstLive.plans;
  out["toggles"] = toggleTimes.size();
  out["toggle_us"] = rounded(median(toggleTimes));
  out["toggle_worst_us"] = rounded(worstToggle.us);
  out["toggle_worst"] = worst;
  out["toggle_allocations"] = median(toggleAllocations);
  out["save_us"] = rounded(save.us);
  out["save_allocations"] = save.allocations;
  return out.dump(2);
}

}  // namespace weft::app
