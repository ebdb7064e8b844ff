// What a person changed in the window: taken back, written into files, kept as a preset; and other files to look at. Declared in
// live_graph.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/live/live_graph.h"
#include "app/session/session.h"
#include "engine/assets/models/model_file.h"
#include "engine/graph/edit/stanzas.h"
#include "engine/graph/language/suffix.h"
#include "engine/graph/print/explain.h"
#include "engine/text/files/file.h"
#include "engine/text/json/dom.h"
#include "engine/text/json/edit.h"
#include "engine/text/json/report.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;

// What makes of each file what it was before.
graph::WriteBack reversed(const graph::WriteBack& files) {
  graph::WriteBack back;
  for (const graph::WriteBack::File& file : files.files)
    back.files.push_back({file.path, file.after, file.before});
  return back;
}

bool isHere(graph::Origin origin) {
  return origin == graph::Origin::panel;
}

}  // namespace

LiveGraph::Moment LiveGraph::now() const {
  return {renderer_.graphPath(), {renderer_.presets().begin(), renderer_.presets().end()}, settings_, {}};
}

void LiveGraph::remember(Moment before, const std::string& name) {
  redo_.clear();
  if (!name.empty() && name == changing_) return;
  changing_ = name;
  undo_.push_back(std::move(before));
}

bool LiveGraph::takeUp(Moment moment, text::Diagnostics& diagnostics) {
  moment.settings.screenWidth = settings_.screenWidth;
  moment.settings.screenHeight = settings_.screenHeight;
  Moment before = now();
  if (moment.graph == before.graph && moment.presets == before.presets && moment.files.files.empty())
    return trySettings(std::move(moment.settings), diagnostics);
  ++changes_;
  renderer_.setFiles(moment.graph, moment.presets);
  settings_ = std::move(moment.settings);
  if (load(diagnostics)) return true;
  renderer_.setFiles(before.graph, before.presets);
  settings_ = std::move(before.settings);
  text::Diagnostics ignored;
  load(ignored);
  return false;
}

bool LiveGraph::travel(std::vector<Moment>& from, std::vector<Moment>& to, text::Diagnostics& diagnostics) {
  if (from.empty()) return false;
  ++changes_;
  const Moment& target = from.back();
  Moment back = now();
  back.files = reversed(target.files);
  if (!graph::saveWriteBack(target.files, diagnostics)) return false;
  if (!takeUp(target, diagnostics)) {
    text::Diagnostics ignored;
    graph::saveWriteBack(back.files, ignored);
    return false;
  }
  from.pop_back();
  to.push_back(std::move(back));
  endChange();
  return true;
}

std::size_t LiveGraph::unsaved() const {
  return static_cast<std::size_t>(std::ranges::count_if(settings_.sets, isHere, &graph::Setting::origin) +
                                  std::ranges::count_if(settings_.disables, isHere, &graph::Disable::origin));
}

bool LiveGraph::isWefts(const std::string& file) {
  std::error_code ignored;
  const fs::path inside =
      fs::weakly_canonical(file, ignored).lexically_relative(fs::weakly_canonical(dataFolder(), ignored));
  return !inside.empty() && *inside.begin() != "..";
}

std::optional<graph::WriteBack> LiveGraph::planWrites(text::Diagnostics& diagnostics) {
  ++changes_;
  if (!renderer_.desc()) return std::nullopt;
  const graph::Registry registry = runtime::makeRegistry(renderer_.device().plugIns, world_.facts());
  return graph::planWriteBack(*renderer_.desc(), renderer_.presets(), registry, settings_, diagnostics);
}

bool LiveGraph::write(const graph::WriteBack& plan, text::Diagnostics& diagnostics) {
  ++changes_;
  const bool wefts = std::ranges::any_of(plan.files, isWefts, &graph::WriteBack::File::path);
  for (const graph::WriteBack::File& file : plan.files)
    if (isWefts(file.path))
      diagnostics
          .error(text::Code::cannotWriteBack, {file.path},
                 fmt::format("'{}' is Weft's own, and is not written over", file.path))
          .hint = "save the changes as a preset, or work on a copy of the graph";
  if (wefts || !graph::saveWriteBack(plan, diagnostics)) return false;
  Moment before = now();
  before.files = reversed(plan);
  settings_ = plan.rest;
  const bool good = load(diagnostics);
  if (!plan.files.empty()) remember(std::move(before));
  return good;
}

std::optional<std::string> LiveGraph::savePreset(const std::string& name, text::Diagnostics& diagnostics) {
  ++changes_;
  const std::string file = presetFolder_ + "/" + name + ".json";
  std::error_code ignored;
  if (name.find_first_of("/.") != std::string::npos || fs::exists(file, ignored) || isWefts(file)) {
    diagnostics
        .error(text::Code::outputNotWritten, {file}, fmt::format("there is a preset '{}' already", name))
        .hint = "give it another name, without '/' and '.'";
    return std::nullopt;
  }
  nlohmann::ordered_json text = {{"name", name}};
  const auto& parameters = renderer_.execution()->plan().graph->parameters;
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (isChanged(parameters[i].path))
      text["set"][parameters[i].path] = graph::jsonOf(renderer_.execution()->uniforms().parameters()[i]);
  graph::eachPass(*renderer_.desc(), [&](const std::string& pass, const graph::PassDesc&) {
    for (const graph::Disable& disable : settings_.disables)
      if (graph::hasSuffix(pass, disable.name))
        text["passes"].push_back({{"name", pass}, {"enabled", false}});
  });
  fs::create_directories(presetFolder_, ignored);
  Moment wanted = now(), before = wanted;
  wanted.presets.push_back(file);
  wanted.settings.sets.clear();
  wanted.settings.disables.clear();
  if (!text::writeFile(file, text.dump(2) + "\n", diagnostics)) return std::nullopt;
  if (!takeUp(std::move(wanted), diagnostics)) {
    fs::remove(file, ignored);
    return std::nullopt;
  }
  remember(std::move(before));
  return file;
}

bool LiveGraph::open(const std::string& file, text::Diagnostics& diagnostics) {
  ++changes_;
  text::chooseFile(file);
  std::error_code ignored;
  if (assets::isEnvironmentName(file) || fs::is_directory(file, ignored)) {
    const auto first = firstEnvironment(file, diagnostics);
    if (first) environment_.request(*first);
    return first.has_value();
  }
  bool scene = assets::isModelName(file);
  Moment wanted = now(), before = wanted;
  if (!scene) {
    const auto text = text::readTextFile(file, diagnostics);
    if (!text) return false;
    const text::JsonEdit json(*text);
    const auto has = [&](const char* key) { return json.root().find(key) != nullptr; };
    scene = has("cameras") || has("grid") || has("spheres") || has("models") || has("sun") || has("lamps");
    if (has("resources") || has("present") || has("extends") || !(has("set") || has("passes"))) {
      wanted = {file, {}, {}, {}};
      wanted.settings.software = settings_.software;
    } else {
      wanted.presets.push_back(file);
    }
  }
  if (scene) {
    scene_.choose(file);
    graphStale_ = untried_ = true;
    return true;
  }
  if (!takeUp(std::move(wanted), diagnostics)) return false;
  remember(std::move(before));
  return true;
}

}  // namespace weft::app
