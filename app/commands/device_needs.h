// What the shaders of a graph need of a device, beside what OpenGL 4.5 guarantees on each.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/gl/programs/program.h"

namespace weft::app {

struct DeviceNeed {
  const char* what;          // "fragment storage blocks"
  std::uint32_t guaranteed;  // OpenGL 4.5 core, chapter 23: the least of what depends on the device
  std::uint32_t needed = 0;  // the most that one pass needs
  std::string pass{};        // that pass
};

class DeviceNeeds {
 public:
  // A variant of a pass, and its program.
  void add(const std::string& pass, std::span<const gl::StageSource> stages,
           std::span<const glsl::Define> defines, const gl::Reflection& linked);
  const std::vector<DeviceNeed>& all() const { return all_; }
  // A line for each that something needs.
  std::string text() const;

 private:
  void note(const std::string& what, std::uint32_t needed, const std::string& pass);

  std::vector<DeviceNeed> all_{{"vertex samplers", 16},
                               {"vertex images", 0},
                               {"vertex uniform blocks", 14},
                               {"vertex storage blocks", 0},
                               {"fragment samplers", 16},
                               {"fragment images", 8},
                               {"fragment uniform blocks", 14},
                               {"fragment storage blocks", 8},
                               {"compute samplers", 16},
                               {"compute images", 8},
                               {"compute uniform blocks", 14},
                               {"compute storage blocks", 8},
                               {"images, storage blocks and outputs", 8},
                               {"outputs", 8},
                               {"bytes of a uniform block", 16384},
                               {"threads of a work group", 1024},
                               {"threads of a work group along z", 64}};
};

}  // namespace weft::app
