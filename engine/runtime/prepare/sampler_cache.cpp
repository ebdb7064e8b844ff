#include "engine/runtime/prepare/sampler_cache.h"

#include "engine/runtime/storage/formats.h"

namespace weft::runtime {

GLuint SamplerCache::get(const graph::Sampler& sampler, bool mipmapped, graph::Compare compare) {
  gl::SamplerDesc desc;
  const bool linear = sampler.linear || sampler.compare;
  desc.magFilter = linear ? GL_LINEAR : GL_NEAREST;
  desc.minFilter = !mipmapped ? desc.magFilter : linear ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST;
  desc.wrap = sampler.wrap ? GL_REPEAT : GL_CLAMP_TO_EDGE;
  if (sampler.compare) desc.compare = compare == graph::Compare::always ? GL_LEQUAL : glCompareOf(compare);
  for (const Entry& each : entries_)
    if (each.desc == desc) return each.object.id();
  entries_.push_back({desc, gl::SamplerObject::create(desc, linear ? "linear" : "nearest")});
  return entries_.back().object.id();
}

}  // namespace weft::runtime
