// What each backend offers to createContext (context.cpp); not for other rooms. An opener makes its context
// current or appends to `failures` one line per thing it tried: "EGL device 0 (/dev/dri/card0): eglInitialize
// failed (…)".
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/gl/context/context.h"

namespace weft::gl {

using GlFunction = void (*)();
using GlLoader = GlFunction (*)(const char* name);

struct OpenedContext {
  std::unique_ptr<Context> context;  // null: nothing could be opened
  GlLoader load = nullptr;
  std::string platform;  // DeviceInfo::platform
};

OpenedContext openOsmesa(const ContextOptions& options, std::vector<std::string>& failures);
OpenedContext openGlfw(const ContextOptions& options, std::vector<std::string>& failures);
// Hardware devices, then, unless hardwareOnly, software devices.
OpenedContext openEgl(const ContextOptions& options, bool hardwareOnly, std::vector<std::string>& failures);

}  // namespace weft::gl
