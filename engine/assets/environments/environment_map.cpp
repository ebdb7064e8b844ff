#include "engine/assets/environments/environment_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>

#include "engine/assets/images/half.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/text/files/file.h"

namespace weft::assets {

std::uint64_t newEnvironmentId() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::optional<EnvironmentMap> loadEnvironmentMap(const std::string& path, text::Diagnostics& diagnostics,
                                                 const LoadObserver& observer) try {
  const auto goOn = [&](LoadStage stage, double done) { return !observer || observer(stage, done); };
  if (!goOn(LoadStage::reading, 0)) return {};
  std::optional<ImageF> image;
  {
    const auto bytes = text::readFile(
        path, diagnostics, text::Code::unreadableImage, {}, [&](std::uint64_t done, std::uint64_t total) {
          // What comes without a size (a pipe) fills half of its part of the bar with a MiB, and never all of it.
          const auto size = static_cast<double>(total > 0 ? total : done + (1u << 20));
          return goOn(LoadStage::reading, std::min(1.0, static_cast<double>(done) / size));
        });
    if (!bytes || !goOn(LoadStage::decoding, 0)) return {};
    image = decodeEnvironment(*bytes, path, diagnostics);
  }
  if (!image || !goOn(LoadStage::converting, 0)) return {};
  return toEnvironmentMap(*image);
} catch (const std::exception& error) {  // out of memory
  reportUnreadable(diagnostics, path, fmt::format("decoding failed ({})", error.what()));
  return {};
}

bool isEnvironmentName(const std::string& name) {
  const ImageKind kind = kindOfName(name);
  return kind == ImageKind::hdr || kind == ImageKind::exr;
}

EnvironmentMap toEnvironmentMap(const ImageF& image) {
  EnvironmentMap map{static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), {}};
  const ImageF wide = image.channels == 4 ? ImageF{} : widenToRgba(image);
  const std::vector<float>& texels = image.channels == 4 ? image.texels : wide.texels;
  map.texels.resize(texels.size());
  floatsToHalves(texels, map.texels);
  return map;
}

}  // namespace weft::assets
