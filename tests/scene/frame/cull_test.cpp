// Culling against points: no box that holds a visible point is culled, and most that hold none are.
#include <doctest/doctest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "engine/scene/camera.h"
#include "engine/scene/frame/mesh_views.h"

using namespace weft::scene;

namespace {

// Inside the clip volume with depth 0..1, as the GPU judges it.
bool isVisible(const glm::dmat4& viewProjection, glm::dvec3 p) {
  const glm::dvec4 clip = viewProjection * glm::dvec4(p, 1);
  return std::abs(clip.x) <= clip.w && std::abs(clip.y) <= clip.w && clip.z >= 0 && clip.z <= clip.w;
}

// An orthographic view with depth 1 near and 0 far.
glm::dmat4 orthographic(double half, double nearest, double farthest) {
  glm::dmat4 m(1);
  m[0][0] = m[1][1] = 1 / half;
  m[2][2] = 1 / (farthest - nearest);
  m[3][2] = farthest / (farthest - nearest);
  return m;
}

}  // namespace

TEST_CASE("a perspective view to infinity has five planes, an orthographic one six") {
  const CameraPose pose{.position = {1, 2, 3}, .target = {4, 0, -1}};
  CHECK(frustumOf(glm::mat4(projectionMatrix(60, 1.5, 0.1) * viewMatrix(pose))).count == 5);
  CHECK(frustumOf(glm::mat4(orthographic(10, 1, 50) * viewMatrix(pose))).count == 6);
  const Frustum frustum = frustumOf(glm::mat4(projectionMatrix(60, 1.5, 0.1) * viewMatrix(pose)));
  for (int i = 0; i < frustum.count; ++i)
    CHECK(glm::length(glm::vec3(frustum.planes[i])) == doctest::Approx(1));
}

TEST_CASE("no box with a visible point is culled; most far outside are") {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0, 1);
  int culled = 0, far = 0, seen = 0;
  for (int round = 0; round < 40; ++round) {
    const auto number = [&](double size) { return (unit(random) * 2 - 1) * size; };
    const double place = round % 4 == 0 ? 1e4 : 20;
    const glm::dvec3 eye(number(place), number(place), number(place));
    const CameraPose pose{.position = eye,
                          .target = eye + glm::dvec3(number(1), number(1), number(1)),
                          .fovDegrees = 20 + 100 * unit(random)};
    const glm::dmat4 projection =
        round % 3 == 0 ? orthographic(5, 0.5, 40)
                       : projectionMatrix(pose.fovDegrees, 1.7, 0.1, {number(0.01), number(0.01)});
    const glm::mat4 viewProjection = glm::mat4(projection * viewMatrix(pose));
    std::vector<Box> boxes;
    for (int i = 0; i < 500; ++i) {
      const glm::dvec3 center = eye + glm::dvec3(number(40), number(40), number(40)),
                       half = glm::dvec3(unit(random), unit(random), unit(random)) * 3.0;
      boxes.push_back({glm::vec3(center - half), glm::vec3(center + half)});
    }
    boxes.push_back({});
    std::vector<bool> kept;
    for (const Box& box : boxes) kept.push_back(reaches(frustumOf(viewProjection), box));
    CHECK_FALSE(kept.back());  // an empty box
    for (std::size_t i = 0; i + 1 < boxes.size(); ++i) {
      bool any = false;
      for (int s = 0; s < 60 && !any; ++s) {
        const auto along = [&](float low, float high) {
          const double f = s < 8 ? static_cast<double>(random() % 2) : unit(random);  // corners first
          return static_cast<double>(low) + f * (static_cast<double>(high) - static_cast<double>(low));
        };
        any = isVisible(glm::dmat4(viewProjection),
                        {along(boxes[i].low.x, boxes[i].high.x), along(boxes[i].low.y, boxes[i].high.y),
                         along(boxes[i].low.z, boxes[i].high.z)});
      }
      seen += any ? 1 : 0;
      if (any) REQUIRE(kept[i]);
      // Far outside: the ball around the box is outside one plane.
      const glm::dvec3 center = (glm::dvec3(boxes[i].low) + glm::dvec3(boxes[i].high)) * 0.5;
      const double radius = glm::length(glm::dvec3(boxes[i].high) - center) + 1e-2;
      const Frustum frustum = frustumOf(viewProjection);
      bool outside = false;
      for (int p = 0; p < frustum.count; ++p)
        outside = outside ||
                  glm::dot(glm::dvec3(frustum.planes[p]), center) + static_cast<double>(frustum.planes[p].w) <
                      -radius;
      far += outside ? 1 : 0;
      culled += outside && !kept[i] ? 1 : 0;
    }
  }
  CHECK(seen > 1000);
  CHECK(far > 5000);
  CHECK(culled == far);
}

TEST_CASE("a command per visible mesh; its instances are where it says in the list of visible rows") {
  Scene scene;
  for (std::uint32_t i = 0; i < 4; ++i) scene.meshes.add({"m", 10 * i, 10, 100 * i, 30 + i, {}, false});
  std::vector<MeshRow> rows(9);
  const std::uint32_t meshes[] = {0, 0, 0, 1, 1, 2, 3, 3, 3};
  for (std::size_t i = 0; i < 9; ++i) rows[i].mesh = meshes[i];
  std::vector<DrawCommand> commands;
  makeCommands(scene, rows, std::vector<std::uint32_t>{0, 2, 5, 6, 8}, commands);
  CHECK(commands == std::vector<DrawCommand>{{30, 2, 0, 0, 0}, {32, 1, 200, 20, 2}, {33, 2, 300, 30, 3}});
  makeCommands(scene, rows, {}, commands);
  CHECK(commands.empty());
}
