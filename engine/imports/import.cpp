#include "engine/imports/import.h"

#include "engine/imports/builtin.h"
#include "engine/imports/camera/camera.h"
#include "engine/imports/files.h"

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

std::shared_ptr<const void> Files::getAny(
    const std::string& path, std::type_index type,
    const std::function<std::shared_ptr<const void>(text::Diagnostics&)>& read,
    text::Diagnostics& diagnostics) {
  touched_.insert(path);
  std::error_code ec;
  Stamp stamp{std::filesystem::last_write_time(path, ec), 0};
  if (ec) stamp = {};
  if (const auto size = std::filesystem::file_size(path, ec); !ec) stamp.second = size;
  const auto [found, fresh] = entries_.try_emplace({path, type});
  Entry& entry = found->second;
  if (fresh || entry.stamp != stamp) {
    entry = {.stamp = stamp, .made = nullptr, .said = {}};
    entry.made = read(entry.said);
  }
  diagnostics.append(entry.said);
  return entry.made;
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
