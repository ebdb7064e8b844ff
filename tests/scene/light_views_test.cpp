// What lights look from, against points projected by hand and the faces of OpenGL's cube maps.
#include "engine/scene/light_views.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace weft::scene;

namespace {

std::mt19937 engine{7};

glm::vec3 randomIn(float low, float high) {
  std::uniform_real_distribution<float> distribution(low, high);
  const float x = distribution(engine), y = distribution(engine);
  return {x, y, distribution(engine)};
}

glm::vec3 projected(const glm::mat4& matrix, glm::vec3 point) {
  const glm::vec4 clip = matrix * glm::vec4(point, 1);
  return glm::vec3(clip) / clip.w;
}

}  // namespace

TEST_CASE(
    "the sun's map holds all of the box, nearer to the sun is deeper, and a texel is as large as it says") {
  for (int round = 0; round < 200; ++round) {
    const glm::vec3 a = randomIn(-50, 50), b = randomIn(-50, 50);
    const Box box{glm::min(a, b), glm::max(a, b)};
    Sun sun;
    sun.direction = round == 0 ? glm::vec3(0, 1, 0) : glm::normalize(randomIn(-1, 1));
    const SunView fitted = sunView(sun, box, 256);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 point{corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                            corner & 4 ? box.high.z : box.low.z};
      const glm::vec3 at = projected(fitted.shadowMatrix, point);
      for (int axis = 0; axis < 3; ++axis) {
        REQUIRE(at[axis] >= 0);
        REQUIRE(at[axis] <= 1);
      }
      CHECK(projected(fitted.shadowMatrix, point + sun.direction * 0.5f).z > at.z);
      const glm::vec3 clip = projected(fitted.view.view_projection, point);
      CHECK(std::abs(clip.x * 0.5f + 0.5f - at.x) < 1e-5f);
      CHECK(std::abs(clip.z - at.z) < 1e-5f);
    }
    // Across the light, one texel along the map's u.
    const glm::vec3 across = glm::vec3(glm::transpose(fitted.view.view) * glm::vec4(1, 0, 0, 0));
    const glm::vec3 from = projected(fitted.shadowMatrix, box.center());
    const glm::vec3 to = projected(fitted.shadowMatrix, box.center() + across * fitted.texel);
    CHECK(std::abs((to.x - from.x) * 256 - 1) < 2e-3f);
    CHECK(fitted.texel * 256 < 2.6f * glm::length(box.high - box.low) / 2 * 1.1f);  // no more than it needs
  }
}

TEST_CASE("texels stay where they are in the world while the bounds wander") {
  const Sun sun{.direction = glm::normalize(glm::vec3(1, 2, 0.5f))};
  const glm::vec3 point{1, 2, 3};
  const auto fractionOf = [&](const Box& box) {
    const SunView fitted = sunView(sun, box, 512);
    const glm::vec3 at = projected(fitted.shadowMatrix, point) * 512.0f;
    return glm::vec3(at.x - std::floor(at.x), at.y - std::floor(at.y), fitted.texel);
  };
  const glm::vec3 first = fractionOf({{-10, -10, -10}, {10, 10, 10}});
  for (int step = 1; step < 40; ++step) {
    const float away = 0.03f * static_cast<float>(step);
    const glm::vec3 now = fractionOf({{-10 + away, -10, -10 - away}, {10 + away, 10, 10 - away}});
    CHECK(now.z == first.z);
    for (int axis = 0; axis < 2; ++axis) {
      const float apart = std::abs(now[axis] - first[axis]);
      CHECK(std::min(apart, 1 - apart) < 0.01f);
    }
  }
}

TEST_CASE("the faces of a lamp are those of a cube map: OpenGL 4.5 core, section 8.13") {
  Lamp lamp;
  lamp.position = {3, -2, 5};
  lamp.range = 100;
  for (int round = 0; round < 2000; ++round) {
    const glm::vec3 r = randomIn(-1, 1), size = glm::abs(r);
    if (std::max({size.x, size.y, size.z}) < 0.01f) continue;
    std::uint32_t face;
    float s, t, major;
    if (size.x >= size.y && size.x >= size.z) {
      face = r.x > 0 ? 0 : 1;
      s = r.x > 0 ? -r.z : r.z;
      t = -r.y;
      major = size.x;
    } else if (size.y >= size.z) {
      face = r.y > 0 ? 2 : 3;
      s = r.x;
      t = r.y > 0 ? r.z : -r.z;
      major = size.y;
    } else {
      face = r.z > 0 ? 4 : 5;
      s = r.z > 0 ? r.x : -r.x;
      t = -r.y;
      major = size.z;
    }
    const ViewData view = cubeView(lamp.position, nearPlaneOf(lamp), face, 128);
    const glm::vec3 at = projected(view.view_projection, lamp.position + r * 7.0f);
    CHECK(std::abs(at.x - s / major) < 1e-4f);
    CHECK(std::abs(at.y - t / major) < 1e-4f);
    CHECK(std::abs(at.z - nearPlaneOf(lamp) / (7 * major)) < 1e-5f);
  }
}
