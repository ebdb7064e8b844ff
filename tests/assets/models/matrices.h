// 4 x 4 matrices by their definition, for tests.
#pragma once

#include "engine/assets/model.h"

namespace weft::test {

inline assets::Matrix4 matrixOf(const assets::ModelNode& node) {
  const auto [x, y, z, w] = node.rotation;
  const assets::Float3 &s = node.scale, &t = node.translation;
  return {(1 - 2 * (y * y + z * z)) * s[0],
          2 * (x * y + w * z) * s[0],
          2 * (x * z - w * y) * s[0],
          0,
          2 * (x * y - w * z) * s[1],
          (1 - 2 * (x * x + z * z)) * s[1],
          2 * (y * z + w * x) * s[1],
          0,
          2 * (x * z + w * y) * s[2],
          2 * (y * z - w * x) * s[2],
          (1 - 2 * (x * x + y * y)) * s[2],
          0,
          t[0],
          t[1],
          t[2],
          1};
}

inline assets::Matrix4 multiply(const assets::Matrix4& a, const assets::Matrix4& b) {
  assets::Matrix4 out{};
  for (std::size_t column = 0; column < 4; ++column)
    for (std::size_t row = 0; row < 4; ++row)
      for (std::size_t k = 0; k < 4; ++k) out[column * 4 + row] += a[k * 4 + row] * b[column * 4 + k];
  return out;
}

}  // namespace weft::test
