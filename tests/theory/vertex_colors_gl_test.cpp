// Colors of vertices, in the studio and in the deferred frame: squares of one color against materials of that color, a gradient
// against its formula, and holes by alpha, which let the sun through.
#include <array>
#include <cmath>
#include <string>

#include "tests/theory/mesh_scene.h"

namespace vertex_colors_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

const std::array<glm::vec4, 4> kColors = {
    glm::vec4(1, 0, 0, 0.5f), {0.2f, 0.9f, 0.4f, 1}, {0.05f, 0.1f, 1, 0.25f}, {0.5f, 0.5f, 0.5f, 0.75f}};
const glm::vec3 kBase(0.8f, 0.6f, 0.9f);
constexpr float kAlpha = 0.8f;

// A dark wall, and four squares before it whose colors are those of their vertices, or of their materials.
scene::Scene squares(bool ofVertices, bool blend) {
  MeshScene made({0, 0, 9}, 45);
  std::vector<glm::vec4> colors(4, glm::vec4(1));
  made.put(made.addSquare(9), {.name = "", .albedo = glm::vec3(0.1f), .roughness = 1}, {0, 0, -1});
  for (std::size_t i = 0; i < 4; ++i) {
    const glm::vec4 color = ofVertices ? glm::vec4(1) : kColors[i];
    scene::Material material{
        .name = "", .albedo = kBase * glm::vec3(color), .roughness = 0.7f, .blend = blend};
    if (blend) material.alpha = kAlpha * color.a;
    made.put(made.addSquare(1), material, {i % 2 ? 1.5f : -1.5f, i / 2 ? 1.2f : -1.2f, 0},
             scene::maskOf(blend ? scene::DrawList::transparent : scene::DrawList::opaque));
    colors.insert(colors.end(), 4, kColors[i]);
  }
  if (ofVertices) made.setColors(colors);
  return made.scene;
}

double worstOf(const std::vector<float>& a, const std::vector<float>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, std::abs(double(a[i]) - double(b[i])));
  return worst;
}

}  // namespace

TEST_CASE("squares with colored vertices are squares of materials of these colors, opaque and transparent") {
  const CleanScope clean;
  for (const char* graph : {"graphs/studio.json", "graphs/deferred.json"})
    for (const bool blend : {false, true}) {
      CAPTURE(graph);
      CAPTURE(blend);
      const Shot shot{.graph = graph};
      const std::vector<float> vertices = take(squares(true, blend), shot).radiance,
                               materials = take(squares(false, blend), shot).radiance;
      CHECK(worstOf(vertices, materials) < 2e-3);  // halves, about 1
      // Another picture than without the colors.
      scene::Scene plain = squares(true, blend);
      auto data = std::make_shared<scene::MeshData>(*plain.meshData);
      data->colors.clear();
      plain.meshData = data;
      CHECK(worstOf(vertices, take(plain, shot).radiance) > 0.2);
    }
}

TEST_CASE("colors between vertices are linear light") {
  const CleanScope clean;
  const auto squareOf = [](std::vector<glm::vec4> colors) {
    MeshScene made({0, 0, 9}, 45);
    made.put(made.addSquare(2), {.name = "", .albedo = glm::vec3(1), .roughness = 1}, {});
    made.setColors(std::move(colors));
    return made.scene;
  };
  const Shot shot{.graph = "graphs/studio.json"};
  const Taken white = take(squareOf({}), shot);
  const std::vector<float> black = take(squareOf(std::vector<glm::vec4>(4, {0, 0, 0, 1})), shot).radiance;
  // Red from left to right, green from below to above, blue against red.
  const std::vector<float> gradient =
      take(squareOf({{0, 0, 1, 1}, {1, 0, 0, 1}, {1, 1, 0, 1}, {0, 1, 1, 1}}), shot).radiance;
  const double scale = std::tan(22.5 * std::numbers::pi / 180) / (shot.height / 2.0) * 9;
  double worst = 0;
  int pixels = 0;
  for (std::uint32_t y = 0; y < shot.height; ++y)
    for (std::uint32_t x = 0; x < shot.width; ++x) {
      const std::size_t pixel = std::size_t{y} * shot.width + x;
      if (white.depth[pixel] == 0) continue;
      ++pixels;
      const double u = ((x + 0.5 - shot.width / 2.0) * scale + 2) / 4,
                   v = ((y + 0.5 - shot.height / 2.0) * scale + 2) / 4;
      const std::array<double, 3> wanted = {u, v, 1 - u};
      for (std::size_t c = 0; c < 3; ++c) {
        // Of a dielectric, only the diffuse share depends on the color, and is proportional to it.
        const double none = black[4 * pixel + c], all = white.radiance[4 * pixel + c];
        worst =
            std::max(worst, std::abs(double(gradient[4 * pixel + c]) - (none + (all - none) * wanted[c])));
      }
    }
  MESSAGE("worst ", worst, " in ", pixels, " pixels");
  CHECK(pixels > 1000);
  CHECK(worst < 1e-3);  // two halves, about 1
}

TEST_CASE("where the alpha of vertices makes a hole of a mask, the sun shines through it") {
  const CleanScope clean;
  const auto scene = [](bool mask, float alpha) {
    MeshScene made({0, 0, 9}, 45);
    made.put(made.addSquare(9), {.name = "", .albedo = {0.8f, 0.5f, 0.3f}, .roughness = 0.9f}, {});
    if (mask)
      made.put(made.addSquare(1), {.name = "", .alphaCutoff = 0.5f}, {0, 0, 2},
               static_cast<std::uint8_t>(scene::maskOf(scene::DrawList::opaque) |
                                         scene::maskOf(scene::DrawList::shadow_casters)));
    std::vector<glm::vec4> colors(mask ? 8 : 4, {1, 1, 1, alpha});
    made.setColors(colors);
    made.scene.sun = scene::Sun{.direction = glm::normalize(glm::vec3(1, 1, 2)), .irradiance = glm::vec3(3)};
    return made.scene;
  };
  const Shot shot{.graph = "graphs/deferred.json", .environment = 0, .sets = {{"ao", "false"}}};
  const std::vector<float> none = take(scene(false, 1), shot).radiance,
                           whole = take(scene(true, 0.75f), shot).radiance,
                           hole = take(scene(true, 0.25f), shot).radiance;
  CHECK(worstOf(none, whole) > 0.3);
  CHECK(worstOf(none, hole) < 1e-3);
}

}  // namespace vertex_colors_test
