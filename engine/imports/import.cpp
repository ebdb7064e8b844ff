#include "engine/imports/import.h"

#include "engine/imports/camera_views.h"

namespace weft::imports {

BufferRef Provider::buffer(const Frame&, const RowLayout&, base::Diagnostics&) {
  return {};
}

const scene::ViewData& Provider::view(const Frame& frame, const ViewPart& part) {
  return frame.camera.view(frame, part.width, part.height);
}

graph::ImportFacts Import::facts(const graph::ImportRequest&, const WorldFacts&, Files&) const {
  return {.exists = true};
}

}  // namespace weft::imports
