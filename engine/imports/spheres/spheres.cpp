#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

constexpr scene::DrawList kList = scene::DrawList::spheres;

class SpheresProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, text::Diagnostics& diagnostics) override {
    return frame.tables.spheres(kList, layout, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.tables.generation(kList); }
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene(), kList); }
};

class Spheres : public ImportOf<SpheresProvider> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "spheres",
            .kind = graph::ImportKind::buffer,
            .doc = "The instances of the draw list `spheres`, in the layout of scene/instances.glsl.",
            .arguments = {},
            .columns = tell(sphereColumns())};
  }
  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = true, .count = world.countOf(scene::drawListNames()[static_cast<std::size_t>(kList)])};
  }
};

}  // namespace

std::unique_ptr<Import> makeSpheres() {
  return std::make_unique<Spheres>();
}

}  // namespace weft::imports
