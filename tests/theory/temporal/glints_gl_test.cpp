// The light of a small mirror that moves under a photographed sky with its sun: the same in every frame, and as much
// as theory says. A sphere scatters light from one direction evenly into all (dA = r^2 / 4 of its disc per solid angle),
// so from far away a mirror is, on average over its disc, as bright as the environment over all directions.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/load_image.h"
#include "tests/theory/lab.h"

namespace temporal_glints_test {

using namespace weft::theory;

namespace {

constexpr const char* kMap = WEFT_SOURCE_DIR "/scenes/environments/spiaggia_di_mondello_1k.hdr";
constexpr std::uint32_t kWidth = 112, kHeight = 80, kFrames = 48, kFirst = 8;
constexpr double kDistance = 60;             // world units
constexpr double kRight = 0.61, kUp = 0.23;  // pixels a frame

using Image = std::shared_ptr<const weft::assets::ImageF>;

Image environment() {
  static const Image once = [] {
    weft::text::Diagnostics said;
    auto image = weft::assets::loadEnvironment(kMap, said);
    REQUIRE(image);
    return std::make_shared<const weft::assets::ImageF>(std::move(*image));
  }();
  return once;
}

double luminanceOf(const float* texel) {
  return 0.2126 * static_cast<double>(texel[0]) + 0.7152 * static_cast<double>(texel[1]) +
         0.0722 * static_cast<double>(texel[2]);
}

// Over all directions, of a map as it was decoded.
double meanRadiance(const weft::assets::ImageF& map) {
  double sum = 0;
  for (int y = 0; y < map.height; ++y) {
    const double share =
        (std::cos(std::numbers::pi * y / map.height) - std::cos(std::numbers::pi * (y + 1) / map.height)) /
        (2 * map.width);
    for (int x = 0; x < map.width; ++x)
      sum +=
          share * luminanceOf(&map.texels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) +
                                           static_cast<std::size_t>(x)) *
                                          static_cast<std::size_t>(map.channels)]);
  }
  return sum;
}

struct Moving {
  Setup setup;
  glm::dvec3 right, back;
  double unitsPerPixel = 0;
  double radius = 16, faster = 1;  // pixels; times kRight and kUp
  double area() const { return std::numbers::pi * radius * radius; }
};

// A white metal that crosses the picture; `azimuth` turns the camera about it.
Moving moving(double azimuth, double roughness, const Image& image, double radius = 16, double faster = 1) {
  Moving out;
  out.radius = radius;
  out.faster = faster;
  const double a = azimuth * std::numbers::pi / 180;
  out.back = {std::sin(a), 0, std::cos(a)};
  out.right = {std::cos(a), 0, -std::sin(a)};
  out.unitsPerPixel = 1 / radius;
  const double slope = kHeight / 2 * out.unitsPerPixel / kDistance;
  out.setup.width = kWidth;
  out.setup.height = kHeight;
  out.setup.camera = {.position = out.back * kDistance,
                      .target = {0, 0, 0},
                      .fovDegrees = 2 * std::atan(slope) * 180 / std::numbers::pi,
                      .nearPlane = 0.1};
  const double middle = kFirst + kFrames / 2;
  const glm::dvec3 step = (out.right * kRight + glm::dvec3(0, kUp, 0)) * (faster * out.unitsPerPixel);
  out.setup.balls = {{.center = glm::vec3(-step * middle),
                      .radius = 1,
                      .roughness = static_cast<float>(roughness),
                      .velocity = glm::vec3(step * 60.0)}};
  out.setup.environment = image;
  return out;
}

// What the disc of the mirror covers of a pixel, roughly: the sky behind it is dim and smooth.
double hidden(const Moving& moving, std::uint32_t frame, std::uint32_t x, std::uint32_t y) {
  const double steps = (static_cast<double>(frame) - (kFirst + kFrames / 2)) * moving.faster;
  const double dx = x + 0.5 - kWidth / 2 - kRight * steps, dy = y + 0.5 - kHeight / 2 - kUp * steps;
  return std::clamp(moving.radius + 0.5 - std::sqrt(dx * dx + dy * dy), 0.0, 1.0);
}

// The mirror's light in each frame: that of the picture, less the sky beside it.
std::vector<double> lightOf(const Moving& moving, const std::string& graph, const std::string& picture_of,
                            const std::vector<weft::graph::Setting>& sets) {
  Setup setup = moving.setup;
  setup.graph = graph;
  setup.sets = sets;
  Setup empty = setup;
  empty.balls.clear();
  Lab sky(empty), lab(setup);
  sky.frame();
  const Picture behind = sky.read(picture_of);
  std::vector<double> light;
  for (std::uint32_t frame = 0; frame < kFirst + kFrames; ++frame) {
    lab.frame(frame);
    if (frame < kFirst) continue;
    const Picture picture = lab.read(picture_of);
    double sum = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x)
        sum +=
            luminanceOf(picture.at(x, y)) - (1 - hidden(moving, frame, x, y)) * luminanceOf(behind.at(x, y));
    light.push_back(sum);
  }
  CHECK(lab.reports() == "");
  return light;
}

struct Spread {
  double ratio = 0, deviation = 0, mean = 0;  // least over most, standard deviation over mean
};

Spread spreadOf(const std::vector<double>& light) {
  Spread spread;
  double square = 0;
  for (const double each : light) {
    spread.mean += each / static_cast<double>(light.size());
    square += each * each / static_cast<double>(light.size());
  }
  spread.deviation = std::sqrt(std::max(square - spread.mean * spread.mean, 0.0)) / spread.mean;
  const auto [least, most] = std::ranges::minmax_element(light);
  spread.ratio = *least / *most;
  return spread;
}

}  // namespace

TEST_CASE(
    "glints: a moving mirror of 16 pixels keeps its light from frame to frame, and has what theory says") {
  const Image image = environment();
  const double mean = meanRadiance(*image);
  for (const double roughness : {0.0, 0.05, 0.1, 0.2})
    for (const double azimuth : {0.0, 215.0}) {
      const Moving mirror = moving(azimuth, roughness, image);
      const Spread raw = spreadOf(lightOf(mirror, "tests/theory/draw_modes.json", "panels", {}));
      CAPTURE(roughness);
      CAPTURE(azimuth);
      MESSAGE("roughness ", roughness, ", camera at ", azimuth, ": min/max ", raw.ratio, ", deviation ",
              100 * raw.deviation, " %, mean of theory's ", raw.mean / (mean * mirror.area()));
      CHECK(raw.ratio > 0.95);
      CHECK(raw.deviation < 0.02);
      CHECK(std::abs(raw.mean / (mean * mirror.area()) - 1) < 0.02);
    }
}

TEST_CASE("glints: moving mirrors keep their light under temporal anti-aliasing") {
  const Image image = environment();
  const double mean = meanRadiance(*image);
  const struct {
    double radius, faster, roughness;
  } cases[] = {{16, 1, 0}, {16, 1, 0.1}, {16, 2.3, 0}, {8, 2.3, 0}};
  for (const auto& each : cases) {
    const Moving mirror = moving(0, each.roughness, image, each.radius, each.faster);
    const Spread taa = spreadOf(lightOf(mirror, "graphs/taa.json", "post.taa.kept", {}));
    const double share = taa.mean / (mean * mirror.area());
    CAPTURE(each.radius);
    CAPTURE(each.faster);
    CAPTURE(each.roughness);
    MESSAGE("radius ", each.radius, ", ", each.faster, " times as fast, roughness ", each.roughness,
            ": min/max ", taa.ratio, ", deviation ", 100 * taa.deviation, " %, mean of theory's ", share);
    CHECK(taa.ratio > 0.93);
    CHECK(taa.deviation < 0.02);
    CHECK(std::abs(share - 1) < 0.03);
  }
}

}  // namespace temporal_glints_test
