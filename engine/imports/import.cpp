#include "engine/imports/import.h"

#include "engine/imports/camera_views.h"

namespace weft::imports {

BufferRef Provider::buffer(const Frame&, const InstanceLayout&, base::Diagnostics&) {
  return {};
}

const scene::ViewData& Provider::view(const Frame& frame, std::uint32_t width, std::uint32_t height) {
  return frame.camera.view(frame, width, height);
}

graph::ImportFacts Import::facts(const graph::ImportRequest&, const WorldFacts&, Files&) const {
  return {.exists = true};
}

}  // namespace weft::imports
