// Irradiance and the prefiltered environment against brute-force integrals of an analytic radiance; the seam at +-180 degrees.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <functional>
#include <numbers>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace lighting_test {

using namespace weft::theory;

namespace {

constexpr double kPower = 12;
const Vec3 kLobe{-0.8, 0.36, 0.48};  // across the seam's side of the map

// max(0, l . lobe)^power, at texel centers.
std::shared_ptr<const weft::assets::ImageF> lobeEnvironment() {
  auto image = std::make_shared<weft::assets::ImageF>();
  image->width = 512;
  image->height = 256;
  image->channels = 4;
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x) {
      const double value = std::pow(std::max(0.0, dot(equirectDirection(x, y, 512, 256), kLobe)), kPower);
      for (int c = 0; c < 3; ++c) image->texels.push_back(static_cast<float>(value));
      image->texels.push_back(1);
    }
  return image;
}

Setup lit() {
  Setup setup{.graph = "tests/theory/furnace.json", .balls = {{}}};
  setup.environment = lobeEnvironment();
  return setup;
}

}  // namespace

TEST_CASE("irradiance: within 0.5 % of its greatest value") {
  Lab lab(lit());
  lab.frame();
  const Picture map = lab.read("ibl.irradiance");
  const double peak = lobeIrradiance(kLobe, kLobe, kPower);
  double worst = 0;
  for (std::uint32_t y = 1; y < map.height; y += 7)
    for (std::uint32_t x = 0; x < map.width; x += 9) {
      const Vec3 normal = equirectDirection(static_cast<int>(x), static_cast<int>(y),
                                            static_cast<int>(map.width), static_cast<int>(map.height));
      worst = std::max(worst, std::abs(map.at(x, y)[0] - lobeIrradiance(normal, kLobe, kPower, 150)));
    }
  MESSAGE("worst error, relative to the peak: ", worst / peak);
  CHECK(worst < 0.005 * peak);
  CHECK(lab.reports() == "");
}

TEST_CASE("prefilter: each level matches its roughness, 0.1 to 1, within 2.5 % of the lobe's peak") {
  Lab lab(lit());
  lab.frame();
  for (std::uint32_t level = 0; level < 5; ++level) {
    const Picture map = lab.read("ibl.specular", level);
    double worst = 0;
    for (std::uint32_t y = 2; y < map.height; y += map.height / 16)
      for (std::uint32_t x = 1; x < map.width; x += map.width / 16) {
        const Vec3 normal = equirectDirection(static_cast<int>(x), static_cast<int>(y),
                                              static_cast<int>(map.width), static_cast<int>(map.height));
        const double truth = lobeReflection(normal, kLobe, kPower, std::pow(0.1, 1 - level / 4.0), 120);
        worst = std::max(worst, std::abs(map.at(x, y)[0] - truth));
      }
    CAPTURE(level);
    MESSAGE("level ", level, ": worst error ", worst);
    CHECK(worst < 0.025);
  }
}

TEST_CASE("no seam: the first and the last column of every map continue each other") {
  Lab lab(lit());
  lab.frame();
  for (const char* name : {"ibl.irradiance", "ibl.specular"}) {
    const Picture map = lab.read(name);
    for (std::uint32_t y = 0; y < map.height; y += 5) {
      // The step across the seam is no larger than its neighbors' steps, give or take rounding.
      const auto value = [&](std::uint32_t x) { return map.at(x % map.width, y)[0]; };
      const float across = std::abs(value(map.width) - value(map.width - 1));
      const float beside =
          std::max(std::abs(value(map.width - 1) - value(map.width - 2)), std::abs(value(1) - value(0)));
      CAPTURE(y);
      CHECK(across <= 1.5f * beside + 0.002f);
    }
  }
}

namespace {

float meanLuminance(std::shared_ptr<const weft::assets::ImageF> environment) {
  Setup setup{.graph = "tests/theory/irradiance.json", .balls = {{}}};
  setup.environment = std::move(environment);
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  return std::bit_cast<float>(lab.readBuffer("ibl.luminance", 1)[0]);
}

}  // namespace

TEST_CASE("mean luminance: a constant is kept, and rows count by their share of the sphere") {
  CHECK(meanLuminance(constantEnvironment(0.5f, 0.5f, 0.5f)) == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(meanLuminance(constantEnvironment(1, 0, 0)) == doctest::Approx(0.2126).epsilon(1e-5));
  // 1 above a height of cos(60 degrees) = 1/2: a quarter of the sphere, though a third of the rows.
  auto cap = std::make_shared<weft::assets::ImageF>(weft::assets::ImageF{96, 48, 4, {}});
  for (int y = 0; y < 48; ++y) cap->texels.insert(cap->texels.end(), 96 * 4, y < 16 ? 1.0f : 0.0f);
  CHECK(meanLuminance(cap) == doctest::Approx(0.25).epsilon(1e-5));
  // The lobe's mean over the sphere is 1 / (2 (power + 1)); halves and texel centers cost what is left.
  CHECK(meanLuminance(lobeEnvironment()) == doctest::Approx(0.5 / (kPower + 1)).epsilon(2e-3));
}

namespace {

// Radiance 1, and `value` within `degrees` of a direction beside the seam of the map.
const Vec3 kSpot{-0.9, 0.42, -0.118};
std::shared_ptr<const weft::assets::ImageF> spotEnvironment(double degrees, float value) {
  auto image = std::make_shared<weft::assets::ImageF>(weft::assets::ImageF{1024, 512, 4, {}});
  for (int y = 0; y < 512; ++y)
    for (int x = 0; x < 1024; ++x) {
      const bool inside = dot(equirectDirection(x, y, 1024, 512), kSpot) / std::sqrt(dot(kSpot, kSpot)) >
                          std::cos(degrees * std::numbers::pi / 180);
      image->texels.insert(image->texels.end(), {inside ? value : 1, inside ? value / 2 : 1, 1, 1});
    }
  return image;
}

struct Spot {
  float direction[3], limit, light[3], variance;
};
Spot readSpot(Lab& lab, const char* buffer) {
  Spot spot;
  const std::vector<std::uint32_t> words = lab.readBuffer(buffer, 8);
  static_assert(sizeof spot == 32);
  std::memcpy(&spot, words.data(), sizeof spot);
  return spot;
}
std::array<Spot, 4> spotsOf(std::shared_ptr<const weft::assets::ImageF> environment) {
  Setup setup{.graph = "tests/theory/irradiance.json", .balls = {{}}};
  setup.environment = std::move(environment);
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  std::array<Spot, 4> spots;
  const std::vector<std::uint32_t> words = lab.readBuffer("ibl.brightest", 33);
  std::memcpy(&spots, words.data(), sizeof spots);
  for (std::uint32_t i = 0; i < 4; ++i) CHECK((spots[i].light[0] > 0) == (i < words[32]));
  return spots;
}
Spot spotOf(std::shared_ptr<const weft::assets::ImageF> environment) {
  const std::array<Spot, 4> spots = spotsOf(std::move(environment));
  for (std::size_t i = 1; i < 4; ++i) CHECK(spots[i].light[0] == 0);
  return spots[0];
}

}  // namespace

TEST_CASE(
    "the brightest spot: a sun is found with its light, direction and size; a wide lamp stays in the map") {
  const double degrees = 1.5, value = 5000;
  const Spot sun = spotOf(spotEnvironment(degrees, static_cast<float>(value)));
  const Vec3 direction{sun.direction[0], sun.direction[1], sun.direction[2]};
  CHECK(dot(direction, kSpot) / std::sqrt(dot(kSpot, kSpot)) > std::cos(0.1 * std::numbers::pi / 180));
  const double angle = degrees * std::numbers::pi / 180, solidAngle = std::numbers::pi * angle * angle;
  CHECK(sun.limit < 0.02 * value);
  CHECK(sun.light[0] == doctest::Approx((value - sun.limit) * solidAngle).epsilon(0.03));
  CHECK(sun.light[1] == doctest::Approx(sun.light[0] / 2).epsilon(1e-3));
  CHECK(sun.variance == doctest::Approx(angle * angle / 4).epsilon(0.05));  // of a disc, along one axis

  for (const Spot& none : {spotOf(spotEnvironment(12, 5000)), spotOf(constantEnvironment(3, 3, 3))}) {
    CHECK(none.light[0] == 0);
    CHECK(none.limit == 65504);
  }
}

// Discs over an even map: one is too wide for a spot, one has too little light to count beside the first, one is the fifth.
TEST_CASE(
    "the brightest spots: up to four, from the brightest on, of those that are small and have enough light") {
  struct Disc {
    double longitude, elevation, degrees, radiance;
    bool found;
  };
  const std::vector<Disc> discs = {{10, 50, 1.5, 4000, true},   {80, 35, 2, 2000, true},
                                   {100, 35, 0.3, 3000, false}, {-60, 20, 1.2, 3500, true},
                                   {150, 60, 9, 900, false},    {-120, -30, 1.8, 1500, true},
                                   {178, -50, 1.8, 800, false}};
  const auto towards = [](double longitude, double elevation) {
    const double turn = longitude * std::numbers::pi / 180, up = elevation * std::numbers::pi / 180;
    return Vec3{std::cos(up) * std::cos(turn), std::sin(up), std::cos(up) * std::sin(turn)};
  };
  auto image = std::make_shared<weft::assets::ImageF>(weft::assets::ImageF{2048, 1024, 4, {}});
  for (int y = 0; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x) {
      float value = 1;
      const Vec3 here = equirectDirection(x, y, image->width, image->height);
      for (const Disc& disc : discs)
        if (dot(here, towards(disc.longitude, disc.elevation)) >
            std::cos(disc.degrees * std::numbers::pi / 180))
          value = static_cast<float>(disc.radiance);
      image->texels.insert(image->texels.end(), {value, value, value, 1});
    }
  const std::array<Spot, 4> spots = spotsOf(image);
  std::vector<Disc> wanted;
  for (const Disc& disc : discs)
    if (disc.found) wanted.push_back(disc);
  std::ranges::sort(wanted, std::greater(), &Disc::radiance);
  REQUIRE(wanted.size() == spots.size());
  for (std::size_t i = 0; i < 4; ++i) {
    CAPTURE(i);
    const double angle = wanted[i].degrees * std::numbers::pi / 180,
                 light = (wanted[i].radiance - spots[i].limit) * std::numbers::pi * angle * angle;
    const Vec3 direction{spots[i].direction[0], spots[i].direction[1], spots[i].direction[2]};
    CHECK(dot(direction, towards(wanted[i].longitude, wanted[i].elevation)) >
          std::cos(0.1 * std::numbers::pi / 180));
    CHECK(spots[i].light[0] == doctest::Approx(light).epsilon(0.03));
    CHECK(spots[i].variance == doctest::Approx(angle * angle / 4).epsilon(0.05));
    CHECK(spots[i].limit == spots[0].limit);
  }
}

// What the map without the sun lacks, summed over all texels, is the sun.
TEST_CASE(
    "the computed sky's sun is what its two maps differ by: light, direction and size, also at the horizon") {
  for (const double turbidity : {2.0, 2.5, 8.0})
    for (const double elevation : {2.0, 5.0, 11.0, 35.0, 80.0}) {
      Lab lab(
          {.graph = "tests/theory/daylight_sun.json",
           .sets = {{"sun_elevation", std::to_string(elevation)}, {"turbidity", std::to_string(turbidity)}},
           .balls = {{}}});
      lab.frame();
      CHECK(lab.reports() == "");
      const Spot sun = readSpot(lab, "sun");
      const Picture sky = lab.read("daylight.sky_map"), rest = lab.read("daylight.rest_map");
      REQUIRE(rest.width == sky.width);
      double light[3] = {}, moment[3] = {}, square = 0, weight = 0, brightest = 0;
      const int width = static_cast<int>(sky.width), height = static_cast<int>(sky.height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const Vec3 d = equirectDirection(x, y, width, height);
          const double angle =
              2 * std::numbers::pi / width *
              (std::cos(y * std::numbers::pi / height) - std::cos((y + 1) * std::numbers::pi / height));
          double luminance = 0;
          const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
          for (std::size_t c = 0; c < 3; ++c) {
            const double out = static_cast<double>(sky.at(column, row)[c] - rest.at(column, row)[c]) * angle;
            light[c] += out;
            luminance += std::array{0.2126, 0.7152, 0.0722}[c] * out;
            brightest = std::max<double>(brightest, rest.at(column, row)[c]);
          }
          const double at[3] = {d.x, d.y, d.z};
          for (std::size_t c = 0; c < 3; ++c) moment[c] += luminance * at[c];
          weight += luminance;
        }
      const double length = std::sqrt(moment[0] * moment[0] + moment[1] * moment[1] + moment[2] * moment[2]);
      double cosine = 0;
      for (std::size_t c = 0; c < 3; ++c)
        cosine += moment[c] / length * static_cast<double>(sun.direction[c]);
      square = 2 * (1 - length / weight);  // mean square of the angle to the mean direction
      CAPTURE(turbidity);
      CAPTURE(elevation);
      CHECK(brightest <= static_cast<double>(sun.limit) * 1.001);
      const double greatest = std::max(light[0], std::max(light[1], light[2]));
      for (std::size_t c = 0; c < 3; ++c)
        CHECK(std::abs(static_cast<double>(sun.light[c]) - light[c]) < 0.01 * greatest);
      CHECK(std::acos(std::min(cosine, 1.0)) < 0.1 * std::numbers::pi / 180);
      CHECK(static_cast<double>(sun.variance) == doctest::Approx(0.5 * square).epsilon(0.03));
    }
}

// The integrals are sums over the texels of the sky itself, by their shares of the sphere.
TEST_CASE("irradiance under a computed sun near the zenith: its light is there once, and the map says so") {
  for (const double elevation : {60.0, 85.0, 88.0, 90.0}) {
    Lab lab({.graph = "tests/theory/daylight_irradiance.json",
             .sets = {{"sun_elevation", std::to_string(elevation)}},
             .balls = {{}}});
    lab.frame();
    CHECK(lab.reports() == "");
    const Picture map = lab.read("irradiance"), sky = lab.read("daylight.sky_map");
    const Vec3 up = equirectDirection(0, 0, static_cast<int>(map.width), static_cast<int>(map.height));
    const int width = static_cast<int>(sky.width), height = static_cast<int>(sky.height);
    const double row = std::numbers::pi / height;
    double sum = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        sum += std::max(0.0, dot(up, equirectDirection(x, y, width, height))) * 2 / width *
               (std::cos(y * row) - std::cos((y + 1) * row)) *
               static_cast<double>(sky.at(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y))[1]);
    const Spot sun = readSpot(lab, "sun");
    const double cosine = dot(up, Vec3{sun.direction[0], sun.direction[1], sun.direction[2]});
    MESSAGE("sun at ", elevation, ": ", map.at(0, 0)[1], " of ", sum, ", cosine ", map.at(0, 0)[3], " of ",
            cosine);
    CHECK(static_cast<double>(map.at(0, 0)[1]) == doctest::Approx(sum).epsilon(0.02));
    CHECK(static_cast<double>(map.at(0, 0)[3]) == doctest::Approx(cosine).epsilon(0.02));
  }
}

// A disc of 1.5 degrees in radius over an even sky, from the zenith downwards. The integrals are sums over the texels, by their shares of the sphere.
TEST_CASE("irradiance of a loaded map: a small sun counts as much as it is large, also at the poles") {
  double worst = 0;
  for (const int width : {1024, 600})
    for (const double from : {0.0, 2.0, 4.5, 7.0, 30.0})
      for (const double strength : {40.0, 4000.0}) {
        const double angle = from * std::numbers::pi / 180;
        const Vec3 to{std::sin(angle) * 0.8, std::cos(angle), std::sin(angle) * 0.6};
        auto map = std::make_shared<weft::assets::ImageF>();
        map->width = width;
        map->height = width / 2;
        map->channels = 4;
        double truth = 0;
        for (int y = 0; y < map->height; ++y)
          for (int x = 0; x < width; ++x) {
            const Vec3 d = equirectDirection(x, y, width, map->height);
            const double value = dot(d, to) > std::cos(1.5 * std::numbers::pi / 180) ? strength : 1;
            for (const double c : {value, value, value, 1.0}) map->texels.push_back(static_cast<float>(c));
            truth += std::max(d.y, 0.0) * value * 2 / width *
                     (std::cos(y * std::numbers::pi / map->height) -
                      std::cos((y + 1) * std::numbers::pi / map->height));
          }
        Setup setup{.graph = "tests/theory/irradiance.json", .balls = {{}}};
        setup.environment = map;
        Lab lab(setup);
        lab.frame();
        CHECK(lab.reports() == "");
        const double given = static_cast<double>(lab.read("ibl.irradiance").at(0, 0)[0]);
        MESSAGE(width, " wide, ", strength, " at ", from, " degrees: ", given, " of ", truth);
        worst = std::max(worst, std::abs(given / truth - 1));
      }
  MESSAGE("off by ", worst);
  CHECK(worst < 0.022);
}

TEST_CASE("irradiance: the cosine to the brightest spot, also where that is at the pole") {
  Setup setup{.graph = "tests/theory/irradiance.json", .balls = {{}}};
  setup.environment = makeEnvironment([](int, int y) {
    const double value = y == 0 ? 5000 : 1;
    return std::array{value, value, value};
  });
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  REQUIRE(readSpot(lab, "ibl.brightest").direction[1] > 0.999f);
  REQUIRE(readSpot(lab, "ibl.brightest").light[0] > 1);
  const Picture map = lab.read("ibl.irradiance");
  double worst = 0;
  for (std::uint32_t y = 0; y < map.height; ++y) {
    const double cosine = std::cos((y + 0.5) * std::numbers::pi / map.height);
    worst = std::max(worst, std::abs(static_cast<double>(map.at(0, y)[3]) - std::max(cosine, 0.0)));
  }
  MESSAGE("off by ", worst);
  CHECK(worst < 0.06);  // a cell is 0.1 wide
}

TEST_CASE("the maps made in slices are those made at once, byte for byte") {
  Setup setup = lit();
  Lab whole(setup);
  whole.frame();
  setup.sets = {{"ibl.sliced", "true"}};
  Lab sliced(setup);
  sliced.frame(0, false);
  CHECK(sliced.read("ibl.specular", 1).texels[0] == 0);  // not published
  for (std::uint32_t frame = 1; frame < 60; ++frame) sliced.frame(frame, false);
  for (std::uint32_t level = 0; level < 5; ++level)
    CHECK(sliced.read("ibl.specular", level).texels == whole.read("ibl.specular", level).texels);
  CHECK(sliced.read("ibl.irradiance").texels == whole.read("ibl.irradiance").texels);
  CHECK(sliced.readBuffer("ibl.luminance", 1) == whole.readBuffer("ibl.luminance", 1));
  CHECK(sliced.reports() == "");
}

}  // namespace lighting_test
