#include "app/session/session.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <future>
#include <set>

#include "app/output/standard_streams.h"
#include "app_sentences.h"
#include "engine/assets/images/image.h"
#include "engine/gl/objects/objects.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/text/hash.h"
#include "engine/text/json/report.h"

namespace weft::app {

namespace {

std::string cacheFolderOf(const Options& options) {
  if (options.cacheFolder == "none") return {};
  if (!options.cacheFolder.empty()) return options.cacheFolder;
  return userFile("XDG_CACHE_HOME", ".cache", "programs");
}

}  // namespace

std::string userFile(const char* variable, const char* inHome, const std::string& name) {
  const char* folder = std::getenv(variable);
  const char* home = std::getenv("HOME");
  if (folder && *folder) return std::string(folder) + "/weft/" + name;
  return home && *home ? std::string(home) + "/" + inHome + "/weft/" + name : "";
}

std::vector<std::string> presetFolders(const std::string& own) {
  std::vector<std::string> folders;
  if (!own.empty()) folders.push_back(own);
  if (std::string user = userFile("XDG_CONFIG_HOME", ".config", "presets"); !user.empty())
    folders.push_back(std::move(user));
  folders.push_back(dataFolder() + kPresets);
  return folders;
}

std::string presetFile(const std::string& preset, const std::string& own) {
  const bool name = !preset.empty() && preset.find_first_of("/.") == std::string::npos;
  if (!name || (text::isThere(preset) && !text::isFolder(preset))) return preset;
  std::string file;
  for (const std::string& folder : presetFolders(own)) {
    file = folder + "/" + preset + ".json";
    if (text::isThere(file)) break;
  }
  return file;
}

runtime::WorldFacts factsWithoutWorld() {
  scene::Scene scene;
  scene.sun.emplace();
  scene.ground.emplace();
  scene.lamps.add({.shadow = true});
  return {.scene = std::make_shared<const scene::Scene>(std::move(scene))};
}

graph::Settings settingsOf(const Options& options, bool software, bool window) {
  return {.screenWidth = options.width,
          .screenHeight = options.height,
          .software = software,
          .window = window,
          .sets = options.sets,
          .disables = options.disables,
          .kept = options.kept};
}

std::string scenePathOf(const Options& options) {
  return options.scene.empty() ? dataFolder() + "/scenes/spheres.json" : options.scene;
}

std::optional<runtime::World> loadWorld(const Options& options, text::Diagnostics& diagnostics) {
  text::Diagnostics said;
  auto loading = std::async(std::launch::async, [&] {  // beside the scene
    return options.environment.empty() ? std::nullopt : assets::loadEnvironmentMap(options.environment, said);
  });
  auto scene = scene::loadScene(scenePathOf(options), diagnostics, nullptr,
                                {.camera = options.camera, .materials = options.materials});
  std::shared_ptr<const assets::EnvironmentMap> environment;
  if (auto map = loading.get()) environment = std::make_shared<const assets::EnvironmentMap>(std::move(*map));
  diagnostics.append(said);
  if (!scene || diagnostics.hasErrors()) return std::nullopt;
  runtime::World world(std::move(*scene));
  if (environment) world.setEnvironment(std::move(environment));
  return world;
}

std::shared_ptr<const graph::Plan> makePlan(const Options& options, const runtime::WorldFacts& facts,
                                            bool software, text::Diagnostics& diagnostics) {
  const auto desc = graph::readGraph(options.graph, diagnostics, {.presets = options.presets});
  if (!desc) return nullptr;
  const auto registry = runtime::makeRegistry({}, facts);
  const auto flat = graph::expandGraph(*desc, registry, settingsOf(options, software), diagnostics);
  if (!flat || diagnostics.hasErrors()) return nullptr;
  auto plan = std::make_shared<const graph::Plan>(graph::compile(flat));
  return graph::checkMemory(*plan, diagnostics) ? plan : nullptr;
}

std::shared_ptr<const graph::Plan> planOf(const Options& options, text::Diagnostics& diagnostics) {
  const auto world = loadWorld(options, diagnostics);
  return makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
}

bool isWrong(const Options& options, const runtime::WorldFacts& facts, text::Diagnostics& diagnostics) {
  text::Diagnostics said, onHardware;
  if (makePlan(options, facts, true, said) || makePlan(options, facts, false, onHardware)) return false;
  diagnostics.append(said);
  return true;
}

void checkDeclared(const graph::Plan& plan, std::uint32_t pass, const gl::ProgramRequest& request,
                   glsl::SourceLoader& sources, LoadedSources& loaded, text::Diagnostics& unread,
                   text::Diagnostics& said) {
  std::vector<gl::StageSource> stages;
  for (const gl::ProgramRequest::Stage& stage : request.stages) {
    if (!stage.text.empty()) continue;
    const auto [source, isNew] = loaded.try_emplace(stage.file);
    if (isNew) source->second = sources.load(stage.file, unread, request.place);
    stages.push_back({stage.stage, source->second});
  }
  if (std::ranges::any_of(stages, [](const gl::StageSource& stage) { return !stage.source; })) return;
  runtime::checkProgram(plan, pass, stages, request.defines, nullptr, said);
  runtime::warnOfConditions(plan.graph->specs[pass], stages, request.defines, said);
}

int report(text::Diagnostics& diagnostics, bool notes) {
  diagnostics.sortByPlace();
  printError(text::chooseMessages(diagnostics, notes).text());
  return diagnostics.hasErrors() ? 1 : 0;
}

// ---- on a device ----

std::unique_ptr<gl::Context> openContext(const Options& options, text::Diagnostics& diagnostics) {
  gl::ContextOptions wanted;
  wanted.backend = gl::findBackend(options.backend).value_or(gl::Backend::automatic);
  if (options.window && wanted.backend == gl::Backend::automatic) wanted.backend = gl::Backend::glfw;
  text::allowFolder(cacheFolderOf(options));
  wanted.title = "weft: " + options.graph;
  wanted.width = options.width;
  wanted.height = options.height;
  wanted.visible = options.window;
  wanted.vsync = options.vsync;
  return gl::createContext(wanted, diagnostics);
}

runtime::Renderer::Options rendererOptionsOf(const Options& options) {
  return {.dataFolder = dataFolder(),
          .cacheFolder = cacheFolderOf(options),
          .trial = {"/proc/self/exe"},
          .presets = options.presets};
}

std::unique_ptr<DeviceSession> openDevice(const Options& options, text::Diagnostics& diagnostics) {
  auto context = openContext(options, diagnostics);
  if (!context) return nullptr;
  gl::Context& current = *context;
  return std::unique_ptr<DeviceSession>(new DeviceSession{
      std::move(context), runtime::Renderer(current, options.graph, rendererOptionsOf(options))});
}

int runOnDevice(std::initializer_list<const Options*> all, int wrong, const DeviceRun& run) {
  text::Diagnostics diagnostics;
  const Options& options = **all.begin();
  auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  const auto isRight = [&](const Options* each) { return !isWrong(*each, facts, diagnostics); };
  if (!world || diagnostics.hasErrors()) {
    makePlan(options, facts, true, diagnostics);
  } else if (std::ranges::all_of(all, isRight)) {
    auto session = openDevice(options, diagnostics);
    if (session) {
      const int code = run(session, *world, diagnostics);
      return report(diagnostics, !options.quiet) ? wrong : code;
    }
    wrong = 3;
  }
  report(diagnostics);
  return wrong;
}

runtime::FrameReport drawFrame(runtime::Renderer& renderer, const runtime::World& world,
                               const Options& options, std::uint32_t frame, text::Diagnostics& diagnostics) {
  const runtime::FrameReport report =
      renderer.frame(world, runtime::headlessFrame(world, frame, options.fps, options.pointer), diagnostics);
  renderer.device().context.drainMessages(diagnostics);
  return report;
}

bool checkPresents(const Options& options, runtime::Renderer& renderer, text::Diagnostics& diagnostics) {
  if (renderer.execution()->presented().id != 0) return true;
  diagnostics.error(say::presentsNothing, {options.graph, 1, 1});
  return false;
}

std::uint64_t hashOfProgram() {
  static const std::uint64_t kHash = [] {
    std::ifstream program("/proc/self/exe", std::ios::binary);
    return text::hashBytes(std::string(std::istreambuf_iterator(program), {}));
  }();
  return kHash;
}

std::uint64_t hashOfSettings(const Options& options, DeviceSession& session) {
  if (session.settings) return *session.settings;  // since then, a manifest was read
  namespace fs = std::filesystem;
  const auto isBelow = [](const std::string& path, const std::string& folder) {
    return !folder.empty() && path.starts_with(text::absolutePath(folder) + "/");
  };
  const auto nameOf = [&](const std::string& path) {
    const std::string absolute = text::absolutePath(path);
    if (isBelow(absolute, dataFolder())) return absolute.substr(text::absolutePath(dataFolder()).size());
    const fs::path folder = fs::path(text::absolutePath(options.graph)).parent_path();
    return path.empty() ? "" : fs::path(absolute).lexically_relative(folder).string();
  };
  std::string all = fmt::format("{:x} {} {} {}x{} {} {} {} {} {} {},{},{}", hashOfProgram(),
                                session.context->device().driverKey, nameOf(options.graph), options.width,
                                options.height, options.fps, nameOf(options.scene),
                                nameOf(options.environment), nameOf(options.materials), options.camera,
                                options.pointer.position.x, options.pointer.position.y, options.pointer.down);
  for (const graph::Setting& set : options.sets) all += fmt::format("\n{}={}", set.name, set.text);
  for (const graph::Disable& pass : options.disables) all += "\n-" + pass.name;
  for (const std::string& preset : options.presets) all += "\n+" + nameOf(preset);
  const std::set<std::string> read = text::filesRead();
  std::set<std::string> files = read, lines;
  for (const std::string& file : session.renderer.files()) files.insert(text::absolutePath(file));
  for (const std::string& file : files) {
    std::error_code ec;
    if (isBelow(file, cacheFolderOf(options)) || (!read.contains(file) && !fs::is_regular_file(file, ec)))
      continue;
    text::Diagnostics unread;
    const auto bytes = read.contains(file) ? text::readFile(file, unread) : std::nullopt;
    const std::uint64_t hash =
        bytes ? text::hashBytes(*bytes)
              : text::hashCombine(
                    fs::file_size(file, ec),
                    static_cast<std::uint64_t>(fs::last_write_time(file, ec).time_since_epoch().count()));
    lines.insert(fmt::format("\n{} {:x}", nameOf(file), hash));
  }
  for (const std::string& line : lines) all += line;
  return session.settings.emplace(text::hashBytes(all));
}

nlohmann::ordered_json statsOf(DeviceSession& session, nlohmann::ordered_json times) {
  const gl::ProgramCacheStats& programs = session.renderer.device().programs.stats();
  const gl::DeviceInfo& device = session.context->device();
  nlohmann::ordered_json out;
  out["device"] = {{"renderer", device.renderer},
                   {"version", device.version},
                   {"platform", device.platform},
                   {"software", device.software}};
  out["times"] = std::move(times);
  out["programs"] = {{"hits", programs.hits},
                     {"misses", programs.misses},
                     {"compilations", programs.compilations},
                     {"refusals", programs.refusals},
                     {"trials", programs.trials},
                     {"binary_loads", programs.binaryLoads},
                     {"binary_rejects", programs.binaryRejects}};
  out["plans_built"] = session.renderer.plansBuilt();
  runtime::Execution* execution = session.renderer.execution();
  if (!execution) return out;
  const graph::Plan& plan = execution->plan();
  out["bytes"] = {{"declared", plan.bytesDeclared},
                  {"allocated", plan.bytesAllocated},
                  {"lower_bound", plan.bytesLowerBound}};
  execution->readBack().finish();
  nlohmann::ordered_json outputs = nlohmann::ordered_json::object();
  for (const runtime::Output& output : execution->readBack().outputs()) {
    nlohmann::ordered_json numbers = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < output.count(); ++i)
      if (output.kind == runtime::NumberKind::floating)
        numbers.push_back(output.number(i));
      else
        numbers.push_back(static_cast<std::int64_t>(output.number(i)));
    outputs[output.name] = std::move(numbers);
  }
  out["outputs"] = std::move(outputs);
  gl::PassTimers& timers = session.renderer.device().timers;
  if (timers.enabled()) {
    timers.finish();
    nlohmann::ordered_json passes;
    for (std::size_t step = 0; step < timers.results().size() && step < plan.steps.size(); ++step) {
      const gl::PassTime& time = timers.results()[step];
      if (time.ran)
        passes.push_back({{"pass", plan.graph->passNames[plan.steps[step].pass]},
                          {"gpu_ms", time.gpu},
                          {"cpu_ms", time.cpu}});
    }
    out["passes"] = std::move(passes);
  }
  return out;
}

std::string closeDevice(std::unique_ptr<DeviceSession> session) {
  const std::unique_ptr<gl::Context> context = std::move(session->context);
  session.reset();
  return gl::liveObjects();
}

}  // namespace weft::app
