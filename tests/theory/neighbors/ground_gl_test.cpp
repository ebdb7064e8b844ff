// The ground of a scene in the studio: the light that spheres leave it against rays, and what it does to the picture.
#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "tests/theory/lab.h"
#include "tests/theory/neighbors/oracle.h"
#include "tests/theory/neighbors/tracer.h"

namespace neighbors_ground_test {

using namespace weft;
using namespace weft::theory;

namespace {

constexpr std::uint32_t kWide = 96, kHigh = 64;
const scene::Ground kWhite{.albedo = glm::vec3(1), .radius = 1e5f};
constexpr double kPi = 3.14159265358979;

Setup studio(std::vector<Ball> balls) {
  return {.graph = "graphs/studio.json",
          .width = kWide,
          .height = kHigh,
          .balls = std::move(balls),
          .camera = {.position = {0, 6, 8}, .target = {0, 0.5f, 0}, .fovDegrees = 50, .nearPlane = 0.1},
          .ground = scene::Ground{}};
}

// Where the ray of a pixel's center meets the plane y = 0, from the camera's definition.
struct Ray {
  glm::dvec3 eye{0}, direction{0};  // its length is 1 along the view axis
  double distance() const { return -eye.y / direction.y; }
  glm::dvec3 onGround() const { return eye + direction * distance(); }
};

Ray rayOf(const Setup& setup, std::uint32_t x, std::uint32_t y) {
  const glm::dvec3 eye(setup.camera.position),
      forward = glm::normalize(glm::dvec3(setup.camera.target) - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, {0, 1, 0})), up = glm::cross(right, forward);
  const double slope = std::tan(double(setup.camera.fovDegrees) / 360 * kPi);
  const double u = (2 * (x + 0.5) / setup.width - 1) * slope * setup.width / setup.height;
  const double v = (2 * (y + 0.5) / setup.height - 1) * slope;
  return {eye, forward + right * u + up * v};
}

// Whether a sphere, a little larger than it is, lies before the ground there.
bool isCovered(const Setup& setup, const Ray& ray) {
  std::vector<Solid> solids = solidsOf(setup.balls);
  for (Solid& solid : solids) solid.radius += 0.3;
  const Meeting met = meet(solids, ray.eye, glm::normalize(ray.direction), -1);
  return met.sphere >= 0 && met.distance < ray.distance() * glm::length(ray.direction);
}

template <class F>
void forGround(const Setup& setup, const F& f) {
  for (std::uint32_t y = 1; y < kHigh; y += 3)
    for (std::uint32_t x = 1; x < kWide; x += 3) {
      const Ray ray = rayOf(setup, x, y);
      if (ray.direction.y < 0) f(x, y, ray);
    }
}

std::vector<Ball> twoBalls(float albedo) {
  return {{.center = {-0.9f, 1, 0}, .radius = 1, .albedo = glm::vec3(albedo), .metallic = 0},
          {.center = {2.2f, 1.5f, -0.5f}, .radius = 0.7f, .albedo = glm::vec3(albedo), .metallic = 0}};
}

}  // namespace

TEST_CASE("ground: a black sphere leaves of the sky what the integral over the hemisphere leaves") {
  std::mt19937 random(3);
  for (const Ball& ball : {Ball{.center = {0, 1, 0}, .albedo = glm::vec3(0)},
                           Ball{.center = {0.5f, 0.2f, 0}, .radius = 0.9f, .albedo = glm::vec3(0)},
                           Ball{.center = {0, 2.5f, -1}, .albedo = glm::vec3(0)}}) {
    Setup setup = studio({ball});
    setup.ground = kWhite;
    Lab lab(setup);
    lab.frame();
    const Picture picture = lab.read("hdr");  // under a white sky: what arrives
    const std::vector<Solid> solids = solidsOf(setup.balls);
    double worst = 0, least = 1;
    int count = 0;
    forGround(setup, [&](std::uint32_t x, std::uint32_t y, const Ray& ray) {
      const glm::dvec3 at = ray.onGround();
      const double away = glm::length(at - solids[0].center) / solids[0].radius;
      // Within the sphere; where its reach begins to end.
      if (away < 1.02 || away > 6 || isCovered(setup, ray)) return;
      const double truth = skySeen(solids, at, {0, 1, 0}, -1, 150, random);
      worst = std::max(worst, std::abs(double(picture.at(x, y)[0]) - truth));
      least = std::min(least, truth);
      ++count;
    });
    MESSAGE(count, " points, at least ", least, " seen, worst ", worst);
    CHECK(count > 150);
    CHECK(least < 0.88);
    CHECK(worst < 1.4e-3);
    CHECK(lab.reports() == "");
  }
}

TEST_CASE("ground: spheres leave of the sun's disc what rays to it leave") {
  std::mt19937 random(4);
  for (const float degrees : {2.0f, 8.0f}) {
    Setup setup = studio(twoBalls(0.5f));
    setup.sun = scene::Sun{.direction = glm::normalize(glm::vec3(-0.5f, 0.6f, 0.4f)), .angle = degrees};
    setup.sun->irradiance = glm::vec3(static_cast<float>(kPi) / setup.sun->direction.y);
    setup.ground = kWhite;
    setup.environment = constantEnvironment(0, 0, 0);
    Lab lab(setup);
    lab.frame();
    const Picture picture = lab.read("hdr");  // the share of the sun that arrives
    const std::vector<Solid> solids = solidsOf(setup.balls);
    double sum = 0, worst = 0, least = 1;
    int count = 0;
    forGround(setup, [&](std::uint32_t x, std::uint32_t y, const Ray& ray) {
      const glm::dvec3 at = ray.onGround();
      if (glm::length(at - solids[0].center) < 1.02 || isCovered(setup, ray)) return;
      const double truth = discSeen(solids, at, glm::dvec3(setup.sun->direction), double(degrees) / 360 * kPi,
                                    -1, 2000, random);
      const double off = std::abs(double(picture.at(x, y)[0]) - truth);
      sum += off;
      worst = std::max(worst, off);
      least = std::min(least, truth);
      ++count;
    });
    MESSAGE(degrees, " degrees: ", count, " points, worst ", worst, ", mean ", sum / count);
    CHECK(least == 0);
    CHECK(worst < (degrees < 5 ? 0.009 : 0.04));  // 2000 rays are off by 0.03 now and then
    CHECK(sum / count < (degrees < 5 ? 2.7e-5 : 1.6e-4));
  }
}

TEST_CASE("ground: the computed sun's shadows are those of a disc of 0.533 degrees") {
  constexpr double kElevation = 35 * kPi / 180, kAzimuth = 130 * kPi / 180;
  const glm::dvec3 to_sun(std::cos(kElevation) * std::cos(kAzimuth), std::sin(kElevation),
                          std::cos(kElevation) * std::sin(kAzimuth));
  std::mt19937 random(5);
  Setup setup = studio(twoBalls(0.5f));
  setup.width = 2 * kWide;
  setup.height = 2 * kHigh;
  setup.camera.position = {0, 5, 2};
  setup.camera.target = {1.5f, 0, -2.5f};
  setup.daylight = true;
  Lab lab(setup);
  lab.frame();
  const Picture picture = lab.read("lit.ground.spots_seen");
  CHECK(lab.reports() == "");
  const std::vector<Solid> solids = solidsOf(setup.balls);
  double sum = 0, worst = 0;
  int count = 0, partly = 0;
  for (std::uint32_t y = 0; y < setup.height; ++y)
    for (std::uint32_t x = 0; x < setup.width; ++x) {
      const Ray ray = rayOf(setup, x, y);
      if (ray.direction.y >= 0 || isCovered(setup, ray)) continue;
      const glm::dvec3 at = ray.onGround();
      if (glm::length(at - solids[0].center) < 1.02) continue;
      const double truth = discSeen(solids, at, to_sun, 0.2665 * kPi / 180, -1, 1000, random);
      const double off = std::abs(double(picture.at(x, y)[0]) - truth);
      sum += off;
      worst = std::max(worst, off);
      ++count;
      partly += truth > 0.02 && truth < 0.98;
    }
  MESSAGE(count, " points, ", partly, " of them in penumbra: worst ", worst, ", mean ", sum / count);
  CHECK(partly > 20);
  CHECK(worst < 0.12);  // a tenth of the disc is 0.05 degrees
  CHECK(sum / count < 2e-4);
}

TEST_CASE(
    "ground: without a surface it darkens the environment and nothing else; with one it is that surface") {
  Setup setup = studio(twoBalls(0));
  Setup bare = setup;
  bare.ground.reset();
  Lab with(setup), without(bare);
  with.frame();
  without.frame();
  CHECK(with.passNames().find("lit.ground.surface\n") != std::string::npos);
  CHECK(without.passNames().find("ground") == std::string::npos);
  setup.ground->albedo = glm::vec3(0.5f, 0.25f, 0.125f);
  setup.ground->radius = 1000;
  Lab surface(setup);
  surface.frame();
  const Picture dark = with.read("hdr"), plain = without.read("hdr"), own = surface.read("hdr");
  const Picture depth = with.read("depth");
  int ground = 0, darker = 0;
  for (std::uint32_t y = 0; y < kHigh; ++y)
    for (std::uint32_t x = 0; x < kWide; ++x) {
      const Ray ray = rayOf(setup, x, y);
      if (ray.direction.y >= 0 || isCovered(setup, ray)) continue;
      ++ground;
      const double left = double(own.at(x, y)[0]) / 0.5;
      if (left < 0.98) ++darker;
      for (std::size_t c = 0; c < 3; ++c) {
        CHECK(double(dark.at(x, y)[c]) == doctest::Approx(double(plain.at(x, y)[c]) * left).epsilon(2e-3));
        CHECK(double(own.at(x, y)[c]) ==
              doctest::Approx(left * double((*setup.ground->albedo)[static_cast<int>(c)])).epsilon(4e-3));
      }
      CHECK(double(depth.at(x, y)[0]) == doctest::Approx(0.1 / ray.distance()).epsilon(1e-3));
    }
  CHECK(ground > 3000);
  CHECK(darker > 200);
  CHECK(with.reports() == "");
}

TEST_CASE("ground: in the studio spheres are drawn before it and take nothing of it but light") {
  Setup setup = studio(twoBalls(0.5f));
  for (const char* draw : {"billboard", "icosphere"}) {
    setup.sets = {{"draw", draw}, {"occlusion", "true"}};
    Lab lab(setup);
    lab.frame();
    setup.sets.back() = {"occlusion", "false"};
    Lab off(setup);
    off.frame();
    CHECK(lab.passNames().find("neighbors.neighbor_lists") != std::string::npos);
    CHECK(off.passNames().find("neighbor") == std::string::npos);
    const Picture a = lab.read("hdr"), b = off.read("hdr");
    int darker = 0, brighter = 0;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
      darker += a.texels[i] < b.texels[i] - 0.01f;
      brighter += a.texels[i] > b.texels[i] + 0.01f;
    }
    CHECK(darker > 30);
    CHECK(brighter == 0);
    CHECK(lab.reports() == "");
  }
}

TEST_CASE("ground: spheres that are not drawn leave it as it is in a scene without them") {
  for (const char* pass : {"billboards", "icospheres"}) {
    CAPTURE(pass);
    Setup setup = studio({{.center = {0, 0.6f, 0}, .radius = 1, .albedo = glm::vec3(0)}});
    setup.ground = kWhite;
    setup.sun = scene::Sun{.direction = glm::normalize(glm::vec3(1, 2, 1)), .irradiance = glm::vec3(2)};
    setup.sets = {{"draw", std::string(pass).substr(0, std::string(pass).size() - 1)}};
    Lab whole(setup);
    setup.disables = {std::string("lit.") + pass};
    Lab bare(setup);
    setup.balls.clear();
    setup.disables.clear();
    Lab empty(setup);
    for (Lab* lab : {&whole, &bare, &empty}) {
      lab->frame();
      CHECK(lab->reports() == "");
    }
    CHECK(whole.passNames().find("lit.ground.contact\n") != std::string::npos);
    for (const char* marks :
         {"lit.ground.cover\n", "lit.ground.contact\n", "lit.ground.sun\n", "lit.ground.spots\n"})
      CHECK(bare.passNames().find(marks) == std::string::npos);
    const Picture drawn = whole.read("hdr"), without = bare.read("hdr"), never = empty.read("hdr");
    CHECK(without.texels == never.texels);
    int darker = 0;
    for (std::size_t i = 0; i < drawn.texels.size(); ++i) darker += drawn.texels[i] < never.texels[i] - 0.1f;
    CHECK(darker > 100);
  }
}

// Such light would come through the ground.
TEST_CASE("ground: spheres get no light from below it, and are not darker than traced paths for that") {
  Setup setup = studio(twoBalls(0.7f));
  setup.sets = {{"occlusion", "true"}};
  setup.camera.fovDegrees = 30;
  setup.ground = scene::Ground{.albedo = glm::vec3(0.4f), .radius = 1e5f};
  setup.environment = makeEnvironment([](int x, int y) {
    const Vec3 to = equirectDirection(x, y, 256, 128);
    const bool softbox = to.y < -0.6 && to.y > -0.95 && to.x > 0;
    return std::array{softbox ? 22.0 : 0.15, softbox ? 20.0 : 0.15, softbox ? 18.0 : 0.2};
  });
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  const Picture picture = lab.read("hdr");
  const MetalTracer tracer(setup);
  std::mt19937 random(5);
  double least = 10, most = 0;
  int count = 0;
  for (std::uint32_t y = 1; y < kHigh; y += 2)
    for (std::uint32_t x = 1; x < kWide; x += 2) {
      const Ray ray = rayOf(setup, x, y);
      const glm::dvec3 to = glm::normalize(ray.direction);
      bool whole = true;
      for (const glm::dvec3 off : {glm::dvec3(0.02, 0, 0), {-0.02, 0, 0}, {0, 0.02, 0}, {0, -0.02, 0}})
        whole = whole && tracer.sphereAt(ray.eye, glm::normalize(to + off)) >= 0;
      if (!whole) continue;
      const double ratio = double(picture.at(x, y)[0]) / tracer.radiance(ray.eye, to, 400, random).x;
      least = std::min(least, ratio);
      most = std::max(most, ratio);
      ++count;
    }
  MESSAGE(count, " points, from ", least, " to ", most, " of what paths say");
  CHECK(count > 100);
  CHECK(least > 0.95);
  CHECK(most < 1.25);  // their gloss, which the paths lack
}

TEST_CASE("ground: a small bright light below it is seen in no sphere") {
  Setup setup = studio(twoBalls(0.7f));
  setup.balls[0].metallic = 1;
  setup.balls[0].roughness = 0.3f;
  setup.sets = {{"occlusion", "true"}};
  setup.ground = scene::Ground{.albedo = glm::vec3(0.4f), .radius = 1e5f};
  const Vec3 below{0.196, -0.588, 0.784};
  std::vector<Picture> pictures;
  for (const double radiance : {0.15, 5000.0}) {
    setup.environment = makeEnvironment([&](int x, int y) {
      const double own = dot(equirectDirection(x, y, 256, 128), below) > 0.999 ? radiance : 0.15;
      return std::array{own, own, own};
    });
    Lab lab(setup);
    lab.frame();
    CHECK(lab.reports() == "");
    pictures.push_back(lab.read("hdr"));
  }
  double worst = 0;
  for (std::size_t i = 0; i < pictures[0].texels.size(); ++i)
    worst = std::max(worst, std::abs(double(pictures[1].texels[i]) - double(pictures[0].texels[i])));
  MESSAGE("off by at most ", worst);
  CHECK(worst < 0.01);
}

// A photographer's view: the surface of the ground ends in the distance, and the computed sky's own ground is behind it.
TEST_CASE("ground: towards the computed sky's horizon no strip is darker than what is below and above it") {
  double deepest = 1;
  for (const char* turbidity : {"2", "2.5", "8"})
    for (const char* elevation : {"2", "13", "35", "80"}) {
      CAPTURE(turbidity);
      CAPTURE(elevation);
      Setup setup = studio({{.center = {0, -50, 0}}});
      setup.height = 192;
      setup.camera = {.position = {0, 1.75f, 0}, .target = {-1, 1.7f, 0}, .fovDegrees = 20, .nearPlane = 0.1};
      for (const double to : {-1.0, 1.0})
        setup.path.push_back({double(setup.path.size()) / 60, {0, 1.75, 0}, {to, 1.7, 0}, 20});
      setup.ground = scene::Ground{.albedo = glm::vec3(0.38f, 0.32f, 0.255f), .radius = 120};
      setup.daylight = true;
      setup.sets = {{"sun_elevation", elevation}, {"sun_azimuth", "0"}, {"turbidity", turbidity}};
      Lab lab(setup);
      for (std::uint32_t look = 0; look < 2; ++look) {
        setup.camera.target.x = look == 0 ? -1 : 1;
        lab.frame(look);
        CHECK(lab.reports() == "");
        const Picture hdr = lab.read("hdr");
        for (std::uint32_t x = 0; x < setup.width; x += 5) {
          const auto luminance = [&](std::uint32_t y) {
            const float* rgb = hdr.at(x, y);
            return 0.2126 * double(rgb[0]) + 0.7152 * double(rgb[1]) + 0.0722 * double(rgb[2]);
          };
          std::uint32_t horizon = 0;
          while (rayOf(setup, x, horizon).direction.y < 0.01) ++horizon;
          REQUIRE(horizon < setup.height);
          const double least = std::min(luminance(0), luminance(horizon));
          for (std::uint32_t y = 0; y < horizon; ++y) deepest = std::min(deepest, luminance(y) / least);
        }
      }
    }
  MESSAGE("the darkest strip has ", deepest, " of what is beside it");
  // Least where sky and surface are about as bright, and the ground between is darker.
  CHECK(deepest > 0.86);
}

}  // namespace neighbors_ground_test
