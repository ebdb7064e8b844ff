#include "app/live/live_graph.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <ranges>

#include "app/session/session.h"
#include "engine/graph/language/suffix.h"
#include "engine/text/files/file.h"

namespace weft::app {

namespace {

// Editors and version control write several files, or one in several steps:
// what is wrong may be so no longer when nothing was written for so long.
constexpr double kQuietSeconds = 0.03;
// The wait for a file that went away: some programs write it anew only a while later.
constexpr double kGoneSeconds = 0.3;

void forget(graph::Settings& settings, const std::string& name) {
  std::erase_if(settings.sets, [&](const graph::Setting& set) { return set.name == name; });
}

}  // namespace

LiveGraph::LiveGraph(const Options& options, runtime::Renderer& renderer, runtime::World world,
                     graph::Settings settings)
    : renderer_(renderer),
      world_(std::move(world)),
      settings_(std::move(settings)),
      scene_(scenePathOf(options), sceneChoiceOf(options), world_.scene().files),
      presetFolder_(presetFolders(options.presetFolder).front()) {
  if (world_.scene().cameras.rows().empty()) scene_.outdate();
  if (world_.environmentPending())
    environment_.request(options.environment);
  else if (!options.environment.empty())
    environment_.assume(options.environment);
}

void LiveGraph::expectScene() {
  scene_.outdate();
  // The first load() does not take the scene, however small the file: its arrival is reported as an event.
  scene_.request();
}

bool LiveGraph::load(text::Diagnostics& diagnostics) {
  graphStale_ = scene_.loading();
  untried_ = untried_ || graphStale_;
  good_ = tryLoad(Attempt::final, diagnostics);
  return good_;
}

bool LiveGraph::tryLoad(Attempt attempt, text::Diagnostics& diagnostics) {
  runtime::World world = world_;
  text::Diagnostics said;
  const bool good = tryScene(world, said) && tryGraph(attempt, world, said);
  if (good || attempt == Attempt::final) diagnostics.append(said);
  if (good) {
    world_ = std::move(world);
    if (!scene_.loading()) scene_.settle();
    ++switches_;
  }
  watch(&diagnostics);
  return good;
}

bool LiveGraph::tryGraph(Attempt attempt, const runtime::World& world, text::Diagnostics& diagnostics) {
  graph::Settings wanted = settings_, lost;
  wanted.sets.insert(wanted.sets.end(), lost_.sets.begin(), lost_.sets.end());
  wanted.disables.insert(wanted.disables.end(), lost_.disables.begin(), lost_.disables.end());
  text::Diagnostics said;
  bool good = renderer_.load(wanted, world, said);
  if (!good && attempt == Attempt::final && running() && !renderer_.refused().empty()) {
    said = {};
    for (const graph::Refusal& refusal : std::views::reverse(renderer_.refused())) {
      text::Diagnostic warning = refusal.why;
      warning.severity = text::Severity::warning;
      warning.message += "; left out until the files take it";
      said.add(std::move(warning));
      const auto at = static_cast<std::ptrdiff_t>(refusal.index);
      if (refusal.disable) {
        lost.disables.push_back(std::move(wanted.disables[refusal.index]));
        wanted.disables.erase(wanted.disables.begin() + at);
      } else {
        lost.sets.push_back(std::move(wanted.sets[refusal.index]));
        wanted.sets.erase(wanted.sets.begin() + at);
      }
    }
    good = renderer_.load(wanted, world, said);
  }
  diagnostics.append(said);
  if (!good) return false;
  settings_ = std::move(wanted);
  lost_ = std::move(lost);
  return true;
}

bool LiveGraph::tryScene(runtime::World& world, text::Diagnostics& diagnostics) {
  if (!scene_.outdated() || scene_.loading()) return true;  // when it is there
  if (!scene_.ready()) scene_.readNow();
  const scene::Scene* scene = scene_.scene(diagnostics);
  if (!scene) return false;
  world.setScene(*scene);
  return true;
}

std::vector<std::string> LiveGraph::files() const {
  std::vector<std::string> files = renderer_.files();
  files.insert(files.end(), scene_.files().begin(), scene_.files().end());
  files.insert(files.end(), world_.scene().files.begin(), world_.scene().files.end());
  for (const std::string& file : {environment_.shown(), environment_.wanted()})
    if (!file.empty()) files.push_back(file);
  return files;
}

// What there is to say of how files are watched goes to `diagnostics`, or waits for the next call that has one.
void LiveGraph::watch(text::Diagnostics* diagnostics) {
  std::vector<std::string> watched = files();
  std::erase_if(watched, [](const std::string& file) { return !text::mayRead(file); });
  watcher_.watch(std::move(watched));
  if (diagnostics) diagnostics->append(watcher_.takeNotices());
}

bool LiveGraph::wantsLoad(double now) {
  const std::vector<std::string> changed = watcher_.poll();
  if (!changed.empty()) {
    const auto gone = [](const std::string& file) {
      std::error_code ignored;
      return !std::filesystem::exists(file, ignored);
    };
    changedAt_ = now;
    untried_ = std::ranges::none_of(changed, gone);
    quiet_ = untried_ ? kQuietSeconds : kGoneSeconds;
  }
  for (const std::string& file : changed) {
    if (std::ranges::find(scene_.files(), file) != scene_.files().end() || file == scene_.path())
      scene_.outdate();
    const bool environment = file == environment_.shown() || file == environment_.wanted();
    if (environment)
      changedEnvironment_ = file;
    else
      graphStale_ = true;
  }
  if (!graphStale_ || (!untried_ && now - changedAt_ < quiet_)) return false;
  // A scene with models is read beside the frames: there is nothing to load until it is there.
  return !running() || !scene_.outdated() || !scene_.slow() || scene_.arrived();
}

bool LiveGraph::poll(double now, text::Diagnostics& diagnostics) {
  const bool wants = wantsLoad(now);
  const bool quiet = now - changedAt_ >= quiet_;
  if (quiet && !changedEnvironment_.empty()) environment_.request(std::exchange(changedEnvironment_, {}));
  if (!wants) return false;
  untried_ = false;
  if (quiet) {
    load(diagnostics);
    return true;
  }
  if (!tryLoad(Attempt::early, diagnostics)) return false;
  good_ = true;
  graphStale_ = false;
  return true;
}

bool LiveGraph::pollEnvironment(text::Diagnostics& diagnostics) {
  auto* provider = renderer_.device().imports.find<imports::EnvironmentProvider>();
  assert(provider && "the viewer runs with all built-in imports");
  const auto event = environment_.poll(provider->textures(), diagnostics);
  if (!event) return false;
  runtime::World world = world_;
  if (*event) world.setEnvironment(*event);
  environmentGood_ = *event != nullptr && tryWorld(world, diagnostics);
  if (!environmentGood_ && world_.environmentPending()) {
    world = world_;
    world.expectEnvironment(false);
    tryWorld(world, diagnostics);
  }
  watch(&diagnostics);
  return true;
}

// Takes up another world; the graph is expanded again when it would be another one.
bool LiveGraph::tryWorld(runtime::World world, text::Diagnostics& diagnostics) {
  if (!running()) {  // for when the files are good
    world_ = std::move(world);
    return true;
  }
  const bool same = world.facts() == world_.facts();
  if (!same && !renderer_.apply(settings_, world, diagnostics)) return false;
  switches_ += same ? 0 : 1;
  world_ = std::move(world);
  return true;
}

bool LiveGraph::stepEnvironment(int by) {
  if (!environment_.step(by)) return false;
  watch();
  return true;
}

bool LiveGraph::resize(std::uint32_t width, std::uint32_t height, text::Diagnostics& diagnostics) {
  if (width == settings_.screenWidth && height == settings_.screenHeight) return false;
  settings_.screenWidth = width;
  settings_.screenHeight = height;
  if (!running()) return false;
  if (renderer_.apply(settings_, world_, diagnostics)) ++switches_;
  watch();
  return true;
}

bool LiveGraph::trySettings(graph::Settings settings, text::Diagnostics& diagnostics) {
  ++changes_;
  text::Diagnostics said;
  const bool taken = renderer_.apply(settings, world_, said);
  diagnostics.append(said);
  if (!taken) return false;
  settings_ = std::move(settings);
  ++switches_;
  watch();
  return true;
}

bool LiveGraph::setParameter(const std::string& name, const graph::Value& value,
                             text::Diagnostics& diagnostics) {
  Moment before = changing_ == name ? Moment{} : now();
  if (!trySetLive(name, value)) {
    graph::Settings settings = settings_;
    forget(settings, name);
    settings.sets.emplace_back(name, value, graph::Origin::panel);
    if (!trySettings(std::move(settings), diagnostics)) return false;
  }
  remember(std::move(before), name);
  return true;
}

bool LiveGraph::change(graph::Settings settings, text::Diagnostics& diagnostics) {
  Moment before = now();
  if (!trySettings(std::move(settings), diagnostics)) return false;
  remember(std::move(before));
  return true;
}

bool LiveGraph::trySetLive(const std::string& name, const graph::Value& value) {
  if (!renderer_.setParameter(name, value)) return false;
  ++changes_;
  ++livesSet_;
  // Where the last setting of the parameter was made in a panel, too, it is
  // overwritten, so that a slider that moves allocates nothing.
  auto& sets = settings_.sets;
  const auto last = std::find_if(sets.rbegin(), sets.rend(),
                                 [&](const graph::Setting& set) { return graph::hasSuffix(name, set.name); });
  if (last != sets.rend() && last->name == name && last->origin == graph::Origin::panel) {
    last->value = value;
    return true;
  }
  forget(settings_, name);
  sets.emplace_back(name, value, graph::Origin::panel);
  return true;
}

bool LiveGraph::resetParameter(const std::string& name, text::Diagnostics& diagnostics) {
  graph::Settings settings = settings_;
  std::erase_if(settings.sets, [&](const auto& set) { return graph::hasSuffix(name, set.name); });
  return change(std::move(settings), diagnostics);
}

bool LiveGraph::isChanged(const std::string& parameter) const {
  return std::ranges::any_of(settings_.sets,
                             [&](const auto& set) { return graph::hasSuffix(parameter, set.name); });
}

bool LiveGraph::setEnabled(const std::string& pass, bool enabled, text::Diagnostics& diagnostics) {
  graph::Settings settings = settings_;
  std::erase_if(settings.disables, [&](const graph::Disable& each) { return each.name == pass; });
  if (!enabled) settings.disables.emplace_back(pass, graph::Origin::panel);
  return change(std::move(settings), diagnostics);
}

}  // namespace weft::app
