#include "engine/scene/probes/sh.h"

#include <algorithm>
#include <cmath>

namespace weft::scene {

std::array<float, kShCount> shBasis(glm::vec3 d) {
  return {0.282094792f,
          0.488602512f * d.y,
          0.488602512f * d.z,
          0.488602512f * d.x,
          1.092548431f * d.x * d.y,
          1.092548431f * d.y * d.z,
          0.315391565f * (3.0f * d.z * d.z - 1.0f),
          1.092548431f * d.x * d.z,
          0.546274215f * (d.x * d.x - d.y * d.y)};
}

// Integrals of the Legendre polynomials from the cosine to 1, times 2 pi. 1 - cosine = sine^2 / (1 + cosine), which keeps
// its digits far away.
glm::vec3 capBands(float sine) {
  const float square = std::min(sine * sine, 1.0f), cosine = std::sqrt(1.0f - square);
  return {2.0f * kPi * square / (1.0f + cosine), kPi * square, kPi * square * cosine};
}

glm::vec3 pointBands(float sine) {
  return glm::vec3(kPi * std::min(sine * sine, 1.0f));
}

}  // namespace weft::scene
