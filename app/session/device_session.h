// A GL context and a renderer on it, as the commands that draw need them.
#pragma once

#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/session/options.h"
#include "engine/gl/context/context.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"

namespace weft::app {

struct DeviceSession {
  std::unique_ptr<gl::Context> context;  // destroyed last
  runtime::Renderer renderer;
};

// A context alone, and what a renderer on it takes from the options.
std::unique_ptr<gl::Context> openContext(const Options& options, text::Diagnostics& diagnostics);
runtime::Renderer::Options rendererOptionsOf(const Options& options);

// Headless unless options.window. Null after errors.
std::unique_ptr<DeviceSession> openDevice(const Options& options, text::Diagnostics& diagnostics);

// What a headless command begins with: the world, a device, and the graph loaded on it. Nothing after a failure, which is
// reported by then; `exitCode` is that of the command. The graph's own mistakes are reported in any case.
struct Opened {
  runtime::World world;
  std::unique_ptr<DeviceSession> session;
};
std::optional<Opened> openGraph(const Options& options, text::Diagnostics& diagnostics, int& exitCode);

// The same for a command that makes renderers of its own: calls `run`, which returns the exit code, with a context and a world, and
// reports. `wrong`: the exit code after errors; a graph of `all` that is wrong is refused before OpenGL is opened. 3 without
// OpenGL. The first of `all` says which world and which device.
int runOnDevice(std::span<const Options> all, int wrong,
                const std::function<int(gl::Context&, const runtime::World&, text::Diagnostics&)>& run);

// What the run reads, once the graph is loaded: none of it is to be written over.
std::vector<std::string> filesReadBy(const Options& options, const runtime::Renderer& renderer,
                                     const runtime::World& world);

// False after W188: the graph presents nothing.
bool checkPresents(const Options& options, runtime::Renderer& renderer, text::Diagnostics& diagnostics);

// --stats: one JSON object. Waits for the outputs of the last frame.
nlohmann::ordered_json statsOf(DeviceSession& session, nlohmann::ordered_json times);
void printStats(const nlohmann::ordered_json& stats);  // on standard error

// Destroys the renderer, then asks the driver which objects still exist: "none", unless one was forgotten.
// The context goes last. What the overlay made must be gone by then.
std::string closeDevice(std::unique_ptr<DeviceSession> session);

}  // namespace weft::app
