// Makes of the command-line options what every command begins with: world, plan; context and renderer.
#pragma once

#include <initializer_list>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/session/options.h"
#include "engine/gl/context/context.h"
#include "engine/graph/plan.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/imports/imports.h"
#include "engine/scene/files/scene_file.h"
#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"

namespace weft::app {

using text::dataFolder;

// A file or folder of Weft's in a person's folder: that of the variable, else the one in the home folder; "" where there is neither.
std::string userFile(const char* variable, const char* inHome, const std::string& name);

constexpr const char* kPresets = "/graphs/presets";  // the bundled ones, in the data folder
// Where a preset's name is looked for, the first first: `own` (--preset-folder) unless it is empty, the user's folder
// ($XDG_CONFIG_HOME/weft/presets, else ~/.config/weft/presets), the bundled ones. They need not be there.
std::vector<std::string> presetFolders(const std::string& own);

// The file of a preset. A word that is no file here is a name in one of the folders; one that is nowhere, of the bundled ones.
std::string presetFile(const std::string& preset, const std::string& own);

graph::Settings settingsOf(const Options& options, bool software, bool window = false);

// Path of the scene file: the one the options name, or the bundled one.
std::string scenePathOf(const Options& options);

// The scene and the environment that the options name. Returns when both are read.
std::optional<runtime::World> loadWorld(const Options& options, text::Diagnostics& diagnostics);

// Facts for checks that go on although the scene could not be read: every draw list exists and is empty.
runtime::WorldFacts factsWithoutWorld();

// Reads, expands and compiles. Null after errors.
std::shared_ptr<const graph::Plan> makePlan(const Options& options, const runtime::WorldFacts& facts,
                                            bool software, text::Diagnostics& diagnostics);

// The same with the world of the options; without one, when the scene cannot be read.
std::shared_ptr<const graph::Plan> planOf(const Options& options, text::Diagnostics& diagnostics);

// Whether the graph is wrong on every device, which `diagnostics` then says. Asked before OpenGL is opened, which takes longer.
bool isWrong(const Options& options, const runtime::WorldFacts& facts, text::Diagnostics& diagnostics);

// Checks the shaders of a pass against it by what they declare, without OpenGL. Why a file cannot be read is said once, in `unread`.
// Each file is looked for once: `loaded` has it from then on, or null.
using LoadedSources = std::map<std::string, std::shared_ptr<const glsl::ShaderSource>>;
void checkDeclared(const graph::Plan& plan, std::uint32_t pass, const gl::ProgramRequest& request,
                   glsl::SourceLoader& sources, LoadedSources& loaded, text::Diagnostics& unread,
                   text::Diagnostics& said);

// Prints the diagnostics to standard error, with or without notes. Of very many it prints only some
// (engine/text/json/report.h). Returns 1 when there is an error among them, else 0.
int report(text::Diagnostics& diagnostics, bool notes = true);

// ---- on a device ----

struct DeviceSession {
  std::unique_ptr<gl::Context> context;  // destroyed last
  runtime::Renderer renderer;
  std::optional<std::uint64_t> settings{};  // hashOfSettings, once it was asked for
};

// A context alone, and what a renderer on it takes from the options.
std::unique_ptr<gl::Context> openContext(const Options& options, text::Diagnostics& diagnostics);
runtime::Renderer::Options rendererOptionsOf(const Options& options);

// Headless unless options.window. Null after errors.
std::unique_ptr<DeviceSession> openDevice(const Options& options, text::Diagnostics& diagnostics);

// Runs a headless command: calls `run` with a device that has loaded no graph yet and a world, and reports. `wrong`: the exit code after
// errors; a graph of `all` that is wrong is refused before OpenGL is opened. 3 without OpenGL. The first of `all` says which world.
using DeviceRun = std::function<int(std::unique_ptr<DeviceSession>&, runtime::World&, text::Diagnostics&)>;
int runOnDevice(std::initializer_list<const Options*> all, int wrong, const DeviceRun& run);

// A frame as `weft render` draws it. What the driver says goes to `diagnostics`, too.
runtime::FrameReport drawFrame(runtime::Renderer& renderer, const runtime::World& world,
                               const Options& options, std::uint32_t frame, text::Diagnostics& diagnostics);

// False after W188: the graph presents nothing.
bool checkPresents(const Options& options, runtime::Renderer& renderer, text::Diagnostics& diagnostics);

// A hash of all that decides pixels, once the graph is loaded: the bytes of the files that were read (of pictures of a sequence their
// size and time), options, this program and the driver. Paths count as they are seen from the graph.
std::uint64_t hashOfSettings(const Options& options, DeviceSession& session);
std::uint64_t hashOfProgram();  // of its bytes

// --stats: one JSON object. Waits for the outputs of the last frame.
nlohmann::ordered_json statsOf(DeviceSession& session, nlohmann::ordered_json times);

// Destroys renderer and context; in between asks the driver which objects still exist: "none", unless one was forgotten.
std::string closeDevice(std::unique_ptr<DeviceSession> session);

}  // namespace weft::app
