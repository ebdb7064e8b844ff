// The GPU storage of a plan: physical textures with their views, the arena of transient buffers, persistent buffers, and
// for each resource the place where it is now (history rotates among copies). A pool is built from a plan; when the graph
// has changed, it shares storage of the same shape and owner with the pool before, until one of the two is destroyed.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/graph/plan.h"
#include "engine/runtime/storage/state_stream.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

// One Storage of a plan: `copies` textures of one shape, and the views made of them so far.
class PhysicalTexture {
 public:
  // `owner`: the resource of persistent storage, "" for transient. Null after errors.
  static std::shared_ptr<PhysicalTexture> create(const graph::Storage& storage, std::string owner,
                                                 const std::string& label, text::Diagnostics& diagnostics);
  // The texture itself when the view would be all of it in its own format, else a cached view. Id 0 after an error.
  gl::TextureRef view(std::uint32_t copy, const gl::ViewDesc& desc, text::Diagnostics& diagnostics);
  bool fits(const graph::Storage& storage, const std::string& owner) const;
  const gl::Texture& texture(std::uint32_t copy) const { return textures_[copy]; }
  std::uint64_t serial() const { return serial_; }
  std::uint32_t copies() const { return static_cast<std::uint32_t>(textures_.size()); }

 private:
  struct View {
    std::uint32_t copy = 0;
    gl::ViewDesc desc;
    gl::Texture view;
  };
  gl::TextureDesc desc_;
  std::string owner_, label_;
  std::vector<gl::Texture> textures_;
  std::vector<View> views_;
  std::uint64_t serial_ = 0;
};

// The copies of a persistent buffer, or the one arena of transient buffers.
struct PhysicalBuffer {
  std::vector<gl::Buffer> copies;
  std::uint64_t serial = 0;
};

// Where a resource of the graph is stored, and when it was published.
struct GpuResource {
  std::shared_ptr<PhysicalTexture> texture;  // null for buffers and imports
  // Of an import: the newest texture; the one that passes outside `publisher` see, and what keeps that alive.
  gl::TextureRef imported, shown;
  std::shared_ptr<const gl::Texture> held;
  std::uint64_t shows = 0;  // how often a publication showed another one
  // Of an import: the group whose publication shows it to all other passes.
  std::uint32_t publisher = graph::kNone;
  std::shared_ptr<PhysicalBuffer> buffer;  // null for textures and imports
  std::vector<GLuint> buffers;             // its names, per copy
  std::uint64_t offset = 0, bytes = 0;     // range within the buffer
  std::uint32_t copies = 1, current = 0;   // current: the latest publication
  std::uint32_t group =
      graph::kNone;          // the time-sliced group that writes it: its passes see the copy after `current`
  std::uint64_t resets = 0;  // how often its history went back to the first value
  std::uint64_t serial = 0;  // identity of the storage
  std::uint64_t publications = 0;
  double publishedAt = -std::numeric_limits<double>::infinity();
  bool fresh = true;                    // storage was made for this plan: contents undefined
  std::uint32_t before = graph::kNone;  // in the pool before: the one of that name that lies where this lies
  const gl::TextureRef& importedFor(std::uint32_t reader) const {
    return publisher != graph::kNone && publisher == reader ? imported : shown;
  }
  // The copy that passes of `reader` (a group, or kNone) see.
  std::uint32_t copyOf(std::uint32_t history, std::uint32_t reader = graph::kNone) const {
    const std::uint32_t newest = current + (group != graph::kNone && group == reader ? 1 : 0);
    return (newest + copies - history % copies) % copies;
  }
  // Whether @-history, as passes of `reader` see it, was published since the first frame or the last reset.
  bool hasPublication(std::uint32_t history, std::uint32_t reader) const {
    return publications + (group != graph::kNone && group == reader ? 1 : 0) > history;
  }
};

class ResourcePool {
 public:
  // Shares storage that fits with `before` (which may be null). Null after errors.
  static std::unique_ptr<ResourcePool> create(const graph::Plan& plan, const ResourcePool* before,
                                              text::Diagnostics& diagnostics);

  GpuResource& operator[](std::size_t resource) { return resources_[resource]; }
  const GpuResource& operator[](std::size_t resource) const { return resources_[resource]; }

  // A view of the levels and layers of `use` in the resource's own format. `target` 0: the resource's own target.
  gl::TextureRef view(const graph::Plan& plan, const graph::FlatUse& use, std::uint32_t copy, GLenum target,
                      text::Diagnostics& diagnostics);
  // All of a resource in its own format and target.
  gl::TextureRef whole(const graph::Plan& plan, std::uint32_t resource, std::uint32_t copy,
                       text::Diagnostics& diagnostics);
  // Fills every copy of a resource of the graph's own with `value`.
  void fill(const graph::Plan& plan, std::uint32_t resource, const graph::Value& value,
            text::Diagnostics& diagnostics);

  // Saves or restores what the resources hold from frame to frame, to the bit, and what is known of it.
  void carry(const graph::Plan& plan, StateStream& state, text::Diagnostics& diagnostics);

 private:
  void carryContents(const graph::Plan& plan, std::uint32_t resource, StateStream& state,
                     text::Diagnostics& diagnostics);
  using Textures = std::vector<std::shared_ptr<PhysicalTexture>>;  // per storage of the plan
  bool createTextures(const graph::Plan& plan, const ResourcePool* before, text::Diagnostics& diagnostics);
  void shareTextures(const graph::Plan& plan, const std::vector<std::string>& owners,
                     const ResourcePool& before, Textures& textures) const;
  bool createArena(const graph::Plan& plan, const ResourcePool* before, text::Diagnostics& diagnostics);
  bool createBuffers(const graph::Plan& plan, const ResourcePool* before, text::Diagnostics& diagnostics);
  void findNames(const ResourcePool& before);
  void continueFrom(const ResourcePool& before);

  std::vector<GpuResource> resources_;
  std::vector<std::string> names_;  // parallel to resources_
  std::shared_ptr<PhysicalBuffer> arena_;
};

// Fill layers of one level of a texture, or a range of a buffer (as floats), with one value.
void clearTexture(const gl::TextureRef& texture, graph::Format format, std::uint32_t mip, std::uint32_t layer,
                  std::uint32_t layers, const graph::Value& value);
void clearBuffer(GLuint buffer, std::uint64_t offset, std::uint64_t bytes, const graph::Value& value);

}  // namespace weft::runtime
