#include "engine/scene/scene.h"

#include <doctest/doctest.h>

using namespace weft::scene;

static Scene twoSpheres() {
  Scene scene;
  Material gold;
  gold.name = "gold";
  gold.albedo = {1, 0.7f, 0.3f};
  gold.metallic = 1;
  gold.roughness = 0.2f;
  const MaterialId id = scene.materials.add(gold);
  Sphere still;
  still.center = {1, 2, 3};
  still.material = id;
  scene.spheres.add(still);
  Sphere moving;
  moving.radius = 2;
  moving.velocity = {0, 3, 0};
  moving.lists = maskOf(DrawList::transparent_spheres);
  scene.spheres.add(moving);
  return scene;
}

TEST_CASE("a draw list holds the spheres that stand in it, with their material's values") {
  const Scene scene = twoSpheres();
  std::vector<Instance> out;
  fillInstances(scene, DrawList::spheres, 1, 0.5, out);
  REQUIRE(out.size() == 1);
  CHECK(out[0].center == glm::vec3(1, 2, 3));
  CHECK(out[0].previous_center == glm::vec3(1, 2, 3));
  CHECK(out[0].albedo == glm::vec3(1, 0.7f, 0.3f));
  CHECK(out[0].metallic == 1);
  CHECK(out[0].roughness == 0.2f);
  CHECK(Members(DrawList::opaque, scene).count(scene.spheres) == 0);
  CHECK_FALSE(isMoving(scene, DrawList::spheres));
}

TEST_CASE("moving spheres stand where the time says, then and before") {
  const Scene scene = twoSpheres();
  CHECK(isMoving(scene, DrawList::transparent_spheres));
  std::vector<Instance> out;
  fillInstances(scene, DrawList::transparent_spheres, 2, 1.5, out);
  REQUIRE(out.size() == 1);
  CHECK(out[0].center == glm::vec3(0, 6, 0));
  CHECK(out[0].previous_center == glm::vec3(0, 4.5f, 0));
  CHECK(out[0].radius == 2);
}

TEST_CASE(
    "a word of a selection stands for itself, and with * at its ends for what begins, ends or holds it") {
  CHECK(matches("left", "left"));
  CHECK_FALSE(matches("left", "lefty"));
  CHECK(matches("left*", "lefty"));
  CHECK_FALSE(matches("left*", "a left"));
  CHECK(matches("*left", "a left"));
  CHECK(matches("*ef*", "left"));
  CHECK_FALSE(matches("*eft*", "le ft"));
  CHECK(matches("*", "anything"));
}

TEST_CASE("a selection holds what is in its lists and has its name, its tag and its material") {
  Scene scene = twoSpheres();
  scene.materials.add({.name = "old gold"});
  Sphere third;
  third.material = scene.materials.idOf(1);
  third.label = scene.labels.add({.names = {"ball", "toys"}, .tags = {"small"}});
  scene.spheres.add(third);
  const auto count = [&](auto choose) {
    Selection selection;
    choose(selection);
    return Members(selection, scene).count(scene.spheres);
  };
  CHECK(count([](Selection&) {}) == 3);
  CHECK(count([](Selection& s) { s.material = "*gold"; }) == 2);
  CHECK(count([](Selection& s) { s.material = "gold"; }) == 1);
  CHECK(count([](Selection& s) { s.name = "toy*"; }) == 1);
  CHECK(count([](Selection& s) { s.name = "*"; }) == 1);  // what has a name
  CHECK(count([](Selection& s) { s.tag = "small"; }) == 1);
  CHECK(count([](Selection& s) { s.tag = "small", s.name = "box"; }) == 0);
  CHECK(count([](Selection& s) { s = DrawList::transparent_spheres, s.tag = "small"; }) == 0);
}

TEST_CASE("lists and cameras are found by name") {
  for (std::size_t i = 0; i < kDrawListCount; ++i)
    CHECK(findDrawList(drawListNames()[i]) == static_cast<DrawList>(i));
  CHECK_FALSE(findDrawList("sphere"));
  Scene scene;
  CHECK(findCamera(scene, "") == nullptr);
  scene.cameras.add({"front", {}, 0, {}});
  scene.cameras.add({"left", {}, 0, {}});
  CHECK(findCamera(scene, "")->name == "front");
  CHECK(findCamera(scene, "left")->name == "left");
  CHECK(findCamera(scene, "top") == nullptr);
}
