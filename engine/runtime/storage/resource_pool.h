// The GPU storage of a plan: physical textures with their views, the arena of transient buffers, persistent buffers, and
// for each resource the place where it is now (history rotates among copies). A pool is built from a plan; when the graph
// has changed, storage of the same shape and owner is taken over from the pool before, with its contents.
// Does not: decide what shares (the plan did), write contents other than first values, or know passes.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <unordered_set>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"
#include "engine/graph/plan.h"

namespace weft::runtime {

// One Storage of a plan: `copies` textures of one shape, and the views made of them so far.
class PhysicalTexture {
 public:
  static std::unique_ptr<PhysicalTexture> create(const graph::Storage& storage, const std::string& label,
                                                 base::Diagnostics& diagnostics);
  // The texture itself when the view would be all of it in its own format, else a cached view. Id 0 after an error.
  gl::TextureRef view(std::uint32_t copy, const gl::ViewDesc& desc, base::Diagnostics& diagnostics);
  bool fits(const graph::Storage& storage) const;
  // Equal for textures that fit each other's storage and have one owner.
  std::uint64_t key() const;
  static std::uint64_t keyOf(const graph::Storage& storage, const std::string& owner);
  // Gives a copy away, which must not be used through this object any more.
  gl::Texture take(std::uint32_t copy) { return std::move(textures_[copy]); }
  void collectNames(std::unordered_set<GLuint>& names) const;
  std::uint64_t serial() const { return serial_; }
  std::uint32_t copies() const { return static_cast<std::uint32_t>(textures_.size()); }

  std::string owner;  // resource name of persistent storage, "" for transient

 private:
  struct View {
    std::uint32_t copy = 0;
    gl::ViewDesc desc;
    gl::TextureView view;
  };
  gl::TextureDesc desc_;
  std::string label_;
  std::vector<gl::Texture> textures_;
  std::vector<View> views_;
  std::uint64_t serial_ = 0;
};

struct PersistentBuffer {
  std::string owner;
  std::vector<gl::Buffer> copies;
  std::uint64_t serial = 0;
};

// Where a resource of the graph is stored, and when it was published.
struct GpuResource {
  PhysicalTexture* texture = nullptr;  // null for buffers and imports
  gl::TextureRef imported,
      shown;  // of an import: the newest texture; the one that passes outside `publisher` see
  std::uint32_t publisher =
      graph::kNone;             // of an import: the group whose publication shows it to all other passes
  std::vector<GLuint> buffers;  // per copy
  std::uint64_t offset = 0, bytes = 0;    // range within the buffer
  std::uint32_t copies = 1, current = 0;  // current: the latest publication
  std::uint32_t group =
      graph::kNone;          // the time-sliced group that writes it: its passes see the copy after `current`
  std::uint64_t resets = 0;  // how often its history went back to the first value
  std::uint64_t serial = 0;  // identity of the storage
  std::uint64_t publications = 0;
  double publishedAt = -std::numeric_limits<double>::infinity();
  bool fresh = true;  // storage was made for this plan: contents undefined
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
  // Takes storage that fits out of `before` (which may be null). Null after errors; then `before` has it back.
  static std::unique_ptr<ResourcePool> create(const graph::Plan& plan, ResourcePool* before,
                                              base::Diagnostics& diagnostics);
  // Puts what create() took where it was: this pool is not to be used after all.
  void giveBack(ResourcePool& before);

  std::vector<GpuResource>& resources() { return resources_; }
  GpuResource& operator[](std::size_t resource) { return resources_[resource]; }

  // The GL names of the pool's own textures and their views.
  std::unordered_set<GLuint> textureNames() const;

  // A view of the levels and layers of `use` in the resource's own format. `target` 0: the resource's own target.
  gl::TextureRef view(const graph::Plan& plan, const graph::FlatUse& use, std::uint32_t copy, GLenum target,
                      base::Diagnostics& diagnostics);
  // Fills every copy of a resource of the graph's own with `value`.
  void fill(const graph::Plan& plan, std::uint32_t resource, const graph::Value& value,
            base::Diagnostics& diagnostics);

 private:
  bool createTextures(const graph::Plan& plan, ResourcePool* before, base::Diagnostics& diagnostics);
  void takeTextures(const graph::Plan& plan, const std::vector<std::string>& owners, ResourcePool& before);
  bool createBuffers(const graph::Plan& plan, ResourcePool* before, base::Diagnostics& diagnostics);
  std::vector<std::unique_ptr<PhysicalTexture>> textures_;
  std::vector<PersistentBuffer> buffers_;
  struct Taken {
    std::size_t mine, theirs;  // places in the two pools
  };
  std::vector<Taken> takenTextures_, takenBuffers_;
  bool arenaTaken_ = false;
  gl::Buffer arena_;
  std::uint64_t arenaSerial_ = 0;
  std::vector<GpuResource> resources_;
  std::vector<std::string> names_;  // parallel to resources_
};

// Fill layers of one level of a texture, or a range of a buffer (as floats), with one value.
void clearTexture(const gl::TextureRef& texture, graph::Format format, std::uint32_t mip, std::uint32_t layer,
                  std::uint32_t layers, const graph::Value& value);
void clearBuffer(GLuint buffer, std::uint64_t offset, std::uint64_t bytes, const graph::Value& value);

}  // namespace weft::runtime
