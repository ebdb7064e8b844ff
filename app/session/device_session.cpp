#include "app/session/device_session.h"

#include <algorithm>
#include <cstdlib>

#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/gl/objects/objects.h"
#include "engine/text/files/file_access.h"

namespace weft::app {

namespace {

std::string cacheFolderOf(const Options& options) {
  if (options.cacheFolder == "none") return {};
  if (!options.cacheFolder.empty()) return options.cacheFolder;
  if (const char* folder = std::getenv("XDG_CACHE_HOME"); folder && *folder)
    return std::string(folder) + "/weft/programs";
  if (const char* home = std::getenv("HOME"); home && *home)
    return std::string(home) + "/.cache/weft/programs";
  return {};
}

}  // namespace

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

namespace {

// A world and a device, unless a graph of `all` is wrong. What is missing is reported.
std::optional<Opened> openStage(std::span<const Options> all, int wrong, text::Diagnostics& diagnostics,
                                int& exitCode) {
  const Options& options = all.front();
  auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  exitCode = wrong;
  const auto isRight = [&](const Options& each) { return !isWrong(each, facts, diagnostics); };
  if (!world || diagnostics.hasErrors()) {
    makePlan(options, facts, true, diagnostics);
  } else if (std::ranges::all_of(all, isRight)) {
    if (auto session = openDevice(options, diagnostics)) return Opened{*std::move(world), std::move(session)};
    makePlan(options, facts, true, diagnostics);  // one that came by a pipe
    exitCode = 3;
  }
  report(diagnostics);
  return std::nullopt;
}

}  // namespace

std::optional<Opened> openGraph(const Options& options, text::Diagnostics& diagnostics, int& exitCode) {
  auto stage = openStage({&options, 1}, 1, diagnostics, exitCode);
  if (!stage) return std::nullopt;
  const bool software = stage->session->context->device().software;
  if (stage->session->renderer.load(settingsOf(options, software), stage->world, diagnostics)) return stage;
  report(diagnostics);
  return std::nullopt;
}

int runOnDevice(std::span<const Options> all, int wrong,
                const std::function<int(gl::Context&, const runtime::World&, text::Diagnostics&)>& run) {
  text::Diagnostics diagnostics;
  int exitCode = 0;
  const auto stage = openStage(all, wrong, diagnostics, exitCode);
  if (!stage) return exitCode;
  const int code = run(*stage->session->context, stage->world, diagnostics);
  return report(diagnostics) ? wrong : code;
}

std::vector<std::string> filesReadBy(const Options& options, const runtime::Renderer& renderer,
                                     const runtime::World& world) {
  std::vector<std::string> files = renderer.files();
  files.insert(files.end(), world.scene().files.begin(), world.scene().files.end());
  for (const std::string& file : {options.graph, scenePathOf(options), options.environment})
    files.push_back(file);
  return files;
}

bool checkPresents(const Options& options, runtime::Renderer& renderer, text::Diagnostics& diagnostics) {
  if (renderer.execution()->presented().id != 0) return true;
  diagnostics
      .error(text::Code::presentsNothing, {std::make_shared<const std::string>(options.graph), 1, 1},
             "the graph presents nothing to write")
      .hint = "add \"present\": \"<texture>\", and enable a pass that writes it";
  return false;
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

void printStats(const nlohmann::ordered_json& stats) {
  printError(dumpJson(stats) + "\n");
}

std::string closeDevice(std::unique_ptr<DeviceSession> session) {
  const std::unique_ptr<gl::Context> context = std::move(session->context);
  session.reset();
  return gl::toText(gl::liveObjects());
}

}  // namespace weft::app
