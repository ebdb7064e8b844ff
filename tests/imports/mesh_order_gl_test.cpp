// Meshes that blend are drawn from far to near, whatever order the scene has them in: each pixel against the panes over it, laid on
// one another by hand.
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <vector>

#include "tests/runtime/stage.h"

namespace mesh_order_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

constexpr std::uint32_t kOrderWidth = 64, kOrderHeight = 48;
constexpr float kOrderViewHeight = 8;  // of the graph's camera

struct Pane {
  std::uint32_t mesh;  // of kHalves
  glm::vec3 at;
  glm::vec3 albedo;
  float alpha;
};
constexpr glm::vec2 kHalves[] = {{1.4f, 1.4f}, {2.4f, 0.6f}};  // no edge goes through the middle of a pixel
// Heights between -3 and 3; panes of both meshes in turns, so that a command holds few of them.
constexpr std::array<Pane, 5> kPanes = {{{0, {-1, 0.5f, -2}, {1, 0, 0}, 0.5f},
                                         {1, {0, 0, -1}, {0, 1, 0}, 0.25f},
                                         {0, {0.5f, 0, 0}, {0, 0, 1}, 0.5f},
                                         {1, {1, -0.5f, 1}, {1, 1, 0}, 0.75f},
                                         {0, {-0.5f, -1, 2}, {1, 1, 1}, 0.5f}}};

scene::Scene sceneOf(const std::vector<std::size_t>& order) {
  scene::Scene scene;
  scene.cameras.add({.name = "front"});
  auto data = std::make_shared<scene::MeshData>();
  std::vector<scene::MeshId> meshes;
  for (const glm::vec2 half : kHalves) {
    scene::Mesh mesh{.name = "pane",
                     .firstVertex = static_cast<std::uint32_t>(data->vertices.size()),
                     .vertexCount = 4,
                     .firstIndex = static_cast<std::uint32_t>(data->indices.size()),
                     .indexCount = 6};
    for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
      data->vertices.push_back({.position = {corner * half, 0}});
      mesh.bounds.add({corner * half, 0});
    }
    for (const std::uint32_t index : {0u, 1u, 2u, 0u, 2u, 3u}) data->indices.push_back(index);
    meshes.push_back(scene.meshes.add(mesh));
  }
  scene.meshData = data;
  for (const std::size_t i : order) {
    const Pane& pane = kPanes[i];
    scene.meshInstances.add(
        {.node = scene.nodes.add({.name = "n", .parent = {}, .local = {.translation = pane.at}}),
         .mesh = meshes[pane.mesh],
         .material =
             scene.materials.add({.name = "", .albedo = pane.albedo, .alpha = pane.alpha, .blend = true}),
         .lists = scene::maskOf(scene::DrawList::transparent)});
  }
  return scene;
}

// From below, left and right are exchanged.
glm::vec4 colorAt(std::uint32_t x, std::uint32_t y, bool below) {
  const float pixel = kOrderViewHeight / kOrderHeight;
  glm::vec2 point{(static_cast<float>(x) + 0.5f - kOrderWidth / 2.0f) * pixel,
                  (static_cast<float>(y) + 0.5f - kOrderHeight / 2.0f) * pixel};
  if (below) point.x = -point.x;
  glm::vec4 color(0);
  for (std::size_t i = 0; i < kPanes.size(); ++i) {
    const Pane& pane = kPanes[below ? kPanes.size() - 1 - i : i];  // farthest first
    const glm::vec2 away = glm::abs(point - glm::vec2(pane.at));
    if (away.x < kHalves[pane.mesh].x && away.y < kHalves[pane.mesh].y)
      color = glm::vec4(pane.albedo, 1) * pane.alpha + color * (1 - pane.alpha);
  }
  return color;
}

int countWrong(const std::vector<float>& picture, bool below) {
  int wrong = 0;
  for (std::uint32_t y = 0; y < kOrderHeight; ++y)
    for (std::uint32_t x = 0; x < kOrderWidth; ++x) {
      const float* seen = &picture[(y * kOrderWidth + x) * 4];
      wrong += glm::vec4(seen[0], seen[1], seen[2], seen[3]) != colorAt(x, y, below);
    }
  return wrong;
}

}  // namespace

TEST_CASE("panes in every order of the scene give the same, right picture, from above and from below") {
  context();
  const CleanScope scope;
  Stage stage("tests/imports/graphs/panes.json", kOrderWidth, kOrderHeight);
  std::vector<std::size_t> order = {0, 1, 2, 3, 4};
  stage.world.setScene(sceneOf(order));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  std::uint32_t frame = 0;
  do {
    stage.world.setScene(sceneOf(order));
    stage.run(frame++);
    REQUIRE(countWrong(stage.read("seen"), false) == 0);
  } while (std::ranges::next_permutation(order).found);
  CHECK(frame == 120);
  stage.settings.sets = {{"side", "-1"}};
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  for (int turn = 0; turn < 5; ++turn) {
    stage.world.setScene(sceneOf(order));
    stage.run(frame++);
    CHECK(countWrong(stage.read("seen"), true) == 0);
    std::ranges::rotate(order, order.begin() + 2);
  }
}

TEST_CASE("a frame of many moving meshes is the same picture on one thread and on two") {
  context();
  const CleanScope scope;
  std::vector<std::uint8_t> pictures[2];
  for (int threads = 1; threads <= 2; ++threads) {
    Stage stage("tests/imports/graphs/mesh.json", kOrderWidth, kOrderHeight, "scenes/crowd.json");
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    tbb::task_arena(threads).execute([&] {
      for (const std::uint32_t frame : {0u, 30u, 31u}) stage.run(frame);
    });
    const std::vector<float> seen = stage.read("seen");
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(seen.data());
    pictures[threads - 1].assign(bytes, bytes + seen.size() * sizeof(float));
    CHECK(std::ranges::any_of(seen, [](float value) { return value > 0; }));
  }
  CHECK(pictures[0] == pictures[1]);
}

}  // namespace mesh_order_test
