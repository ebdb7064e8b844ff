// Every pass of graphs/studio.json, and of what graphs/studio_gi.json adds, disabled, alone and in pairs, and every pass of the deferred
// graphs alone: a frame without GL messages, or a documented diagnostic. Pairs of these without GL: disable_test.cpp.
#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include "engine/gl/context/debug.h"
#include "tests/runtime/stage.h"

namespace frame_disable_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

const std::string& errorsPage() {
  static const std::string text = [] {
    std::ifstream in(sourcePath("docs/errors.md"));
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
  }();
  return text;
}

bool isDocumented(text::Code code) {
  return errorsPage().find("\n## " + text::nameOf(code)) != std::string::npos;
}

// Passes whose outputs are costly to make again come last, so that counting up leaves them alone longest.
int costOf(const std::string& pass) {
  if (pass.find("ibl.") == std::string::npos) return 0;
  return pass.find("daylight") == std::string::npos ? 2 : 1;
}

std::vector<std::string> declaredPasses(const graph::FlatGraph& graph) {
  std::vector<std::string> names;
  for (const graph::PassSpec& spec : graph.specs)
    if (std::ranges::find(names, spec.declared) == names.end()) names.push_back(spec.declared);
  std::ranges::stable_sort(names, {}, costOf);
  return names;
}

Stage smallStage(const std::string& graph, const std::string& scene = "scenes/spheres.json") {
  return Stage(graph, 48, 27, scene, "", {sourcePath("tests/small_maps.json")});
}

struct Outcome {
  std::size_t pictures = 0, refusals = 0;
  std::map<std::string, std::size_t> codes;
};

void tryWithout(Stage& stage, std::vector<std::string> disables, Outcome& outcome) {
  std::string label = "without";
  for (const std::string& name : disables) label += " " + name;
  INFO(label);
  stage.settings.disables = {disables.begin(), disables.end()};
  if (stage.load()) {
    CHECK_MESSAGE(!stage.diagnostics.hasErrors(), stage.diagnostics.text());
    stage.run();
    CHECK(gl::takeErrors() == "");
    CHECK(!stage.pixels().empty());
    ++outcome.pictures;
    return;
  }
  ++outcome.refusals;
  CHECK(stage.diagnostics.hasErrors());
  for (const text::Diagnostic& each : stage.diagnostics.items()) {
    ++outcome.codes[text::nameOf(each.code)];
    CHECK_MESSAGE(isDocumented(each.code), "docs/errors.md lacks " << text::nameOf(each.code));
    if (each.severity != text::Severity::error) continue;
    const std::uint32_t line = each.place.line;
    CHECK_MESSAGE(line > 0, text::format(each));
    CHECK_MESSAGE(!each.hint.empty(), "no fix: " << text::format(each));
  }
}

// `of`: passes whose name begins so, and pairs with one of them. More than one try in `share` gives a picture; 0: in three with
// pairs, else in two.
void tryAll(Stage& stage, bool pairs, std::string_view of = {}, int share = 0) {
  stage.settings.disables = {};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const std::vector<std::string> names = declaredPasses(*stage.execution().plan().graph);
  CHECK(names.size() >= 12);
  Outcome outcome;
  for (std::size_t b = 0; b < names.size(); ++b) {
    if (pairs || names[b].starts_with(of)) tryWithout(stage, {names[b]}, outcome);
    for (std::size_t a = 0; pairs && a < b; ++a)
      if (names[a].starts_with(of) || names[b].starts_with(of))
        tryWithout(stage, {names[a], names[b]}, outcome);
  }
  std::string codes;
  for (const auto& [code, count] : outcome.codes) codes += " " + code + " x " + std::to_string(count);
  MESSAGE(names.size() << " passes: " << outcome.pictures << " pictures, " << outcome.refusals
                       << " refusals:" << codes);
  CHECK(outcome.pictures > (outcome.pictures + outcome.refusals) / (share > 0 ? share : pairs ? 3 : 2));
}

}  // namespace

TEST_CASE("disable: every pass of studio alone and in pairs, with the daylight environment") {
  const CleanScope clean;
  Stage stage = smallStage("graphs/studio.json");
  tryAll(stage, true);
}

TEST_CASE("disable: every pass of studio alone, with a loaded environment") {
  const CleanScope clean;
  Stage stage = smallStage("graphs/studio.json");
  auto image = std::make_shared<assets::ImageF>(assets::ImageF{64, 32, 4, {}});
  image->texels.assign(64 * 32 * 4, 0.5f);
  stage.world.setEnvironment(
      std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(*image)));
  tryAll(stage, false);
}

TEST_CASE("disable: every pass of studio_gi alone, and the probes' with every other") {
  const CleanScope clean;
  Stage stage = smallStage("graphs/studio_gi.json");
  stage.settings.sets = {{"probes_debug", "true"}};
  tryAll(stage, true, "gi.", 4);  // two of four stanzas make the probes, which nothing else does: refused
}

TEST_CASE(
    "disable: every pass of studio alone, where spheres hide light from each other and stand on a ground") {
  const CleanScope clean;
  Stage stage = smallStage("graphs/studio.json", "tests/runtime/scenes/everything.json");
  stage.settings.sets = {{"occlusion", "true"}};
  tryAll(stage, false);
}

TEST_CASE("disable: every pass of deferred alone, with meshes, glass, spheres, a sun and lamps") {
  const CleanScope clean;
  Stage stage = smallStage("graphs/deferred.json", "tests/runtime/scenes/everything.json");
  stage.settings.sets = {
      {"shadow_texels", "256"}, {"lamp_texels", "64"}, {"bayer", "true"}, {"motion_blur", "true"}};
  tryAll(stage, false);
}

TEST_CASE("disable: every pass of the probes of deferred_gi alone") {
  const CleanScope clean;
  Stage stage = smallStage("graphs/deferred_gi.json", "tests/runtime/scenes/everything.json");
  stage.settings.sets = {{"shadow_texels", "256"}, {"lamp_texels", "64"}, {"probes_debug", "true"}};
  tryAll(stage, false, "gi", 4);  // as above
}

}  // namespace frame_disable_test
