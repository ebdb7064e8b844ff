// Runs a graph file on a device: reads, expands, compiles and prepares it, then runs frame after frame. Loading replaces
// the running graph only when the new one has no error; after an error the last good execution goes on.
// Of the runtime this and what it includes is installed for embedders (cmake/install.cmake).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/assets/images/image.h"
#include "engine/gl/context/context.h"
#include "engine/gl/objects/objects.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/imports/import.h"
#include "engine/imports/world.h"
#include "engine/passes/pass_type.h"

namespace weft::runtime {

using imports::FrameInput;
using imports::headlessFrame;
using imports::World;

// What graphs may name: pass types and imports, of plug-ins that an embedder may add to. Never null.
struct PlugIns {
  std::shared_ptr<const passes::PassRegistry> passTypes =
      std::make_shared<const passes::PassRegistry>(passes::PassRegistry::builtin());
  std::shared_ptr<const imports::ImportRegistry> imports =
      std::make_shared<const imports::ImportRegistry>(imports::ImportRegistry::builtin());
};

// These and the draw lists of a world: a graph is checked by them on a machine without OpenGL. `files` keeps what imports
// were read from, and must outlive the registry; without, it is read whenever it is asked for.
graph::Registry makeRegistry(const PlugIns& plugIns, const imports::WorldFacts& facts,
                             imports::Files* files = nullptr);
// What a frame did.
struct FrameReport {
  std::uint32_t passesRun = 0, passesSkipped = 0, barriers = 0;
  std::uint32_t slowRun = 0;  // how many of passesRun are not `always`
};

struct Device;
class Execution;
enum class ShaderFiles : std::uint8_t;

// Where a graph's shaders are looked for: beside each of its files and beside that file's folder, in the order of
// GraphDesc::files (the graph, what it extends, presets, includes), then the bundled ones.
std::vector<std::string> shaderRootsOf(std::span<const std::string> files, const std::string& dataFolder);

// The picture in 8 bits, as readPresented8() gives it: values are clamped to 0 and 1, NaN becomes 0, missing alpha 1.
assets::Image8 toBytes(const assets::ImageF& picture);

class Renderer {
 public:
  struct Options {
    std::string dataFolder;              // holds graphs/ and shaders/
    std::string cacheFolder;             // of program binaries; empty: none
    std::vector<std::string> trial{};    // starts a process that tries a large shader; empty: none
    std::vector<std::string> presets{};  // overlays laid over the graph whenever it is read, in order
    PlugIns plugIns{};                   // pass types and imports that graphs may name
    graph::CompileOptions compile{};     // another order or storage, for those who test plans
  };
  Renderer(gl::Context& context, const std::string& graphPath, Options options);
  ~Renderer();

  // Another graph and other overlays, from the next load() on.
  void setFiles(std::string graphPath, std::vector<std::string> presets) {
    graphPath_ = std::move(graphPath);
    options_.presets = std::move(presets);
  }
  // Reads the graph file again and switches to it. False after errors.
  bool load(const graph::Settings& settings, const World& world, text::Diagnostics& diagnostics);
  // Reads no file: runs the last description under other settings or in another world. Passes that do not change keep their
  // programs, whatever is on disk.
  bool apply(const graph::Settings& settings, const World& world, text::Diagnostics& diagnostics);
  // Sets a live parameter at once, as FrameUniforms::set() does.
  bool setParameter(std::string_view path, const graph::Value& value);
  // The settings that the graph of the last load() does not take; empty when there was no error.
  std::span<const graph::Refusal> refused() const { return refused_; }
  // The files to watch (graphs, shaders, includes, tables): those of the running graph, and those that the last load() or
  // apply() read or did not find.
  std::vector<std::string> files() const;
  // The numbers of one of the graph's live "outputs", the latest that have arrived, which are one or a few frames old; empty
  // when there is none of that name.
  std::vector<double> output(std::string_view name) const;
  // Runs nothing and presents black while an import of the graph is still being loaded (World::expectEnvironment).
  FrameReport frame(const World& world, const FrameInput& input, text::Diagnostics& diagnostics);

  Execution* execution() { return execution_.get(); }
  // The running graph, as it was read; null before the first load().
  const graph::GraphDesc* desc() const { return desc_.get(); }
  std::span<const std::string> presets() const { return options_.presets; }
  Device& device() { return *device_; }
  const std::string& graphPath() const { return graphPath_; }
  // Graphs compiled to plans so far, also those that could not be prepared.
  std::uint64_t plansBuilt() const { return plansBuilt_; }

  // The presented picture with its top row first. Empty when the graph presents nothing.
  std::optional<assets::Image8> readPresented8();
  std::optional<assets::ImageF> readPresentedFloat();
  // Copies the presented texture to framebuffer 0 (a window's), bit for bit when the sizes agree. Leaves framebuffer 0
  // bound, after gl::releaseBindings(). `x`, `y`: its lower left corner there.
  void present(std::uint32_t width, std::uint32_t height, std::uint32_t x = 0, std::uint32_t y = 0);

 private:
  bool switchTo(std::shared_ptr<const graph::GraphDesc> desc, ShaderFiles files,
                const graph::Settings& settings, const World& world, text::Diagnostics& diagnostics);
  std::unique_ptr<Execution> makeExecution(const graph::GraphDesc& desc, ShaderFiles files,
                                           const graph::Settings& settings, const World& world,
                                           text::Diagnostics& diagnostics);
  bool prepareStandIns(const graph::FlatGraph& graph, const World& world, text::Diagnostics& diagnostics);
  const graph::Registry& registryOf(const World& world);
  void blackOut();

  std::string graphPath_;
  Options options_;
  std::unique_ptr<Device> device_;
  graph::Registry registry_;  // of the device's plug-ins
  std::unique_ptr<Execution> execution_;
  std::shared_ptr<const graph::GraphDesc> desc_;  // what runs
  std::vector<std::string> runningFiles_, triedFiles_;
  std::vector<graph::Refusal> refused_;
  // Graphs whose pictures replace imports that the world lacks. Each has run one frame.
  std::map<std::string, std::unique_ptr<Renderer>> standIns_;
  gl::Framebuffer presentSource_;
  GLuint presentTexture_ = 0;
  std::uint64_t plansBuilt_ = 0;
};

}  // namespace weft::runtime
