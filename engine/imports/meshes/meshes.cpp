// The import `meshes`: the rows of the meshes of a draw list, as a table.
#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

class MeshesProvider : public Provider {
 public:
  explicit MeshesProvider(const graph::ImportRequest& request) : list_(drawListOf(request)) {}

  BufferRef buffer(const Frame& frame, const RowLayout& layout, text::Diagnostics& diagnostics) override {
    return frame.tables.meshes(list_, layout, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.tables.meshFrame().generation(list_); }
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene()); }

 private:
  scene::DrawList list_;
};

class Meshes : public ImportOf<MeshesProvider> {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "meshes",
        .kind = graph::ImportKind::buffer,
        .doc =
            "The meshes of a draw list, one row each, as a draw of them has in its block `instances`. Not "
            "there when there are none.",
        .arguments = {drawListArgument(scene::DrawList::opaque)},
        .columns = tell(meshColumns())};
  }
  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files&) const override {
    const double count = world.meshesOf(request.at("list").symbol);
    return {.exists = count > 0, .count = count};
  }
};

}  // namespace

std::unique_ptr<Import> makeMeshes() {
  return std::make_unique<Meshes>();
}

}  // namespace weft::imports
