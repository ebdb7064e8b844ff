#include "engine/assets/models/parts/decompose.h"

#include <algorithm>
#include <cmath>

namespace weft::assets {

namespace {

constexpr double kTiny = 1e-12;

// The quaternion of a rotation matrix with columns x, y, z. Shepperd, "Quaternion from Rotation Matrix", 1978.
Float4 rotationOf(const double m[3][3]) {
  const double trace = m[0][0] + m[1][1] + m[2][2];
  double q[4];
  if (trace > 0) {
    const double s = std::sqrt(trace + 1) * 2;
    q[3] = s / 4;
    q[0] = (m[1][2] - m[2][1]) / s;
    q[1] = (m[2][0] - m[0][2]) / s;
    q[2] = (m[0][1] - m[1][0]) / s;
  } else {
    const int i = m[0][0] > m[1][1] && m[0][0] > m[2][2] ? 0 : m[1][1] > m[2][2] ? 1 : 2;
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const double s = std::sqrt(std::max(0.0, 1 + m[i][i] - m[j][j] - m[k][k])) * 2;
    q[i] = s / 4;
    q[3] = (m[j][k] - m[k][j]) / s;
    q[j] = (m[i][j] + m[j][i]) / s;
    q[k] = (m[i][k] + m[k][i]) / s;
  }
  return {static_cast<float>(q[0]), static_cast<float>(q[1]), static_cast<float>(q[2]),
          static_cast<float>(q[3])};
}

}  // namespace

bool normalizeRotation(Float4& q) {
  const double length =
      std::sqrt(double(q[0]) * q[0] + double(q[1]) * q[1] + double(q[2]) * q[2] + double(q[3]) * q[3]);
  if (!(length > kTiny)) return false;
  for (float& c : q) c = static_cast<float>(c / length);
  return true;
}

bool decompose(const Matrix4& matrix, ModelNode& node) {
  double columns[3][3], scale[3];
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t r = 0; r < 3; ++r) columns[c][r] = static_cast<double>(matrix[c * 4 + r]);
    scale[c] = std::sqrt(columns[c][0] * columns[c][0] + columns[c][1] * columns[c][1] +
                         columns[c][2] * columns[c][2]);
    if (!std::isfinite(scale[c])) return false;
  }
  const auto& [x, y, z] = columns;
  const double determinant = x[0] * (y[1] * z[2] - y[2] * z[1]) - x[1] * (y[0] * z[2] - y[2] * z[0]) +
                             x[2] * (y[0] * z[1] - y[1] * z[0]);
  if (determinant < 0) scale[0] = -scale[0];
  node.translation = {matrix[12], matrix[13], matrix[14]};
  node.rotation = {0, 0, 0, 1};
  for (std::size_t c = 0; c < 3; ++c) {
    node.scale[c] = static_cast<float>(scale[c]);
    if (std::abs(scale[c]) < kTiny) continue;
    for (double& r : columns[c]) r /= scale[c];
  }
  const bool flat = std::any_of(scale, scale + 3, [](double s) { return std::abs(s) < kTiny; });
  if (!flat) node.rotation = rotationOf(columns);
  return normalizeRotation(node.rotation);
}

}  // namespace weft::assets
