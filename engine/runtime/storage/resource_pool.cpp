#include "engine/runtime/storage/resource_pool.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "engine/base/hash.h"
#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

using graph::FlatResource;
using graph::FlatUse;
using graph::kNone;
using graph::Plan;
using graph::ResourceKind;
using graph::Storage;

namespace {

// Storage identities: unique within the process, never reused.
std::uint64_t nextSerial() {
  static std::atomic<std::uint64_t> counter{1};
  return counter++;
}

gl::TextureDesc descOf(const Storage& s) {
  return {.target = glTargetOf(s.target),
          .format = glFormatOf(s.format).internal,
          .width = s.width,
          .height = s.height,
          .depth = s.depth,
          .layers = s.layers,
          .mips = s.mips,
          .samples = s.samples};
}

bool isTexture(const FlatResource& r) {
  return r.kind == ResourceKind::texture;
}

}  // namespace

std::unique_ptr<PhysicalTexture> PhysicalTexture::create(const Storage& storage, const std::string& label,
                                                         base::Diagnostics& diagnostics) {
  auto made = std::make_unique<PhysicalTexture>();
  made->desc_ = descOf(storage);
  made->label_ = label;
  made->serial_ = nextSerial();
  for (std::uint32_t copy = 0; copy < storage.copies; ++copy) {
    auto texture = gl::Texture::create(made->desc_, label, diagnostics);
    if (!texture) return nullptr;
    made->textures_.push_back(std::move(*texture));
  }
  return made;
}

namespace {

std::uint64_t hashOf(const gl::TextureDesc& desc, std::uint32_t copies, const std::string& owner) {
  std::uint64_t hash = base::hashBytes(owner);
  for (const std::uint64_t part :
       {std::uint64_t{desc.target}, std::uint64_t{desc.format}, std::uint64_t{desc.width},
        std::uint64_t{desc.height}, std::uint64_t{desc.depth}, std::uint64_t{desc.layers},
        std::uint64_t{desc.mips}, std::uint64_t{desc.samples}, std::uint64_t{copies}})
    hash = base::hashCombine(hash, part);
  return hash;
}

}  // namespace

std::uint64_t PhysicalTexture::key() const {
  return hashOf(desc_, copies(), owner);
}

std::uint64_t PhysicalTexture::keyOf(const Storage& storage, const std::string& owner) {
  return hashOf(descOf(storage), storage.copies, owner);
}

bool PhysicalTexture::fits(const Storage& storage) const {
  return storage.copies == copies() && descOf(storage) == desc_;
}

gl::TextureRef PhysicalTexture::view(std::uint32_t copy, const gl::ViewDesc& desc,
                                     base::Diagnostics& diagnostics) {
  const gl::Texture& texture = textures_[copy];
  const bool whole = desc.target == desc_.target && (desc.format == 0 || desc.format == desc_.format) &&
                     !desc.stencil && desc.mip == 0 && desc.mips == desc_.mips && desc.layer == 0 &&
                     desc.layers == desc_.layers;
  if (whole) return texture.ref();
  for (const View& view : views_)
    if (view.copy == copy && view.desc == desc) return view.view.ref();
  auto made = gl::TextureView::create(texture.ref(), desc, label_, diagnostics);
  if (!made) return {};
  views_.push_back({copy, desc, std::move(*made)});
  return views_.back().view.ref();
}

namespace {

// The largest of the buffers that share the arena; kNone when there are none.
std::uint32_t largestTransientOf(const Plan& plan) {
  std::uint32_t largest = kNone;
  for (std::uint32_t r = 0; r < plan.bufferOffsetOf.size(); ++r)
    if (plan.bufferOffsetOf[r] != Plan::kNoOffset &&
        (largest == kNone || plan.graph->resources[r].bytes > plan.graph->resources[largest].bytes))
      largest = r;
  return largest;
}

// Reports buffers of shaders that are larger than the largest block of the device, whose end no shader could reach.
bool checkBlocks(const Plan& plan, base::Diagnostics& diagnostics) {
  GLint64 most = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
  std::vector<std::uint8_t> told(plan.graph->resources.size(), 0);
  bool good = true;
  for (std::size_t u = 0; u < plan.graph->uses.size(); ++u) {
    const FlatUse& use = plan.graph->uses[u];
    if (use.kind != graph::Kind::storage || plan.attached[u] == 0 || use.resource == kNone) continue;
    const FlatResource& resource = plan.graph->resources[use.resource];
    if (resource.kind != ResourceKind::buffer || resource.bytes <= static_cast<std::uint64_t>(most)) continue;
    good = false;
    if (std::exchange(told[use.resource], std::uint8_t{1}) != 0) continue;
    auto& d = diagnostics.error(base::Code::bufferNotCreated, {},
                                fmt::format("buffer '{}' of {} bytes is larger than a shader can see",
                                            plan.graph->resourceNames[use.resource], resource.bytes));
    d.resource = plan.graph->resourceNames[use.resource];
    d.expected = fmt::format("at most {} bytes in one storage block of this device", most);
    d.hint = "split it into several buffers";
  }
  return good;
}

}  // namespace

void PhysicalTexture::collectNames(std::unordered_set<GLuint>& names) const {
  for (const gl::Texture& texture : textures_) names.insert(texture.id());
  for (const View& view : views_) names.insert(view.view.id());
}

std::unordered_set<GLuint> ResourcePool::textureNames() const {
  std::unordered_set<GLuint> names;
  for (const auto& texture : textures_) texture->collectNames(names);
  return names;
}

std::unique_ptr<ResourcePool> ResourcePool::create(const Plan& plan, ResourcePool* before,
                                                   base::Diagnostics& diagnostics) {
  if (!checkBlocks(plan, diagnostics)) return nullptr;
  auto pool = std::make_unique<ResourcePool>();
  pool->resources_.resize(plan.graph->resources.size());
  pool->names_ = plan.graph->resourceNames;
  if (!pool->createTextures(plan, before, diagnostics) || !pool->createBuffers(plan, before, diagnostics)) {
    if (before) pool->giveBack(*before);
    return nullptr;
  }
  // Publication state follows persistent storage.
  if (before) {
    std::unordered_map<std::uint64_t, const GpuResource*> bySerial;
    for (const GpuResource& old : before->resources_) bySerial[old.serial] = &old;
    for (GpuResource& mine : pool->resources_) {
      if (mine.fresh || mine.serial == 0) continue;
      const auto old = bySerial.find(mine.serial);
      if (old == bySerial.end() || old->second->copies != mine.copies) continue;
      mine.current = old->second->current;
      mine.publications = old->second->publications;
      mine.resets = old->second->resets;
      mine.publishedAt = old->second->publishedAt;
    }
  }
  std::unordered_map<std::uint32_t, const graph::Value*> clearOf;
  for (const graph::ClearSpec& clear : plan.graph->clears) clearOf[clear.resource] = &clear.value;
  for (const graph::HistorySpec& history : plan.graph->histories)
    if ((*pool)[history.resource].fresh) pool->fill(plan, history.resource, history.first, diagnostics);
  // Until a time-sliced group first publishes a resource, other passes see version zero, or zeros where there is none.
  for (std::uint32_t r = 0; r < pool->resources_.size(); ++r) {
    GpuResource& mine = (*pool)[r];
    mine.group = plan.groups.slicedWriterOf(r);
    if (mine.group == kNone || !mine.fresh || plan.graph->resources[r].history > 0) continue;
    const auto clear = clearOf.find(r);
    pool->fill(plan, r, clear == clearOf.end() ? graph::Value::number(0) : *clear->second, diagnostics);
  }
  // A plan does not know these clears; its first steps may store to the same memory.
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  return pool;
}

void ResourcePool::fill(const Plan& plan, std::uint32_t resource, const graph::Value& value,
                        base::Diagnostics& diagnostics) {
  const GpuResource& mine = resources_[resource];
  const FlatResource& r = plan.graph->resources[resource];
  for (std::uint32_t copy = 0; copy < mine.copies; ++copy) {
    if (mine.texture) {
      const FlatUse all{.resource = resource, .mips = r.mips, .layers = r.layers};
      const gl::TextureRef ref = view(plan, all, copy, 0, diagnostics);
      for (std::uint32_t mip = 0; mip < r.mips && ref.id; ++mip)
        clearTexture(ref, r.format, mip, 0, r.layers, value);
    } else if (copy < mine.buffers.size()) {
      clearBuffer(mine.buffers[copy], mine.offset, mine.bytes, value);
    }
  }
}

void ResourcePool::giveBack(ResourcePool& before) {
  for (const Taken& taken : takenTextures_) before.textures_[taken.theirs] = std::move(textures_[taken.mine]);
  for (const Taken& taken : takenBuffers_) before.buffers_[taken.theirs] = std::move(buffers_[taken.mine]);
  if (arenaTaken_) before.arena_ = std::move(arena_);
}

// First takes the storage of resources of the same name, so that passes find their textures where they were; then whatever
// fits.
void ResourcePool::takeTextures(const Plan& plan, const std::vector<std::string>& owners,
                                ResourcePool& before) {
  std::unordered_map<std::string_view, const PhysicalTexture*> byName;
  std::unordered_map<const PhysicalTexture*, std::size_t> indexOf;
  for (std::size_t i = 0; i < before.textures_.size(); ++i)
    if (before.textures_[i]) indexOf[before.textures_[i].get()] = i;
  for (std::size_t r = 0; r < before.resources_.size(); ++r)
    if (before.resources_[r].texture) byName[before.names_[r]] = before.resources_[r].texture;
  const auto take = [&](std::size_t s, std::size_t i) {
    std::unique_ptr<PhysicalTexture>& old = before.textures_[i];
    if (!old || old->owner != owners[s] || !old->fits(plan.storages[s])) return false;
    textures_[s] = std::move(old);
    takenTextures_.push_back({s, i});
    return true;
  };
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const std::uint32_t s = plan.storageOf[r];
    if (s == kNone || textures_[s]) continue;
    const auto old = byName.find(names_[r]);
    if (old == byName.end()) continue;
    if (const auto index = indexOf.find(old->second); index != indexOf.end()) take(s, index->second);
  }
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> left;  // by shape and owner
  for (std::size_t i = 0; i < before.textures_.size(); ++i)
    if (before.textures_[i]) left[before.textures_[i]->key()].push_back(i);
  for (std::size_t s = 0; s < plan.storages.size(); ++s) {
    if (textures_[s]) continue;
    const auto found = left.find(PhysicalTexture::keyOf(plan.storages[s], owners[s]));
    if (found == left.end()) continue;
    std::vector<std::size_t>& fitting = found->second;
    while (!fitting.empty() && !textures_[s]) {
      take(s, fitting.back());
      fitting.pop_back();
    }
  }
}

bool ResourcePool::createTextures(const Plan& plan, ResourcePool* before, base::Diagnostics& diagnostics) {
  std::vector<std::string> owners(plan.storages.size()), labels(plan.storages.size());
  const auto forEachShared = [&](const auto& f) {
    for (std::size_t r = 0; r < resources_.size(); ++r)
      if (const std::uint32_t s = plan.storageOf[r]; s != kNone) f(r, s);
  };
  forEachShared([&](std::size_t r, std::uint32_t s) {
    if (plan.storages[s].persistent) owners[s] = names_[r];
  });
  textures_.resize(plan.storages.size());
  if (before) takeTextures(plan, owners, *before);
  forEachShared([&](std::size_t r, std::uint32_t s) {
    if (!textures_[s]) labels[s].append(labels[s].empty() ? "" : " | ").append(names_[r]);
  });
  std::vector<std::uint8_t> reused(plan.storages.size(), 0);
  for (std::size_t s = 0; s < plan.storages.size(); ++s) {
    reused[s] = textures_[s] != nullptr;
    if (!textures_[s]) textures_[s] = PhysicalTexture::create(plan.storages[s], labels[s], diagnostics);
    if (!textures_[s]) return false;
    textures_[s]->owner = owners[s];
  }
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const std::uint32_t s = plan.storageOf[r];
    if (s == kNone || !isTexture(plan.graph->resources[r])) continue;
    GpuResource& mine = resources_[r];
    mine.texture = textures_[s].get();
    mine.copies = mine.texture->copies();
    mine.serial = mine.texture->serial();
    mine.fresh = !reused[s];
  }
  return true;
}

bool ResourcePool::createBuffers(const Plan& plan, ResourcePool* before, base::Diagnostics& diagnostics) {
  constexpr GLbitfield kFlags = GL_DYNAMIC_STORAGE_BIT | GL_MAP_READ_BIT;
  bool arenaFresh = true;
  if (plan.arenaBytes > 0) {
    if (before && before->arena_ && before->arena_.bytes() == plan.arenaBytes) {
      arena_ = std::move(before->arena_);
      arenaTaken_ = true;
      arenaSerial_ = before->arenaSerial_;
      arenaFresh = false;
    } else {
      base::Diagnostics refused;
      auto arena = gl::Buffer::create(plan.arenaBytes, kFlags, "transient buffers", refused);
      // The message names the largest of the buffers, which gives it a place.
      for (base::Diagnostic each : refused.items()) {
        if (const std::uint32_t largest = largestTransientOf(plan); largest != kNone) {
          each.resource = names_[largest];
          each.hint = fmt::format("'{}' is the largest of them, {} bytes: make it smaller", names_[largest],
                                  plan.graph->resources[largest].bytes);
        }
        diagnostics.add(std::move(each));
      }
      if (!arena) return false;
      arena_ = std::move(*arena);
      arenaSerial_ = nextSerial();
    }
  }
  std::unordered_map<std::string_view, std::size_t> buffersBefore;
  if (before)
    for (std::size_t i = 0; i < before->buffers_.size(); ++i) buffersBefore[before->buffers_[i].owner] = i;
  for (std::size_t r = 0; r < resources_.size(); ++r) {
    const FlatResource& desc = plan.graph->resources[r];
    GpuResource& mine = resources_[r];
    if (desc.kind != ResourceKind::buffer || plan.firstStep[r] == kNone) continue;
    mine.bytes = desc.bytes;
    if (plan.bufferOffsetOf[r] != Plan::kNoOffset) {
      mine.offset = plan.bufferOffsetOf[r];
      mine.buffers = {arena_.id()};
      mine.serial = arenaSerial_;
      mine.fresh = arenaFresh;
      continue;
    }
    const std::uint32_t copies = plan.copiesOf(static_cast<std::uint32_t>(r));
    PersistentBuffer buffer;
    if (const auto found = buffersBefore.find(names_[r]); found != buffersBefore.end()) {
      PersistentBuffer& old = before->buffers_[found->second];
      if (old.copies.size() == copies && old.copies[0].bytes() == desc.bytes) {
        buffer.copies = std::exchange(old.copies, {});
        buffer.serial = old.serial;
        takenBuffers_.push_back({buffers_.size(), found->second});
        mine.fresh = false;
      }
    }
    while (buffer.copies.size() < copies) {
      auto copy = gl::Buffer::create(desc.bytes, kFlags, names_[r], diagnostics);
      if (!copy) return false;
      buffer.copies.push_back(std::move(*copy));
    }
    if (mine.fresh) buffer.serial = nextSerial();
    buffer.owner = names_[r];
    for (const gl::Buffer& copy : buffer.copies) mine.buffers.push_back(copy.id());
    mine.copies = copies;
    mine.serial = buffer.serial;
    buffers_.push_back(std::move(buffer));
  }
  return true;
}

gl::TextureRef ResourcePool::view(const Plan& plan, const FlatUse& use, std::uint32_t copy, GLenum target,
                                  base::Diagnostics& diagnostics) {
  const FlatResource& desc = plan.graph->resources[use.resource];
  GpuResource& mine = resources_[use.resource];
  if (!mine.texture) return mine.imported;
  gl::ViewDesc view{.target = target ? target : glTargetOf(desc.target),
                    .format = glFormatOf(desc.format).internal,
                    .mip = use.mip,
                    .mips = use.mips,
                    .layer = use.layer,
                    .layers = use.layers,
                    .stencil = use.planes == 2};
  return mine.texture->view(copy, view, diagnostics);
}

void clearTexture(const gl::TextureRef& texture, graph::Format format, std::uint32_t mip, std::uint32_t layer,
                  std::uint32_t layers, const graph::Value& value) {
  const ClearTexel texel = clearTexelOf(format, value);
  const gl::Extent extent = gl::extentOf(texture.desc, mip);
  const bool volume = texture.desc.target == GL_TEXTURE_3D;
  glClearTexSubImage(texture.id, static_cast<GLint>(mip), 0, 0, volume ? 0 : static_cast<GLint>(layer),
                     static_cast<GLsizei>(extent.width), static_cast<GLsizei>(extent.height),
                     static_cast<GLsizei>(volume ? extent.layers : layers), texel.format, texel.type,
                     texel.bytes.data());
}

void clearBuffer(GLuint buffer, std::uint64_t offset, std::uint64_t bytes, const graph::Value& value) {
  const auto begin = static_cast<GLintptr>(offset);
  const auto size = static_cast<GLsizeiptr>(bytes);
  const std::array<float, 4> texel = clearChannelsOf(value);
  const bool vector = value.type == graph::Value::Type::list && value.count == 4 && bytes % 16 == 0;
  if (vector)
    glClearNamedBufferSubData(buffer, GL_RGBA32F, begin, size, GL_RGBA, GL_FLOAT, texel.data());
  else if (bytes % 4 == 0)
    glClearNamedBufferSubData(buffer, GL_R32F, begin, size, GL_RED, GL_FLOAT, texel.data());
  else
    glClearNamedBufferSubData(buffer, GL_R8, begin, size, GL_RED, GL_FLOAT, texel.data());
}

}  // namespace weft::runtime
