#include "app/session/pick_outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace weft::app {

namespace {

// .exr files have one channel, three or four.
assets::ImageF withThree(assets::ImageF image) {
  if (image.channels != 2) return image;
  assets::ImageF wide{image.width, image.height, 3, {}};
  wide.texels.reserve(image.texels.size() / 2 * 3);
  for (std::size_t i = 0; i < image.texels.size(); i += 2) {
    wide.texels.insert(wide.texels.end(), {image.texels[i], image.texels[i + 1], 0.0f});
  }
  return wide;
}

}  // namespace

bool saveInspected(runtime::Inspector& inspector, const std::string& path, base::Diagnostics& diagnostics) {
  if (pictureKindOf(path) == ".exr") {
    auto image = inspector.values();
    return image && assets::saveExr(path, withThree(std::move(*image)), diagnostics);
  }
  const auto image = inspector.drawWhole(inspector.fittedView(), diagnostics);
  return image &&
         assets::savePng8(path, image->width, image->height, image->channels, image->texels, diagnostics);
}

bool PickOutputs::check(base::Diagnostics& diagnostics) const {
  bool good = true;
  for (const PickedOutput& each : picked_)
    good =
        checkOutput(each.file, options_.firstFrame, options_.lastFrame > options_.firstFrame, diagnostics) &&
        good;
  return good;
}

bool PickOutputs::makeAllFolders(base::Diagnostics& diagnostics) const {
  return std::ranges::all_of(picked_, [&](const PickedOutput& each) {
    return makeFolders(each.file, options_.firstFrame, options_.lastFrame, diagnostics);
  });
}

void PickOutputs::append(std::vector<OutputFile>& files) const {
  for (const PickedOutput& each : picked_)
    files.push_back({"-o " + each.pick.text, each.file, options_.firstFrame, options_.lastFrame});
}

bool PickOutputs::start(runtime::Renderer& renderer, base::Diagnostics& diagnostics) {
  if (empty()) return true;
  runtime::Execution& execution = *renderer.execution();
  std::vector<runtime::CaptureItem> items;
  for (const PickedOutput& each : picked_) {
    const auto item = runtime::captureItemOf(execution.plan(), each.pick, diagnostics);
    if (!item) continue;
    const graph::FlatGraph& graph = *execution.plan().graph;
    const auto at =
        std::ranges::find(graph.resourceNames, item->target.resource) - graph.resourceNames.begin();
    if (graph.resources[static_cast<std::size_t>(at)].kind == graph::ResourceKind::buffer) {
      auto& d =
          diagnostics.error(base::Code::outputNotWritten, {std::make_shared<const std::string>(each.file)},
                            fmt::format("'{}' is a buffer and no picture", each.pick.name));
      d.hint = "weft dump writes the bytes of buffers";
      continue;
    }
    items.push_back(*item);
  }
  if (items.size() < picked_.size()) return false;
  saved_.assign(items.size(), 0);
  capture_ = std::make_unique<runtime::Capture>(renderer.device());
  capture_->start(execution, std::move(items), [this](std::size_t item, runtime::Inspector& inspector) {
    if (!frame_) return;
    const PickedOutput& each = picked_[item];
    saved_[item] = saveInspected(inspector, *outputNameOf(each.file, *frame_), said_);
  });
  return true;
}

bool PickOutputs::finish(base::Diagnostics& diagnostics) {
  diagnostics.append(said_);
  said_.clear();
  if (!frame_) return true;
  const bool all = std::ranges::all_of(saved_, [](std::uint8_t saved) { return saved != 0; });
  if (!all && !diagnostics.hasErrors()) {
    const auto missing = std::ranges::find(saved_, 0) - saved_.begin();
    const PickedOutput& each = picked_[static_cast<std::size_t>(missing)];
    diagnostics
        .error(base::Code::outputNotWritten, {std::make_shared<const std::string>(each.file)},
               fmt::format("nothing was in '{}' to write", each.pick.text))
        .hint = "an import that is not there has no picture, nor has a pass that did not run";
  }
  std::ranges::fill(saved_, 0);
  return all;
}

void PickOutputs::stop(runtime::Renderer& renderer) {
  if (capture_ && renderer.execution()) capture_->stop(*renderer.execution());
  capture_ = nullptr;
}

}  // namespace weft::app
