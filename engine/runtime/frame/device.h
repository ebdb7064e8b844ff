// What outlives a plan on one GL context: programs, samplers, geometries, pass types, what graphs import, timers.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/objects/timers.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/passes/draw/geometry.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/storage/caches.h"

namespace weft::runtime {

struct Device {
  // `trial` as in gl::ProgramCache::Options.
  Device(gl::Context& c, std::vector<std::string> shaderRoots, std::string cacheFolder,
         std::vector<std::string> trial = {}, PlugIns names = {})
      : context(c),
        sources(std::move(shaderRoots)),
        programs(c.device(), sources, {.folder = std::move(cacheFolder), .trial = std::move(trial)}),
        plugIns(std::move(names)),
        imports(plugIns.imports),
        passTypes(*plugIns.passTypes),
        timers(c.device()) {}
  gl::Context& context;
  glsl::SourceLoader sources;
  gl::ProgramCache programs;
  SamplerCache samplers;
  passes::Geometries geometries;
  const PlugIns plugIns;
  Imports imports;
  const passes::PassRegistry& passTypes;  // of plugIns
  gl::PassTimers timers;
};

}  // namespace weft::runtime
