// A graph file running on software GL for tests of the whole runtime: one OSMesa context per process, a world
// from a scene file and an environment, a Renderer. Skips the process with exit code 77 when there is no
// context. Does not: judge pictures.
#pragma once

#include <doctest/doctest.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/gl/context/debug.h"
#include "engine/imports/world.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"

namespace weft::runtime::test {

gl::Context& context();

std::string sourcePath(const std::string& relative);
// The same file of graphs/ in a copy of it whose environments have small maps, made in little time: for tests that hold pictures against each
// other, or look at no reflection.
std::string withSmallMaps(const std::string& graph);
// The photographed environment that comes with Weft.
std::shared_ptr<const assets::ImageF> realEnvironment();
World worldOf(const std::string& scene = "scenes/spheres.json");

// Put first in a test case: at its end GL has no error, no message above notification, and no object is left.
class CleanScope {
 public:
  CleanScope() : before_(gl::liveObjects()) { context().debugLog().clear(); }
  ~CleanScope();

 private:
  std::string before_;
};

class Stage {
 public:
  // `graph` relative to the source folder, or absolute.
  explicit Stage(const std::string& graph, std::uint32_t width = 160, std::uint32_t height = 90,
                 const std::string& scene = "scenes/spheres.json", const std::string& cacheFolder = "",
                 std::vector<std::string> presets = {});

  graph::Settings settings;
  World world;
  text::Diagnostics diagnostics;  // of the last load() or frame()

  bool load();                        // reads the file again
  bool apply();                       // does not: the settings alone changed
  void run(std::uint32_t frame = 0);  // headless; requires that nothing is reported
  void run(const FrameInput& input);
  bool ran(std::string_view pass);
  Execution& execution() { return *renderer_->execution(); }
  Renderer& renderer() { return *renderer_; }
  // Floats of a whole level of a resource, four per texel (depth: one).
  std::vector<float> read(const std::string& resource, std::uint32_t mip = 0);
  // The last version of that name that is alive; id 0: there is none.
  gl::TextureRef texture(std::string_view name);
  BufferRef buffer(std::string_view name, std::uint64_t& offset);
  std::vector<std::uint8_t> pixels();  // presented, RGBA, top row first
  float value() { return renderer_->readPresentedFloat()->texels.at(0); }

 private:
  std::unique_ptr<Renderer> renderer_;
};

}  // namespace weft::runtime::test
