// Draw lists of a graph's own: the picture of one is that of a scene which has only the things in it; and what is drawn last in
// each order, each pixel looked up by hand.
#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

#include "tests/runtime/stage.h"

namespace draw_list_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

constexpr std::uint32_t kListWidth = 64, kListHeight = 48;
constexpr float kListViewHeight = 8;  // of the graph's camera

struct Thing {
  bool sphere;
  glm::vec3 at;
  std::size_t material;  // of kListMaterials
  std::vector<std::string> names, tags;
  std::uint8_t lists = scene::maskOf(scene::DrawList::opaque);
};
struct ListMaterial {
  const char* name;
  glm::vec3 albedo;
};
constexpr ListMaterial kListMaterials[] = {
    {"dark red", {0.5f, 0, 0}}, {"green", {0, 1, 0}}, {"red glass", {1, 0.2f, 0.2f}}, {"", {0, 0, 1}}};
constexpr float kHalf = 1.4f;  // of a pane

std::vector<Thing> thingsOf() {
  const std::uint8_t transparent = scene::maskOf(scene::DrawList::transparent);
  return {{false, {-1, 0.5f, -2}, 0, {"left pane", "house"}, {"marked"}},
          {false, {0, 0, -1}, 1, {"middle", "house"}, {"other", "marked"}},
          {false, {0.5f, 0, 0}, 2, {"glass"}, {}, transparent},
          {false, {1, -0.5f, 1}, 0, {"leftover"}, {}},
          {false, {-0.5f, -1, 2}, 3, {}, {}},
          {true, {-2, -1, 0.5f}, 0, {"left ball"}, {}},
          {true, {2, 1.5f, 0.5f}, 1, {}, {"marked"}},
          {true, {2, 1.5f, 3}, 2, {"nowhere"}, {"marked"}, 0}};
}

scene::Scene sceneWith(const std::vector<Thing>& things) {
  scene::Scene scene;
  scene.cameras.add({.name = "front"});
  scene::Mesh mesh{.name = "pane", .vertexCount = 4, .indexCount = 6};
  auto data = std::make_shared<scene::MeshData>();
  for (const glm::vec2 corner : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
    data->vertices.push_back({.position = {corner * kHalf, 0}});
    mesh.bounds.add({corner * kHalf, 0});
  }
  data->indices = {0, 1, 2, 0, 2, 3};
  const scene::MeshId pane = scene.meshes.add(mesh);
  scene.meshData = data;
  for (const ListMaterial& material : kListMaterials)
    scene.materials.add({.name = material.name, .albedo = material.albedo});
  for (const Thing& thing : things) {
    const scene::LabelId label = thing.names.empty() && thing.tags.empty()
                                     ? scene::LabelId{}
                                     : scene.labels.add({.names = thing.names, .tags = thing.tags});
    const scene::MaterialId material = scene.materials.idOf(thing.material);
    if (thing.sphere)
      scene.spheres.add(
          {.center = thing.at, .radius = 0.8f, .material = material, .label = label, .lists = thing.lists});
    else
      scene.meshInstances.add(
          {.node = scene.nodes.add({.name = "n", .parent = {}, .local = {.translation = thing.at}}),
           .mesh = pane,
           .material = material,
           .label = label,
           .lists = thing.lists});
  }
  return scene;
}

bool startsLeft(const std::string& name) {
  return name.starts_with("left");
}

bool isTagged(const Thing& thing) {
  return thing.lists != 0 && std::ranges::find(thing.tags, "marked") != thing.tags.end();
}

bool isRed(const Thing& thing) {
  return thing.lists != 0 && thing.material % 2 == 0;
}

bool isNamed(const Thing& thing) {
  return std::ranges::any_of(thing.names, startsLeft);
}

bool isBoth(const Thing& thing) {
  return isTagged(thing) && thing.material == 0;
}

}  // namespace

TEST_CASE("a list of the graph's own shows what a scene shows that has only the things in it") {
  context();
  const CleanScope scope;
  const struct {
    const char* texture;
    bool (*holds)(const Thing&);
  } kLists[] = {
      {"tagged_seen", isTagged}, {"named_seen", isNamed}, {"red_seen", isRed}, {"both_seen", isBoth}};
  Stage stage("tests/imports/graphs/draw_list.json", kListWidth, kListHeight);
  stage.world.setScene(sceneWith(thingsOf()));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  const std::vector<float> all = stage.read("everything_seen");
  for (const auto& [texture, holds] : kLists) {
    CAPTURE(texture);
    std::vector<Thing> some = thingsOf();
    std::erase_if(some, [&](const Thing& thing) { return !holds(thing); });
    REQUIRE(!some.empty());
    Stage alone("tests/imports/graphs/draw_list.json", kListWidth, kListHeight);
    alone.world.setScene(sceneWith(some));
    REQUIRE_MESSAGE(alone.load(), alone.diagnostics.text());
    alone.run(0);
    CHECK(stage.read(texture) == alone.read("everything_seen"));
    CHECK(stage.read(texture) != all);
  }
}

TEST_CASE("a pass that runs on change follows what enters and leaves its list, and rests otherwise") {
  context();
  const CleanScope scope;
  Stage stage("tests/imports/graphs/draw_list.json", kListWidth, kListHeight);
  std::vector<Thing> things = thingsOf();
  stage.world.setScene(sceneWith(things));
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run(0);
  const std::vector<float> before = stage.read("tagged_seen");
  stage.run(1);
  CHECK_FALSE(stage.ran("tagged_meshes"));
  things[4].tags = {"marked"};
  stage.world.setScene(sceneWith(things));
  stage.run(2);
  CHECK(stage.ran("tagged_meshes"));
  CHECK(stage.read("tagged_seen") != before);
  things[4].tags = {};
  stage.world.setScene(sceneWith(things));
  stage.run(3);
  CHECK(stage.read("tagged_seen") == before);
}

TEST_CASE("what a list draws last is the nearest, the farthest, or what has the last material") {
  context();
  const CleanScope scope;
  Stage stage("tests/imports/graphs/draw_list.json", kListWidth, kListHeight);
  const std::vector<Thing> things = thingsOf();
  stage.world.setScene(sceneWith(things));
  const struct {
    const char* order;
    std::function<float(const Thing&)> rank;  // the greatest is seen; the later one of equals
  } kOrders[] = {{"back_to_front", [](const Thing& thing) { return thing.at.z; }},
                 {"front_to_back", [](const Thing& thing) { return -thing.at.z; }},
                 {"by_material", [](const Thing& thing) { return static_cast<float>(thing.material); }}};
  for (const auto& [order, rank] : kOrders) {
    CAPTURE(order);
    stage.settings.sets = {{"order", order}};
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    stage.run(0);
    const std::vector<float> seen = stage.read("last");
    int wrong = 0;
    for (std::uint32_t y = 0; y < kListHeight; ++y)
      for (std::uint32_t x = 0; x < kListWidth; ++x) {
        const float pixel = kListViewHeight / kListHeight;
        const glm::vec2 point{(static_cast<float>(x) + 0.5f - kListWidth / 2.0f) * pixel,
                              (static_cast<float>(y) + 0.5f - kListHeight / 2.0f) * pixel};
        const Thing* last = nullptr;
        for (const Thing& thing : things) {
          const glm::vec2 away = glm::abs(point - glm::vec2(thing.at));
          if (!thing.sphere && away.x < kHalf && away.y < kHalf && (!last || rank(thing) >= rank(*last)))
            last = &thing;
        }
        const glm::vec4 expected = last ? glm::vec4(kListMaterials[last->material].albedo, 1) : glm::vec4(0);
        const float* texel = &seen[(y * kListWidth + x) * 4];
        wrong += glm::vec4(texel[0], texel[1], texel[2], texel[3]) != expected;
      }
    CHECK(wrong == 0);
  }
}

}  // namespace draw_list_test
