// What graphs may name: pass types from the pass registry, and the imports this runtime provides, with what is known of
// them before anything runs. No GL context is needed, so a graph is checked on a machine that has none.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/graph/registry.h"
#include "engine/passes/pass_registry.h"

namespace weft::runtime {

class LutFiles;

// The facts of a scene and an environment that a graph can ask for: size(environment), count(spheres), has(environment).
struct WorldFacts {
  bool environment =
      false;  // one was loaded; otherwise @environment has only its fallback, graphs/daylight.json
  std::uint32_t environmentWidth = 1024, environmentHeight = 512;
  struct List {
    std::string name;  // draw list: "spheres"
    std::uint64_t count = 0;
  };
  std::vector<List> lists;
  friend bool operator==(const WorldFacts&, const WorldFacts&);
};

// `luts` keeps the tables that were read, and must outlive the registry; without, each is read when it is asked for.
graph::Registry makeRegistry(const passes::PassRegistry& passTypes, const WorldFacts& facts,
                             LutFiles* luts = nullptr);

// Levels of a full mip chain of a width x height texture.
std::uint32_t fullMips(std::uint32_t width, std::uint32_t height);

}  // namespace weft::runtime
