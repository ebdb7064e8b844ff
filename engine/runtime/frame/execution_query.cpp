// What an execution shows to the outside: resources by name, the presented picture.
#include <utility>

#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/frame_memory.h"

namespace weft::runtime {

using graph::FlatUse;
using graph::kNone;

gl::TextureRef Execution::texture(std::string_view name) {
  const std::uint32_t r = lastVersionOf(*plan_, name);
  return r == kNone ? gl::TextureRef{} : texture(r);
}

gl::TextureRef Execution::texture(std::uint32_t r, std::uint32_t history) {
  base::Diagnostics ignored;
  const graph::FlatResource& desc = plan_->graph->resources[r];
  const FlatUse all{.resource = r, .mips = desc.mips, .layers = desc.layers};
  return pool_->view(*plan_, all, (*pool_)[r].copyOf(history), 0, ignored);
}

BufferRef Execution::buffer(std::string_view name, std::uint64_t& offset) {
  const std::uint32_t r = lastVersionOf(*plan_, name);
  return r == kNone ? BufferRef{} : buffer(r, offset);
}

BufferRef Execution::buffer(std::uint32_t r, std::uint64_t& offset, std::uint32_t history) {
  const GpuResource& resource = (*pool_)[r];
  if (resource.buffers.empty()) return {};
  offset = resource.offset;
  return {resource.buffers[resource.copyOf(history)], resource.bytes};
}

gl::TextureRef Execution::presented() {
  const FlatUse& use = plan_->graph->present;
  if (use.resource == kNone) return {};
  base::Diagnostics ignored;
  return pool_->view(*plan_, use, (*pool_)[use.resource].copyOf(0), GL_TEXTURE_2D, ignored);
}

gl::TextureRef Execution::presentedWhole() {
  FlatUse all = plan_->graph->present;
  if (all.resource == kNone) return {};
  const graph::FlatResource& desc = plan_->graph->resources[all.resource];
  all.mip = all.layer = 0;
  all.mips = desc.mips;
  all.layers = desc.layers;
  base::Diagnostics ignored;
  return pool_->view(*plan_, all, (*pool_)[all.resource].copyOf(0), 0, ignored);
}

bool Execution::remembers(const World& world) const {
  return remembersFrames(*plan_, passes_, device_.imports, world);
}

const Output* Execution::output(std::string_view name) const {
  for (const Output& each : outputs())
    if (each.name == name) return &each;
  return nullptr;
}

bool Execution::ran(std::string_view pass) const {
  for (std::size_t step = 0; step < passes_.size(); ++step)
    if (passes_[step].context.spec->name == pass) return ran_[step] != 0;
  return false;
}

}  // namespace weft::runtime
