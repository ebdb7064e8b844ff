// What of meshes depends on time, against walks by definition: matrices up the parents, vertices through their joints.
#include "engine/scene/frame/mesh_frame.h"

#include <doctest/doctest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <cstring>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <random>
#include <utility>

#include "engine/assets/models/model_file.h"
#include "engine/scene/files/scene_file.h"
#include "engine/scene/frame/transforms.h"
#include "engine/scene/models/add_model.h"

using namespace weft;
using namespace weft::scene;

namespace {

const std::string kSource = WEFT_SOURCE_DIR "/";

// A tree of nodes, some of which turn or move, with a box at each.
Scene randomTree(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> number(-1, 1);
  Scene scene;
  const MaterialId material = scene.materials.add({});
  const MeshId meshes[2] = {scene.meshes.add({"a", 0, 3, 0, 3, {glm::vec3(-1), glm::vec3(1)}, false}),
                            scene.meshes.add({"b", 0, 3, 0, 3, {glm::vec3(0), glm::vec3(2)}, false})};
  std::vector<NodeId> ids;
  for (int i = 0; i < count; ++i) {
    Node node;
    if (i > 0 && number(random) < 0.7f) node.parent = ids[random() % ids.size()];
    node.local.translation = {number(random), number(random), number(random)};
    node.local.rotation =
        glm::normalize(glm::quat(number(random), number(random), number(random), number(random)));
    node.local.scale = {1 + number(random) / 2, 1 + number(random) / 2, -1 - number(random) / 2};
    for (int c = 0; i % 3 == 0 && c < 3; ++c)
      node.inner[c] += 0.4f * glm::vec3(number(random), number(random), number(random));
    if (random() % 4 == 0) node.spin = {number(random), number(random), number(random)};
    if (random() % 4 == 0) node.velocity = {number(random), number(random), number(random)};
    ids.push_back(scene.nodes.add(node));
    MeshInstance instance;
    instance.node = ids.back();
    instance.mesh = meshes[random() % 2];
    instance.material = material;
    scene.meshInstances.add(instance);
  }
  return scene;
}

// A node's place in the world, by its definition, in double.
glm::dmat4 worldOf(const Scene& scene, NodeId id, double time) {
  const Node* node = scene.nodes.find(id);
  if (!node) return glm::dmat4(1);
  const double speed = glm::length(glm::dvec3(node->spin));
  glm::dmat4 local =
      glm::translate(glm::dmat4(1), glm::dvec3(node->local.translation) + glm::dvec3(node->velocity) * time);
  if (speed > 0) local = glm::rotate(local, speed * time, glm::dvec3(node->spin) / speed);
  local = local * glm::mat4_cast(glm::dquat(node->local.rotation));
  return worldOf(scene, node->parent, time) * glm::scale(local, glm::dvec3(node->local.scale)) *
         glm::dmat4(glm::dmat3(node->inner));
}

double difference(const glm::mat4& a, const glm::dmat4& b) {
  double worst = 0;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) worst = std::max(worst, std::abs(static_cast<double>(a[c][r]) - b[c][r]));
  return worst;
}

bool anythingMovesAbove(const Scene& scene, NodeId id) {
  for (const Node* node = scene.nodes.find(id); node; node = scene.nodes.find(node->parent))
    if (node->spin != glm::vec3(0) || node->velocity != glm::vec3(0)) return true;
  return false;
}

}  // namespace

TEST_CASE("every row's matrix is the product of its node's and all above, now and before") {
  const Scene scene = randomTree(200, 7);
  MeshFrame frame;
  double before = 0.25;
  for (const double time : {0.5, 0.75, 0.8, 3.0, 0.1, 100.0}) {
    frame.update(scene, 1, time, before);
    const std::span<const MeshRow> rows = frame.rows(DrawList::opaque);
    REQUIRE(rows.size() == 200);
    std::uint32_t mesh = 0;
    std::size_t row = 0;
    for (const std::uint32_t which : {0u, 1u})
      for (std::size_t i = 0; i < 200; ++i) {
        const MeshInstance& instance = scene.meshInstances.rows()[i];
        if (scene.meshes.find(instance.mesh) != &scene.meshes.rows()[which]) continue;
        // Rows of one mesh stand together, in table order.
        REQUIRE(rows[row].mesh == which);
        mesh = std::max(mesh, which);
        const glm::dmat4 now = worldOf(scene, instance.node, time);
        const double size = 1 + std::abs(now[3][0]) + std::abs(now[3][1]) + std::abs(now[3][2]);
        REQUIRE(difference(rows[row].transform, now) < 2e-4 * size);
        REQUIRE(difference(rows[row].previous_transform, worldOf(scene, instance.node, before)) <
                2e-4 * size);
        ++row;
      }
    CHECK(mesh == 1);
    before = time;
  }
}

TEST_CASE("a frame places the nodes that move, once, and nothing when nothing is asked") {
  const Scene scene = randomTree(300, 3);
  std::size_t moving = 0;
  for (std::size_t i = 0; i < 300; ++i) moving += anythingMovesAbove(scene, scene.nodes.idOf(i)) ? 1 : 0;
  REQUIRE(moving > 50);
  REQUIRE(moving < 280);
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  CHECK(frame.nodeUpdates() == 300);
  std::uint64_t count = frame.nodeUpdates();
  const auto placed = [&](double time, double before) {
    frame.update(scene, 1, time, before);
    const std::uint64_t earlier = std::exchange(count, frame.nodeUpdates());
    return count - earlier;
  };
  CHECK(placed(0, 0) == 0);
  CHECK(placed(1, 0) == moving);  // the time before is the frame before
  CHECK(placed(2, 1) == moving);
  CHECK(placed(2, 1) == 0);
  CHECK(placed(9, 8) == 2 * moving);
  const std::uint64_t generation = frame.generation(DrawList::opaque);
  frame.update(scene, 1, 9, 8);
  CHECK(frame.generation(DrawList::opaque) == generation);
  frame.update(scene, 1, 10, 9);
  CHECK(frame.generation(DrawList::opaque) != generation);
  frame.update(scene, 2, 10, 9);
  CHECK(frame.nodeUpdates() - count == 300 + 2 * moving);
}

TEST_CASE("what does not move costs nothing and keeps its generation") {
  Scene scene = randomTree(50, 1);
  for (std::size_t i = 0; i < 50; ++i) {
    Node& node = scene.nodes.edit(scene.nodes.idOf(i));
    node.spin = node.velocity = glm::vec3(0);
  }
  MeshFrame frame;
  frame.update(scene, 1, 0, 0);
  const std::uint64_t generation = frame.generation(DrawList::opaque);
  const MeshRow* rows = frame.rows(DrawList::opaque).data();
  for (int i = 1; i < 10; ++i) frame.update(scene, 1, i, i - 1);
  CHECK(frame.nodeUpdates() == 50);
  CHECK(frame.generation(DrawList::opaque) == generation);
  CHECK(frame.rows(DrawList::shadow_casters).data() ==
        rows);  // lists of the same instances share their table
  CHECK(frame.rows(DrawList::transparent).empty());
  CHECK(frame.generation(DrawList::transparent) != 0);
}

TEST_CASE("a list that a graph chooses is added to those that there are, which stay as they were") {
  Scene scene = randomTree(50, 3);
  for (std::size_t i = 0; i < 50; ++i) {
    Node& node = scene.nodes.edit(scene.nodes.idOf(i));
    node.spin = node.velocity = glm::vec3(0);
  }
  const LabelId label = scene.labels.add({.names = {}, .tags = {"marked"}});
  for (const std::size_t row : {3, 7}) scene.meshInstances.edit(scene.meshInstances.idOf(row)).label = label;
  MeshFrame frame;
  frame.update(scene, 1, 1, 0);
  const std::uint64_t generation = frame.generation(DrawList::opaque);
  Selection marked;
  marked.tag = "marked";
  const auto list = static_cast<DrawList>(kDrawListCount);
  for (const std::uint64_t scenes : {1, 2}) {
    frame.update(scene, scenes, 1, 0, {&marked, 1});
    REQUIRE(frame.rows(list).size() == 2);
    CHECK(frame.generation(list) != 0);
    CHECK((frame.generation(DrawList::opaque) == generation) == (scenes == 1));
    int same = 0;
    for (const MeshRow& row : frame.rows(DrawList::opaque))
      same += row.transform == frame.rows(list)[0].transform && row.mesh == frame.rows(list)[0].mesh ? 1 : 0;
    CHECK(same == 1);
  }
}

TEST_CASE("boxes hold their meshes, and the scene's box everything") {
  Scene scene = randomTree(100, 5);
  Sphere sphere;
  sphere.center = {50, 0, 0};
  sphere.radius = 2;
  sphere.velocity = {1, 0, 0};
  scene.spheres.add(sphere);
  MeshFrame frame;
  for (const double time : {0.0, 2.0}) {
    frame.update(scene, 1, time, time);
    const std::span<const MeshRow> rows = frame.rows(DrawList::opaque);
    const std::span<const Box> boxes = frame.bounds(DrawList::opaque);
    const Box all = frame.sceneBounds();
    CHECK(all.high.x == doctest::Approx(52 + time));
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const Box& mesh = scene.meshes.rows()[rows[i].mesh].bounds;
      glm::vec3 low(1e30f), high(-1e30f);
      for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 p(rows[i].transform * glm::vec4(corner & 1 ? mesh.high.x : mesh.low.x,
                                                        corner & 2 ? mesh.high.y : mesh.low.y,
                                                        corner & 4 ? mesh.high.z : mesh.low.z, 1));
        low = glm::min(low, p);
        high = glm::max(high, p);
      }
      // The smallest box of the corners, within rounding.
      CHECK(glm::distance(low, boxes[i].low) < 1e-4f);
      CHECK(glm::distance(high, boxes[i].high) < 1e-4f);
      CHECK(glm::all(glm::lessThanEqual(all.low, boxes[i].low)));
      CHECK(glm::all(glm::greaterThanEqual(all.high, boxes[i].high)));
    }
  }
}

TEST_CASE("the fox walks: joints by their definition, every vertex in its box, the loop closes") {
  text::Diagnostics diagnostics;
  const auto scene = loadScene(kSource + "scenes/fox.json", diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  const Skin& skin = scene->skins.rows()[0];
  const Animation& walk = scene->animations.rows()[0];
  MeshFrame frame;
  double moved = 0;
  std::vector<glm::vec3> first;
  for (const double time : {0.0, 0.1, 0.35, 0.7, 5.0}) {
    const double before = time - 0.05;
    frame.update(*scene, 1, time, before);
    const std::span<const MeshRow> rows = frame.rows(DrawList::opaque);
    REQUIRE(rows.size() == 1);
    CHECK(rows[0].transform == glm::mat4(1));
    REQUIRE(frame.joints().size() == skin.joints.size());
    // Each joint: the nodes' transforms with the tracks' values, up the parents.
    for (const auto& [when, matrix] : {std::pair{time, &Joint::now}, std::pair{before, &Joint::previous}}) {
      std::vector<Transform> locals;
      for (const Node& node : scene->nodes.rows()) locals.push_back(node.local);
      for (std::size_t i = 0; i < walk.nodes.size(); ++i) {
        const assets::ModelTrack& track = walk.tracks->tracks[i];
        const glm::vec4 v = sampleTrack(track, animationTime(walk, when));
        Transform& local =
            locals[static_cast<std::size_t>(scene->nodes.find(walk.nodes[i]) - scene->nodes.rows().data())];
        if (track.path == assets::TrackPath::rotation) local.rotation = glm::quat(v.w, v.x, v.y, v.z);
        if (track.path == assets::TrackPath::translation) local.translation = v;
        if (track.path == assets::TrackPath::scale) local.scale = v;
      }
      for (std::size_t j = 0; j < skin.joints.size(); ++j) {
        glm::dmat4 world(skin.inverseBind[j]);
        for (const Node* node = scene->nodes.find(skin.joints[j]); node;
             node = scene->nodes.find(node->parent)) {
          const Transform& local = locals[static_cast<std::size_t>(node - scene->nodes.rows().data())];
          world = glm::translate(glm::dmat4(1), glm::dvec3(local.translation)) *
                  glm::mat4_cast(glm::dquat(local.rotation)) *
                  glm::scale(glm::dmat4(1), glm::dvec3(local.scale)) * world;
        }
        REQUIRE(difference(frame.joints()[j].*matrix, world) < 1e-4);
      }
    }
    const Box box = frame.bounds(DrawList::opaque)[0];
    const Mesh& mesh = scene->meshes.rows()[0];
    Box smallest;
    for (std::uint32_t v = mesh.firstVertex; v < mesh.firstVertex + mesh.vertexCount; ++v) {
      glm::vec3 p(0);
      for (std::size_t i = 0; i < 4; ++i)
        p += scene->meshData->skin[v].weights[i] *
             glm::vec3(frame.joints()[scene->meshData->skin[v].joints[i]].now *
                       glm::vec4(scene->meshData->vertices[v].position, 1));
      smallest.add(p);
      if (time == 0) first.push_back(p);
      if (time == 0.35)
        moved = std::max(moved, static_cast<double>(glm::distance(p, first[v - mesh.firstVertex])));
    }
    CHECK(glm::all(glm::lessThanEqual(box.low, smallest.low + 1e-5f)));
    CHECK(glm::all(glm::greaterThanEqual(box.high, smallest.high - 1e-5f)));
    CHECK(glm::length(box.high - box.low) < 2 * glm::length(smallest.high - smallest.low));
  }
  CHECK(moved > 0.1);  // of a fox of 1.5: its legs
  const std::vector<Joint> at(frame.joints().begin(), frame.joints().end());
  frame.update(*scene, 1, 5.0 + walk.tracks->duration, 4.95 + static_cast<double>(walk.tracks->duration));
  for (std::size_t i = 0; i < at.size(); ++i) {
    CHECK(difference(at[i].now, glm::dmat4(frame.joints()[i].now)) < 1e-3);
    CHECK(difference(at[i].previous, glm::dmat4(frame.joints()[i].previous)) < 1e-3);
  }
}

TEST_CASE("a hundred thousand moving instances") {
  text::Diagnostics diagnostics;
  const auto scene = loadScene(kSource + "scenes/crowd.json", diagnostics);
  REQUIRE_MESSAGE(scene, diagnostics.text());
  MeshFrame frame;
  frame.update(*scene, 1, 1, 0.9);
  const std::span<const MeshRow> rows = frame.rows(DrawList::opaque);
  REQUIRE(rows.size() == 100000);
  for (const std::size_t row : {std::size_t{0}, std::size_t{50000}, std::size_t{99999}}) {
    const MeshInstance& instance = scene->meshInstances.rows()[row];
    CHECK(difference(rows[row].transform, worldOf(*scene, instance.node, 1)) < 1e-3);
    CHECK(difference(rows[row].previous_transform, worldOf(*scene, instance.node, 0.9)) < 1e-3);
    CHECK(rows[row].transform != rows[row].previous_transform);
  }
}

TEST_CASE("a frame is the same, byte for byte, on one thread and on two") {
  text::Diagnostics diagnostics;
  for (const char* file : {"scenes/crowd.json", "scenes/fox.json"}) {
    const auto scene = loadScene(kSource + file, diagnostics);
    REQUIRE_MESSAGE(scene, diagnostics.text());
    MeshFrame one, two;
    tbb::task_arena single(1), pair(2);
    for (int i = 0; i < 4; ++i) {
      const double time = 0.1 * i, before = i == 2 ? 7 : 0.1 * (i - 1);
      single.execute([&] { one.update(*scene, 1, time, before); });
      pair.execute([&] { two.update(*scene, 1, time, before); });
      const auto same = [](const auto& a, const auto& b) {
        return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
      };
      CHECK(same(one.rows(DrawList::opaque), two.rows(DrawList::opaque)));
      CHECK(same(one.bounds(DrawList::opaque), two.bounds(DrawList::opaque)));
      CHECK(same(one.joints(), two.joints()));
      CHECK(one.sceneBounds() == two.sceneBounds());
      CHECK(one.nodeUpdates() == two.nodeUpdates());
    }
    CHECK(one.isMoving(DrawList::opaque));
    CHECK_FALSE(one.isMoving(DrawList::transparent));
  }
  MeshFrame frame;
  MeshFrame moved = std::move(frame);
  const auto fox = loadScene(kSource + "scenes/fox.json", diagnostics);
  moved.update(*fox, 1, 1, 0.5);
  CHECK(moved.rows(DrawList::opaque).size() == 1);
}
