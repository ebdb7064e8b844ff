// Motion blur against the definition of a shutter: the mean of sharp pictures from all over the time for which it is open. The sharp
// pictures are Weft's; how they are added up is all that the shutter is.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "tests/theory/lab.h"
#include "tests/theory/lens/compare.h"
#include "tests/theory/lens/one_picture.h"

namespace lens_shutter_test {

using namespace weft;
using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 480, kHeight = 270;
constexpr int kMoments = 64;
constexpr double kFrame = 1 / 60.0;
using Scene = std::function<std::vector<Ball>()>;

// Where the camera looks, in radians about the vertical axis through it, `seconds` after the middle of the shutter's time.
scene::CameraKey poseAt(double time, double seconds, double turn) {
  const double angle = turn * seconds;
  const glm::dvec3 eye(0, 0.6, 7), ahead(std::sin(angle), -0.08, -std::cos(angle));
  return {time, eye, eye + 7.0 * ahead, 40};
}

// Scenes are as they stand in the middle of the shutter's time. Two rows of small spheres far away, which move by 12 pixels a frame.
void addRows(std::vector<Ball>& balls, glm::vec3 velocity) {
  for (int i = 0; i < 18; ++i)
    balls.push_back({.center = {float(i % 9 - 4) * 3, i / 9 ? 4.4f : -6.4f, -14},
                     .albedo = {i % 2 ? 0.9f : 0.2f, 0.5f, i % 3 ? 0.2f : 0.9f},
                     .metallic = 0,
                     .velocity = i % 2 ? velocity : -velocity});
}

// Spheres that cross each other's way at several distances, by up to 25 pixels a frame.
std::vector<Ball> crossing() {
  std::vector<Ball> balls = {
      {.center = {-1.0f, 0, 0}, .albedo = {1, 0.76f, 0.33f}, .roughness = 0.4f, .velocity = {28, 0, 0}},
      {.center = {0.9f, 0.5f, -1.5f}, .albedo = {0.6f, 0.05f, 0.04f}, .metallic = 0, .velocity = {0, -32, 0}},
      {.center = {0.2f, -0.9f, 2},
       .radius = 0.5f,
       .albedo = {0.1f, 0.3f, 0.8f},
       .metallic = 0,
       .velocity = {-15, 15, 0}},
      {.center = {2.6f, 0.3f, -1}, .albedo = {0.8f, 0.8f, 0.8f}, .metallic = 0},
      {.center = {2.2f, 0.9f, 1.5f},
       .radius = 0.45f,
       .albedo = {0.1f, 0.7f, 0.2f},
       .metallic = 0,
       .velocity = {20, 6, 0}}};
  addRows(balls, {0, 40, 0});
  return balls;
}

// Spheres that come from behind others, pass each other in opposite directions, come towards the camera, and are partly out of the picture.
std::vector<Ball> emerging() {
  const auto ball = [](glm::vec3 center, float radius, glm::vec3 albedo, glm::vec3 velocity) {
    return Ball{.center = center, .radius = radius, .albedo = albedo, .metallic = 0, .velocity = velocity};
  };
  std::vector<Ball> balls = {ball({-2.2f, 0.2f, 0.5f}, 0.8f, {0.8f, 0.8f, 0.8f}, {0, 0, 0}),
                             ball({-1.5f, 0.5f, -1}, 0.7f, {0.7f, 0.1f, 0.05f}, {28, 4, 0}),
                             ball({-3.1f, 0, -2}, 0.8f, {0.1f, 0.5f, 0.1f}, {-34, -8, 0}),
                             {.center = {1.2f, 0.9f, 0.5f},
                              .radius = 0.6f,
                              .albedo = {1, 0.76f, 0.33f},
                              .roughness = 0.4f,
                              .velocity = {-26, 0, 0}},
                             ball({1.6f, 0.6f, -1.5f}, 0.9f, {0.1f, 0.2f, 0.8f}, {30, 0, 0}),
                             ball({1.3f, -0.9f, -1}, 0.7f, {0.9f, 0.9f, 0.2f}, {0, 30, 0}),
                             ball({1.5f, -0.9f, 1}, 0.5f, {0.5f, 0.05f, 0.5f}, {0, -22, 0}),
                             ball({4.3f, 1.2f, 0}, 0.9f, {0.8f, 0.3f, 0.1f}, {-30, 10, 0}),
                             ball({-4.2f, -1.6f, 0}, 0.8f, {0.2f, 0.7f, 0.7f}, {-30, 0, 0}),
                             ball({0.1f, 2.3f, 1}, 0.5f, {0.9f, 0.9f, 0.9f}, {10, 24, 0}),
                             ball({-0.8f, -2, 1.5f}, 0.5f, {0.05f, 0.4f, 0.1f}, {14, -18, 0}),
                             ball({0, -0.3f, 2.5f}, 0.35f, {0.9f, 0.1f, 0.1f}, {-10, 8, 20}),
                             ball({-0.2f, 0.4f, -3}, 1, {0.3f, 0.3f, 0.9f}, {20, -20, -30})};
  addRows(balls, {40, 0, 0});
  return balls;
}

// 24 spheres anywhere, which move by up to 26 pixels a frame in any direction and do not touch; every fifth is still.
std::vector<Ball> scattered() {
  std::mt19937 random(2);
  const auto chance = [&] { return float(random()) / 4294967296.0f; };
  std::vector<Ball> balls;
  while (balls.size() < 24) {
    Ball ball{.metallic = 0};
    const float z = -6 + 8 * chance(), away = 7 - z, x = chance() * 2 - 1, y = chance() * 2 - 1;
    ball.center = {x * 0.7f * away, y * 0.38f * away + 0.6f - 0.08f * away, z};
    ball.radius = (0.04f + 0.08f * chance()) * away;
    for (int c = 0; c < 3; ++c) ball.albedo[c] = 0.05f + 0.9f * chance();
    const float angle = 6.2831853f * chance(), speed = 4.2f * chance() * away, back = chance() - 0.5f;
    if (balls.size() % 5 != 0) ball.velocity = speed * glm::vec3(std::cos(angle), std::sin(angle), back);
    const bool alone = std::ranges::none_of(balls, [&](const Ball& other) {
      return std::ranges::any_of(std::vector{-0.5f, 0.0f, 0.5f}, [&](float frames) {
        const glm::vec3 apart = ball.center - other.center + (ball.velocity - other.velocity) * (frames / 60);
        return glm::length(apart) < ball.radius + other.radius;
      });
    });
    if (alone) balls.push_back(ball);
  }
  return balls;
}

// `seconds` after the middle; `slower`: share of their motion in a frame.
std::vector<Ball> ballsAt(const Scene& scene, double seconds, double slower) {
  std::vector<Ball> balls = scene();
  for (Ball& ball : balls) {
    ball.center += ball.velocity * float(seconds);
    ball.velocity *= float(slower);
  }
  return balls;
}

Setup sceneOf() {
  Setup setup{.graph = "tests/theory/lens/lens.json", .width = kWidth, .height = kHeight};
  setup.camera = {.position = {0, 0.6, 7}, .target = {0, 0, 0}, .fovDegrees = 40, .nearPlane = 0.1};
  setup.environment = coarseEnvironment();
  return setup;
}

struct Panels {
  Radiance sharp, blurred;
};

Panels byWeft(const Scene& scene, double turn, double degrees, int layers) {
  Setup setup = sceneOf();
  setup.balls = ballsAt(scene, -kFrame, 1);
  setup.sets = {{"motion_blur", "true"},
                {"bloom", "false"},
                {"shutter", std::to_string(int(degrees))},
                {"motion_layers", std::to_string(layers)}};
  for (int i = 0; i < 3; ++i) setup.path.push_back(poseAt(i * kFrame, (i - 1) * kFrame, turn));
  Lab lab(setup);
  lab.frame(0);
  lab.frame(1);
  const Picture panels = lab.read("panels");
  CHECK(lab.reports() == "");
  Panels result;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      for (int c = 0; c < 3; ++c) {
        result.sharp.push_back(double(panels.at(x, y)[c]));
        result.blurred.push_back(double(panels.at(kWidth + x, y)[c]));
      }
  return result;
}

// The mean of the moments; `judge` sees each of them.
Radiance throughShutter(const Scene& scene, double turn, double degrees, OnePicture& judge) {
  Setup setup = sceneOf();
  const double open = kFrame * degrees / 360, step = open / kMoments, first = -open / 2 + step / 2;
  setup.balls = ballsAt(scene, first, step / kFrame);
  setup.graph = "tests/theory/lens/sharp.json";
  setup.disables = {"post"};
  for (int i = 0; i < kMoments; ++i) setup.path.push_back(poseAt(i * kFrame, first + i * step, turn));
  Lab lab(setup);
  Radiance sum(std::size_t{kWidth} * kHeight * 3);
  for (int i = 0; i < kMoments; ++i) {
    lab.frame(static_cast<std::uint32_t>(i));
    const Picture sharp = lab.read("sharp");
    judge.add(first + i * step, setup.path[std::size_t(i)], sharp, 1.0 / kMoments);
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          sum[(std::size_t{y} * kWidth + x) * 3 + c] += double(sharp.at(x, y)[c]) / kMoments;
  }
  CHECK(lab.reports() == "");
  return sum;
}

}  // namespace

TEST_CASE("shutter: where motions cross, the picture is the mean of 64 moments") {
  // Before a sky that turns by so many radians per second, or is still. Bounds from one picture, and with a second layer, which has what the
  // one picture hides: of the mean and of the 99th percentile. `share`: the 99th percentile from one picture is at most so much of that of a
  // judge who knows where everything is at every moment.
  const struct {
    const char* name;
    Scene scene;
    double turn, degrees;
    struct {
      double mean, most;
    } one, two;
    double share;
  } cases[] = {{"crossing", crossing, 0, 180, {0.45, 6.3}, {0.4, 5.7}, 0.9},
               {"crossing", crossing, 2, 180, {0.5, 6.6}, {0.46, 6}, 1},
               {"scattered", scattered, 0, 180, {0.52, 8}, {0.49, 8}, 1},
               {"crossing", crossing, 0, 360, {0.71, 8}, {0.52, 6.7}, 1},
               {"scattered", scattered, 0, 360, {0.64, 8}, {0.53, 7.8}, 1},
               {"emerging", emerging, 0, 180, {0.81, 12}, {0.53, 7.8}, 1},
               {"emerging", emerging, 0, 360, {1.5, 26}, {0.79, 8}, 1.45}};
  for (const auto& each : cases) {
    const Panels one = byWeft(each.scene, each.turn, each.degrees, 1);
    const Panels two = byWeft(each.scene, each.turn, each.degrees, 2);
    OnePicture judge(each.scene(), poseAt(0, 0, each.turn), kWidth, kHeight, one.sharp);
    const Radiance truth = throughShutter(each.scene, each.turn, each.degrees, judge);
    const Difference difference = differenceOf(truth, one.blurred), better = differenceOf(truth, two.blurred),
                     without = differenceOf(truth, one.sharp),
                     judged = differenceOf(truth, judge.withItsColors()),
                     told = differenceOf(truth, judge.withTrueColors());
    MESSAGE(std::string(each.name), ", turning by ", each.turn, ", ", each.degrees, " degrees: not blurred ",
            without.percentile99, ", one layer ", difference.percentile99, " (mean ", difference.mean,
            "), two layers ", better.percentile99, " (mean ", better.mean, "); hidden ", 100 * judge.hidden(),
            " %, judge ", judged.percentile99, ", judge with true colors of what is visible ",
            told.percentile99);
    CAPTURE(each.name);
    CAPTURE(each.turn);
    CAPTURE(each.degrees);
    CHECK(without.percentile99 > 30);
    CHECK(told.percentile99 < judged.percentile99);
    CHECK(difference.mean < each.one.mean);
    CHECK(difference.percentile99 < each.one.most);
    CHECK(difference.percentile99 < each.share * judged.percentile99);
    CHECK(better.mean < each.two.mean);
    CHECK(better.percentile99 < each.two.most);
  }
}

}  // namespace lens_shutter_test
