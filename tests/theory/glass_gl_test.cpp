// Meshes that one sees through, among ray-traced spheres, in the studio and in the deferred frame: what is before the glass, what is
// behind it, and the share that its alpha says. Glass that transmits (KHR_materials_transmission, KHR_materials_volume) is held against
// rays of this file's own.
#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "tests/theory/mesh_scene.h"

namespace glass_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr float kAlpha = 0.3f;

enum class Pane { none, glass, solid, glass_as_solid };

// A wall at z = 0, a sphere before it, a pane of half the picture at z = 2 and a sphere before that.
scene::Scene sceneWith(Pane pane) {
  MeshScene made({0, 0, 9}, 45);
  const scene::MeshId square = made.addSquare(9);
  made.put(square, {.name = "", .albedo = {0.8f, 0.5f, 0.3f}, .roughness = 0.9f}, {});
  const bool glass = pane == Pane::glass, blend = glass || pane == Pane::glass_as_solid;
  if (pane != Pane::none)
    made.put(square,
             {.name = "",
              .albedo = {0.1f, 0.2f, 0.7f},
              .roughness = 0.4f,
              .alpha = blend ? kAlpha : 1.0f,
              .blend = blend},
             {9, 0, 2}, scene::maskOf(glass ? scene::DrawList::transparent : scene::DrawList::opaque));
  for (const float z : {1.0f, 3.0f})
    made.putSphere({0.3f, z > 2 ? -0.7f : 0.9f, z}, 0.6f,
                   {.name = "", .albedo = {0.9f, 0.2f, 0.2f}, .roughness = 0.5f});
  return made.scene;
}

Taken render(const Shot& shot, Pane pane) {
  return take(sceneWith(pane), shot);
}

}  // namespace

TEST_CASE(
    "glass in the studio and in the deferred frame: its share of its own light and the rest of what is "
    "behind "
    "it, a sphere too, whose depth stays; a sphere before it hides it") {
  const CleanScope clean;
  const Shot studio{.graph = "graphs/studio.json"};
  // Occlusion from depth is of the G-buffer: the pane would darken the wall if it was solid, and has none itself.
  const Shot deferred{.graph = "graphs/deferred.json", .sets = {{"ao", "false"}}};
  for (const Shot& shot : {studio, deferred}) {
    CAPTURE(shot.graph);
    const Taken behind = render(shot, Pane::none), glass = render(shot, Pane::glass),
                solid = render(shot, Pane::solid);
    CHECK(glass.depth == behind.depth);
    double worst = 0;
    int tinted = 0, untouched = 0, spheres = 0;
    for (std::size_t i = 0; i < std::size_t{shot.width} * shot.height; ++i) {
      // What the pane would hide is seen through it; what stands before it and beside it is as it was.
      const bool hidden = solid.depth[i] > behind.depth[i];
      for (std::size_t c = 0; c < 3; ++c) {
        const double own = double(solid.radiance[4 * i + c]), far = double(behind.radiance[4 * i + c]);
        const double share = hidden ? double(kAlpha) : 0.0;
        worst =
            std::max(worst, std::abs(double(glass.radiance[4 * i + c]) - (share * own + (1 - share) * far)));
      }
      (hidden ? tinted : untouched) += 1;
      // The sphere between the pane and the wall, which is 9 away.
      spheres += hidden && behind.depth[i] > 0.1f / 8.8f;
    }
    MESSAGE(shot.graph, ": worst ", worst, " in ", tinted, " pixels of glass, ", spheres,
            " of which show a sphere through it, and ", untouched, " others");
    CHECK(tinted > 2000);
    CHECK(spheres > 50);
    CHECK(untouched > 2000);
    CHECK(worst < 1.5e-3);  // halves, about 1

    // A scene may say that it is drawn with what is solid.
    CHECK(render(shot, Pane::glass_as_solid).radiance == solid.radiance);

    // Without the pass there is no glass.
    Shot without = shot;
    without.disables = {std::string("lit.transparent")};
    CHECK(render(without, Pane::glass).radiance == behind.radiance);
  }
}

namespace {

// Shining stripes in the plane z = 0, in no other light.
glm::dvec3 stripeAt(double x) {
  const auto number = static_cast<int>(std::floor(x / 0.75));
  return number % 2 == 0 ? glm::dvec3(0.2, 0.6, 1) : glm::dvec3(1, 0.5, 0.1);
}

struct Glass {
  float roughness = 0, thickness = 0;
  glm::vec3 albedo{1}, absorption{0};
  float specular = 1;
  std::uint8_t lists = scene::maskOf(scene::DrawList::transmissive);
  double mean = 0, often = 0;  // allowed: mean difference, and share of pixels over 0.05
};

constexpr double kEye = 9, kPane = 2, kIor = 1.5, kTan = 0.41421356237309503;  // half of 45 degrees

void putPane(const Glass& glass, MeshScene& made) {
  scene::Material material{.name = "", .albedo = glass.albedo, .roughness = glass.roughness};
  material.alpha = 0.5f;  // not of a material that blends
  material.layers.transmission = 1;
  material.layers.thickness = glass.thickness;
  material.layers.absorption = glass.absorption;
  material.layers.specular = glass.specular;
  material.layers.layered = true;
  made.put(made.addSquare(1.6f), material, {0, 0, float(kPane)}, glass.lists);
}

scene::Scene stripesBehind(const Glass& glass) {
  MeshScene made({0, 0, kEye}, 45);
  const scene::MeshId stripe = made.addSquare(0.375f);
  for (int x = -10; x < 10; ++x)
    for (int y = -5; y <= 5; ++y) {
      const double middle = (x + 0.5) * 0.75;
      made.put(stripe, {.name = "", .albedo = glm::vec3(0), .emissive = glm::vec3(stripeAt(middle))},
               {float(middle), 0.75f * float(y), 0});
    }
  putPane(glass, made);
  return made.scene;
}

// A facet that an eye at `v` sees (z: the normal), of GGX: Heitz, "Sampling the GGX distribution of visible normals", JCGT 2018.
glm::dvec3 facetSeen(glm::dvec3 v, double alpha, double u1, double u2) {
  const glm::dvec3 s = glm::normalize(glm::dvec3(alpha * v.x, alpha * v.y, v.z));
  const glm::dvec3 t1 = s.x * s.x + s.y * s.y > 0 ? glm::normalize(glm::dvec3(-s.y, s.x, 0))
                                                  : glm::dvec3(1, 0, 0),
                   t2 = glm::cross(s, t1);
  const double r = std::sqrt(u1), phi = 2 * std::numbers::pi * u2, p1 = r * std::cos(phi),
               half = 0.5 * (1 + s.z), p2 = (1 - half) * std::sqrt(1 - p1 * p1) + half * r * std::sin(phi);
  const glm::dvec3 n = p1 * t1 + p2 * t2 + std::sqrt(std::max(0.0, 1 - p1 * p1 - p2 * p2)) * s;
  return glm::normalize(glm::dvec3(alpha * n.x, alpha * n.y, std::max(n.z, 1e-9)));
}

// What the pane lets through of the stripes towards a point of the picture, -1 to 1 each way.
glm::dvec3 seenThrough(const Glass& glass, double x, double y, std::mt19937& random) {
  const glm::dvec3 eye(0, 0, kEye), ray = glm::normalize(glm::dvec3(x, y, -1)),
                                    at = eye + ray * ((kEye - kPane) / -ray.z), v = -ray;
  glm::dvec3 light(0);
  if (glass.thickness > 0) {
    // Snell's law; the stripes lie on the far side.
    glm::dvec3 into = glm::dvec3(ray.x, ray.y, 0) / kIor;
    into.z = -std::sqrt(1 - into.x * into.x - into.y * into.y);
    const double way = double(glass.thickness) / -into.z;
    light = stripeAt(at.x + into.x * way) * glm::exp(-glm::dvec3(glass.absorption) * way);
  } else {
    // The lobe that the extension gives a thin wall: that of what is reflected, on the other side.
    const double alpha = double(glass.roughness) * double(glass.roughness);
    const int count = alpha > 0 ? 4000 : 1;
    double all = 0;
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int i = 0; i < count; ++i) {
      const glm::dvec3 h = alpha > 0 ? facetSeen(v, alpha, uniform(random), uniform(random))
                                     : glm::dvec3(0, 0, 1),
                       out = 2 * glm::dot(v, h) * h - v;
      if (out.z <= 0) continue;
      const double masked = alpha * alpha * (1 - out.z * out.z) / (out.z * out.z),
                   weight =
                       2 / (1 + std::sqrt(1 + masked));  // of Smith's masking; the view's is in the sampling
      light += weight * stripeAt(at.x + out.x * kPane / out.z);
      all += weight;
    }
    light /= all;
  }
  const double f = 0.04 + 0.96 * std::pow(1 - v.z, 5);
  return light * glm::dvec3(glass.albedo) * (1 - f);
}

}  // namespace

TEST_CASE("glass transmits what rays find behind it: thin walls, smooth and rough, and a tinted slab") {
  const CleanScope clean;
  const Glass panes[] = {
      {.albedo = {0.9f, 0.6f, 0.3f}, .mean = 0.004, .often = 0.01},
      {.roughness = 0.15f, .mean = 0.03, .often = 0.2},
      {.roughness = 0.35f, .mean = 0.035, .often = 0.2},
      {.thickness = float(kPane), .absorption = {0.1f, 0.4f, 0.05f}, .mean = 0.012, .often = 0.1}};
  for (const char* graph : {"graphs/studio.json", "graphs/deferred.json"}) {
    const Shot shot{.graph = graph, .width = 192, .height = 128, .environment = 0};
    Camera camera(shot);
    std::mt19937 random(7);
    for (const Glass& glass : panes) {
      const Taken taken = camera.take(stripesBehind(glass), shot);
      double sum = 0;
      int over = 0, count = 0;
      for (std::uint32_t row = 3; row < shot.height; row += 5)
        for (std::uint32_t column = 0; column < shot.width; ++column) {
          const double y = (2 * (row + 0.5) / shot.height - 1) * kTan,
                       x = (2 * (column + 0.5) / shot.width - 1) * kTan * shot.width / shot.height;
          if (std::max(std::abs(x), std::abs(y)) * (kEye - kPane) > 1.5) continue;
          const glm::dvec3 right = seenThrough(glass, x, y, random);
          double worst = 0;
          for (int c = 0; c < 3; ++c)
            worst = std::max(
                worst,
                std::abs(
                    double(taken.radiance[4 * (std::size_t{row} * shot.width + column) + std::size_t(c)]) -
                    right[c]));
          sum += worst;
          over += worst > 0.05;
          ++count;
        }
      MESSAGE(std::string(graph), ", roughness ", glass.roughness, ", thickness ", glass.thickness, ": mean ",
              sum / count, ", ", over, " of ", count, " over 0.05");
      CHECK(count > 500);
      CHECK(sum / count < glass.mean);
      CHECK(over < glass.often * count);
    }
  }
}

TEST_CASE("a light behind rough glass is one blur, however wide") {
  const CleanScope clean;
  for (const char* graph : {"graphs/studio.json", "graphs/deferred.json"})
    for (const float roughness : {0.4f, 0.6f}) {
      const Shot shot{.graph = graph, .width = 768, .height = 512, .environment = 0};
      MeshScene made({0, 0, kEye}, 12);
      made.put(made.addSquare(0.1f), {.name = "", .albedo = glm::vec3(0), .emissive = glm::vec3(100)}, {});
      putPane({.roughness = roughness}, made);
      const Taken taken = take(made.scene, shot);
      const auto at = [&](std::uint32_t column) {
        return double(taken.radiance[4 * (std::size_t{shot.height} / 2 * shot.width + column)]);
      };
      CHECK(at(shot.width / 2) > 0.1);
      for (std::uint32_t column = shot.width / 2; column + 32 < shot.width; column += 16)
        CHECK_MESSAGE(at(column + 32) <= 1.02 * at(column), graph, ", ", roughness, ": column ", column);
    }
}

TEST_CASE("glass that reflects nothing and lets all through is not seen, in fog neither") {
  const CleanScope clean;
  for (const char* graph : {"graphs/studio.json", "graphs/deferred.json"}) {
    const Shot shot{.graph = graph, .sets = {{"fog", "true"}, {"fog_density", "0.1"}}};
    Camera camera(shot);
    const Taken with = camera.take(stripesBehind({.specular = 0}), shot),
                without = camera.take(stripesBehind({.lists = 0}), shot);
    double worst = 0;
    for (std::size_t i = 0; i < with.radiance.size(); ++i)
      worst = std::max(worst, std::abs(double(with.radiance[i]) - double(without.radiance[i])));
    CHECK_MESSAGE(worst < 0.01, graph);  // halves of up to 2
    CHECK(with.depth != without.depth);
  }
}

}  // namespace glass_test
