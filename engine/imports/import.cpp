#include "engine/imports/import.h"

#include "engine/imports/builtin.h"
#include "engine/imports/camera/camera.h"

namespace weft::imports {

const scene::ViewData& Provider::view(const Frame& frame, const ViewPart& part) {
  return frame.camera.view(frame, part);
}

NamedView::NamedView(const graph::ImportRequest& request) {
  if (const graph::ImportRequest* view = request.named("view")) view_ = {*view, graph::keyOf(*view)};
}

const scene::ViewData& NamedView::view(const Frame& frame) const {
  return view_ ? frame.providers.of(view_->first, view_->second).view(frame, {})
               : frame.camera.view(frame, {});
}

std::uint64_t NamedView::generation(const Frame& frame) const {
  return view_ ? frame.providers.of(view_->first, view_->second).generation(frame)
               : frame.camera.generation(frame);
}

ImportRegistry ImportRegistry::builtin() {
  ImportRegistry registry;
  addTables(registry);
  for (const auto make :
       {makeEnvironment, makeDrawList, makeSun, makeLamps, makeCamera, makeCubeLut, makeImage})
    registry.add(make());
  return registry;
}

}  // namespace weft::imports
