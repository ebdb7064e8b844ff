// An import: something that graphs take from outside (`@environment`, `{ "import": "camera" }`). A plug-in says what a graph
// may write of it (reflect), what is known before anything runs (facts), and makes the Provider that gives it to passes
// frame after frame (provide). Plug-ins hold no state and are shared by devices; what a provider holds is of one device.
// Nothing outside the folder of a plug-in knows its name. To add one: a folder here, a class, a line in import_registry.cpp.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"
#include "engine/graph/registry.h"
#include "engine/imports/frame.h"
#include "engine/imports/row_layout.h"
#include "engine/imports/world.h"
#include "engine/scene/camera.h"

namespace weft::imports {

class Files;

// What a pass looks from: `@lamps[element].face[face]`, in a picture of width x height pixels.
struct ViewPart {
  std::uint32_t width = 1, height = 1;
  std::uint16_t element = 0, face = 0;
};

// What one request (a type and its arguments) stands for, on one device. Most types give one of texture(), buffer() and
// view(), as their ImportKind says; events give a generation alone. Called within a frame where a Frame is an argument.
class Provider {
 public:
  virtual ~Provider() = default;

  // What is newest. Id 0: there is nothing.
  virtual gl::TextureRef texture(const Frame&, base::Diagnostics&) { return {}; }
  // `layout` is for types that reflect `columns`: how the reading shader lays a row out.
  virtual BufferRef buffer(const Frame&, const RowLayout& layout, base::Diagnostics&);
  // Valid until the next call.
  virtual const scene::ViewData& view(const Frame& frame, const ViewPart& part);
  // Moves whenever what it stands for changed; passes that are `on_change` run then, and histories that it resets begin
  // again. Unless overridden: in every frame.
  virtual std::uint64_t generation(const Frame& frame) { return frame.number; }

  // Whether it is the same in every frame of a world that nobody changes.
  virtual bool isStill(const World&) const { return false; }
  // Whether it depends on which frames ran before this one: it is no function of World and FrameInput.
  virtual bool remembers(const World&) const { return false; }

  // What passes see of a texture that is shown later than it changes, together with what was made of it: the newest of the
  // last publish(), and before that. Types that are shown at once leave these as they are.
  virtual gl::TextureRef shown(const Frame& frame, base::Diagnostics& said) { return texture(frame, said); }
  virtual gl::TextureRef before(const Frame& frame, base::Diagnostics& said) { return texture(frame, said); }
  virtual void publish(const Frame&) {}
  virtual bool isPublished(const Frame&) const { return true; }
  virtual std::uint64_t publications(const Frame&) const { return 0; }
  // Nobody reads before() any more.
  virtual void releaseBefore(const Frame&) {}
  // Textures of a graph's own that were in its place are what it shows and showed before (may be empty), until publish().
  virtual void adopt(gl::Texture, gl::Texture) {}

  // On its way: pictures of graphs that read it stay black until it is there.
  virtual bool isPending(const World&) const { return false; }
  // Whether the world lacks it, so that Import::standInGraph() is to stand in.
  virtual bool needsStandIn(const World&) const { return false; }
  // The picture of that graph. Not owned; stays.
  virtual void setStandIn(gl::TextureRef) {}

  // Before a graph is prepared: files may have changed. `used`: somebody asked for it since the last call. False: it goes.
  virtual bool renew(bool used) { return used; }
  // Frees what the world holds of it and the device has.
  virtual void dropUploaded(World&) const {}
};

class Import {
 public:
  virtual ~Import() = default;
  virtual graph::ImportType reflect() const = 0;
  // Called while graphs are expanded, without a device. `files`: what it is read from goes through here, so that it is
  // watched and read once. Unless overridden: it is there.
  virtual graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                                   Files& files) const;
  // A graph whose picture stands in for a texture that the world lacks, from the folder that holds graphs/; empty: none.
  virtual std::string standInGraph() const { return {}; }
  // Makes no GL call: a request may never be used.
  virtual std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const = 0;
};

}  // namespace weft::imports
