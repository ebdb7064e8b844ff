// Light probes on the GPU: the compute pass against the CPU's, textures against the buffer, and what the studio makes of them.
#include <doctest/doctest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <random>

#include "tests/theory/gi/probe_reading.h"
#include "tests/theory/gi/probe_reference.h"
#include "tests/theory/lab.h"

namespace gi_studio_test {

using namespace weft;
using namespace weft::theory;

namespace {

constexpr std::uint32_t kSide = 64;

std::vector<Ball> someBalls(int count, bool moving = false) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(-4, 4), share(0, 1);
  std::vector<Ball> balls;
  for (int i = 0; i < count; ++i)
    balls.push_back({.center = {place(random), place(random), place(random)},
                     .radius = 0.2f + 0.6f * share(random),
                     .albedo = {share(random), share(random), share(random)},
                     .metallic = i % 4 == 0 ? 1.0f : 0.0f,
                     .velocity = moving ? glm::vec3(place(random), 0, place(random)) : glm::vec3(0)});
  return balls;
}

Setup probeLab(std::vector<weft::graph::Setting> sets, bool moving = false) {
  return {.graph = "tests/theory/gi/gi.json",
          .width = kSide,
          .height = kSide,
          .sets = std::move(sets),
          .balls = someBalls(24, moving)};
}

struct Grid {
  scene::ProbeGrid grid;
  std::vector<scene::Probe> probes;
};

Grid readGrid(Lab& lab, glm::uvec3 count) {
  Grid read;
  read.grid.count = count;
  const auto words = lab.readBuffer("copied", 12 + 36 * read.grid.size());
  const auto number = [&](std::size_t i) { return std::bit_cast<float>(words[i]); };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    read.grid.low[static_cast<int>(axis)] = number(axis);
    read.grid.high[static_cast<int>(axis)] = number(4 + axis);
    CHECK(words[8 + axis] == count[static_cast<int>(axis)]);
  }
  read.probes.resize(read.grid.size());
  std::memcpy(read.probes.data(), words.data() + 12, read.probes.size() * sizeof(scene::Probe));
  return read;
}

Grid computedAt(const Lab& lab, double time, glm::uvec3 count, const scene::ProbeRules& rules) {
  std::vector<scene::Instance> spheres;
  scene::fillInstances(lab.world().scene(), scene::DrawList::spheres, time, time, spheres);
  const scene::ProbeGrid grid = scene::placeProbes(spheres, count);
  return {grid, scene::computeProbes(grid, rules, spheres)};
}

struct Difference {
  double worst = 0, greatest = 0;
};

Difference compare(const Grid& a, const Grid& b) {
  CHECK(a.grid.low == b.grid.low);
  CHECK(a.grid.high == b.grid.high);
  REQUIRE(a.probes.size() == b.probes.size());
  Difference out;
  for (std::size_t i = 0; i < a.probes.size(); ++i)
    for (std::size_t n = 0; n < scene::kShCount; ++n)
      for (int c = 0; c < 4; ++c) {
        const double x = double(a.probes[i].sh[n][c]), y = double(b.probes[i].sh[n][c]);
        REQUIRE(std::isfinite(x));
        out.worst = std::max(out.worst, std::abs(x - y));
        out.greatest = std::max(out.greatest, std::abs(y));
      }
  return out;
}

}  // namespace

TEST_CASE(
    "gi: the compute pass gives what the CPU gives, with every shape and window, for a box of any "
    "proportion") {
  for (const char* shape : {"cap", "point"})
    for (const char* window : {"smooth", "hard"}) {
      CAPTURE(shape);
      CAPTURE(window);
      std::vector<weft::graph::Setting> sets = {
          {"gi.shape", shape}, {"gi.window", window}, {"gi.grid", "[9, 6, 1]"}, {"gi.far", "4"}};
      const scene::ProbeRules rules{
          .far = 4,
          .shape = std::string_view(shape) == "cap" ? scene::ProbeShape::cap : scene::ProbeShape::point,
          .window =
              std::string_view(window) == "hard" ? scene::ProbeWindow::hard : scene::ProbeWindow::smooth};
      Lab gpu(probeLab(sets));
      gpu.frame();
      const glm::uvec3 count(9, 6, 1);
      const Difference off = compare(readGrid(gpu, count), computedAt(gpu, 0, count, rules));
      MESSAGE(std::string(shape), ", ", std::string(window), ": worst ", off.worst, " of ", off.greatest);
      CHECK(off.greatest > 0.3);
      CHECK(off.worst < 1e-5 * off.greatest);
      CHECK(gpu.reports() == "");
    }
}

TEST_CASE(
    "gi: textures and buffer give one irradiance within half floats, and the buffer's is the CPU's mix") {
  for (const char* grid : {"[21, 21, 3]", "[5, 1, 4]", "[1, 1, 1]"}) {
    CAPTURE(grid);
    Lab buffer(probeLab({{"gi.grid", grid}, {"gi_sampling", "buffer"}}));
    buffer.frame();
    Lab textures(probeLab({{"gi.grid", grid}}));
    textures.frame();
    glm::uvec3 count(1);
    REQUIRE(std::sscanf(grid, "[%u, %u, %u]", &count.x, &count.y, &count.z) == 3);
    const Grid probes = readGrid(buffer, count);
    const Picture a = buffer.read("light"), b = textures.read("light");
    const Picture place = buffer.read("place"), facing = buffer.read("facing");
    const Picture from = buffer.read("from");
    double greatest = 0, halves = 0, mixed = 0, turned = 0;
    for (std::uint32_t y = 0; y < kSide; ++y)
      for (std::uint32_t x = 0; x < kSide; ++x) {
        const auto vec = [&](const Picture& picture) {
          return glm::vec3(picture.at(x, y)[0], picture.at(x, y)[1], picture.at(x, y)[2]);
        };
        const scene::Bounce bounce =
            scene::bounceOf(scene::probeAt(probes.grid, probes.probes, vec(place)), vec(facing));
        const glm::vec3 truth = bounce.irradiance;
        if (truth.y > 0.01f)  // else there is no direction
          turned = std::max(turned, double(glm::length(vec(from) - bounce.facing)) +
                                        double(std::abs(from.at(x, y)[3] - bounce.sure)));
        for (int c = 0; c < 3; ++c) {
          greatest = std::max(greatest, double(truth[c]));
          mixed = std::max(mixed, double(std::abs(vec(a)[c] - truth[c])));
          halves = std::max(halves, double(std::abs(vec(a)[c] - vec(b)[c])));
        }
      }
    MESSAGE(std::string(grid), ": textures off by ", halves / greatest, ", the CPU's mix by ",
            mixed / greatest);
    CHECK(greatest > 0.01);
    CHECK(mixed < 2e-5 * greatest);
    CHECK(turned < 1e-3);
    CHECK(halves < 1e-3 * greatest);  // half an ulp of a half is 2^-11 of each of nine coefficients
    CHECK(textures.reports() == "");
  }
}

TEST_CASE("gi: moving spheres are lit anew in every frame, as the CPU computes it") {
  const glm::uvec3 count(5, 4, 3);
  std::vector<weft::graph::Setting> sets = {{"gi.grid", "[5, 4, 3]"}};
  Lab gpu(probeLab(sets, true));
  std::vector<float> before;
  for (std::uint32_t frame = 0; frame < 4; ++frame) {
    gpu.frame(frame);
    const Difference off = compare(readGrid(gpu, count), computedAt(gpu, frame / 60.0, count, {}));
    CHECK(off.worst < 1e-5 * off.greatest);
    const std::vector<float> light = gpu.read("light").texels;
    CHECK(light != before);
    before = light;
  }
}

namespace {

// The studio's light at frame 0, without and with probes, and what it is of the environment's diffuse light alone.
std::vector<float> studio(const char* graph, const std::vector<Ball>& balls, float environment,
                          std::vector<weft::graph::Setting> sets = {},
                          std::vector<weft::graph::Disable> disables = {}) {
  Setup setup{.graph = graph,
              .width = 96,
              .height = 64,
              .sets = std::move(sets),
              .disables = std::move(disables),
              .balls = balls};
  setup.camera = {.position = {0, 0, 9}, .target = {0, 0, 0}, .fovDegrees = 45, .nearPlane = 0.1};
  setup.environment = constantEnvironment(environment, environment, environment);
  Lab lab(setup);
  lab.frame();
  std::vector<float> texels = lab.read("hdr").texels;
  CHECK(lab.reports() == "");
  return texels;
}

const std::vector<Ball> kPair = {
    {.center = {-1.3f, 0, 0}, .albedo = {0.9f, 0.9f, 0.9f}, .metallic = 0, .roughness = 1},
    {.center = {1.3f, 0, 0}, .albedo = {0.9f, 0.1f, 0.05f}, .metallic = 0, .roughness = 1}};

}  // namespace

TEST_CASE("gi: a black environment gives no bounce, and light is linear in it") {
  for (const float texel : studio("graphs/studio_gi.json", kPair, 0))
    CHECK((texel == 0 || texel == 1));  // alpha
  const std::vector<float> off = studio("graphs/studio.json", kPair, 1);
  const std::vector<float> one = studio("graphs/studio_gi.json", kPair, 1),
                           two = studio("graphs/studio_gi.json", kPair, 2);
  REQUIRE(one.size() == two.size());
  double most = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (i % 4 == 3) continue;
    CHECK(two[i] == doctest::Approx(2 * one[i]).epsilon(2e-3));  // two halves
    CHECK(one[i] >= off[i] - 1e-3f);
    most = std::max(most, double(one[i] - off[i]));
  }
  MESSAGE("most that a pixel gains: ", most);
  CHECK(most > 0.05);
}

TEST_CASE("gi: switched off, and without spheres, the picture is the studio's byte for byte") {
  for (const std::vector<Ball>& balls : {kPair, std::vector<Ball>{}})
    CHECK(studio("graphs/studio_gi.json", balls, 1, {{"bounce", "false"}}) ==
          studio("graphs/studio.json", balls, 1));
  CHECK(studio("graphs/studio_gi.json", {}, 1, {{"probes_debug", "true"}}) ==
        studio("graphs/studio.json", {}, 1));
}

TEST_CASE(
    "gi: what a pixel of the studio gains is the irradiance of the probes, in every way to draw and sample") {
  // On the left sphere, which is white, straight at its neighbor's side: a pixel whose normal is (sin 60, 0, cos 60).
  const std::vector<std::string> noReflection = {"ibl.specular_prefilter"};
  const std::vector<float> diffuse =
      studio("graphs/studio.json", kPair, 1, {}, {noReflection.begin(), noReflection.end()});
  const std::vector<float> off = studio("graphs/studio.json", kPair, 1);
  std::vector<scene::Instance> spheres;
  for (const Ball& ball : kPair)
    spheres.push_back(
        {.center = ball.center, .radius = ball.radius, .albedo = ball.albedo, .metallic = ball.metallic});
  const scene::ProbeGrid grid = scene::placeProbes(spheres, {21, 21, 3});
  const std::vector<scene::Probe> probes = scene::computeProbes(grid, {}, spheres);
  for (const std::vector<weft::graph::Setting>& sets : std::vector<std::vector<weft::graph::Setting>>{
           {}, {{"gi_sampling", "buffer"}}, {{"draw", "icosphere"}, {"subdivision", "6"}}}) {
    const std::vector<float> on = studio("graphs/studio_gi.json", kPair, 1, sets);
    double worst = 0, greatest = 0;
    for (std::uint32_t y = 8; y < 56; ++y)
      for (std::uint32_t x = 16; x < 80; ++x) {
        // The ray of the pixel's center, from the eye at (0, 0, 9).
        const double scale = std::tan(22.5 * 3.14159265358979 / 180) / 32;
        const glm::dvec3 ray = glm::normalize(glm::dvec3((x + 0.5 - 48) * scale, (y + 0.5 - 32) * scale, -1));
        const glm::dvec3 from = glm::dvec3(0, 0, 9) - glm::dvec3(kPair[0].center);
        const double b = glm::dot(from, ray), c = glm::dot(from, from) - 1, root = b * b - c;
        if (root < 0.2) continue;  // off the white sphere, or within a pixel of its rim
        const glm::dvec3 normal = from + ray * (-b - std::sqrt(root));
        const glm::vec3 light =
            scene::irradianceOf(scene::probeAt(grid, probes, kPair[0].center + glm::vec3(normal)),
                                glm::normalize(glm::vec3(normal)));
        const std::size_t i = (std::size_t{y} * 96 + x) * 4;
        for (int channel = 0; channel < 3; ++channel) {
          // Under a constant environment the diffuse light, 1, becomes 1 + light / pi.
          const double gained = double(on[i + channel]) - double(off[i + channel]);
          const double expected = double(diffuse[i + channel]) * double(light[channel]) / 3.14159265358979;
          worst = std::max(worst, std::abs(gained - expected));
          greatest = std::max(greatest, expected);
        }
      }
    MESSAGE((sets.empty() ? std::string("as it is") : sets[0].text), ": worst ", worst, " of ", greatest);
    CHECK(greatest > 0.1);
    CHECK(worst < 1.5e-3);  // a pixel is two halves, about 1
  }
}

}  // namespace gi_studio_test
