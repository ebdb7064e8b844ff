// Reflections of the scene, against a path tracer of one bounce: mirrors and rough metals, as meshes, as ray-traced spheres
// and as a floor, between things that emit, under a sky that is bright above.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>
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
  std::vector<float> off, on, bare, occluded;  // `bare`: with what they reflect disabled
};

void show(runtime::test::Stage& stage, const scene::Scene& made) {
  stage.world.setScene(made);
  const auto map = makeEnvironment([](int x, int y) {
    const Vec3 d = equirectDirection(x, y, 256, 128);
    const glm::dvec3 sky = skyAt({d.x, d.y, d.z});
    return std::array{sky.r, sky.g, sky.b};
  });
  stage.world.setEnvironment(std::make_shared<const assets::EnvironmentMap>(assets::toEnvironmentMap(*map)));
}

Shown take(const scene::Scene& made, std::uint32_t width, std::uint32_t height, const char* fog = "false") {
  runtime::test::Stage stage("graphs/deferred.json", width, height);
  show(stage, made);
  const auto draw = [&](const char* reflections, const char* ao) {
    stage.settings.sets = {{"reflections", reflections}, {"ao", ao}, {"fog", fog}, {"fog_density", "0.05"}};
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run();
    return stage.read("hdr");
  };
  Shown shown{.off = draw("false", "false"), .on = draw("true", "false"), .occluded = draw("true", "true")};
  stage.settings.disables = {{"scenery"}};
  shown.bare = draw("true", "false");
  return shown;
}

struct Error {
  double off = 0, on = 0;
  int count = 0;
};

// Of meshes and of ray-traced spheres.
std::array<Error, 2> errorsOf(const MirrorTracer& tracer, const Shown& shown, std::uint32_t width,
                              std::uint32_t height, int rays) {
  std::array<Error, 2> errors;
  for (std::uint32_t y = 2; y + 2 < height; ++y)
    for (std::uint32_t x = 2; x + 2 < width; ++x) {
      const MirrorTracer::Pixel pixel = tracer.pixel(x, y, rays);
      if (!pixel.metal) continue;
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

MeshScene metalsBetweenLights(float roughness) {
  MeshScene made({0, 2.2, 6}, 40);
  const scene::Material metal = metalOf(roughness);
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
  return made;
}

}  // namespace

TEST_CASE("metals reflect the scene as a path tracer does, within 4 of 255") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 192, kHeight = 108;
  for (const double roughness : {0.0, 0.15, 0.35}) {
    const MeshScene made = metalsBetweenLights(static_cast<float>(roughness));
    const Shown shown = take(made.scene, kWidth, kHeight);
    CHECK(shown.bare == shown.off);
    CHECK(std::ranges::all_of(shown.occluded, [](float v) { return v >= 0; }));  // nor NaN
    const MirrorTracer tracer(made.scene, made.scene.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
    const std::array<Error, 2> errors = errorsOf(tracer, shown, kWidth, kHeight, roughness == 0 ? 1 : 48);
    for (const bool spheres : {false, true}) {
      const Error& error = errors[spheres];
      const std::string kind = spheres ? ", spheres: " : ", meshes: ";
      MESSAGE("roughness ", roughness, kind, error.on, " of 255, with the map alone ", error.off, ", ",
              error.count, " pixels");
      CHECK(error.count > 1000);
      CHECK(error.on < 4);
      CHECK(error.off > 4);
    }
  }
}

TEST_CASE("rough metals in the studio reflect the scene smoothly: a few rays show no ghosts of it") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 192, kHeight = 108;
  for (const double roughness : {0.35, 0.5}) {
    const MeshScene made = metalsBetweenLights(static_cast<float>(roughness));
    runtime::test::Stage stage("graphs/studio.json", kWidth, kHeight);
    show(stage, made.scene);
    stage.settings.sets = {{"reflections", "true"}};
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run();
    const std::vector<float> on = stage.read("hdr");
    const MirrorTracer tracer(made.scene, made.scene.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
    constexpr double kNone = 1e9;
    std::vector<double> off_by(std::size_t{kWidth} * kHeight, kNone);
    double mean = 0, change = 0;
    int count = 0, pairs = 0;
    for (std::uint32_t y = 2; y + 2 < kHeight; ++y)
      for (std::uint32_t x = 2; x + 2 < kWidth; ++x) {
        const MirrorTracer::Pixel pixel = tracer.pixel(x, y, 256);
        if (!pixel.metal) continue;
        const std::size_t at = std::size_t{y} * kWidth + x;
        off_by[at] = 0;
        for (int c = 0; c < 3; ++c) {
          const double shown = static_cast<double>(on[4 * at + static_cast<std::size_t>(c)]);
          const double error = shownOf255(shown) - shownOf255(pixel.radiance[c]);
          off_by[at] += error / 3, mean += std::abs(error) / 3;
        }
        ++count;
        for (const std::size_t beside : {at - 2, at - 2 * kWidth})
          if (off_by[beside] != kNone) change += std::abs(off_by[at] - off_by[beside]), ++pairs;
      }
    mean /= count, change /= pairs;
    MESSAGE("studio, roughness ", roughness, ": ", mean, " of 255, changes by ", change,
            " within two pixels");
    CHECK(mean < 3.05);
    CHECK(change < 2);
  }
}

TEST_CASE(
    "a mirror behind helmets, which are of many shells, shows whole ones and the floor to its horizon") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 256, kHeight = 144;
  scene::Scene made = runtime::test::worldOf("scenes/helmets.json").scene();
  for (std::size_t row = 0; row < made.materials.size(); ++row) {
    const float part = static_cast<float>(row % 5) / 4;
    made.materials.edit(made.materials.idOf(row)) = lightOf({6 - 4 * part, 1.5f, 1 + 3 * part});
  }
  made.sun.reset();
  made.lamps = {};
  made.spheres = {};
  made.spheres.add({.center = {0.12f, 0.3f, -0.75f},
                    .radius = 0.3f,
                    .material = made.materials.add(metalOf(0)),
                    .lists = scene::maskOf(scene::DrawList::spheres)});
  const Shown shown = take(made, kWidth, kHeight);
  const MirrorTracer tracer(made, made.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
  const Error error = errorsOf(tracer, shown, kWidth, kHeight, 1)[1];
  MESSAGE(error.on, " of 255, with the map alone ", error.off, ", ", error.count, " pixels");
  CHECK(error.on < 4);
}

TEST_CASE("beside what a mirror floor reflects there are no specks of it") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 320, kHeight = 180;
  MeshScene made({0, 1.6f, 5}, 40);
  made.put(made.addBox({4, 0.1f, 4}), metalOf(0), {0, -0.6f, 0});
  const auto box = made.addBox({0.4f, 0.4f, 0.4f});
  for (const float x : {-1.0f, 0.2f, 1.3f}) made.put(box, lightOf({3, 0.1f, 0.1f}), {x, -0.09f, -0.6f * x});
  const MirrorTracer tracer(made.scene, made.scene.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
  const Shown shown = take(made.scene, kWidth, kHeight);
  int specks = 0, compared = 0;
  for (std::uint32_t y = 3; y + 3 < kHeight; ++y)
    for (std::uint32_t x = 3; x + 3 < kWidth; ++x) {
      bool sky = true;  // all around, too
      for (std::uint32_t i = 0; i < 9 && sky; ++i) {
        const auto beside = tracer.pixel(x + 3 * (i % 3) - 3, y + 3 * (i / 3) - 3, 1);
        sky = beside.metal && beside.radiance.r < 1;
      }
      if (!sky) continue;
      ++compared;
      specks += shown.on[4 * (std::size_t{y} * kWidth + x)] > 1;
    }
  MESSAGE(specks, " of ", compared);
  CHECK(compared > 10000);
  CHECK(specks == 0);
}

TEST_CASE("a mirror floor shows the underside of a table, which neither the picture nor the probe shows") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 192, kHeight = 108;
  MeshScene made({0.6f, 2.2f, 6}, 32);
  made.put(made.addBox({6, 0.1f, 5}), metalOf(0), {0, -1.1f, -1});
  made.put(made.addBox({1.2f, 0.02f, 0.8f}), lightOf({0.5f, 0.15f, 0.06f}), {0, 0.2f, 0});
  for (const float x : {-1.1f, 1.1f})
    for (const float z : {-0.7f, 0.7f})
      made.put(made.addBox({0.05f, 0.6f, 0.05f}), lightOf({0.2f, 0.1f, 0.05f}), {x, -0.4f, z});
  made.put(made.addBox({2, 1, 0.1f}), lightOf({0.6f, 0.6f, 0.55f}), {1, 0, -3});
  const MirrorTracer tracer(made.scene, made.scene.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
  for (const auto& [graph, bound] : {std::pair{"graphs/deferred.json", 2.0}, {"graphs/studio.json", 4.0}}) {
    const std::string name = graph;
    CAPTURE(name);
    runtime::test::Stage stage(graph, kWidth, kHeight);
    show(stage, made.scene);
    const auto draw = [&](const char* reflections) {
      stage.settings.sets = {{"reflections", reflections}};
      REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
      stage.run();
      return stage.read("hdr");
    };
    const Error error = errorsOf(tracer, {.off = draw("false"), .on = draw("true")}, kWidth, kHeight, 1)[0];
    MESSAGE(name, ": ", error.on, " of 255, with the map alone ", error.off);
    CHECK(error.on < bound);
  }
}

TEST_CASE("a ground without a surface shows the sky in mirrors, too, not black") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 96, kHeight = 54;
  MeshScene made({0, 1, 6}, 25);
  made.put(made.addBox({0.3f, 1.5f, 0.3f}), lightOf({1.5f, 0.2f, 0.1f}), {-1.2f, 0.5f, -0.8f});
  made.putSphere({0.3f, -0.3f, 0}, 0.7f, metalOf(0),
                 scene::maskOf(scene::DrawList::spheres) | scene::maskOf(scene::DrawList::shadow_casters));
  made.scene.ground = scene::Ground{.height = -1};
  made.scene.sun =
      scene::Sun{.direction = glm::normalize(glm::vec3(-1, 0.5, -0.5)), .irradiance = glm::vec3(9)};
  runtime::test::Stage stage("graphs/studio.json", kWidth, kHeight);
  show(stage, made.scene);
  stage.settings.sets = {{"reflections", "true"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const std::vector<float> hdr = stage.read("hdr");
  const MirrorTracer tracer(made.scene, made.scene.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
  double darkest = 1;
  for (std::uint32_t y = 2; y + 2 < kHeight; ++y)
    for (std::uint32_t x = 2; x + 2 < kWidth; ++x)
      if (tracer.pixel(x, y, 1).metal)
        darkest = std::min(darkest, static_cast<double>(hdr[4 * (std::size_t{y} * kWidth + x)]));
  MESSAGE("darkest ", darkest);
  CHECK(darkest > 0.1);
}

TEST_CASE("a mirror that faces the camera shows what is far behind the camera, without a hole") {
  const CleanScope clean;
  constexpr std::uint32_t kWidth = 192, kHeight = 108;
  MeshScene made({0, 0, 6}, 40);
  made.put(made.addBox({1.5f, 1, 0.05f}), metalOf(0), {0, 0, 0});
  made.put(made.addBox({20, 10, 0.5f}), lightOf({6, 1.5f, 1}), {0, 0, 16});
  const Shown shown = take(made.scene, kWidth, kHeight);
  const MirrorTracer tracer(made.scene, made.scene.cameras.rows()[0].pose, kWidth, kHeight, skyAt);
  const Error error = errorsOf(tracer, shown, kWidth, kHeight, 1)[0];
  MESSAGE(error.on, " of 255, with the map alone ", error.off, ", ", error.count, " pixels");
  CHECK(error.on < 0.2);

  // In fog, by Beer and Lambert's law along the way from the eye to the mirror and along the one from there to the wall.
  const Shown misty = take(made.scene, kWidth, kHeight, "true");
  const double fog[3] = {0.8, 0.85, 0.9}, wall[3] = {6, 1.5, 1};
  double worst = 0;
  for (std::uint32_t y = 2; y + 2 < kHeight; ++y)
    for (std::uint32_t x = 2; x + 2 < kWidth; ++x) {
      if (!tracer.pixel(x, y, 1).metal) continue;
      const double step = 2 * std::tan(std::numbers::pi / 9) / kHeight;
      const double longer = std::sqrt(1 + std::pow(step * (x + 0.5 - kWidth / 2.0), 2) +
                                      std::pow(step * (y + 0.5 - kHeight / 2.0), 2));
      const double there = std::exp(-0.05 * 5.95 * longer), onward = std::exp(-0.05 * 15.45 * longer);
      for (int c = 0; c < 3; ++c) {
        const std::size_t at = 4 * (std::size_t{y} * kWidth + x) + static_cast<std::size_t>(c);
        const double clear = static_cast<double>(shown.on[at]), metal = clear / wall[c];
        const double right = fog[c] + there * (onward * clear + (1 - onward) * metal * fog[c] - fog[c]);
        worst = std::max(worst, std::abs(static_cast<double>(misty.on[at]) - right));
      }
    }
  MESSAGE("in fog, worst ", worst);
  CHECK(worst < 0.05);
}

}  // namespace deferred_mirrors_test
