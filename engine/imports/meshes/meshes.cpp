// The import `meshes`: the rows of the meshes of a draw list, as a table.
#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

const std::string kOpaque = scene::drawListNames()[static_cast<std::size_t>(scene::DrawList::opaque)];

const std::string& listOf(const graph::ImportRequest& request) {
  return request.arguments[0].second.symbol;
}

class MeshesProvider : public Provider {
 public:
  // Expansion lets known lists through only.
  explicit MeshesProvider(const std::string& list)
      : list_(scene::findDrawList(list).value_or(scene::DrawList::opaque)) {}

  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    return frame.tables.meshes(list_, layout, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.tables.meshGeneration(list_); }
  bool isStill(const World& world) const override { return !scene::isMoving(world.scene()); }

 private:
  scene::DrawList list_;
};

class Meshes : public Import {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "meshes",
        .kind = graph::ImportKind::buffer,
        .doc =
            "The meshes of a draw list, one row each, as a draw of them has in its block `instances`. Not "
            "there when there are none.",
        .arguments = {{.name = "list",
                       .initial = graph::Value::text(kOpaque),
                       .choices = {},
                       .doc = "a draw list",
                       .drawList = true}},
        .columns = tell(meshColumns())};
  }

  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files&) const override {
    const double count = world.meshesOf(listOf(request));
    return {.exists = count > 0, .count = count};
  }

  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override {
    return std::make_unique<MeshesProvider>(listOf(request));
  }
};

}  // namespace

std::unique_ptr<Import> makeMeshes() {
  return std::make_unique<Meshes>();
}

}  // namespace weft::imports
