// Environments of 256 x 128 texels that tests make.
#pragma once

#include <array>
#include <memory>

#include "engine/assets/images/image.h"

namespace weft::theory {

// `radiance(x, y)` of each texel, from the top left: r, g, b.
template <class Radiance>
std::shared_ptr<const assets::ImageF> makeEnvironment(const Radiance& radiance) {
  auto image = std::make_shared<assets::ImageF>();
  image->width = 256;
  image->height = 128;
  image->channels = 4;
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x) {
      const std::array<double, 3> rgb = radiance(x, y);
      for (const double c : {rgb[0], rgb[1], rgb[2], 1.0}) image->texels.push_back(static_cast<float>(c));
    }
  return image;
}

inline std::shared_ptr<const assets::ImageF> constantEnvironment(double r, double g, double b) {
  return makeEnvironment([&](int, int) { return std::array{r, g, b}; });
}

}  // namespace weft::theory
