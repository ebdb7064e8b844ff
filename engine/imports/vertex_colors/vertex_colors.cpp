// The import `vertex_colors`: a colour for each vertex of the scene's meshes, where one of them has any.
#include "engine/imports/builtin.h"
#include "engine/imports/row_table.h"

namespace weft::imports {

namespace {

const Columns<glm::vec4>& colorColumns() {
  static const Columns<glm::vec4> columns = {
      column<glm::vec4, std::identity{}>("color", "linear; a factor of the material's albedo and alpha")};
  return columns;
}

class VertexColorsProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const scene::MeshData* data = frame.world.scene().meshData.get();
    const auto rows = [&] { return data ? std::span(data->colors) : std::span<const glm::vec4>(); };
    return table_.get(layout, frame.world.sceneGeneration(), rows, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  RowTable<glm::vec4> table_{"vertex colours", colorColumns()};
};

class VertexColors : public Import {
 public:
  graph::ImportType reflect() const override {
    return {
        .name = "vertex_colors",
        .kind = graph::ImportKind::buffer,
        .doc =
            "A row for each vertex of the scene's meshes, which a vertex shader of geometry `mesh` finds by "
            "gl_VertexID. It exists where a mesh has vertex colours; those of the others are white.",
        .columns = tell(colorColumns())};
  }

  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = world.coloredVertices > 0, .count = static_cast<double>(world.coloredVertices)};
  }

  std::unique_ptr<Provider> provide(const graph::ImportRequest&) const override {
    return std::make_unique<VertexColorsProvider>();
  }
};

}  // namespace

std::unique_ptr<Import> makeVertexColors() {
  return std::make_unique<VertexColors>();
}

}  // namespace weft::imports
