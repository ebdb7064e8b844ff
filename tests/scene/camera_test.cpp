#include "engine/scene/camera.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace weft::scene;

static glm::dvec3 project(const glm::mat4& m, glm::dvec3 p) {
  const glm::dvec4 clip = glm::dmat4(m) * glm::dvec4(p, 1);
  return glm::dvec3(clip) / clip.w;
}

static ViewRequest standard() {
  ViewRequest request;
  request.pose = {{0, 0, 20}, {0, 0, 0}, 60, 0.5};
  request.previousPose = request.pose;
  request.viewport = {1280, 720};
  return request;
}

TEST_CASE("the near plane has depth 1, infinity 0, and depth falls in between as near / distance") {
  const ViewData v = makeView(standard());
  CHECK(project(v.view_projection, {0, 0, 19.5}).z == doctest::Approx(1));
  CHECK(project(v.view_projection, {0, 0, 15}).z == doctest::Approx(0.1));
  CHECK(project(v.view_projection, {3, 2, -1e9}).z == doctest::Approx(0).epsilon(1e-8));
  const glm::vec4 infinity = v.view_projection * glm::vec4(0, 0, -1, 0);
  CHECK(infinity.z == 0);
  CHECK(infinity.w > 0);
}

TEST_CASE("known points: the target is the center, +X right, +Y up, the edge of the field at clip 1") {
  const ViewData v = makeView(standard());
  const glm::dvec3 center = project(v.view_projection, {0, 0, 0});
  CHECK(center.x == doctest::Approx(0));
  CHECK(center.y == doctest::Approx(0));
  const double half = 20 * std::tan(30 * 3.14159265358979 / 180);
  CHECK(project(v.view_projection, {0, half, 0}).y == doctest::Approx(1));
  CHECK(project(v.view_projection, {half * 1280 / 720, 0, 0}).x == doctest::Approx(1));
  CHECK((v.view * glm::vec4(0, 0, 0, 1)).z == doctest::Approx(-20));
  CHECK(v.eye == glm::vec3(0, 0, 20));
  CHECK(v.near_plane == 0.5f);
  CHECK(v.viewport == glm::vec2(1280, 720));
}

TEST_CASE("the inverse takes clip back to world") {
  ViewRequest request = standard();
  request.pose = {{3, 5, -7}, {1, 0, 2}, 45, 0.01};
  request.jitter = {0.25f, -0.4f};
  const ViewData v = makeView(request);
  for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), glm::dvec3(1, 2, 3), glm::dvec3(-4, 1, 10)}) {
    const glm::dvec3 back = project(v.inverse_view_projection, project(v.view_projection, p));
    CHECK(glm::length(back - p) < 1e-2);
  }
  const glm::dmat4 exact = glm::dmat4(v.view_projection) * glm::dmat4(v.inverse_view_projection);
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) CHECK(exact[c][r] == doctest::Approx(c == r ? 1 : 0).epsilon(1e-4));
}

TEST_CASE(
    "jitter moves every point by so many pixels, right and up, at every distance; motion is free of it") {
  ViewRequest request = standard();
  const ViewData still = makeView(request);
  request.jitter = {0.5f, 0.25f};
  const ViewData moved = makeView(request);
  for (const glm::dvec3 p : {glm::dvec3(0, 0, 0), glm::dvec3(5, -3, 10), glm::dvec3(-30, 20, -400)}) {
    const glm::dvec3 d = project(moved.view_projection, p) - project(still.view_projection, p);
    CHECK(d.x * 1280 / 2 == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(d.y * 720 / 2 == doctest::Approx(0.25).epsilon(1e-3));
    CHECK(project(moved.previous_view_projection, p) == project(moved.view_projection, p));
  }
}

TEST_CASE("straight down and straight up have a view") {
  for (const double side : {1.0, -1.0}) {
    CameraPose pose;
    pose.position = {0, 20 * side, 0};
    const glm::dmat4 view = viewMatrix(pose);
    CHECK(glm::determinant(view) == doctest::Approx(1));
    CHECK((view * glm::dvec4(0, 0, 0, 1)).z == doctest::Approx(-20));
    CHECK((view * glm::dvec4(0, 0, -side, 1)).y == doctest::Approx(1));
    CHECK((view * glm::dvec4(1, 0, 0, 1)).x == doctest::Approx(1));
  }
}

TEST_CASE("an orbit turns +Z towards +X and comes round; a still camera never moves") {
  Camera camera{"c", {{0, 2, 10}, {0, 0, 0}, 60, 0.1}, 90, {}};
  CHECK(isMoving(camera));
  CHECK(poseAt(camera, 0) == camera.pose);
  const CameraPose quarter = poseAt(camera, 1);
  CHECK(quarter.position.x == doctest::Approx(10));
  CHECK(quarter.position.y == 2);
  CHECK(quarter.position.z == doctest::Approx(0));
  CHECK(poseAt(camera, 4) == camera.pose);
  camera.orbitDegreesPerSecond = 0;
  CHECK_FALSE(isMoving(camera));
  CHECK(poseAt(camera, 1e6) == camera.pose);
}

TEST_CASE("a path is linear between its keys and held outside") {
  Camera camera;
  camera.path = {
      {1, {0, 0, 10}, {0, 0, 0}, 60}, {3, {4, 0, 10}, {0, 2, 0}, 40}, {4, {4, 0, 0}, {0, 2, -5}, 40}};
  CHECK(isMoving(camera));
  CHECK(poseAt(camera, -5).position == glm::dvec3(0, 0, 10));
  CHECK(poseAt(camera, 1).position == glm::dvec3(0, 0, 10));
  CHECK(poseAt(camera, 2).position == glm::dvec3(2, 0, 10));
  CHECK(poseAt(camera, 2).target == glm::dvec3(0, 1, 0));
  CHECK(poseAt(camera, 2).fovDegrees == 50);
  CHECK(poseAt(camera, 3).position == glm::dvec3(4, 0, 10));
  CHECK(poseAt(camera, 9).position == glm::dvec3(4, 0, 0));
}

TEST_CASE("the previous matrices are those of the previous pose") {
  ViewRequest request = standard();
  request.previousPose.position = {1, 0, 20};
  request.previousPose.target = {1, 0, 0};
  const ViewData v = makeView(request);
  CHECK(project(v.previous_view_projection, {1, 0, 0}).x == doctest::Approx(0));
  CHECK(v.previous_eye == glm::vec3(1, 0, 20));
  CHECK(v.previous_view_projection != v.view_projection);
}

TEST_CASE("the angle of view of a lens: 24 mm of sensor are 53 degrees at 24 mm, 16 at 85") {
  CHECK(fovOfLens(24, 24) == doctest::Approx(53.1301024));
  CHECK(fovOfLens(85, 24) == doctest::Approx(16.07138));
  CHECK(fovOfLens(0.5, 1) == doctest::Approx(90));
}

TEST_CASE("jitter repeats after its period, is spread, and averages near zero") {
  CHECK(jitterAt(5, 0) == glm::vec2(0));
  CHECK(jitterAt(5, 1) == glm::vec2(0));
  glm::vec2 sum(0);
  for (std::uint32_t i = 0; i < 16; ++i) {
    const glm::vec2 j = jitterAt(i, 16);
    CHECK(j == jitterAt(i + 16, 16));
    CHECK(std::max(std::abs(j.x), std::abs(j.y)) <= 0.5f);
    for (std::uint32_t k = 0; k < i; ++k) CHECK(glm::length(j - jitterAt(k, 16)) > 0.05f);
    sum += j;
  }
  CHECK(glm::length(sum) / 16 < 0.05f);
}
