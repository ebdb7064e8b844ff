// Meshes of a draw list, drawn by one command: which pixel shows which mesh, against each pixel looked up by hand.
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "tests/runtime/stage.h"

namespace mesh_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

constexpr std::uint32_t kWidth = 64, kHeight = 48;
constexpr float kViewHeight = 8;  // of the graph's camera

struct Shape {
  std::vector<glm::vec2> corners;  // convex, counter-clockwise
};
struct Placed {
  int shape;
  glm::vec3 at;
  float turn, scale;  // about z, radians
  glm::vec3 albedo;
  std::uint8_t lists = scene::maskOf(scene::DrawList::opaque);
};

const std::vector<Shape> kShapes = {{{{-1, -1}, {1, -1}, {0, 1}}},
                                    {{{-1, -0.5f}, {1, -0.5f}, {1, 0.5f}, {-1, 0.5f}}}};
// Overlapping at several heights; the fourth is far outside, the fifth in another list.
const std::vector<Placed> kPlaced = {
    {0, {-2, 1, 0}, 0.3f, 1.5f, {1, 0, 0}},
    {1, {-1.5f, 0.7f, 1}, 1.1f, 1.2f, {0, 1, 0}},
    {0, {1.7f, -1.1f, -1}, -0.7f, 2.0f, {0, 0, 1}},
    {1, {60, 0, 0}, 0, 1, {1, 1, 0}},
    {0, {0, 0, 3}, 0, 1, {1, 1, 1}, scene::maskOf(scene::DrawList::shadow_casters)},
    {1, {2.2f, -0.4f, 2}, 0.2f, 1.0f, {0, 1, 1}}};

scene::Scene sceneOf(float velocity = 0) {
  scene::Scene scene;
  scene.cameras.add({.name = "front"});
  auto data = std::make_shared<scene::MeshData>();
  std::vector<scene::MeshId> meshes;
  for (const Shape& shape : kShapes) {
    scene::Mesh mesh{.name = "shape",
                     .firstVertex = static_cast<std::uint32_t>(data->vertices.size()),
                     .vertexCount = static_cast<std::uint32_t>(shape.corners.size()),
                     .firstIndex = static_cast<std::uint32_t>(data->indices.size())};
    for (const glm::vec2 corner : shape.corners) {
      data->vertices.push_back({.position = {corner, 0}});
      mesh.bounds.add({corner, 0});
    }
    for (std::uint32_t i = 2; i < shape.corners.size(); ++i)
      for (const std::uint32_t index : {0u, i - 1, i}) data->indices.push_back(index);
    mesh.indexCount = static_cast<std::uint32_t>(data->indices.size()) - mesh.firstIndex;
    meshes.push_back(scene.meshes.add(mesh));
  }
  scene.meshData = data;
  for (const Placed& placed : kPlaced) {
    const auto node = scene.nodes.add({.name = "n",
                                       .parent = {},
                                       .local = {.translation = placed.at,
                                                 .rotation = glm::angleAxis(placed.turn, glm::vec3(0, 0, 1)),
                                                 .scale = glm::vec3(placed.scale)},
                                       .velocity = {velocity, 0, 0}});
    scene.meshInstances.add({.node = node,
                             .mesh = meshes[static_cast<std::size_t>(placed.shape)],
                             .material = scene.materials.add({.name = "", .albedo = placed.albedo}),
                             .lists = placed.lists});
  }
  return scene;
}

bool isInside(const Placed& placed, glm::vec2 point) {
  const float c = std::cos(placed.turn), s = std::sin(placed.turn);
  const glm::vec2 away = (point - glm::vec2(placed.at)) / placed.scale;
  const glm::vec2 local{c * away.x + s * away.y, c * away.y - s * away.x};
  const auto& corners = kShapes[static_cast<std::size_t>(placed.shape)].corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::vec2 a = corners[i], edge = corners[(i + 1) % corners.size()] - a, to = local - a;
    if (edge.x * to.y - edge.y * to.x < 0) return false;
  }
  return true;
}

// What stands highest over a point.
glm::vec3 topAt(glm::vec2 point, float moved) {
  float height = -100;
  glm::vec3 albedo(0);
  for (Placed placed : kPlaced) {
    placed.at.x += moved;
    if ((placed.lists & scene::maskOf(scene::DrawList::opaque)) == 0 || placed.at.z < height) continue;
    if (!isInside(placed, point)) continue;
    height = placed.at.z;
    albedo = placed.albedo;
  }
  return albedo;
}

int countWrong(const std::vector<float>& picture, float moved) {
  int wrong = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const float pixel = kViewHeight / kHeight;
      const glm::vec2 point{(static_cast<float>(x) + 0.5f - kWidth / 2.0f) * pixel,
                            (static_cast<float>(y) + 0.5f - kHeight / 2.0f) * pixel};
      const float* seen = &picture[(y * kWidth + x) * 4];
      wrong += glm::vec3(seen[0], seen[1], seen[2]) != topAt(point, moved);
    }
  return wrong;
}

struct Drawn {
  explicit Drawn(scene::Scene scene, const std::string& graph = "mesh")
      : stage("tests/imports/graphs/" + graph + ".json", kWidth, kHeight) {
    stage.world.setScene(std::move(scene));
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  }
  Stage stage;
};

}  // namespace

TEST_CASE("each pixel shows the highest mesh over it, and only those of the list") {
  context();
  const CleanScope scope;
  Drawn drawn(sceneOf());
  drawn.stage.run(0);
  CHECK(countWrong(drawn.stage.read("seen"), 0) == 0);
  drawn.stage.run(1);
  CHECK_FALSE(drawn.stage.ran("draw"));  // nothing moved
}

TEST_CASE("a pass that runs on change follows meshes that move; another scene replaces them") {
  context();
  const CleanScope scope;
  Drawn drawn(sceneOf(6));
  for (const std::uint32_t frame : {0u, 7u, 20u}) {
    drawn.stage.run(frame);
    CHECK(drawn.stage.ran("draw"));
    CHECK(countWrong(drawn.stage.read("seen"), 6 * static_cast<float>(frame) / 60) <=
          2);  // rounding at edges
  }
  drawn.stage.world.setScene(sceneOf());
  drawn.stage.run(21);
  CHECK(countWrong(drawn.stage.read("seen"), 0) == 0);
  scene::Scene empty;
  empty.cameras.add({.name = "front"});
  drawn.stage.world.setScene(std::move(empty));
  drawn.stage.run(22);
  for (const float value : drawn.stage.read("seen")) REQUIRE(value == 0);
}

TEST_CASE("boxes are drawn around what is in any list, dashed where a mesh is in front") {
  context();
  const CleanScope scope;
  constexpr float kPixel = kViewHeight / kHeight;
  scene::Scene scene = sceneOf();
  scene.spheres.add({.center = {-3, -2.5f, 0}, .radius = 0.9f, .material = scene.materials.idOf(0)});
  std::vector<scene::Box> boxes{{{-3.9f, -3.4f, -0.9f}, {-2.1f, -1.6f, 0.9f}}};
  for (const Placed& placed : kPlaced) {
    const auto turned = glm::rotate(glm::mat4(1), placed.turn, glm::vec3(0, 0, 1));
    scene::Box mesh, &box = boxes.emplace_back();
    for (const glm::vec2 corner : kShapes[static_cast<std::size_t>(placed.shape)].corners)
      mesh.add({corner, 0});
    for (const glm::vec2 corner :
         {glm::vec2(mesh.low), glm::vec2(mesh.high), {mesh.low.x, mesh.high.y}, {mesh.high.x, mesh.low.y}})
      box.add(placed.at + placed.scale * glm::vec3(turned * glm::vec4(corner, 0, 1)));
  }
  Drawn drawn(std::move(scene), "boxes");
  drawn.stage.run(0);
  const std::vector<float> picture = drawn.stage.read("ldr");
  const auto colored = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < int{kWidth} && y < int{kHeight} &&
           picture[static_cast<std::size_t>((y * int{kWidth} + x) * 4 + 3)] > 0;
  };
  // From a point to the outline of a box that is seen from above.
  const auto distance = [](const scene::Box& box, glm::vec2 point) {
    const glm::vec2 outside = glm::max(glm::vec2(box.low) - point, point - glm::vec2(box.high));
    return std::abs(std::min(std::max(outside.x, outside.y), 0.0f) + glm::length(glm::max(outside, 0.0f)));
  };
  int stray = 0, missing = 0, gaps = 0;
  for (int y = 0; y < int{kHeight}; ++y)
    for (int x = 0; x < int{kWidth}; ++x) {
      const glm::vec2 point = (glm::vec2(x, y) + 0.5f - glm::vec2(kWidth, kHeight) / 2.0f) * kPixel;
      float nearest = 100;
      for (const scene::Box& box : boxes) nearest = std::min(nearest, distance(box, point));
      if (colored(x, y)) stray += nearest > kPixel;
      bool around = false;
      for (int i = 0; i < 9; ++i) around = around || colored(x + i % 3 - 1, y + i / 3 - 1);
      for (const scene::Box& box : boxes) {
        if (distance(box, point) > 0.4f * kPixel) continue;
        const bool hidden = std::ranges::any_of(kPlaced, [&](const Placed& each) {
          return (each.lists & scene::maskOf(scene::DrawList::opaque)) != 0 && each.at.z > box.high.z &&
                 isInside(each, point);
        });
        gaps += hidden && !colored(x, y);
        missing += !hidden && !around;
      }
    }
  CHECK(stray == 0);
  CHECK(missing == 0);
  CHECK(gaps > 0);
}

}  // namespace mesh_test
