// A GL context and a renderer on it, as the commands that draw need them.
#pragma once

#include <memory>
#include <optional>

#include <nlohmann/json.hpp>

#include "app/options.h"
#include "engine/gl/context.h"
#include "engine/runtime/renderer.h"

namespace weft::app {

struct DeviceSession {
  std::unique_ptr<gl::Context> context;   // destroyed last
  runtime::Renderer renderer;
};

// Headless unless options.command is "view". Null after errors.
std::unique_ptr<DeviceSession> openDevice(const Options& options, base::Diagnostics& diagnostics);

// --stats: one JSON object on standard error.
void printStats(DeviceSession& session, nlohmann::ordered_json times);

}  // namespace weft::app
