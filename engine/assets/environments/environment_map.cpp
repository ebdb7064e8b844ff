#include "engine/assets/environments/environment_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cassert>
#include <exception>
#include <span>

#include "engine/assets/images/half.h"
#include "engine/assets/images/image_codecs.h"
#include "engine/base/files/file.h"

namespace weft::assets {

namespace {

// Between two looks at the observer: about a millisecond's work.
constexpr std::size_t kTexelsPerPortion = std::size_t{1} << 17;
// What comes without a size (a pipe) fills half of its part of the bar with so much, and never all of it.
constexpr double kTypicalBytes = 1 << 20;

// Empty when `goOn` gave up.
std::optional<EnvironmentMap> convert(const ImageF& image, const std::function<bool(double)>& goOn) {
  assert(image.channels == 3 || image.channels == 4);
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const std::size_t count = image.texels.size() / channels;
  EnvironmentMap map{static_cast<std::uint32_t>(image.width), static_cast<std::uint32_t>(image.height), {}};
  map.texels.resize(count * 4);
  std::vector<float> wide;
  for (std::size_t at = 0; at < count; at += kTexelsPerPortion) {
    if (!goOn(static_cast<double>(at) / static_cast<double>(count))) return {};
    const std::size_t texels = std::min(kTexelsPerPortion, count - at);
    std::span<const float> from(image.texels.data() + at * channels, texels * channels);
    if (channels == 3) {
      wide.assign(texels * 4, 1.0f);
      for (std::size_t i = 0; i < texels; ++i)
        std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * 3), 3,
                    wide.begin() + static_cast<std::ptrdiff_t>(i * 4));
      from = wide;
    }
    floatsToHalves(from, std::span(map.texels).subspan(at * 4, texels * 4));
  }
  return map;
}

}  // namespace

std::uint64_t newEnvironmentId() {
  static std::atomic<std::uint64_t> last{0};
  return ++last;
}

std::optional<EnvironmentMap> loadEnvironmentMap(const std::string& path, base::Diagnostics& diagnostics,
                                                 const LoadObserver& observer) try {
  const auto goOn = [&](LoadStage stage, double done) { return !observer || observer(stage, done); };
  if (!goOn(LoadStage::reading, 0)) return {};
  std::optional<ImageF> image;
  {
    const auto bytes = base::readFile(
        path, diagnostics, base::Code::unreadableImage, {}, [&](std::uint64_t done, std::uint64_t total) {
          const double size =
              total == 0 ? static_cast<double>(done) + kTypicalBytes : static_cast<double>(total);
          return goOn(LoadStage::reading, std::min(1.0, static_cast<double>(done) / size));
        });
    if (!bytes || !goOn(LoadStage::decoding, 0)) return {};
    image = decodeEnvironment(*bytes, path, diagnostics);
  }
  if (!image || !goOn(LoadStage::converting, 0)) return {};
  return convert(*image, [&](double done) { return goOn(LoadStage::converting, done); });
} catch (const std::exception& error) {  // out of memory
  reportUnreadable(diagnostics, path, fmt::format("decoding failed ({})", error.what()));
  return {};
}

bool isEnvironmentName(const std::string& name) {
  const ImageKind kind = kindOfName(name);
  return kind == ImageKind::hdr || kind == ImageKind::exr;
}

EnvironmentMap toEnvironmentMap(const ImageF& image) {
  return *convert(image, [](double) { return true; });
}

}  // namespace weft::assets
