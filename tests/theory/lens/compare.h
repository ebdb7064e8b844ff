// Pictures through Weft's lens and shutter against sums of sharp pictures: how far apart they are as seen, and an environment without
// details that a pixel could miss.
#pragma once

#include <memory>
#include <vector>

#include "engine/assets/images/image.h"

namespace weft::theory {

// Row y, column x: three numbers.
using Radiance = std::vector<double>;

struct Difference {
  double mean = 0,
         percentile99 = 0;  // of 255, after x / (1 + x) and gamma 2.2; per pixel that of the worst channel
  double above32 = 0;       // share of the pixels
};

Difference differenceOf(const Radiance& a, const Radiance& b);

// The bundled photograph at an eighth of its size, and with a sun of no more than 20: a pixel that misses or meets a detail of a reflection
// is no matter of lens or shutter.
std::shared_ptr<const assets::ImageF> coarseEnvironment();

}  // namespace weft::theory
