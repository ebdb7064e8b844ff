// A graph running on software GL for a test: a world built in C++, frames, and textures read back by resource name.
// Skips by process exit code 77 when no context can be made.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/imports/world.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"
#include "tests/theory/environments.h"

namespace weft::theory {

struct Ball {
  glm::vec3 center{0};
  float radius = 1;
  glm::vec3 albedo{1};
  float metallic = 1, roughness = 0.5f;
  glm::vec3 velocity{0};  // units per second
};

struct Setup {
  std::string graph;  // relative to the source folder
  std::uint32_t width = 64, height = 64;
  std::vector<weft::graph::Setting> sets;
  std::vector<weft::graph::Disable> disables;
  std::vector<Ball> balls;
  scene::CameraPose camera{.position = {0, 0, 20}, .target = {0, 0, 0}, .fovDegrees = 60, .nearPlane = 0.1};
  double orbitDegreesPerSecond = 0;                   // of the camera about its target
  std::vector<scene::CameraKey> path{};               // of the camera, instead of an orbit
  std::shared_ptr<const assets::ImageF> environment;  // null: a white one
  bool daylight = false;                              // the computed sky instead
  std::optional<scene::Sun> sun{};
  std::optional<scene::Ground> ground{};
};

struct Picture {
  std::uint32_t width = 0, height = 0, channels = 4;
  std::vector<float> texels;  // row 0 first, as stored
  const float* at(std::uint32_t x, std::uint32_t y) const {
    return &texels[(std::size_t{y} * width + x) * channels];
  }
};

// A lab that is done leaves its programs to the next one of the same graph, and also the maps of an environment that both have, where no
// picture depends on when they were made.
class Lab {
 public:
  explicit Lab(const Setup& setup);
  void frame(std::uint32_t number = 0,
             bool headless = true);  // not headless: work in slices takes its frames
  Picture read(const std::string& resource, std::uint32_t mip = 0, std::uint32_t layer = 0);
  std::vector<std::uint32_t> readBuffer(const std::string& resource, std::size_t words);
  std::string passNames() const;  // of what runs, in order, a line each
  // Everything the driver and the engine said; "" when there is nothing above a note.
  std::string reports();
  const runtime::World& world() const;
  scene::ViewData view() const;
  // The view of a frame at 60 frames per second, with the one before it.
  scene::ViewData viewAt(std::uint32_t number) const;

 private:
  struct Bench;
  struct GiveBack {
    void operator()(Bench* bench) const;
  };
  static std::vector<std::unique_ptr<Bench>>& idleBenches();
  std::unique_ptr<Bench, GiveBack> takeBench();
  void make(bool fresh);

  Setup setup_;
  bool mayKeep_ = false;  // what the lab before made once; set with the bench
  std::unique_ptr<Bench, GiveBack> bench_;
  text::Diagnostics diagnostics_;
};

}  // namespace weft::theory
