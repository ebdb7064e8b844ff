// How two pictures differ, for tests and golden images.
#pragma once

#include <cstddef>

#include "engine/assets/images/image.h"

namespace weft::assets {

struct Comparison {
  bool sameShape = false;  // width, height and channels agree; everything below is 0 when they do not
  double maxDifference =
      0;  // largest |a - b| of any component; infinite when one is NaN and the other is not
  double meanDifference = 0;  // mean |a - b| over all components
  double psnr = 0;            // dB relative to 255 (Image8) or 1.0 (ImageF); infinite for equal pictures
  std::size_t differingPixels = 0;  // pixels with a component that differs by more than the tolerance
  int worstX = 0, worstY = 0;       // where maxDifference is; y counts from the top
  bool equal() const { return sameShape && maxDifference == 0; }
};

Comparison compareImages(const Image8& a, const Image8& b, double tolerance = 0);
Comparison compareImages(const ImageF& a, const ImageF& b, double tolerance = 0);

// |a - b| * gain per component, saturated; an alpha channel is opaque. Asserts equal shapes.
Image8 makeDifference(const Image8& a, const Image8& b, int gain = 16);

}  // namespace weft::assets
