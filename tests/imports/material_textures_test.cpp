#include "engine/imports/material_textures.h"

#include <doctest/doctest.h>

#include <set>

using namespace weft;
using namespace weft::imports;

namespace {

auto add(scene::Scene& scene, int width, int height, bool srgb) {
  auto image = std::make_shared<assets::Image8>();
  image->width = width;
  image->height = height;
  image->channels = 4;
  image->texels.resize(static_cast<std::size_t>(width * height) * 4);
  return scene.textures.add(
      {.name = "t", .image = std::move(image), .srgb = srgb, .content = scene.textures.size()});
}

}  // namespace

TEST_CASE("textures of one size and kind share an array, in the order of the scene") {
  scene::Scene scene;
  add(scene, 4, 4, true);
  add(scene, 8, 8, false);
  add(scene, 4, 4, true);
  add(scene, 4, 4, false);
  const auto arrays = batchTextures(scene);
  REQUIRE(arrays.size() == 3);
  CHECK(arrays[0].width == 8);
  CHECK(arrays[1].textures == std::vector<std::uint32_t>{0, 2});
  CHECK(arrays[1].srgb);
  CHECK(mapsOf(arrays, 4) == std::vector<std::uint32_t>{1u << 16, 0, 1u << 16 | 1, 2u << 16});
  CHECK(batchTextures({}).empty());
}

TEST_CASE("more sizes than there are samplers: the rest goes to the nearest size of its kind, none is lost") {
  scene::Scene scene;
  for (int i = 0; i < 12; ++i) add(scene, 1 << i, 1 << i, false);
  add(scene, 1, 1, true);  // the least of all, but the only one of its kind
  const auto arrays = batchTextures(scene);
  REQUIRE(arrays.size() == kMaterialArrays);
  std::set<std::uint32_t> seen;
  int colors = 0;
  for (const MaterialArray& array : arrays) {
    for (const std::uint32_t texture : array.textures) {
      CHECK(seen.insert(texture).second);
      CHECK(scene.textures.rows()[texture].srgb == array.srgb);
    }
    colors += array.srgb;
  }
  CHECK(seen.size() == 13);
  CHECK(colors == 1);
  for (const MaterialArray& array : arrays)
    if (!array.srgb && array.width == 32)
      CHECK(std::set(array.textures.begin(), array.textures.end()) ==
            std::set<std::uint32_t>{0, 1, 2, 3, 4, 5});
}
