#include "app/live/live_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <ranges>

#include "app/session/session.h"
#include "app_sentences.h"
#include "engine/assets/models/model_file.h"
#include "engine/graph/language/names.h"
#include "engine/graph/print/print.h"
#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"

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

// Editors and version control write several files, or one in steps: what is wrong may be right when nothing was written for so long.
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
      scene_(scenePathOf(options), {.camera = options.camera, .materials = options.materials},
             world_.scene().files),
      presetFolders_(presetFolders(options.presetFolder)) {
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
  wentBack_ = false;
  const bool scene = tryScene(world, said), good = scene && tryGraph(attempt, world, said);
  if (good || attempt == Attempt::final) diagnostics.append(said);
  if (good) {
    world_ = std::move(world);
    if (!scene_.loading()) scene_.settle();
    ++switches_;
  } else if ((!scene || good_) && attempt == Attempt::final && scene_.goBack()) {
    wentBack_ = graphStale_ = untried_ = true;
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
      const auto moveTo = [&](auto& to, auto& from) {
        const auto at = from.begin() + static_cast<std::ptrdiff_t>(refusal.index);
        to.push_back(std::move(*at));
        from.erase(at);
      };
      refusal.disable ? moveTo(lost.disables, wanted.disables) : moveTo(lost.sets, wanted.sets);
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
    changedAt_ = now;
    untried_ = std::ranges::all_of(changed, text::isThere);
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
  // A scene is read beside the frames: there is nothing to load until it is there.
  return !running() || !scene_.outdated() || scene_.arrived();
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
  const auto event = environment_.poll(diagnostics);
  if (!event) return false;
  runtime::World world = world_;
  if (*event) world.setEnvironment(*event);
  const bool taken = *event != nullptr && tryWorld(world, diagnostics);
  // One that was opened and refused leaves the one that is shown as good as it was.
  if (taken || world_.environmentPending() || environment_.wanted() == environment_.shown())
    environmentGood_ = taken;
  if (!taken && world_.environmentPending()) {
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
  // A setting that was made in a panel is overwritten, so that a slider that moves allocates nothing.
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

// ---- what a person changed in the window, and other files to look at ----

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
    if (isWefts(file.path)) diagnostics.error(say::weftsOwn, {file.path}, file.path);
  if (wefts || !graph::saveWriteBack(plan, diagnostics)) return false;
  Moment before = now();
  before.files = reversed(plan);
  settings_ = plan.rest;
  const bool good = load(diagnostics);
  if (!plan.files.empty()) remember(std::move(before));
  return good;
}

bool LiveGraph::saveCamera(const scene::CameraPose& pose, text::Diagnostics& diagnostics) {
  const std::string& path = scene_.path();
  const auto before =
      assets::isModelName(path) || pose.height > 0 ? std::nullopt : text::readTextFile(path, diagnostics);
  const text::JsonEdit edit(before ? *before : std::string_view());
  const text::JsonValue* const cameras = edit.root().find("cameras");
  const text::JsonValue& into = cameras ? *cameras : edit.root();
  if (!edit || !into.is(text::JsonValue::Type::object)) {
    diagnostics.error(say::cameraNotTaken, {path});
    return false;
  }
  std::string name = "view_1";
  for (int i = 2; cameras && cameras->find(name); ++i) name = fmt::format("view_{}", i);
  const auto& [at, to] = std::tie(pose.position, pose.target);
  std::string json =
      fmt::format(R"({{ "position": [{}, {}, {}], "target": [{}, {}, {}], "fov": {}, "near": {} }})", at.x,
                  at.y, at.z, to.x, to.y, to.z, pose.fovDegrees, pose.nearPlane);
  if (!cameras) json = fmt::format(R"({{ "{}": {} }})", name, json);
  const std::string after = edit.withMember(into, cameras ? name : "cameras", json);
  return write({.files = {{path, *before, after}}, .rest = settings_}, diagnostics);
}

std::optional<std::string> LiveGraph::savePreset(const std::string& name, text::Diagnostics& diagnostics) {
  ++changes_;
  const std::string file = presetFolders_.front() + "/" + name + ".json";
  std::error_code ignored;
  if (name.find_first_of("/.") != std::string::npos || text::isThere(file) || isWefts(file)) {
    diagnostics.error(say::presetThere, {file}, name);
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
  fs::create_directories(presetFolders_.front(), ignored);
  Moment wanted = now(), before = wanted;
  wanted.presets.push_back(file);
  wanted.settings.sets.clear();
  wanted.settings.disables.clear();
  if (!text::writeFile(file, text::dumpJson(text, 2, false) + "\n", diagnostics)) return std::nullopt;
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
  if (assets::isEnvironmentName(file) || text::isFolder(file)) {
    const auto first = firstEnvironment(file, diagnostics);
    if (first) environment_.request(*first);
    return first.has_value();
  }
  bool scene = assets::isModelName(file);
  Moment wanted = now(), before = wanted;
  if (!scene || !text::isThere(file)) {
    const auto text = text::readTextFile(file, diagnostics);
    if (!text) return false;
    const text::JsonEdit json(*text);
    const auto has = [&](const char* key) { return json.root().find(key) != nullptr; };
    scene = has("cameras") || has("grid") || has("spheres") || has("models") || has("sun") || has("lamps");
    if (has("resources") || has("present") || has("extends") || !(has("set") || has("passes"))) {
      wanted = {file, {}, {}, {}};
      wanted.settings.software = settings_.software, wanted.settings.window = settings_.window;
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

bool LiveGraph::stepPreset(int by, text::Diagnostics& diagnostics) {
  std::map<std::string, std::string> named{{"", ""}};  // files; that of an earlier folder is meant; or none
  for (const std::string& folder : presetFolders_) {
    std::error_code none;
    for (const auto& entry : fs::directory_iterator(folder, none))
      if (entry.path().extension() == ".json") named.emplace(entry.path().stem(), entry.path());
  }
  Moment before = now(), wanted = before;
  auto at = std::ranges::find_if(named, [&](const auto& each) {
    return !wanted.presets.empty() && each.second == wanted.presets.back();
  });
  at == named.end() ? void(at = named.begin()) : wanted.presets.pop_back();
  for (std::size_t i = 1; i < named.size(); ++i) {
    if (by < 0 && at == named.begin()) at = named.end();
    std::advance(at, by);
    if (at == named.end()) at = named.begin();
    Moment next = wanted;
    if (!at->second.empty()) next.presets.push_back(at->second);
    text::Diagnostics said;
    if (!takeUp(std::move(next), said)) continue;
    diagnostics.append(said);
    remember(std::move(before));
    return true;
  }
  return false;
}

}  // namespace weft::app
