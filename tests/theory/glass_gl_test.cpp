// Meshes that one sees through, among ray-traced spheres, in the studio and in the deferred frame: what is before the glass, what is
// behind it, and the share that its alpha says.
#include <cmath>
#include <string>

#include "tests/theory/mesh_scene.h"

namespace glass_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

constexpr float kAlpha = 0.3f;

enum class Pane { none, glass, solid };

// A wall at z = 0, a sphere before it, a pane of half the picture at z = 2 and a sphere before that.
scene::Scene sceneWith(Pane pane) {
  MeshScene made({0, 0, 9}, 45);
  const scene::MeshId square = made.addSquare(9);
  made.put(square, {.name = "", .albedo = {0.8f, 0.5f, 0.3f}, .roughness = 0.9f}, {});
  const bool glass = pane == Pane::glass;
  if (pane != Pane::none)
    made.put(square,
             {.name = "",
              .albedo = {0.1f, 0.2f, 0.7f},
              .roughness = 0.4f,
              .alpha = glass ? kAlpha : 1.0f,
              .blend = glass},
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

    // Without the pass there is no glass.
    Shot without = shot;
    without.disables = {std::string("lit.transparent")};
    CHECK(render(without, Pane::glass).radiance == behind.radiance);
  }
}

}  // namespace glass_test
