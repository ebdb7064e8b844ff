// What spheres hide of each other's light, against rays and paths.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/theory/lab.h"
#include "tests/theory/neighbors/oracle.h"

namespace neighbors_occlusion_test {

using namespace weft;
using namespace weft::theory;

namespace {

constexpr std::uint32_t kSide = 64;

std::vector<Ball> gridOf(int x, int y, int z, float spacing, float albedo) {
  std::vector<Ball> balls;
  for (int k = 0; k < z; ++k)
    for (int j = 0; j < y; ++j)
      for (int i = 0; i < x; ++i)
        balls.push_back({.center = glm::vec3(2 * i - x + 1, 2 * j - y + 1, 2 * k - z + 1) * (spacing / 2),
                         .albedo = glm::vec3(albedo)});
  return balls;
}

Setup labOf(const std::vector<Ball>& balls, std::size_t row) {
  return {.graph = "tests/theory/neighbors/neighbors.json",
          .width = kSide,
          .height = kSide,
          .sets = {{"row", std::to_string(row)}},
          .balls = balls,
          .camera = {.position = {3, 5, 20}, .target = {0, 0, 0}, .fovDegrees = 60, .nearPlane = 0.1}};
}

struct Sample {
  glm::dvec3 at{0}, normal{0};
  double sky = 0, mirror = 0, sun = 0, around = 0;
};

// Points all over a sphere, every `step`-th.
std::vector<Sample> look(const Setup& setup, std::uint32_t step) {
  Lab lab(setup);
  lab.frame();
  const Picture shares = lab.read("shares"), around = lab.read("around"), place = lab.read("place"),
                facing = lab.read("facing");
  const auto vec = [](const float* p) { return glm::dvec3(double(p[0]), double(p[1]), double(p[2])); };
  std::vector<Sample> samples;
  for (std::uint32_t i = step / 2; i < kSide * kSide; i += step) {
    const std::uint32_t x = i % kSide, y = i / kSide;
    const float* share = shares.at(x, y);
    samples.push_back({.at = vec(place.at(x, y)),
                       .normal = glm::normalize(vec(facing.at(x, y))),
                       .sky = double(share[0]),
                       .mirror = double(share[1]),
                       .sun = double(share[2]),
                       .around = double(around.at(x, y)[0])});
  }
  CHECK(lab.reports() == "");
  return samples;
}

struct Means {
  double ours = 0, truth = 0, off = 0;  // of the two, and of the difference's size
  int count = 0;
  void add(double a, double b) {
    ours += a;
    truth += b;
    off += std::abs(a - b);
    ++count;
  }
  double error() const { return ours / truth - 1; }
};

// 1 above the horizon.
std::shared_ptr<const assets::ImageF> halfSky(float below = 0) {
  auto image = std::make_shared<assets::ImageF>(*constantEnvironment(1, 1, 1));
  for (int y = image->height / 2; y < image->height; ++y)
    for (int x = 0; x < image->width; ++x)
      for (int c = 0; c < 3; ++c)
        image->texels[static_cast<std::size_t>((y * image->width + x) * 4 + c)] = below;
  return image;
}

}  // namespace

TEST_CASE(
    "occlusion: of one sphere, above, across and below the horizon, it is the integral over the hemisphere") {
  std::mt19937 random(7);
  const Ball own{.center = {0, 0, 0}, .radius = 1, .albedo = glm::vec3(0)};
  for (const Ball& other : {Ball{.center = {2.01f, 0, 0}, .radius = 1, .albedo = glm::vec3(0)},
                            Ball{.center = {0, 2.5f, 1}, .radius = 1, .albedo = glm::vec3(0)},
                            Ball{.center = {3, 3, -4}, .radius = 4, .albedo = glm::vec3(0)},
                            Ball{.center = {0, 0, 1.5f}, .radius = 0.3f, .albedo = glm::vec3(0)},
                            Ball{.center = {-1, 0, 0.5f}, .radius = 0.8f, .albedo = glm::vec3(0)}}) {
    CAPTURE(other.radius);
    const std::vector<Ball> balls = {own, other};
    const std::vector<Solid> solids = solidsOf(balls);
    double worst = 0, least = 1;
    for (const Sample& sample : look(labOf(balls, 0), 11)) {
      if (glm::length(sample.at - solids[1].center) < solids[1].radius) continue;  // within the other
      const double truth = skySeen(solids, sample.at, sample.normal, 0, 150, random);
      least = std::min(least, truth);
      worst = std::max(worst, std::abs(sample.sky - truth));
    }
    MESSAGE("radius ", other.radius, ": at least ", least, " seen, worst ", worst);
    CHECK(least < 0.93);
    CHECK(worst < 1.1e-3);
  }
}

TEST_CASE(
    "occlusion: in a grid its mean, with light that goes to and fro, is within 0.65 % of traced paths") {
  std::mt19937 random(8);
  const auto sky = [](glm::dvec3 d) { return d.y > 0 ? 1.0 : 0.0; };
  const auto half = halfSky();
  for (const double albedo : {0.2, 0.5, 0.8})
    for (const bool white : {true, false}) {
      const std::vector<Ball> balls = gridOf(10, 10, 1, 2.5f, static_cast<float>(albedo));
      const std::vector<Solid> solids = solidsOf(balls);
      Means seen, light;
      for (const std::size_t row : {0u, 5u, 23u, 44u, 55u, 71u, 90u, 98u}) {
        Setup setup = labOf(balls, row);
        if (!white) setup.environment = half;
        for (const Sample& sample : look(setup, 23)) {
          if (albedo == 0.5 && white)
            seen.add(sample.sky, skySeen(solids, sample.at, sample.normal, int(row), 12, random));
          light.add(sample.around,
                    tracedLight(solids, sample.at, sample.normal, int(row),
                                white ? Sky([](glm::dvec3) { return 1.0; }) : Sky(sky), 100, random));
        }
      }
      MESSAGE(std::string(white ? "white" : "half a sky"), ", albedo ", albedo, ": light ", light.error(),
              " off, mean difference ", light.off / light.count, "; seen ", seen.count ? seen.error() : 0);
      CHECK(std::abs(light.error()) < 0.0065);
      if (seen.count) CHECK(std::abs(seen.error()) < 0.006);
    }
}

TEST_CASE("occlusion: of a reflected lobe it is that of rays through the lobe") {
  std::mt19937 random(9);
  const std::vector<Ball> balls = gridOf(5, 5, 2, 2.4f, 0.5f);
  const std::vector<Solid> solids = solidsOf(balls);
  for (const double roughness : {0.0, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    Means lobes;
    for (const std::size_t row : {0u, 32u, 36u, 37u, 45u, 49u}) {
      Setup setup = labOf(balls, row);
      setup.sets.push_back({"roughness", std::to_string(roughness)});
      for (const Sample& sample : look(setup, 17)) {
        const glm::dvec3 view = glm::normalize(glm::dvec3(setup.camera.position) - sample.at);
        if (glm::dot(view, sample.normal) < 0.1) continue;
        lobes.add(sample.mirror, lobeSeen(solids, sample.at, sample.normal, view, roughness, int(row),
                                          roughness == 0 ? 4 : 150, random));
      }
    }
    MESSAGE("roughness ", roughness, ": seen ", lobes.truth / lobes.count, ", off by ",
            lobes.ours / lobes.count - lobes.truth / lobes.count, " in the mean, a point by ",
            lobes.off / lobes.count);
    CHECK(lobes.truth / lobes.count < 0.9);
    CHECK(std::abs(lobes.ours - lobes.truth) / lobes.count < (roughness == 0  ? 3e-4
                                                              : roughness < 1 ? 0.013
                                                                              : 0.045));
    CHECK(lobes.off / lobes.count < (roughness == 0 ? 0.01 : roughness < 0.2 ? 0.017 : 0.065));
  }
}

TEST_CASE("occlusion: spheres that stand on a ground get its light, and less of it where they are near it") {
  std::mt19937 random(11);
  for (const double albedo : {0.2, 0.5}) {
    std::vector<Ball> balls = {{.center = {0, 1, 0}, .albedo = glm::vec3(0.5f)},
                               {.center = {2.3f, 0.8f, 0.3f}, .radius = 0.8f, .albedo = glm::vec3(0.5f)}};
    const std::vector<Solid> solids = solidsOf(balls);
    Setup setup = labOf(balls, 0);
    setup.ground = scene::Ground{.albedo = glm::vec3(static_cast<float>(albedo))};
    setup.environment = halfSky(static_cast<float>(albedo));
    Means all, below;
    for (const Sample& sample : look(setup, 5)) {
      const double truth = tracedLight(
          solids, sample.at, sample.normal, 0, [](glm::dvec3 d) { return d.y > 0 ? 1.0 : 0.0; }, 300, random,
          albedo);
      all.add(sample.around, truth);
      if (sample.normal.y < -0.3) below.add(sample.around, truth);
    }
    MESSAGE("ground of albedo ", albedo, ": light ", all.error(), " off; below ", below.error(),
            ", a point by ", below.off / below.count, " of ", below.truth / below.count);
    CHECK(std::abs(all.error()) < 0.02);
    CHECK(std::abs(below.error()) < 0.07);
  }
}

TEST_CASE("occlusion: of the sun it is that of rays to its disc") {
  std::mt19937 random(10);
  const std::vector<Ball> balls = gridOf(4, 4, 1, 2.5f, 0.5f);
  const std::vector<Solid> solids = solidsOf(balls);
  for (const float degrees : {0.53f, 10.0f}) {
    Means shares;
    for (const std::size_t row : {5u, 10u}) {
      Setup setup = labOf(balls, row);
      setup.sun = scene::Sun{.direction = glm::normalize(glm::vec3(0.7f, 0.5f, 0.3f)), .angle = degrees};
      for (const Sample& sample : look(setup, 5)) {
        const glm::dvec3 towards(setup.sun->direction);
        if (glm::dot(towards, sample.normal) <= 0.1) continue;
        shares.add(sample.sun, discSeen(solids, sample.at, towards, double(degrees) / 360 * 3.14159265358979,
                                        int(row), 200, random));
      }
    }
    MESSAGE(degrees, " degrees: seen ", shares.truth / shares.count, ", a point off by ",
            shares.off / shares.count);
    CHECK(shares.truth / shares.count < 0.9);
    CHECK(shares.off / shares.count < (degrees < 1 ? 7e-4 : 0.01));
  }
}

// A sky of 1 lights the side that the spot does not reach, however bright the spot is. In the irradiance map, whose texels are wide, some of its light is there.
TEST_CASE(
    "occlusion: the side of a sphere that a bright spot does not reach gets the sky alone, up to the edge") {
  constexpr double kPi = 3.14159265358979;
  const std::vector<Ball> balls = {
      {.center = {0, 0, 0}, .albedo = glm::vec3(0.8f), .metallic = 0, .roughness = 1},
      {.center = {0, -2.4f, 0}, .albedo = glm::vec3(0), .metallic = 0, .roughness = 1}};
  const auto pictureOf = [&](std::shared_ptr<const assets::ImageF> environment) {
    Lab lab({.graph = "graphs/studio.json",
             .width = 128,
             .height = 128,
             .sets = {{"occlusion", "true"}},
             .balls = balls,
             .camera = {.position = {0, 0, 40}, .target = {0, 0, 0}, .fovDegrees = 3, .nearPlane = 0.1},
             .environment = std::move(environment)});
    lab.frame();
    CHECK(lab.reports() == "");
    return lab.read("hdr");
  };
  const Picture sky = pictureOf(constantEnvironment(1, 1, 1));
  // Four texels of 6600 are an irradiance over pi of about 5.
  for (const glm::ivec2 at : {glm::ivec2{8, 54}, {11, 54}, {14, 40}, {17, 6}}) {
    const Picture both = pictureOf(makeEnvironment([&](int x, int y) {
      const double value = (x == at.x || x == at.x + 1) && (y == at.y || y == at.y + 1) ? 6600 : 1;
      return std::array{value, value, value};
    }));
    const double polar = kPi * (at.y + 1) / 128, azimuth = 2 * kPi * ((at.x + 1) / 256.0 - 0.5);
    const glm::dvec3 spot{std::sin(polar) * std::cos(azimuth), std::cos(polar),
                          std::sin(polar) * std::sin(azimuth)};
    double most = 0, least = 0;
    int count = 0;
    for (std::uint32_t y = 0; y < 128; ++y)
      for (std::uint32_t x = 0; x < 128; ++x) {
        // So far away the lens is nearly parallel.
        const double half = 40 * std::tan(3.0 / 360 * kPi);
        const double u = ((x + 0.5) / 64 - 1) * half, v = ((y + 0.5) / 64 - 1) * half,
                     rest = 1 - u * u - v * v;
        if (rest < 0.05) continue;
        const double facing = glm::dot(spot, glm::dvec3{u, v, std::sqrt(rest)});
        if (facing > -0.03 || facing < -0.3) continue;
        const double over = double(both.at(x, y)[0]) / double(sky.at(x, y)[0]) - 1;
        most = std::max(most, over);
        least = std::min(least, over);
        ++count;
      }
    MESSAGE("azimuth ", azimuth, ", from the zenith ", polar, ": from ", least, " to ", most,
            " of the sky's light");
    CHECK(count > 500);
    CHECK(most < 0.02);
    CHECK(least > -0.02);
  }
}

}  // namespace neighbors_occlusion_test
