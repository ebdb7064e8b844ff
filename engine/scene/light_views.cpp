#include "engine/scene/light_views.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

namespace weft::scene {

SunView sunView(const Sun& sun, const Box& bounds, std::uint32_t texels) {
  assert(texels > 0);
  const glm::dvec3 low = bounds.empty() ? glm::dvec3(-0.5) : glm::dvec3(bounds.low);
  const glm::dvec3 high = bounds.empty() ? glm::dvec3(0.5) : glm::dvec3(bounds.high);
  // The radius of a ball around the box, so that it is the same from every side; in steps of a sixteenth of its power of two.
  const double ball = std::max(glm::length(high - low) / 2, 1e-4);
  const double step = std::exp2(std::floor(std::log2(ball))) / 16;
  // A texel more on each side than what is inside, for filters and for the snapping.
  const double inner = std::ceil(ball / step) * step, n = texels;
  const double radius = texels > 4 ? inner * n / (n - 4) : inner;
  const double texel = 2 * radius / n;

  const CameraPose towards{.position = glm::dvec3(glm::normalize(sun.direction)), .target = {0, 0, 0}};
  const glm::dmat4 turn(glm::dmat3(viewMatrix(towards)));  // without the translation
  glm::dvec3 center = glm::dvec3(turn * glm::dvec4((low + high) / 2.0, 1));
  for (int axis = 0; axis < 2; ++axis) center[axis] = std::floor(center[axis] / texel + 0.5) * texel;
  const glm::dmat4 view = glm::translate(glm::dmat4(1), -center) * turn;
  glm::dmat4 projection(1);
  projection[0][0] = projection[1][1] = 1 / radius;
  projection[2][2] = 0.5 / radius;  // nearest to the sun is 1
  projection[3][2] = 0.5;

  SunView result;
  const glm::dvec3 eye = glm::transpose(glm::dmat3(turn)) * (center + glm::dvec3(0, 0, radius));
  result.view = viewOf(view, projection, eye, glm::vec2(static_cast<float>(texels)));
  const glm::dmat4 toTexture = glm::translate(glm::dmat4(1), glm::dvec3(0.5, 0.5, 0)) *
                               glm::scale(glm::dmat4(1), glm::dvec3(0.5, 0.5, 1));
  result.shadowMatrix = glm::mat4(toTexture * projection * view);
  result.texel = static_cast<float>(texel);
  return result;
}

float nearPlaneOf(const Lamp& lamp) {
  return lamp.range > 0 ? lamp.range / 1000 : 0.01f;
}

ViewData cubeView(glm::vec3 from, float nearPlane, std::uint32_t face, std::uint32_t texels) {
  // OpenGL 4.5 core, table 8.19: s and t of each face, as directions of a camera's right and up.
  static constexpr std::array<std::array<glm::dvec3, 2>, 6> kFaces = {{{{{1, 0, 0}, {0, -1, 0}}},
                                                                       {{{-1, 0, 0}, {0, -1, 0}}},
                                                                       {{{0, 1, 0}, {0, 0, 1}}},
                                                                       {{{0, -1, 0}, {0, 0, -1}}},
                                                                       {{{0, 0, 1}, {0, -1, 0}}},
                                                                       {{{0, 0, -1}, {0, -1, 0}}}}};
  const glm::dvec3 eye(from);
  const auto& [ahead, up] = kFaces[std::min(face, 5u)];
  const glm::dmat4 view = glm::lookAt(eye, eye + ahead, up);
  ViewData data =
      viewOf(view, projectionMatrix(90, 1, nearPlane), eye, glm::vec2(static_cast<float>(texels)));
  data.near_plane = nearPlane;
  return data;
}

}  // namespace weft::scene
