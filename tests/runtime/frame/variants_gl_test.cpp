// 1,000 random toggles of the effects of graphs/post.json through the whole renderer: nothing is compiled from source twice,
// and with the binaries on disk nothing is compiled at all.
#include <algorithm>
#include <array>
#include <random>
#include <set>

#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/prepare/program_request.h"
#include "tests/runtime/stage.h"
#include "tests/skip.h"
#include "tests/temporary_folder.h"

namespace frame_variants_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr std::size_t kCapacity = 128;  // the cache's default
constexpr int kToggles = 1000;

// What tells one variant from another: stages, defines, outputs.
std::string keyOf(const gl::ProgramRequest& request) {
  std::string key;
  for (const auto& stage : request.stages) key += stage.file + ";";
  for (const glsl::Define& define : request.defines) key += define.name + "=" + define.value + ";";
  for (const std::string& output : request.outputs) key += output + ";";
  return key;
}

// One after another, each a switch thrown at random; deterministic.
class Toggles {
 public:
  void step() {
    const auto at = static_cast<std::size_t>(random_() % (kSwitches.size() + 1));
    if (at == kSwitches.size())
      curve_ = static_cast<std::size_t>(random_() % kCurves.size());
    else
      on_[at] = !on_[at];
  }
  std::vector<weft::graph::Setting> sets() const {
    std::vector<weft::graph::Setting> all;
    for (std::size_t i = 0; i < kSwitches.size(); ++i)
      all.emplace_back(kSwitches[i], on_[i] ? "true" : "false");
    all.emplace_back("curve", kCurves[curve_]);
    return all;
  }

 private:
  static constexpr std::array kSwitches = {"post.bloom",
                                           "post.fxaa",
                                           "post.dof",
                                           "post.motion_blur",
                                           "post.auto_exposure",
                                           "aberration",
                                           "white_balance",
                                           "composite.vignette",
                                           "grain",
                                           "dither",
                                           "firefly"};
  static constexpr std::array kCurves = {"linear", "filmic", "agx"};
  std::mt19937 random_{20260101};
  std::array<bool, kSwitches.size()> on_{};
  std::size_t curve_ = 0;
};

// Adds what is asked for to `distinct`.
gl::ProgramCacheStats toggleAll(const std::string& folder, std::set<std::string>& distinct) {
  Stage stage("tests/runtime/graphs/toggle.json", 8, 8, "scenes/empty.json", folder);
  Toggles toggles;
  for (int i = 0; i < kToggles; ++i) {
    toggles.step();
    stage.settings.sets = toggles.sets();
    const bool good = i == 0 ? stage.load() : stage.apply();
    REQUIRE_MESSAGE(good, stage.diagnostics.text());
    const graph::Plan& plan = stage.execution().plan();
    for (const graph::Step& step : plan.steps) {
      const graph::PassType type =
          stage.renderer().device().passTypes.find(plan.graph->specs[step.pass].type)->reflect();
      if (type.shader != graph::ShaderShape::none)
        distinct.insert(keyOf(runtime::programRequestOf(*plan.graph, plan, step.pass, type)));
    }
  }
  stage.run();
  return stage.renderer().device().programs.stats();
}

}  // namespace

TEST_CASE("a thousand toggles: each variant is compiled once") {
  if (!context().device().hasProgramBinaries)
    return weft::test::skipCase(
        "the driver offers no program binaries; Mesa offers them with its shader cache on");
  const TemporaryFolder folder;
  for (const bool warm : {false, true}) {
    INFO((warm ? "warm" : "cold"));
    const CleanScope clean;
    std::set<std::string> distinct;
    const gl::ProgramCacheStats stats = toggleAll(folder.at("binaries"), distinct);
    MESSAGE(distinct.size() << " distinct variants, " << stats.compilations << " compiled from source, "
                            << stats.hits << " hits, " << stats.misses << " misses");
    CHECK(distinct.size() > kCapacity);  // else nothing was shown
    CHECK(stats.misses == stats.compilations + stats.binaryLoads);
    CHECK(stats.failures == 0);
    CHECK(stats.compilations == (warm ? 0 : distinct.size()));
    CHECK(stats.binaryRejects == 0);
  }
}

}  // namespace frame_variants_test
