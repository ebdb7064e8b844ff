// How two pictures of one size differ, in numbers and as a sentence. Does not: judge whether that is too much.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/assets/images/flip.h"

namespace weft::app {

struct PictureDifference {
  assets::Comparison bytes;
  assets::FlipSummary flip;
  double share = 0;  // of the pixels that differ at all

  // "FLIP 0.0123, at most 0.200 (at 1,2); 96 pixels differ (1.5 %), by up to 12 of 255 (at 3,4)"
  std::string text() const;
};

// `map`: of these two. What has the weight 0 does not count for `flip`; an empty `weights` means that all do.
PictureDifference measureDifference(const assets::Image8& a, const assets::Image8& b,
                                    const assets::FlipMap& map,
                                    const std::vector<std::uint8_t>& weights = {});

}  // namespace weft::app
