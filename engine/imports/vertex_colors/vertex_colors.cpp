// The import `vertex_colors`: a color for each vertex of the scene's meshes, where one of them has any.
#include "engine/imports/builtin.h"

namespace weft::imports {

namespace {

struct ColorTable : SceneTable<glm::vec4> {
  static constexpr const char* kLabel = "vertex colors";
  static Columns<Row> columns() {
    return {column<Row, std::identity{}>("color", "linear; a factor of the material's albedo and alpha")};
  }
  static std::span<const Row> rows(const Frame& frame) {
    const scene::MeshData* data = frame.world.scene().meshData.get();
    return data ? std::span(data->colors) : std::span<const Row>();
  }
};

class VertexColors : public ImportOf<TableProvider<ColorTable>> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "vertex_colors",
            .kind = graph::ImportKind::buffer,
            .doc =
                "A row for each vertex of the scene's meshes, which a vertex shader of geometry `mesh` finds "
                "by gl_VertexID. It exists where a mesh has vertex colors; those of the others are white.",
            .columns = tell(ColorTable::columns())};
  }
  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = world.coloredVertices > 0, .count = static_cast<double>(world.coloredVertices)};
  }
};

}  // namespace

std::unique_ptr<Import> makeVertexColors() {
  return std::make_unique<VertexColors>();
}

}  // namespace weft::imports
