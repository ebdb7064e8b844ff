// GL things that outlive a plan: programs, samplers, geometries, what graphs import, timers.
#pragma once

#include <string>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/objects/timers.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/passes/pass_registry.h"
#include "engine/runtime/imports/geometry.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/sampler_cache.h"

namespace weft::runtime {

struct Device {
  // `trial` as in gl::ProgramCache::Options.
  Device(gl::Context& context, std::vector<std::string> shaderRoots, std::string cacheFolder,
         std::vector<std::string> trial = {});
  gl::Context& context;
  gl::SourceLoader sources;
  gl::ProgramCache programs;
  SamplerCache samplers;
  Geometries geometries;
  Imports imports;
  passes::PassRegistry passTypes = passes::PassRegistry::builtin();
  gl::PassTimers timers;
};

}  // namespace weft::runtime
