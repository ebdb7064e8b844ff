// Temporal anti-aliasing: a still picture converges to the supersampled one and then stays as it is; what moves leaves no ghost;
// what changes without moving is followed; when off there is nothing of it.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/theory/lab.h"

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 128, kHeight = 80, kFine = 8;
// What is known after the first frame, eight more, one round of the camera's offsets, and the frames that are averaged.
constexpr std::uint32_t kConverged = 8 + 16 + 128 + 2;

Setup busy() {
  Setup setup{.graph = "graphs/taa.json", .width = kWidth, .height = kHeight};
  setup.sets = {{"curve", "linear"}, {"composite.white", "1"}, {"dither", "false"}, {"bloom", "false"}};
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
  weft::base::Diagnostics said;
  auto image =
      weft::assets::loadEnvironment(WEFT_SOURCE_DIR "/scenes/environments/spiaggia_di_mondello_1k.hdr", said);
  REQUIRE(image);
  setup.environment = std::make_shared<const weft::assets::ImageF>(std::move(*image));
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
  CHECK(lab.complaints() == "");
  return out;
}

}  // namespace

TEST_CASE("temporal anti-aliasing: a still picture comes to rest, to the bit") {
  for (const char* draw : {"billboard", "icosphere"}) {
    Lab lab(with(busy(), {{"draw", draw}}));
    for (std::uint32_t frame = 0; frame < kConverged; ++frame) lab.frame(frame);
    const Picture rest = lab.read("post.taa.kept");
    int young = 0;
    for (std::size_t i = 3; i < rest.texels.size(); i += 4) young += rest.texels[i] < 16 + 128;
    CHECK(young == 0);
    for (std::uint32_t frame = kConverged; frame < kConverged + 17; ++frame) {
      lab.frame(frame);
      const bool same = lab.read("post.taa.kept").texels == rest.texels;
      CHECK(same);
    }
    CHECK(lab.complaints() == "");
  }
}

TEST_CASE(
    "temporal anti-aliasing: a still picture is nearer to 64 samples a pixel than with FXAA, or with "
    "nothing") {
  for (const char* draw : {"billboard", "icosphere"}) {
    const Setup setup = with(busy(), {{"draw", draw}, {"subdivision", "5"}});
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
