// The judge of toggles. In a running Renderer something is changed and changed back: a pass or an include is switched off, a
// boolean is turned, a preset is chosen, a line of the file is removed, another environment comes, the picture gets another
// size. Each time the settled picture must be, byte for byte, that of a fresh start with the same files and settings.
//
// Settled: frames of 0.1 s pass until no pass that is not `always` has run in five of them, which also ends every fade. Then come a
// cut and kJudged frames with numbers and times that the fresh start has, too; the last one is held against it. The cut is
// for effects that accumulate (temporal anti-aliasing, exposure): their histories begin there.
//
// A sample with a fixed seed runs by default; WEFT_TOGGLES=all runs everything, WEFT_TOGGLES=NAME all of one graph.
#include <algorithm>
#include <cstdlib>
#include <map>
#include <optional>
#include <random>
#include <set>

#include "tests/runtime/stage.h"
#include "tests/temporary_folder.h"

namespace frame_toggles_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr std::uint32_t kWidth = 48, kHeight = 27;
constexpr int kJudged = 3, kMaxFrames = 400;
constexpr double kTogglesStep = 0.1;  // seconds
constexpr std::size_t kSample = 14;   // toggles of each graph

using Picture = std::vector<std::uint8_t>;
using Environment = std::shared_ptr<const assets::EnvironmentMap>;

Environment togglesMap(std::uint32_t width, std::uint16_t base) {
  auto map = std::make_shared<assets::EnvironmentMap>();
  map->width = width;
  map->height = width / 2;
  for (std::uint32_t i = 0; i < width * width * 2; ++i)
    map->texels.push_back(i % 4 == 3 ? 0x3c00
                                     : static_cast<std::uint16_t>(base + (i / 16 * 2654435761u) % 0x0400));
  return map;
}

// What a person can change.
struct State {
  std::string file;  // what stands in the opened file
  std::vector<graph::Setting> sets;
  std::vector<graph::Disable> disables;
  int environment = 0;  // 0: none
  std::uint32_t width = kWidth, height = kHeight;
  // The same text: the same picture.
  std::string key() const {
    std::string text = file + "|" + std::to_string(environment) + "|" + std::to_string(width);
    for (const graph::Setting& set : sets) text += "|" + set.name + "=" + graph::toText(set.value) + set.text;
    for (const graph::Disable& disable : disables) text += "|" + disable.name;
    return text;
  }
};

class Subject {
 public:
  Subject(const TemporaryFolder& folder, const std::string& scene)
      : folder_(folder), path_(folder.at("opened.json")), stage_(path_, kWidth, kHeight, scene) {}

  // False when the state is refused; what ran before goes on.
  bool change(const State& state, bool reread) {
    stage_.settings.sets = state.sets;
    stage_.settings.disables = state.disables;
    stage_.settings.screenWidth = state.width;
    stage_.settings.screenHeight = state.height;
    if (state.environment != environment_) stage_.world.setEnvironment(mapOf(state.environment));
    environment_ = state.environment;
    if (!reread && state.file == file_) return stage_.apply();
    folder_.write("opened.json", state.file);
    file_ = state.file;
    return stage_.load();
  }
  // One frame of the window. How many passes ran that are not `always`.
  std::uint32_t frame() { return run(number_ + 1, time_ + kTogglesStep); }
  bool settle() {
    int quiet = 0;
    for (int n = 0; n < kMaxFrames && quiet < 5; ++n) quiet = frame() == 0 ? quiet + 1 : 0;
    return quiet == 5;
  }
  Picture judge(std::uint32_t number, double time) {
    ++cut_;
    for (int n = 0; n < kJudged; ++n) run(number + static_cast<std::uint32_t>(n), time + n * kTogglesStep);
    return stage_.pixels();
  }
  Stage& stage() { return stage_; }

 private:
  Environment mapOf(int environment) {
    static const Environment kMaps[] = {nullptr, togglesMap(64, 0x3800), togglesMap(128, 0x3400)};
    return kMaps[environment];
  }
  std::uint32_t run(std::uint32_t number, double time) {
    runtime::FrameInput input = runtime::headlessFrame(stage_.world, 0, 60);
    input.headless = false;
    input.frame = number_ = number;
    input.time = time_ = time;
    input.deltaTime = kTogglesStep;
    input.cutGeneration = cut_;
    stage_.diagnostics.clear();
    const runtime::FrameReport report = stage_.renderer().frame(stage_.world, input, stage_.diagnostics);
    return report.slowRun;
  }
  const TemporaryFolder& folder_;
  std::string path_, file_;
  Stage stage_;
  int environment_ = 0;
  std::uint32_t number_ = 0;
  double time_ = 0;
  std::uint64_t cut_ = 1;
};

struct Toggle {
  std::string name;
  State off;
};

std::string overlay(const std::string& graph, const std::string& rest = "", const std::string& preset = "") {
  std::string below = "\"" + withSmallMaps("graphs/" + graph) + "\"";
  if (!preset.empty()) below = "[" + below + ", \"" + withSmallMaps("graphs/presets/" + preset) + "\"]";
  return "{ \"extends\": " + below + rest + " }";
}

class Judge {
 public:
  explicit Judge(std::string graph) : graph_(std::move(graph)) {}

  // The differences found, a line each.
  std::vector<std::string> found;
  std::size_t tried = 0, refused = 0;

  void run(const State& base, const std::string& variant, bool fading, std::size_t most, std::uint32_t seed) {
    Subject subject(folder_, "scenes/spheres.json");
    REQUIRE_MESSAGE(subject.change(base, true), graph_ << "\n" << subject.stage().diagnostics.text());
    subject.settle();
    std::vector<Toggle> toggles = togglesOf(base, subject);
    if (most < toggles.size()) {
      std::mt19937 random(seed);
      std::shuffle(toggles.begin(), toggles.end(), random);
      toggles.resize(most);
    }
    int other = base.environment;
    for (const Toggle& toggle : toggles) {
      State on = base, off = toggle.off;
      if (fading && base.environment > 0 && off.environment == base.environment) {
        other = 3 - other;  // another light, which is fading in
        on.environment = off.environment = other;
        subject.change(on, false);
        subject.frame();
      }
      ++tried;
      const std::string name = graph_ + ", " + variant + ": " + toggle.name;
      const bool reread = off.file != on.file;
      if (!subject.change(off, reread)) {
        ++refused;
        subject.change(on, reread);
        compare(subject, on, name + ", refused");
        continue;
      }
      if (fading)
        subject.frame();
      else
        compare(subject, off, name);
      if (!subject.change(on, reread))
        found.push_back(name + ": cannot be undone: " + subject.stage().diagnostics.text());
      else
        compare(subject, on, name + ", and back");
    }
  }

 private:
  void compare(Subject& subject, const State& state, const std::string& name) {
    const bool settled = subject.settle();
    if (!settled) found.push_back(name + ": never comes to rest");
    const std::uint32_t number = 100'000;
    const double time = 1e5 + 10.0 * static_cast<double>(++judged_);
    const Picture seen = subject.judge(number, time);
    const Picture& wanted = freshOf(state, number, time);
    if (seen == wanted) return;
    std::size_t differ = 0;
    double mine = 0, theirs = 0;
    for (std::size_t i = 0; i < std::min(seen.size(), wanted.size()); ++i) {
      differ += seen[i] != wanted[i];
      mine += seen[i];
      theirs += wanted[i];
    }
    const double bytes = static_cast<double>(std::max<std::size_t>(1, seen.size()));
    found.push_back(name + ": " + std::to_string(differ) + " of " + std::to_string(seen.size()) +
                    " bytes differ, mean " + std::to_string(mine / bytes) + " for " +
                    std::to_string(theirs / bytes));
  }
  // Scenes and graphs here do not move with time, so one picture of a state serves for all times.
  const Picture& freshOf(const State& state, std::uint32_t number, double time) {
    const auto known = fresh_.find(state.key());
    if (known != fresh_.end()) return known->second;
    Subject subject(other_, "scenes/spheres.json");
    REQUIRE_MESSAGE(subject.change(state, true), subject.stage().diagnostics.text());
    subject.settle();
    return fresh_[state.key()] = subject.judge(number, time);
  }

  std::vector<Toggle> togglesOf(const State& base, Subject& subject) {
    std::vector<Toggle> toggles;
    const graph::FlatGraph& flat = *subject.stage().execution().plan().graph;
    std::set<std::string> passes, includes;
    const auto add = [&](const std::string& declared) {
      passes.insert(declared);
      for (std::size_t dot = declared.find('.'); dot != std::string::npos; dot = declared.find('.', dot + 1))
        includes.insert(declared.substr(0, dot));
    };
    for (const graph::PassSpec& spec : flat.specs) add(spec.declared);
    for (const std::set<std::string>* names : {&passes, &includes})
      for (const std::string& name : *names) {
        State off = base;
        off.disables.push_back(name);
        toggles.push_back({"disable " + name, off});
        off = base;
        off.file = overlay(graph_, ", \"passes\": [{ \"name\": \"" + name + "\", \"remove\": true }]");
        toggles.push_back({"remove " + name, off});
      }
    for (const graph::ParameterSpec& parameter : flat.parameters) {
      if (parameter.desc.type != graph::ParameterDesc::Type::boolean) continue;
      State off = base;
      off.sets.push_back(
          {parameter.path, graph::Value::boolean(!parameter.value.truth()), graph::Origin::panel});
      toggles.push_back({"turn " + parameter.path, off});
    }
    for (const char* preset :
         {"cinema.json", "evening.json", "portrait.json", "plain.json", "black_and_white.json"}) {
      State off = base;
      off.file = overlay(graph_, "", preset);
      toggles.push_back({std::string("preset ") + preset, off});
    }
    if (base.environment > 0) {
      State off = base;
      off.environment = 3 - base.environment;
      toggles.push_back({"environment", off});
    }
    State off = base;
    off.width = 64;
    off.height = 36;
    toggles.push_back({"size", off});
    return toggles;
  }

  std::string graph_;
  TemporaryFolder folder_, other_;
  std::map<std::string, Picture> fresh_;
  int judged_ = 0;
};

}  // namespace

TEST_CASE("what is switched and switched back gives the picture of a fresh start") {
  const char* const wish = std::getenv("WEFT_TOGGLES");
  const std::string which = wish ? wish : "";
  std::uint32_t seed = 25;
  const std::vector<std::string> sample = {"studio.json", "taa.json"},
                                 others = {"deferred.json", "studio_gi.json", "deferred_gi.json",
                                           "glow.json"};
  std::vector<std::string> graphs = sample;
  if (!which.empty()) graphs.insert(graphs.end(), others.begin(), others.end());
  for (const std::string& graph : graphs) {
    if (!which.empty() && which != "all" && which != graph) continue;
    const CleanScope clean;
    Judge judge(graph);
    const bool lit = graph != "glow.json";
    for (const int environment : {0, 1})
      for (const bool sliced : {false, true}) {
        if (sliced && !lit) continue;
        for (const bool fading : {false, true}) {
          if (fading && (environment == 0 || !lit)) continue;
          State base;
          base.file = overlay(graph);
          base.environment = environment;
          if (lit) base.sets.push_back({"ibl.sliced", sliced ? "true" : "false"});
          std::string variant = environment ? "a map" : "no map";
          if (sliced) variant += ", sliced";
          if (fading) variant += ", fading";
          judge.run(base, variant, fading, which.empty() ? kSample / 7 : 10'000, ++seed);
        }
      }
    for (const std::string& line : judge.found) FAIL_CHECK(line);
    MESSAGE(graph << ": " << judge.tried << " toggles, " << judge.refused << " refused, "
                  << judge.found.size() << " differ");
  }
}

}  // namespace frame_toggles_test
