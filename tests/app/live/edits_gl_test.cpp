// Random edits of a running graph and as many undos: every file is byte for byte what it was, and plan and parameters are the same. What
// undo took back, redo makes again. WEFT_EDITS: how many of each graph (default: 400, and 80 of graphs of many passes). And files that are
// opened and refused.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <thread>

#include "app/live/live_graph.h"
#include "engine/graph/print/print.h"
#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace {

using namespace weft;
using namespace weft::runtime::test;
namespace fs = std::filesystem;

constexpr std::uint32_t kWidth = 32, kHeight = 18;

std::map<std::string, std::string> filesIn(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& each : fs::recursive_directory_iterator(folder))
    if (each.is_regular_file()) {
      std::ifstream in(each.path(), std::ios::binary);
      files[each.path().string()] = {std::istreambuf_iterator<char>(in), {}};
    }
  return files;
}

// A person at the panels, who does one thing after another.
class Editor {
 public:
  Editor(app::LiveGraph& live, runtime::Renderer& renderer, std::uint32_t seed)
      : live_(live), renderer_(renderer), random_(seed) {}

  int edits = 0, writes = 0;

  // False when the program refused it; then nothing may have changed.
  bool edit() {
    const std::size_t dice = below(100);
    text::Diagnostics said;
    if (dice < 55) return setParameter(said);
    if (dice < 80) return setPass(said);
    if (dice < 88) return write(said);
    return dice < 95 ? live_.undo(said) : live_.redo(said);
  }

 private:
  std::size_t below(std::size_t count) { return random_() % count; }

  bool setParameter(text::Diagnostics& said) {
    const auto parameters = renderer_.execution()->plan().graph->parameters;
    if (parameters.empty()) return false;
    const graph::ParameterSpec& chosen = parameters[below(parameters.size())];
    const graph::ParameterDesc& desc = chosen.desc;
    graph::Value value = chosen.value;
    if (desc.type == graph::ParameterDesc::Type::boolean) {
      value = graph::Value::boolean(!value.truth());
    } else if (desc.type == graph::ParameterDesc::Type::choice) {
      value = graph::Value::text(desc.choices[below(desc.choices.size())]);
    } else if (desc.type != graph::ParameterDesc::Type::file) {
      const double low = desc.min.value_or(0), high = desc.max.value_or(low + 4);
      for (std::size_t i = 0; i < value.count; ++i)
        value.v[i] = std::floor(low + (high - low) * static_cast<double>(below(1000)) / 999);
    }
    live_.endChange();
    return live_.setParameter(chosen.path, value, said);
  }

  bool setPass(text::Diagnostics& said) {
    std::vector<std::string> names;
    graph::eachPass(*renderer_.desc(),
                    [&](const std::string& name, const graph::PassDesc&) { names.push_back(name); });
    return live_.setEnabled(names[below(names.size())], below(2) == 0, said);
  }

  bool write(text::Diagnostics& said) {
    const auto plan = live_.planWrites(said);
    if (!plan || plan->files.empty()) return false;
    ++writes;
    return live_.write(*plan, said);
  }

  app::LiveGraph& live_;
  runtime::Renderer& renderer_;
  std::mt19937 random_;
};

void checkEdits(const std::string& file, int edits, std::uint32_t seed) {
  CAPTURE(file);
  const CleanScope clean;
  const TemporaryFolder folder;
  fs::copy(sourcePath("graphs"), folder.at("graphs"), fs::copy_options::recursive);
  fs::create_directory(folder.at("docs"));
  app::Options options{.graph = folder.at("graphs/" + file), .width = kWidth, .height = kHeight};
  options.presetFolder = folder.at("presets");
  runtime::Renderer renderer(context(), options.graph,
                             {.dataFolder = WEFT_SOURCE_DIR, .cacheFolder = {}, .presets = {}});
  app::LiveGraph live(options, renderer, worldOf(),
                      {.screenWidth = kWidth, .screenHeight = kHeight, .software = true});
  text::Diagnostics said;
  REQUIRE_MESSAGE(live.load(said), said.text());
  const auto state = [&] {
    std::string text = graph::dumpText(renderer.execution()->plan());
    for (const graph::Value& value : renderer.execution()->uniforms().parameters())
      text += graph::toText(value) + "\n";
    return text;
  };
  const auto files = filesIn(folder.path());
  const std::string first = state();
  Editor editor(live, renderer, seed);
  int done = 0;
  for (int i = 0; i < edits; ++i) done += editor.edit() ? 1 : 0;
  const auto changed = filesIn(folder.path());
  const std::string last = state();
  int undone = 0;
  while (live.canUndo()) {
    REQUIRE_MESSAGE(live.undo(said), said.text());
    ++undone;
  }
  MESSAGE(file << ": " << edits << " edits, " << done << " accepted, " << editor.writes
               << " written into files, " << undone << " undone");
  CHECK(undone > edits / 4);
  CHECK(editor.writes > 0);
  CHECK(changed != files);
  CHECK(filesIn(folder.path()) == files);
  CHECK(state() == first);
  for (int i = 0; i < undone; ++i) REQUIRE_MESSAGE(live.redo(said), said.text());
  CHECK(filesIn(folder.path()) == changed);
  CHECK(state() == last);
}

}  // namespace

TEST_CASE("random edits and as many undos leave every file as it was") {
  const char* wanted = std::getenv("WEFT_EDITS");
  const int all = wanted ? std::atoi(wanted) : 400;
  checkEdits("glow.json", all, 1);
  checkEdits("studio.json", wanted ? all : all / 5, 2);
  checkEdits("deferred_gi.json", wanted ? all : all / 5, 3);
}

TEST_CASE("a scene or an environment that is opened and refused leaves what is shown, and good") {
  const CleanScope clean;
  const TemporaryFolder folder;
  fs::copy(sourcePath("graphs"), folder.at("graphs"), fs::copy_options::recursive);
  const app::Options options{.graph = folder.at("graphs/glow.json"), .width = kWidth, .height = kHeight};
  runtime::Renderer renderer(context(), options.graph,
                             {.dataFolder = WEFT_SOURCE_DIR, .cacheFolder = {}, .presets = {}});
  app::LiveGraph live(options, renderer, worldOf(),
                      {.screenWidth = kWidth, .screenHeight = kHeight, .software = true});
  text::Diagnostics said;
  REQUIRE_MESSAGE(live.load(said), said.text());
  double now = 0;
  const auto until = [&](const auto& holds) {
    for (int i = 0; i < 60000 && !holds(); ++i) {
      live.poll(++now, said);
      live.pollEnvironment(said);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return holds();
  };
  const auto refused = [&] { return until([&] { return said.hasErrors(); }); };

  const std::string scene = live.scene().path();
  for (const char* missing : {"no.hdr", "no.glb", "no.json"}) {
    said = {};
    CHECK_FALSE(live.open(folder.at(missing), said));
    CHECK(said.hasErrors());
    CHECK(live.good());
  }
  for (const auto& [name, text] :
       {std::pair("no_model.glb", "7"), std::pair("no_scene.json", "{ \"spheres\": 7 }")}) {
    CAPTURE(name);
    said = {};
    CHECK(live.open(folder.write(name, text), said));
    CHECK(refused());
    CHECK(live.scene().path() == scene);
    CHECK(until([&] { return live.good() && !live.scene().outdated(); }));
    const std::uint64_t switches = live.switches();
    std::ofstream(options.graph, std::ios::app) << "\n";
    CHECK(until([&] { return live.switches() > switches; }));  // files are followed as before
  }

  const std::string map = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n" + std::string(32, 'a');
  const auto open = [&](const std::string& name, const std::string& text) {
    said = {};
    CHECK(live.open(folder.write(name, text), said));
    CHECK(until([&] { return !live.environment().loading(); }));
  };
  open("no_map.hdr", "7");
  CHECK(said.hasErrors());
  CHECK(live.good());
  open("map.hdr", map);
  CHECK_MESSAGE(said.empty(), said.text());
  CHECK(live.environment().shown() == folder.at("map.hdr"));
  open("no_other.hdr", "7");
  CHECK(said.hasErrors());
  CHECK(live.good());
  open("other.hdr", map);
  folder.write("other.hdr", "7");  // what is shown is not good any more
  CHECK(until([&] { return !live.good(); }));
  open("no_third.hdr", "7");
  CHECK_FALSE(live.good());
}
