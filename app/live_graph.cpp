#include "app/live_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <utility>

#include "app/session.h"
#include "engine/base/file_access.h"
#include "engine/graph/suffix.h"
#include "engine/graph/write_back.h"
#include "engine/scene/scene_file.h"

namespace weft::app {

namespace {

// Editors and version control write several files, or one in several steps: what is wrong may be so no longer
// when nothing was written for so long.
constexpr double kQuietSeconds = 0.03;
// The same for a file that went away: some programs write it anew only a while later.
constexpr double kGoneSeconds = 0.3;

// Not where the name goes on.
void replaceAll(std::string& text, const std::string& what, const std::string& by) {
  const auto goesOn = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) != 0 || text[at] == '_');
  };
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos;) {
    if (goesOn(at + what.size())) {
      at += what.size();
      continue;
    }
    text.replace(at, what.size(), by);
    at += by.size();
  }
}

// Whether `diagnostic` is at a setting.
bool isAt(const base::Diagnostic& diagnostic, const std::string& source) {
  return diagnostic.place.file && *diagnostic.place.file == *graph::placeOfSetting(source).file;
}

// Whether it says that the graph does not take it. (A file it names that is missing may come back.)
bool isAbout(const base::Diagnostic& diagnostic, const std::string& source) {
  return diagnostic.severity == base::Severity::error && diagnostic.code != base::Code::W1 && isAt(diagnostic, source);
}

}  // namespace

LiveGraph::LiveGraph(const Options& options, runtime::Renderer& renderer, runtime::World world,
                     graph::Settings settings)
    : renderer_(renderer),
      world_(std::move(world)),
      settings_(std::move(settings)),
      scenePath_(scenePathOf(options)),
      sceneChoice_(sceneChoiceOf(options)),
      sceneFiles_(world_.scene().files),
      sceneStale_(world_.scene().cameras.rows().empty()) {
  if (world_.environmentPending())
    environment_.request(options.environment);
  else if (!options.environment.empty())
    environment_.assume(options.environment);
}

void LiveGraph::tellOfHere(const base::Diagnostics& said, const graph::Settings& settings,
                           base::Diagnostics& diagnostics) const {
  for (base::Diagnostic each : said.items()) {
    const auto rename = [&](const std::string& what, const std::string& by) {
      if (isAt(each, what)) {
        each.place = {};
        each.message = fmt::format("{}: {}", by, each.message);
      }
      for (std::string* text : {&each.message, &each.expected, &each.found, &each.hint})
        replaceAll(*text, what, by);
    };
    for (const auto* sets : {&settings.sets, &lostSets_})
      for (const auto& [name, value] : *sets)
        if (setHere_.contains(name))
          rename(graph::sourceOfSet(name, value), "the value " + value + " set here for " + name);
    for (const auto* names : {&settings.disables, &lostDisables_})
      for (const std::string& name : *names)
        if (disabledHere_.contains(name))
          rename(graph::sourceOfDisable(name), "switching off " + name + " here");
    diagnostics.add(std::move(each));
  }
}

bool LiveGraph::load(base::Diagnostics& diagnostics) {
  graphStale_ = false;
  good_ = tryLoad(Attempt::final, diagnostics);
  return good_;
}

bool LiveGraph::tryLoad(Attempt attempt, base::Diagnostics& diagnostics) {
  runtime::World world = world_;
  base::Diagnostics said;
  const bool good = tryScene(world, said) && tryGraph(attempt, world, said);
  if (good || attempt == Attempt::final) tellOfHere(said, settings_, diagnostics);
  if (good) {
    world_ = std::move(world);
    sceneStale_ = false;
    ++switches_;
  }
  watch(&diagnostics);
  return good;
}

bool LiveGraph::tryGraph(Attempt attempt, const runtime::World& world, base::Diagnostics& diagnostics) {
  graph::Settings wanted = settings_;
  wanted.sets.insert(wanted.sets.end(), lostSets_.begin(), lostSets_.end());
  wanted.disables.insert(wanted.disables.end(), lostDisables_.begin(), lostDisables_.end());
  base::Diagnostics said;
  if (renderer_.load(wanted, world, said)) {
    diagnostics.append(said);
    settings_ = std::move(wanted);
    lostSets_.clear();
    lostDisables_.clear();
    return true;
  }
  if (attempt == Attempt::early) return false;
  std::vector<std::pair<std::string, std::string>> sets;
  std::vector<std::string> disables;
  base::Diagnostics warnings;
  const auto take = [&](const std::string& source) {
    const auto found =
        std::ranges::find_if(said.items(), [&](const auto& each) { return isAbout(each, source); });
    if (found == said.items().end()) return false;
    base::Diagnostic warning = *found;
    warning.severity = base::Severity::warning;
    warning.message += "; left out until the files take it";
    warnings.add(std::move(warning));
    return true;
  };
  std::erase_if(wanted.sets, [&](const auto& set) {
    const bool lost = take(graph::sourceOfSet(set.first, set.second));
    if (lost) sets.push_back(set);
    return lost;
  });
  std::erase_if(wanted.disables, [&](const std::string& name) {
    const bool lost = take(graph::sourceOfDisable(name));
    if (lost) disables.push_back(name);
    return lost;
  });
  if (warnings.empty() || !running()) {
    diagnostics.append(said);
    return false;
  }
  diagnostics.append(warnings);
  if (!renderer_.load(wanted, world, diagnostics)) return false;
  settings_ = std::move(wanted);
  lostSets_ = std::move(sets);
  lostDisables_ = std::move(disables);
  return true;
}

bool LiveGraph::tryScene(runtime::World& world, base::Diagnostics& diagnostics) {
  if (sceneStale_) {
    auto scene = scene::loadScene(scenePath_, diagnostics, &sceneFiles_, sceneChoice_);
    if (!scene) return false;
    world.setScene(std::move(*scene));
  }
  return true;
}

std::vector<std::string> LiveGraph::files() const {
  std::vector<std::string> files = renderer_.files();
  files.insert(files.end(), sceneFiles_.begin(), sceneFiles_.end());
  files.insert(files.end(), world_.scene().files.begin(), world_.scene().files.end());
  for (const std::string& file : {environment_.shown(), environment_.wanted()})
    if (!file.empty()) files.push_back(file);
  return files;
}

// What there is to say of how files are watched goes to `diagnostics`, or waits for the next call that has one.
void LiveGraph::watch(base::Diagnostics* diagnostics) {
  std::vector<std::string> watched = files();
  std::erase_if(watched, [](const std::string& file) { return !base::mayRead(file); });
  watcher_.watch(watched);
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
    sceneStale_ |= std::ranges::find(sceneFiles_, file) != sceneFiles_.end() || file == scenePath_;
    const bool environment = file == environment_.shown() || file == environment_.wanted();
    if (environment)
      changedEnvironment_ = file;
    else
      graphStale_ = true;
  }
  return graphStale_ && (untried_ || now - changedAt_ >= quiet_);
}

bool LiveGraph::poll(double now, base::Diagnostics& diagnostics) {
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

bool LiveGraph::pollEnvironment(base::Diagnostics& diagnostics) {
  const auto event = environment_.poll(renderer_.device().imports.environments(), diagnostics);
  if (!event) return false;
  runtime::World world = world_;
  if (event->map) world.setEnvironment(event->map);
  environmentGood_ = event->map && tryWorld(world, diagnostics);
  if (!environmentGood_ && world_.environmentPending()) {
    world = world_;
    world.expectEnvironment(false);
    tryWorld(world, diagnostics);
  }
  watch(&diagnostics);
  return true;
}

// Takes up another world; the graph is expanded again when it would be another one.
bool LiveGraph::tryWorld(runtime::World world, base::Diagnostics& diagnostics) {
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

void LiveGraph::stepEnvironment(int by) {
  if (environment_.step(by)) watch();
}

bool LiveGraph::resize(std::uint32_t width, std::uint32_t height, base::Diagnostics& diagnostics) {
  if (width == settings_.screenWidth && height == settings_.screenHeight) return false;
  settings_.screenWidth = width;
  settings_.screenHeight = height;
  if (!running()) return false;
  if (renderer_.apply(settings_, world_, diagnostics)) ++switches_;
  watch();
  return true;
}

bool LiveGraph::trySettings(graph::Settings settings, base::Diagnostics& diagnostics) {
  ++changes_;
  base::Diagnostics said;
  const bool taken = renderer_.apply(settings, world_, said);
  tellOfHere(said, settings, diagnostics);
  if (!taken) return false;
  settings_ = std::move(settings);
  ++switches_;
  watch();
  return true;
}

bool LiveGraph::setParameter(const std::string& name, const std::string& value,
                             base::Diagnostics& diagnostics) {
  graph::Settings settings = settings_;
  const auto same = [&](const auto& set) { return set.first == name; };
  std::erase_if(settings.sets, same);
  std::erase_if(lostSets_, same);
  settings.sets.emplace_back(name, value);
  setHere_.insert(name);
  return trySettings(std::move(settings), diagnostics);
}

bool LiveGraph::resetParameter(const std::string& name, base::Diagnostics& diagnostics) {
  graph::Settings settings = settings_;
  std::erase_if(settings.sets, [&](const auto& set) { return graph::hasSuffix(name, set.first); });
  return trySettings(std::move(settings), diagnostics);
}

bool LiveGraph::isChanged(const std::string& parameter) const {
  return std::ranges::any_of(settings_.sets,
                             [&](const auto& set) { return graph::hasSuffix(parameter, set.first); });
}

bool LiveGraph::writeBack(std::vector<std::string>& files, base::Diagnostics& diagnostics) {
  ++changes_;
  if (!renderer_.desc()) return false;
  const graph::Registry registry = runtime::makeRegistry(renderer_.device().passTypes, world_.facts());
  const auto plan =
      graph::planWriteBack(*renderer_.desc(), renderer_.presets(), registry, settings_, diagnostics);
  if (!plan || !graph::saveWriteBack(*plan, diagnostics)) return false;
  for (const graph::WriteBack::File& file : plan->files) files.push_back(file.path);
  settings_ = plan->rest;
  return load(diagnostics);
}

bool LiveGraph::setEnabled(const std::string& pass, bool enabled, base::Diagnostics& diagnostics) {
  graph::Settings settings = settings_;
  std::erase(settings.disables, pass);
  if (!enabled) {
    settings.disables.push_back(pass);
    disabledHere_.insert(pass);
  }
  return trySettings(std::move(settings), diagnostics);
}

}  // namespace weft::app
