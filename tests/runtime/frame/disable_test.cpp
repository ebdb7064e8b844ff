// Every pass of the deferred graphs, of those with light probes and of the studio with all that spheres do disabled, alone and in pairs, without GL: a plan, or documented
// diagnostics that say where and what to do. tests/runtime/frame/disable_gl_test.cpp renders them.
#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/imports/world.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/scene/files/scene_file.h"

using namespace weft;

namespace {

const std::string kTop = std::string(WEFT_SOURCE_DIR) + "/";

std::string errorsPage() {
  std::ifstream in(kTop + "docs/errors.md");
  std::stringstream all;
  all << in.rdbuf();
  return all.str();
}

class Bench {
 public:
  Bench(const std::string& graph, std::vector<graph::Setting> sets) : page_(errorsPage()) {
    text::Diagnostics diagnostics;
    auto scene = scene::loadScene(kTop + "tests/runtime/scenes/everything.json", diagnostics);
    REQUIRE_MESSAGE(scene.has_value(), diagnostics.text());
    registry_ = runtime::makeRegistry({}, imports::World(std::move(*scene)).facts());
    desc_ = graph::readGraph(kTop + graph, diagnostics);
    REQUIRE_MESSAGE(desc_, diagnostics.text());
    settings_.software = true;
    settings_.sets = std::move(sets);
    const auto flat = graph::expandGraph(*desc_, registry_, settings_, diagnostics);
    REQUIRE_MESSAGE(flat, diagnostics.text());
    for (const graph::PassSpec& spec : flat->specs)
      if (std::ranges::find(names_, spec.declared) == names_.end()) names_.push_back(spec.declared);
  }

  const std::vector<std::string>& names() const { return names_; }

  void tryWithout(std::vector<std::string> disables) {
    std::string label = "without";
    for (const std::string& name : disables) label += " " + name;
    INFO(label);
    settings_.disables = {disables.begin(), disables.end()};
    text::Diagnostics diagnostics;
    const auto flat = graph::expandGraph(*desc_, registry_, settings_, diagnostics);
    for (const text::Diagnostic& each : diagnostics.items()) {
      ++codes[text::nameOf(each.code)];
      CHECK_MESSAGE(page_.find("\n## " + text::nameOf(each.code)) != std::string::npos, text::format(each));
      if (each.severity != text::Severity::error) continue;
      CHECK_MESSAGE(each.place.line > 0, text::format(each));
      CHECK_MESSAGE(!each.hint.empty(), "no fix: " << text::format(each));
    }
    if (!flat || diagnostics.hasErrors()) {
      CHECK(diagnostics.hasErrors());
      ++refusals;
      return;
    }
    const graph::Plan plan = graph::compile(flat);
    for (const graph::Step& step : plan.steps)
      for (const std::string& name : disables) CHECK(flat->specs[step.pass].declared != name);
    ++plans;
    steps += plan.steps.size();
  }

  std::map<std::string, std::size_t> codes;
  std::size_t plans = 0, refusals = 0, steps = 0;

 private:
  std::string page_;
  graph::Registry registry_;
  std::shared_ptr<const graph::GraphDesc> desc_;
  graph::Settings settings_;
  std::vector<std::string> names_;
};

void tryAll(const std::string& graph, std::vector<graph::Setting> sets, std::size_t least) {
  CAPTURE(graph);
  Bench bench(graph, std::move(sets));
  const std::vector<std::string>& names = bench.names();
  CHECK(names.size() >= least);
  for (std::size_t b = 0; b < names.size(); ++b) {
    bench.tryWithout({names[b]});
    for (std::size_t a = 0; a < b; ++a) bench.tryWithout({names[a], names[b]});
  }
  std::string codes;
  for (const auto& [code, count] : bench.codes) codes += " " + code + " x " + std::to_string(count);
  MESSAGE(graph << ": " << names.size() << " passes, " << bench.plans << " plans, " << bench.refusals
                << " refusals:" << codes);
  CHECK(bench.plans + bench.refusals == names.size() * (names.size() + 1) / 2);
}

}  // namespace

TEST_CASE(
    "disable: every pass of the deferred graphs, of those with probes and of the studio, alone and in "
    "pairs") {
  tryAll("graphs/deferred.json", {}, 25);
  tryAll("graphs/deferred.json",
         {{"ao_method", "hemisphere"}, {"store_positions", "true"}, {"bayer", "true"}}, 25);
  tryAll("graphs/deferred_gi.json", {{"probes_debug", "true"}}, 32);
  tryAll("graphs/studio_gi.json", {{"probes_debug", "true"}}, 20);
  tryAll("graphs/studio.json", {{"occlusion", "true"}}, 24);
  tryAll("graphs/gi.json", {}, 3);
}
