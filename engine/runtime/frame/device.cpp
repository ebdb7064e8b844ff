#include "engine/runtime/frame/device.h"

#include <utility>

namespace weft::runtime {

Device::Device(gl::Context& c, std::vector<std::string> shaderRoots, std::string cacheFolder,
               std::vector<std::string> trial, PlugIns plugIns_)
    : context(c),
      sources(std::move(shaderRoots)),
      programs(c.device(), sources,
               {.capacity = 32, .folder = std::move(cacheFolder), .trial = std::move(trial)}),
      plugIns(std::move(plugIns_)),
      imports(plugIns.imports),
      passTypes(*plugIns.passTypes),
      timers(c.device()) {}

}  // namespace weft::runtime
