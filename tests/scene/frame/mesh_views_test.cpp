// What views see of a frame's meshes, against culling and sorting one view after another.
#include "engine/scene/frame/mesh_views.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstring>
#include <random>

#include "engine/scene/camera.h"
#include "engine/scene/frame/mesh_frame.h"

using namespace weft::scene;

namespace {

// Boxes of three meshes, some of which move; half of them are seen through.
Scene scatteredMeshes(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-1, 1);
  Scene scene;
  const MaterialId material = scene.materials.add({});
  std::vector<MeshId> meshes;
  for (std::uint32_t i = 0; i < 3; ++i)
    meshes.push_back(scene.meshes.add(
        {"m", 10 * i, 10, 30 * i, 30, {glm::vec3(-1), glm::vec3(1 + static_cast<float>(i))}, false}));
  for (int i = 0; i < count; ++i) {
    Node node;
    node.local.translation = glm::vec3(number(random), number(random), number(random)) * 60.0f;
    if (random() % 2 == 0) node.velocity = glm::vec3(number(random), number(random), number(random)) * 5.0f;
    MeshInstance instance;
    instance.node = scene.nodes.add(node);
    instance.mesh = meshes[random() % meshes.size()];
    instance.material = material;
    instance.lists = maskOf(random() % 2 == 0 ? DrawList::transparent : DrawList::opaque);
    scene.meshInstances.add(instance);
  }
  return scene;
}

ViewData viewFrom(glm::dvec3 position, glm::dvec3 target) {
  const CameraPose pose{.position = position, .target = target};
  return makeView({.pose = pose, .previousPose = pose, .viewport = {160, 90}});
}

void lookFrom(MeshView& mesh, DrawList list, const ViewData& view, MeshOrder order) {
  mesh.look(list, view.view, view.view_projection, order);
}

template <class T>
bool areSame(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

// Farthest center first, in double; equal depths by row.
std::vector<std::uint32_t> sortedByHand(std::vector<std::uint32_t> rows, std::span<const Box> boxes,
                                        const ViewData& view) {
  const auto depth = [&](std::uint32_t row) {
    const glm::dvec3 center = (glm::dvec3(boxes[row].low) + glm::dvec3(boxes[row].high)) * 0.5;
    return -(glm::dmat4(view.view) * glm::dvec4(center, 1)).z;
  };
  std::ranges::stable_sort(rows, [&](std::uint32_t a, std::uint32_t b) { return depth(a) > depth(b); });
  return rows;
}

}  // namespace

TEST_CASE("all views at once see what each would see alone, on one thread and on two, byte for byte") {
  const Scene scene = scatteredMeshes(30000, 3);
  MeshFrame frame;
  tbb::task_arena single(1), pair(2);
  std::vector<MeshView> seen(5), seenByTwo(5);
  for (int i = 0; i < 4; ++i) {
    frame.update(scene, 1, 0.5 * i, 0.5 * (i - 1));
    const ViewData views[] = {viewFrom({0, 0, 80}, {0, 0, 0}), viewFrom({0, 90, 1}, {0, 0, 0}),
                              viewFrom({0, 0, 0}, {1, 0.2 * i, 0})};
    for (std::vector<MeshView>* mine : {&seen, &seenByTwo}) {
      for (std::size_t v = 0; v < 3; ++v)
        lookFrom((*mine)[v], DrawList::opaque, views[v], MeshOrder::by_mesh);
      for (std::size_t v = 0; v < 2; ++v)
        lookFrom((*mine)[3 + v], DrawList::transparent, views[v], MeshOrder::back_to_front);
    }
    const auto pointers = [](std::vector<MeshView>& from) {
      std::vector<MeshView*> all;
      for (MeshView& view : from) all.push_back(&view);
      return all;
    };
    single.execute([&] { MeshView::update(scene, frame, pointers(seen)); });
    pair.execute([&] { MeshView::update(scene, frame, pointers(seenByTwo)); });
    for (std::size_t v = 0; v < seen.size(); ++v) {
      CHECK(areSame(seen[v].visible(), seenByTwo[v].visible()));
      CHECK(areSame(seen[v].commands(), seenByTwo[v].commands()));
      const DrawList list = v < 3 ? DrawList::opaque : DrawList::transparent;
      const ViewData& view = views[v % 3];
      const std::span<const Box> boxes = frame.bounds(list);
      std::vector<std::uint32_t> wanted;
      for (std::uint32_t row = 0; row < boxes.size(); ++row)
        if (reaches(frustumOf(view.view_projection), boxes[row])) wanted.push_back(row);
      CHECK(wanted.size() > 100);
      CHECK(wanted.size() < frame.rows(list).size());
      if (v >= 3) wanted = sortedByHand(wanted, frame.bounds(list), view);
      std::size_t misplaced = 0;  // float depths may order neighbors otherwise than double ones
      REQUIRE(seen[v].visible().size() == wanted.size());
      for (std::size_t k = 0; k < wanted.size(); ++k) misplaced += seen[v].visible()[k] != wanted[k];
      if (v < 3)
        CHECK(misplaced == 0);
      else
        CHECK(misplaced < wanted.size() / 100);
      std::vector<DrawCommand> commands;
      makeCommands(scene, frame.rows(list),
                   std::vector<std::uint32_t>(seen[v].visible().begin(), seen[v].visible().end()), commands);
      CHECK(areSame(std::span<const DrawCommand>(commands), seen[v].commands()));
    }
    CHECK(seen[0].commands().size() == 3);    // one per mesh
    CHECK(seen[3].commands().size() > 1000);  // they change from instance to instance
  }
}

TEST_CASE("a view is made anew when it, its order, or the rows of its list are others, and only then") {
  Scene scene = scatteredMeshes(500, 9);
  MeshFrame frame;
  MeshView still;
  MeshView* const all[] = {&still};
  const ViewData front = viewFrom({0, 0, 80}, {0, 0, 0}), top = viewFrom({0, 90, 1}, {0, 0, 0});
  frame.update(scene, 1, 0, 0);
  lookFrom(still, DrawList::opaque, front, MeshOrder::by_mesh);
  CHECK(still.generation() == 0);
  std::uint64_t before = 0;
  const auto isAnother = [&] {
    MeshView::update(scene, frame, all);
    return std::exchange(before, still.generation()) != still.generation();
  };
  CHECK(isAnother());
  CHECK_FALSE(isAnother());
  lookFrom(still, DrawList::opaque, top, MeshOrder::by_mesh);
  CHECK(isAnother());
  lookFrom(still, DrawList::opaque, top, MeshOrder::back_to_front);
  CHECK(isAnother());
  CHECK_FALSE(isAnother());
  frame.update(scene, 1, 1, 0);  // meshes move
  CHECK(isAnother());
  lookFrom(still, DrawList::shadow_casters, top, MeshOrder::back_to_front);  // nobody is in it
  CHECK(isAnother());
  CHECK(still.visible().empty());
  CHECK(still.commands().empty());
  frame.update(scene, 1, 2, 1);
  CHECK_FALSE(isAnother());
}

TEST_CASE("meshes are drawn from far to near, those at one depth in the order of their rows") {
  Scene scene;
  const MaterialId material = scene.materials.add({});
  const MeshId mesh = scene.meshes.add({"m", 0, 3, 0, 3, {glm::vec3(-1), glm::vec3(1)}, false});
  const float depths[] = {0, -4, 0, 3, -4, 0};
  for (int i = 0; i < 6; ++i) {
    Node node;
    node.local.translation = {static_cast<float>(i), 0, depths[i]};
    MeshInstance instance;
    instance.node = scene.nodes.add(node);
    instance.mesh = mesh;
    instance.material = material;
    instance.lists = maskOf(DrawList::transparent);
    scene.meshInstances.add(instance);
  }
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  MeshView view;
  MeshView* const all[] = {&view};
  lookFrom(view, DrawList::transparent, viewFrom({0, 0, 30}, {0, 0, 0}), MeshOrder::back_to_front);
  MeshView::update(scene, frame, all);
  CHECK(std::ranges::equal(view.visible(), std::vector<std::uint32_t>{1, 4, 0, 2, 5, 3}));
  CHECK(view.commands().size() == 1);  // one mesh: one command, whatever the order
  lookFrom(view, DrawList::transparent, viewFrom({0, 0, -30}, {0, 0, 0}), MeshOrder::back_to_front);
  MeshView::update(scene, frame, all);
  CHECK(std::ranges::equal(view.visible(), std::vector<std::uint32_t>{3, 0, 2, 5, 1, 4}));
}
