// Light probes on meshes, forward and by way of a G-buffer: a wall beside two spheres.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "tests/theory/gi/probe_reading.h"
#include "tests/theory/gi/probe_reference.h"
#include "tests/theory/mesh_scene.h"

namespace gi_mesh_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 64;
constexpr double kEye = 9, kTangent = 0.41421356237309503;  // of half the angle of view, 22.5 degrees
constexpr double kPi = 3.14159265358979;

const std::vector<scene::Instance> kSpheres = {
    {.center = {-1.6f, 0, 0.5f}, .radius = 0.7f, .albedo = {0.9f, 0.1f, 0.05f}},
    {.center = {1.5f, 0.3f, 1}, .radius = 0.6f, .albedo = {0.2f, 0.9f, 0.9f}}};

// A wall at z = 0 that faces the eye and fills the picture, and the spheres before it and in it.
scene::Scene wallAndSpheres() {
  MeshScene made({0, 0, kEye}, 45);
  made.put(made.addSquare(9), {.name = "", .albedo = {0.8f, 0.7f, 0.6f}, .metallic = 0, .roughness = 1}, {});
  for (const scene::Instance& sphere : kSpheres)
    made.putSphere(sphere.center, sphere.radius,
                   {.name = "", .albedo = sphere.albedo, .metallic = sphere.metallic, .roughness = 1});
  return made.scene;
}

// Under an environment of radiance 1.
std::vector<float> render(const std::string& graph, std::vector<graph::Setting> sets,
                          std::vector<graph::Disable> disables = {}) {
  return take(wallAndSpheres(), {.graph = graph,
                                 .width = kWidth,
                                 .height = kHeight,
                                 .sets = std::move(sets),
                                 .disables = std::move(disables)})
      .radiance;
}

// Where the ray of a pixel's center meets the wall, unless it comes near a sphere.
std::optional<glm::vec3> wallAt(std::uint32_t x, std::uint32_t y) {
  const double scale = kTangent / (kHeight / 2.0);
  const glm::dvec3 eye(0, 0, kEye);
  const glm::dvec3 ray((x + 0.5 - kWidth / 2.0) * scale, (y + 0.5 - kHeight / 2.0) * scale, -1);
  const glm::dvec3 way = glm::normalize(ray);
  for (const scene::Instance& sphere : kSpheres) {
    const glm::dvec3 to = glm::dvec3(sphere.center) - eye;
    if (glm::length(to - glm::dot(to, way) * way) < 1.3 * double(sphere.radius)) return {};
  }
  return glm::vec3(eye + kEye * ray);
}

}  // namespace

TEST_CASE(
    "gi: what a pixel of a mesh gains is the irradiance of the probes, forward and by way of a G-buffer, "
    "from textures and from the buffer") {
  const CleanScope clean;
  const scene::ProbeGrid grid = scene::placeProbes(kSpheres, {21, 21, 3});
  const std::vector<scene::Probe> probes = scene::computeProbes(grid, {}, kSpheres);
  for (const std::string graph : {"graphs/studio_gi.json", "graphs/deferred_gi.json"}) {
    const std::vector<float> off = render(graph, {{"bounce", "false"}});
    const std::vector<float> diffuse =
        render(graph, {{"bounce", "false"}}, {std::string("ibl.specular_prefilter")});
    for (const std::string sampling : {"textures", "buffer"}) {
      CAPTURE(graph);
      CAPTURE(sampling);
      const std::vector<float> on = render(graph, {{"gi_sampling", sampling}});
      double worst = 0, greatest = 0;
      int pixels = 0;
      for (std::uint32_t y = 0; y < kHeight; ++y)
        for (std::uint32_t x = 0; x < kWidth; ++x) {
          const std::optional<glm::vec3> point = wallAt(x, y);
          if (!point) continue;
          const glm::vec3 light = scene::irradianceOf(scene::probeAt(grid, probes, *point), {0, 0, 1});
          const std::size_t i = (std::size_t{y} * kWidth + x) * 4;
          for (std::size_t channel = 0; channel < 3; ++channel) {
            // Diffuse light, 1, becomes 1 + light / pi; of occlusion both get the same.
            const double gained = double(on[i + channel]) - double(off[i + channel]);
            const double expected =
                double(diffuse[i + channel]) * double(light[static_cast<int>(channel)]) / kPi;
            worst = std::max(worst, std::abs(gained - expected));
            greatest = std::max(greatest, expected);
          }
          ++pixels;
        }
      MESSAGE(graph, ", ", sampling, ": worst ", worst, " of ", greatest, " in ", pixels, " pixels");
      CHECK(pixels > 3000);
      CHECK(greatest > 0.02);
      CHECK(worst < 1.5e-3);  // a pixel is two halves, about 1
    }
  }
}

TEST_CASE("gi: without a bounce the deferred picture is that of deferred.json byte for byte") {
  const CleanScope clean;
  CHECK(render("graphs/deferred_gi.json", {{"bounce", "false"}}) == render("graphs/deferred.json", {}));
}

}  // namespace gi_mesh_test
