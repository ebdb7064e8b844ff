// The GPU side of what graphs import from the world: the environment texture, instance tables, draw orders, views.
// Lives across plans; everything is made on first use and renewed when the world's generation moves.
// Does not: decode files (World holds decoded images) or know passes.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"
#include "engine/graph/flat_graph.h"
#include "engine/runtime/imports/environment_texture.h"
#include "engine/runtime/imports/lut_texture.h"
#include "engine/runtime/imports/world.h"
#include "engine/runtime/storage/block_writer.h"
#include "engine/scene/sort.h"

namespace weft::runtime {

struct BufferRef {
  GLuint id = 0;
  std::uint64_t bytes = 0;
};

class Imports {
 public:
  // Takes the frame's inputs; uploads happen in texture() and buffer(). Call once per frame before anything else.
  void beginFrame(const World& world, const FrameInput& input);

  // The environment, or the fallback when none is loaded; id 0 when there is neither.
  gl::TextureRef texture(const graph::ImportSpec& import, base::Diagnostics& diagnostics);
  // For sending the next environment beside the one in use.
  EnvironmentTextures& environments() { return environments_; }
  const EnvironmentTextures& environments() const { return environments_; }
  // What `name` and `name@-1` are to passes that do not take part in making anything of it: an environment is shown from
  // publish() on, other imports at once. After texture().
  gl::TextureRef shown(const graph::ImportSpec& import, base::Diagnostics& diagnostics);
  gl::TextureRef before(const graph::ImportSpec& import, base::Diagnostics& diagnostics);
  void publish(const graph::ImportSpec& import);
  bool isPublished(const graph::ImportSpec& import) const {
    return !hasBefore(import) || environments_.isPublished();
  }
  std::uint64_t publications(const graph::ImportSpec& import) const {
    return hasBefore(import) ? environments_.publications() : 0;
  }
  // Textures of a graph's own that were in the import's place are what it shows and showed before (may be empty), until
  // it is published.
  void adopt(const graph::ImportSpec& import, gl::Texture shown, gl::Texture before) {
    if (import.request.type == "environment") environments_.adopt(std::move(shown), std::move(before));
  }
  // Nobody fades from what was shown before.
  void releaseBefore(const graph::ImportSpec& import) {
    if (hasBefore(import)) environments_.releaseBefore();
  }
  // Used while the world has no environment: a texture made by a graph of its own. Not owned.
  void setEnvironmentFallback(gl::TextureRef texture, std::uint64_t generation);

  // Before a graph is loaded: tables whose file changed are made again on next use, and those unused since the last call go.
  void renewFiles();
  LutFiles& lutFiles() { return lutFiles_; }

  // A buffer import: instance tables need the layout of the block that reads them, draw orders do not.
  BufferRef buffer(const graph::ImportSpec& import, const InstanceLayout& layout,
                   base::Diagnostics& diagnostics);
  BufferRef instances(scene::DrawList list, const InstanceLayout& layout, base::Diagnostics& diagnostics);
  std::uint32_t countOf(scene::DrawList list) const;

  // The camera with its jitter and lens, for a screen of width x height. Null import: the default camera.
  const scene::ViewData& view(const graph::ImportSpec* import, std::uint32_t width, std::uint32_t height);

  // Moves whenever what the import stands for changed.
  std::uint64_t generation(const graph::ImportSpec& import) const;

 private:
  struct Table {
    scene::DrawList list{};
    InstanceLayout layout;
    gl::Buffer buffer;
    std::uint64_t generation = 0;
  };
  struct Order {
    scene::DrawList list{};
    scene::SortMethod method{};
    gl::Buffer buffer;
    std::uint32_t frame = ~0u;
    std::uint64_t generation = 0;
  };
  struct CachedView {
    std::uint32_t jitter = 0, width = 0, height = 0;
    double fovDegrees = 0;  // 0: the scene's
    bool stale = true;
    scene::ViewData data;
  };
  // What is asked of a draw list several times a frame; looking at every sphere each time would cost with a million.
  struct ListFacts {
    std::uint64_t scene = 0;  // generation
    std::uint32_t count = 0;
    bool moving = false;
  };
  const ListFacts& factsOf(scene::DrawList list) const;
  mutable ListFacts lists_[scene::kDrawListCount];

  std::uint64_t listGeneration(scene::DrawList list) const;
  BufferRef order(scene::DrawList list, scene::SortMethod method, base::Diagnostics& diagnostics);
  const std::vector<scene::Instance>& instancesOf(scene::DrawList list);

  struct Lut {
    std::string file;
    std::shared_ptr<const assets::CubeLut> table;  // what the texture holds
    gl::Texture texture;
    std::uint64_t generation = 0;
    bool stale = true;
  };
  bool hasBefore(const graph::ImportSpec& import) const {
    return import.request.type == "environment" && world_->environment();
  }
  gl::TextureRef lut(const std::string& file, base::Diagnostics& diagnostics);
  LutFiles lutFiles_;
  std::vector<Lut> luts_;
  std::uint64_t lutGenerations_ = 0;

  const World* world_ = nullptr;
  FrameInput input_;
  std::uint64_t frames_ = 0;
  EnvironmentTextures environments_;
  gl::TextureRef fallback_;
  std::uint64_t fallbackGeneration_ = 0;
  std::vector<std::unique_ptr<Table>> tables_;
  std::vector<std::unique_ptr<Order>> orders_;
  std::vector<CachedView> views_;
  struct CpuInstances {
    std::vector<scene::Instance> rows;
    std::uint64_t generation = 0;
  };
  CpuInstances cpu_[scene::kDrawListCount];
  std::vector<std::byte> bytes_;
  std::vector<scene::SortElement> elements_, scratch_;
};

}  // namespace weft::runtime
