// The imports of graphs on one device: finds the provider of an import, which is made when a graph first asks for it, and
// hands it the frame. Outlives plans.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>

#include "engine/gl/objects/objects.h"
#include "engine/graph/flat_graph.h"
#include "engine/imports/camera/camera.h"
#include "engine/imports/import.h"
#include "engine/imports/scene_tables.h"
#include "engine/text/diagnostic.h"
#include "engine/text/files/file_cache.h"

namespace weft::runtime {

using imports::BufferRef;
using imports::FrameInput;
using imports::headlessFrame;
using imports::RowLayout;
using imports::World;
using imports::WorldFacts;

class Imports : public imports::Providers {
 public:
  explicit Imports(std::shared_ptr<const imports::ImportRegistry> registry)
      : registry_(std::move(registry)) {}
  Imports(const Imports&) = delete;
  Imports& operator=(const Imports&) = delete;

  // To be called before a plan is made. Files are checked for changes on their next use, providers that no graph has asked
  // for since the last call are destroyed, and those that `graph` asks for are made.
  void prepare(const graph::FlatGraph& graph);
  imports::Files& files() { return files_; }

  // Takes the frame's inputs; uploads happen in texture() and buffer(). Call once per frame before anything else.
  void beginFrame(const World& world, const FrameInput& input);

  imports::Provider& of(const graph::ImportSpec& import) { return use(heldOf(import)); }
  // For the functions of providers.
  imports::Frame frame() { return {*world_, input_, frames_, files_, tables_, camera_, *this, generations_}; }
  // What stands in for a texture included.
  gl::TextureRef texture(const graph::ImportSpec& import, text::Diagnostics& diagnostics) {
    const gl::TextureRef texture = of(import).texture(frame(), diagnostics);
    return texture.id != 0 ? texture : heldOf(import).standIn;
  }
  // What a pass whose attachments have this size is seen from: its view, else the scene's camera as it is. A camera's is of
  // the screen of the pass.
  const scene::ViewData& view(const graph::FlatGraph& graph, const graph::PassSpec& spec, std::uint32_t width,
                              std::uint32_t height);
  std::uint64_t generation(const graph::ImportSpec& import) { return of(import).generation(frame()); }

  // The draw lists, for draw passes, whether or not a graph imports them.
  imports::SceneTables& tables() { return tables_; }

  // Something that `graph` imports is on its way.
  bool isPending(const graph::FlatGraph& graph, const World& world);
  // `texture` must live as long as the provider.
  void setStandIn(const graph::ImportSpec& import, gl::TextureRef texture) {
    heldOf(import).standIn = texture;
  }

 private:
  struct Held {
    std::uint64_t key = 0;
    std::unique_ptr<imports::Provider> provider;
    gl::TextureRef standIn;  // id 0: there is none
    bool used = false;
  };
  Held& hold(const graph::ImportRequest& request, std::uint64_t key);
  Held& heldOf(const graph::ImportRequest& request, std::uint64_t key) {
    for (Held& each : held_)
      if (each.key == key) return each;
    return hold(request, key);
  }
  Held& heldOf(const graph::ImportSpec& import) { return heldOf(import.request, import.key); }
  imports::Provider& of(const graph::ImportRequest& request, std::uint64_t key) override {
    return use(heldOf(request, key));
  }
  static imports::Provider& use(Held& held) {
    held.used = true;
    return *held.provider;
  }

  std::shared_ptr<const imports::ImportRegistry> registry_;
  std::deque<Held> held_;  // stays in place while another is made for it
  const World* world_ = nullptr;
  FrameInput input_;
  std::uint64_t frames_ = 0, generations_ = 0;
  imports::Files files_;
  imports::SceneTables tables_;
  imports::CameraProvider camera_;
};

}  // namespace weft::runtime
