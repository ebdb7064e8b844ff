// Reflections of what is in the picture, against a path tracer of one bounce: mirrors and rough metals, as meshes, as ray-traced spheres
// and as a floor, between things that emit, under a sky that is bright above.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/theory/deferred/mirror_tracer.h"
#include "tests/theory/mesh_scene.h"
#include "tests/theory/oracle.h"
#include "tests/theory/reflection/oracle.h"

namespace deferred_mirrors_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

glm::dvec3 skyAt(glm::dvec3 d) {
  return glm::mix(glm::dvec3(0.35, 0.3, 0.25), glm::dvec3(0.7, 1.0, 1.6), 1 / (1 + std::exp(-4 * d.y)));
}

scene::Material lightOf(glm::vec3 radiance) {
  return {.name = "",
          .albedo = glm::vec3(0),
          .metallic = 1,
          .emissive = radiance,
          .blinnPhong = true,
          .shininess = 8};
}
scene::Material metalOf(float roughness) {
  return {.name = "", .albedo = {0.9f, 0.8f, 0.7f}, .metallic = 1, .roughness = roughness};
}

struct Shown {
  std::vector<float> off, on;
};

Shown take(const scene::Scene& made, std::uint32_t width, std::uint32_t height) {
  runtime::test::Stage stage("graphs/deferred.json", width, height);
  stage.world.setScene(made);
  stage.world.setEnvironment(makeEnvironment([](int x, int y) {
    const Vec3 d = equirectDirection(x, y, 256, 128);
    const glm::dvec3 sky = skyAt({d.x, d.y, d.z});
    return std::array{sky.r, sky.g, sky.b};
  }));
  Shown shown;
  for (const bool on : {false, true}) {
    stage.settings.sets = {{"reflections", on ? "true" : "false"}, {"ao", "false"}};
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run();
    (on ? shown.on : shown.off) = stage.read("hdr");
  }
  return shown;
}

struct Error {
  double off = 0, on = 0;
  int count = 0;
};

// Of meshes and of ray-traced spheres, over pixels whose lobe meets the sky or what the picture shows.
std::array<Error, 2> errorsOf(const MirrorTracer& tracer, const Shown& shown, std::uint32_t width,
                              std::uint32_t height, int rays) {
  std::array<Error, 2> errors;
  for (std::uint32_t y = 2; y + 2 < height; ++y)
    for (std::uint32_t x = 2; x + 2 < width; ++x) {
      const MirrorTracer::Pixel pixel = tracer.pixel(x, y, rays);
      if (!pixel.metal || pixel.hidden > 0.04 || pixel.shown < 0.2) continue;
      const std::uint32_t beside[4] = {tracer.pixel(x - 2, y, 1).surface, tracer.pixel(x + 2, y, 1).surface,
                                       tracer.pixel(x, y - 2, 1).surface, tracer.pixel(x, y + 2, 1).surface};
      if (std::ranges::any_of(beside, [&](std::uint32_t other) { return other != pixel.surface; })) continue;
      Error& error = errors[pixel.sphere];
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = 4 * (std::size_t{y} * width + x) + static_cast<std::size_t>(c);
        const double right = shownOf255(pixel.radiance[c]);
        error.off += std::abs(shownOf255(static_cast<double>(shown.off[at])) - right) / 3;
        error.on += std::abs(shownOf255(static_cast<double>(shown.on[at])) - right) / 3;
      }
      ++error.count;
    }
  for (Error& error : errors) error.off /= error.count, error.on /= error.count;
  return errors;
}

}  // namespace

TEST_CASE(
    "metals reflect what the picture shows as a path tracer does, within 4 of 255, rough spheres within 6") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 192, kHeight = 108;
  for (const double roughness : {0.0, 0.2, 0.5}) {
    MeshScene made({0, 2.2, 6}, 40);
    const scene::Material metal = metalOf(static_cast<float>(roughness));
    const auto tile = made.addBox({1, 0.1f, 1});
    for (int i = -3; i < 3; ++i)
      for (int j = -4; j < 2; ++j)
        made.put(tile, lightOf((i + j) % 2 ? glm::vec3(0.7f, 0.6f, 0.5f) : glm::vec3(0.2f, 0.25f, 0.2f)),
                 {2 * static_cast<float>(i) + 1, -1.1f, 2 * static_cast<float>(j) + 1});
    made.put(made.addBox({0.4f, 0.8f, 0.4f}), lightOf({1.5f, 0.2f, 0.1f}), {-0.1f, -0.2f, -1.6f});
    made.put(made.addBox({0.3f, 0.3f, 0.3f}), lightOf({0.1f, 0.3f, 1.5f}), {0.1f, -0.7f, 0.9f});
    made.put(made.addBall(), metal, {-1.5f, 0, 0});
    made.putSphere({1.5f, 0, 0}, 1, metal);
    made.put(made.addBox({1.2f, 0.02f, 0.8f}), metal, {-0.1f, -0.98f, -0.4f});
    const Shown shown = take(made.scene, kWidth, kHeight);
    const MirrorTracer tracer(made.scene, made.scene.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
    const std::array<Error, 2> errors = errorsOf(tracer, shown, kWidth, kHeight, roughness == 0 ? 1 : 64);
    for (const bool spheres : {false, true}) {
      const Error& error = errors[spheres];
      const std::string kind = spheres ? ", spheres: " : ", meshes: ";
      MESSAGE("roughness ", roughness, kind, error.on, " of 255, with the map alone ", error.off, ", ",
              error.count, " pixels");
      CHECK(error.count > 40);
      // Rough spheres have 8 rays of their own; meshes share those of their neighbors.
      CHECK(error.on < (spheres && roughness > 0.3 ? 6 : 4));
      CHECK(error.off > 10);
    }
  }
}

}  // namespace deferred_mirrors_test
