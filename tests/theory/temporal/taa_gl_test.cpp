// Temporal anti-aliasing: a still picture converges to the supersampled one and then stays as it is; what moves leaves no ghost;
// what changes without moving is followed; when off there is nothing of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/load_image.h"
#include "tests/theory/lab.h"

namespace temporal_taa_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 128, kHeight = 80, kFine = 8;
// What is known after the first frame, eight more, one round of the camera's offsets, and the frames that are averaged.
constexpr std::uint32_t kFrames = 64, kConverged = 8 + 16 + kFrames + 2;

std::shared_ptr<const weft::assets::ImageF> photographedSky() {
  static const auto once = [] {
    weft::text::Diagnostics said;
    auto image = weft::assets::loadEnvironment(
        WEFT_SOURCE_DIR "/scenes/environments/spiaggia_di_mondello_1k.hdr", said);
    REQUIRE(image);
    return std::make_shared<const weft::assets::ImageF>(std::move(*image));
  }();
  return once;
}

Setup busy() {
  Setup setup{.graph = "graphs/taa.json", .width = kWidth, .height = kHeight};
  setup.sets = {{"curve", "linear"},
                {"composite.white", "1"},
                {"dither", "false"},
                {"bloom", "false"},
                {"taa_frames", std::to_string(kFrames)}};
  setup.camera = {.position = {0, 0, 10}, .target = {0, 0, 0}, .fovDegrees = 45, .nearPlane = 0.1};
  float x = -5;
  for (const float roughness : {0.0f, 0.1f, 0.3f, 0.6f}) {
    const glm::vec3 albedo(0.9f, 0.5f + roughness / 2, 0.3f);
    setup.balls.push_back({.center = {x, 1.2f, 0}, .radius = 1.5f, .albedo = albedo, .roughness = roughness});
    setup.balls.push_back({.center = {x, -2.2f, 1}, .radius = 0.8f, .metallic = 0, .roughness = roughness});
    for (int i = 0; i < 6; ++i)
      setup.balls.push_back(
          {.center = {x + 0.3f * static_cast<float>(i), -0.9f, 0}, .radius = 0.11f, .roughness = roughness});
    x += 3.3f;
  }
  setup.environment = photographedSky();
  return setup;
}

Setup with(Setup setup, std::vector<weft::graph::Setting> sets) {
  setup.sets.insert(setup.sets.end(), sets.begin(), sets.end());
  return setup;
}

// What each pixel is of 255, encoded.
using Encoded = std::vector<double>;

Encoded encodedOf(Lab& lab) {
  const Picture picture = lab.read("post.ldr");
  Encoded out;
  for (std::size_t i = 0; i < picture.texels.size(); ++i)
    if (i % 4 != 3) out.push_back(255 * static_cast<double>(picture.texels[i]));
  return out;
}

double encoded(double linear) {
  const double c = std::clamp(linear, 0.0, 1.0);
  return 255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
}

// The mean radiance of kFine x kFine pixels for each, of one frame, encoded.
Encoded supersampled(Setup setup, std::uint32_t frame) {
  setup.graph = "tests/theory/draw_modes.json";
  std::erase_if(setup.sets, [](const auto& set) { return set.name != "draw" && set.name != "subdivision"; });
  setup.width *= kFine;
  setup.height *= kFine;
  Lab lab(setup);
  for (std::uint32_t i = frame > 0 ? frame - 1 : 0; i <= frame; ++i) lab.frame(i);
  const Picture fine = lab.read("panels");
  Encoded out;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      for (std::uint32_t c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::uint32_t j = 0; j < kFine; ++j)
          for (std::uint32_t i = 0; i < kFine; ++i)
            sum += static_cast<double>(fine.at(x * kFine + i, y * kFine + j)[c]);
        out.push_back(encoded(sum / (kFine * kFine)));
      }
  return out;
}

double meanDifference(const Encoded& a, const Encoded& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
  return sum / static_cast<double>(a.size());
}

double rootMeanSquare(const Encoded& a, const Encoded& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

Encoded drawn(const Setup& setup, std::uint32_t frames) {
  Lab lab(setup);
  for (std::uint32_t frame = 0; frame < frames; ++frame) lab.frame(frame);
  Encoded out = encodedOf(lab);
  CHECK(lab.reports() == "");
  return out;
}

}  // namespace

TEST_CASE("temporal anti-aliasing: a still picture comes to rest, to the bit") {
  for (const char* draw : {"billboard", "icosphere"}) {
    Lab lab(with(busy(), {{"draw", draw}}));
    for (std::uint32_t frame = 0; frame < kConverged; ++frame) lab.frame(frame);
    const Picture rest = lab.read("post.taa.kept");
    int young = 0;
    for (std::size_t i = 3; i < rest.texels.size(); i += 4) young += rest.texels[i] < 16 + kFrames;
    CHECK(young == 0);
    for (std::uint32_t frame = kConverged; frame < kConverged + 17; ++frame) {
      lab.frame(frame);
      const bool same = lab.read("post.taa.kept").texels == rest.texels;
      CHECK(same);
    }
    CHECK(lab.reports() == "");
  }
}

TEST_CASE("temporal anti-aliasing: a still picture is nearer to 64 samples a pixel than with FXAA") {
  for (const char* draw : {"billboard", "icosphere"}) {
    const Setup setup = with(busy(), {{"draw", draw}, {"subdivision", "4"}});
    const Encoded truth = supersampled(setup, 0);
    const Encoded taa = drawn(setup, kConverged), plain = drawn(with(setup, {{"taa", "false"}}), 1),
                  fxaa = drawn(with(setup, {{"taa", "false"}, {"fxaa", "true"}}), 1);
    MESSAGE(std::string(draw), ": mean difference and root mean square of 255: TAA ",
            meanDifference(taa, truth), ", ", rootMeanSquare(taa, truth), "; FXAA ",
            meanDifference(fxaa, truth), ", ", rootMeanSquare(fxaa, truth), "; nothing ",
            meanDifference(plain, truth), ", ", rootMeanSquare(plain, truth));
    CHECK(meanDifference(taa, truth) < meanDifference(fxaa, truth));
    CHECK(meanDifference(taa, truth) < meanDifference(plain, truth));
    CHECK(rootMeanSquare(taa, truth) < rootMeanSquare(fxaa, truth));
    CHECK(rootMeanSquare(taa, truth) < rootMeanSquare(plain, truth));
  }
}

TEST_CASE("temporal anti-aliasing: a ball that moves four pixels a frame leaves no ghost") {
  constexpr std::uint32_t kFrame = 14;
  constexpr double kStep = 0.4, kPixels = kHeight / 2 / 0.41421356 / 10;  // units a frame, pixels a unit
  Setup setup = busy();
  setup.balls = {{.center = {static_cast<float>(-kStep * kFrame / 2), 0.3f, 0},
                  .albedo = {0.9f, 0.1f, 0.05f},
                  .metallic = 0,
                  .velocity = {static_cast<float>(kStep * 60), 0, 0}}};
  const Encoded truth = supersampled(setup, kFrame), taa = drawn(setup, kFrame + 1),
                plain = drawn(with(setup, {{"taa", "false"}}), kFrame + 1);
  // Where the ball was within the last eight frames, two pixels beside where it is now.
  const auto distance = [&](std::uint32_t x, std::uint32_t y, double frame) {
    return std::hypot(x + 0.5 - kWidth / 2.0 - kPixels * kStep * (frame - kFrame / 2.0),
                      y + 0.5 - kHeight / 2.0 - kPixels * 0.3);
  };
  double sum = 0, most = 0, sum_plain = 0, ball = 0;
  int count = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      bool was = false;
      for (int i = 1; i <= 8; ++i) was = was || distance(x, y, kFrame - i) < kPixels;
      if (!was || distance(x, y, kFrame) < kPixels + 2) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t at = (std::size_t{y} * kWidth + x) * 3 + c;
        sum += std::abs(taa[at] - truth[at]);
        sum_plain += std::abs(plain[at] - truth[at]);
        most = std::max(most, std::abs(taa[at] - truth[at]));
        ++count;
      }
    }
  // What a ghost would be: the ball's color beside the sky's.
  const std::size_t on_ball = (std::size_t{kHeight / 2} * kWidth + kWidth / 2 +
                               static_cast<std::size_t>(kPixels * kStep * kFrame / 2)) *
                                  3 +
                              2;
  ball = std::abs(truth[on_ball] - truth[(std::size_t{kHeight / 2} * kWidth + 4) * 3 + 2]);
  REQUIRE(count > 1000);
  CHECK(ball > 60);
  MESSAGE("in the wake: mean ", sum / count, " and at most ", most, " of 255; without TAA ",
          sum_plain / count, "; the ball is off by ", ball, "; whole picture: TAA ",
          meanDifference(taa, truth), ", without ", meanDifference(plain, truth));
  CHECK(sum / count < 5);
  CHECK(most < 0.3 * ball);
}

TEST_CASE("temporal anti-aliasing: light that changes on still things is followed") {
  constexpr std::uint32_t kFrom = 100;  // as in dim.json: by then the picture rests
  static_assert(kFrom > kConverged);
  Setup setup = busy();
  setup.graph = "tests/theory/temporal/dim.json";
  Lab lab(setup);
  const auto mean = [&] {
    const Picture picture = lab.read("post.taa.kept");
    double sum = 0;
    for (std::size_t i = 0; i < picture.texels.size(); i += 4) sum += static_cast<double>(picture.texels[i]);
    return sum;
  };
  for (std::uint32_t frame = 0; frame < kFrom; ++frame) lab.frame(frame);
  const double before = mean();
  for (std::uint32_t frame = kFrom; frame < kFrom + 12; ++frame) lab.frame(frame);
  MESSAGE("a tenth darker; after 12 frames: ", mean() / before);
  CHECK(std::abs(mean() / before - 0.9) < 0.01);
}

}  // namespace temporal_taa_test
