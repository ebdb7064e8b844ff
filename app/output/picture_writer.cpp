#include "app/output/picture_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "app/output/output_files.h"
#include "engine/base/counted.h"

namespace weft::app {

void PictureWriter::look(const assets::ImageF& picture, runtime::Renderer& renderer,
                         const std::string& path) {
  Found found;
  const auto channels = static_cast<std::size_t>(picture.channels);
  for (std::size_t at = 0; at < picture.texels.size(); at += channels) {
    bool nan = false, infinite = false;
    for (std::size_t c = 0; c < channels; ++c) {
      nan |= std::isnan(picture.texels[at + c]);
      infinite |= std::isinf(picture.texels[at + c]);
    }
    if (!nan && !infinite) continue;
    if (found.pixels++ == 0) {
      const auto pixel = static_cast<int>(at / channels);
      found.x = pixel % picture.width;
      found.y = pixel / picture.width;
    }
    ++(nan ? found.nan : found.infinite);
  }
  if (found.pixels == 0) return;
  ++counts_.broken;
  counts_.pixels += found.pixels;
  if (first_.pixels > 0) return;
  found.path = path;
  const graph::FlatGraph& graph = *renderer.execution()->plan().graph;
  found.resource = graph.resourceNames[graph.present.resource];
  first_ = std::move(found);
}

bool PictureWriter::save(runtime::Renderer& renderer, const std::string& path,
                         base::Diagnostics& diagnostics) {
  const auto written = [&](bool good) {
    counts_.pictures += good ? 1 : 0;
    return good;
  };
  const auto png = [&](const assets::Image8& image) {
    return written(
        assets::savePng8(path, image.width, image.height, image.channels, image.texels, diagnostics));
  };
  const bool values = pictureKindOf(path) == ".exr";
  if (!values && renderer.presentsBytes()) {  // they hold no such values, and are read faster
    const auto image = renderer.readPresented8();
    return image && png(*image);
  }
  const auto image = renderer.readPresentedFloat();
  if (!image) return false;
  look(*image, renderer, path);
  return values ? written(assets::saveExr(path, *image, diagnostics)) : png(runtime::toBytes(*image));
}

void PictureWriter::tell(base::Diagnostics& diagnostics) {
  if (first_.pixels == 0) return;
  auto& d = diagnostics.warning(
      base::Code::pictureNotFinite, {std::make_shared<const std::string>(first_.path), 0, 0},
      fmt::format("{} of the picture {} NaN or infinite, the first at x {}, y {} from the upper left",
                  base::counted(first_.pixels, "pixel"), first_.pixels == 1 ? "is" : "are", first_.x,
                  first_.y));
  d.resource = first_.resource;
  d.expected = "finite numbers";
  d.found = fmt::format("NaN in {} and infinity in {}", first_.nan, first_.infinite);
  if (const std::uint64_t more = counts_.broken - brokenBefore_ - 1; more > 0)
    d.found += fmt::format("; {} more of the pictures after it have such pixels", more);
  d.hint =
      "look for a division by 0, a root or logarithm of what may be negative, or values beyond what the "
      "format holds; "
      "the texture inspector of `weft view` marks them";
  first_ = {};
  brokenBefore_ = counts_.broken;
}

}  // namespace weft::app
