// Meshes that one sees through, among ray-traced spheres in the studio: what is before the glass, what is behind it, and the share that
// its alpha says.
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "tests/runtime/stage.h"

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr std::uint32_t kWidth = 96, kHeight = 64;
constexpr float kAlpha = 0.3f;

enum class Pane { none, glass, solid };

// A wall at z = 0, a sphere before it, a pane of half the picture at z = 2 and a sphere before that.
scene::Scene sceneWith(Pane pane) {
  scene::Scene scene;
  scene.cameras.add(
      {.name = "front",
       .pose = {.position = {0, 0, 9}, .target = {0, 0, 0}, .fovDegrees = 45, .nearPlane = 0.1}});
  auto data = std::make_shared<scene::MeshData>();
  scene::Mesh mesh{.name = "square", .vertexCount = 4, .indexCount = 6};
  for (const glm::vec3 corner : {glm::vec3(-9, -9, 0), {9, -9, 0}, {9, 9, 0}, {-9, 9, 0}}) {
    data->vertices.push_back({.position = corner});
    mesh.bounds.add(corner);
  }
  data->indices = {0, 1, 2, 0, 2, 3};
  scene.meshData = data;
  const auto square = scene.meshes.add(mesh);
  scene.meshInstances.add(
      {.node = scene.nodes.add({.name = "wall", .parent = {}}),
       .mesh = square,
       .material = scene.materials.add({.name = "", .albedo = {0.8f, 0.5f, 0.3f}, .roughness = 0.9f})});
  if (pane != Pane::none) {
    const bool glass = pane == Pane::glass;
    scene.meshInstances.add(
        {.node = scene.nodes.add({.name = "pane", .parent = {}, .local = {.translation = {9, 0, 2}}}),
         .mesh = square,
         .material = scene.materials.add({.name = "",
                                          .albedo = {0.1f, 0.2f, 0.7f},
                                          .roughness = 0.4f,
                                          .alpha = glass ? kAlpha : 1.0f,
                                          .blend = glass}),
         .lists = scene::maskOf(glass ? scene::DrawList::transparent : scene::DrawList::opaque)});
  }
  for (const float z : {1.0f, 3.0f})
    scene.spheres.add(
        {.center = {0.3f, z > 2 ? -0.7f : 0.9f, z},
         .radius = 0.6f,
         .material = scene.materials.add({.name = "", .albedo = {0.9f, 0.2f, 0.2f}, .roughness = 0.5f})});
  return scene;
}

struct Render {
  std::vector<float> radiance, depth;
};

Render render(Pane pane, std::vector<graph::Disable> disables = {}) {
  Stage stage("graphs/studio.json", kWidth, kHeight);
  stage.world.setScene(sceneWith(pane));
  auto white = std::make_shared<assets::ImageF>();
  white->width = 256;
  white->height = 128;
  white->channels = 4;
  white->texels.assign(std::size_t{256} * 128 * 4, 1.0f);
  stage.world.setEnvironment(white);
  stage.settings.disables = std::move(disables);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(1);
  return {stage.read("hdr"), stage.read("depth")};
}

}  // namespace

TEST_CASE(
    "glass in the studio: its share of its own light and the rest of what is behind it, whose depth stays") {
  const CleanScope clean;
  const Render behind = render(Pane::none), glass = render(Pane::glass), solid = render(Pane::solid);
  CHECK(glass.depth == behind.depth);
  double worst = 0;
  int tinted = 0, untouched = 0;
  for (std::size_t i = 0; i < std::size_t{kWidth} * kHeight; ++i) {
    // What the pane would hide is seen through it; what stands before it and beside it is as it was.
    const bool hidden = solid.depth[i] > behind.depth[i];
    for (std::size_t c = 0; c < 3; ++c) {
      const double own = double(solid.radiance[4 * i + c]), far = double(behind.radiance[4 * i + c]);
      const double share = hidden ? double(kAlpha) : 0.0;
      worst =
          std::max(worst, std::abs(double(glass.radiance[4 * i + c]) - (share * own + (1 - share) * far)));
    }
    (hidden ? tinted : untouched) += 1;
  }
  MESSAGE("worst ", worst, " in ", tinted, " pixels of glass and ", untouched, " others");
  CHECK(tinted > 2000);
  CHECK(untouched > 2000);
  CHECK(worst < 1.5e-3);  // halves, about 1

  // Without the pass there is no glass.
  CHECK(render(Pane::glass, {std::string("lit.transparent")}).radiance == behind.radiance);
}
