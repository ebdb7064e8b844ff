#include "app/trials/picture_difference.h"

#include <fmt/format.h>

#include "engine/base/counted.h"

namespace weft::app {

PictureDifference measureDifference(const assets::Image8& a, const assets::Image8& b,
                                    const assets::FlipMap& map, const std::vector<std::uint8_t>& weights) {
  PictureDifference found{assets::compareImages(a, b), assets::summarizeFlip(map, weights)};
  found.share = static_cast<double>(found.bytes.differingPixels) /
                (static_cast<double>(a.width) * static_cast<double>(a.height));
  return found;
}

std::string PictureDifference::text() const {
  return fmt::format(
      "FLIP {:.4f}, at most {:.3f} (at {},{}); {} {} ({:.3g} %), by up to {:.0f} of 255 (at "
      "{},{})",
      flip.mean, flip.peak, flip.x, flip.y, base::counted(bytes.differingPixels, "pixel"),
      bytes.differingPixels == 1 ? "differs" : "differ", 100 * share, bytes.maxDifference, bytes.worstX,
      bytes.worstY);
}

}  // namespace weft::app
