#include "engine/imports/vertex_colors/vertex_colors.h"

#include "engine/imports/row_table.h"

namespace weft::imports {

namespace {

class VertexColorsProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const scene::MeshData* data = frame.world.scene().meshData.get();
    const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) {
      const std::size_t count = data ? data->colors.size() : 0;
      RowWriter writer(wanted, count, bytes);
      for (std::size_t i = 0; i < count; ++i) writer.put(i, 0, data->colors[i]);
    };
    return table_.get(layout, frame.world.sceneGeneration(), fill, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  RowTable table_{"vertex colours"};
};

}  // namespace

graph::ImportType VertexColors::reflect() const {
  return {
      .name = "vertex_colors",
      .kind = graph::ImportKind::buffer,
      .doc =
          "A row for each vertex of the scene's meshes, which a vertex shader of geometry `mesh` finds by "
          "gl_VertexID. It exists where a mesh has vertex colours; those of the others are white.",
      .columns = {{"color", "vec4", "linear; a factor of the material's albedo and alpha"}}};
}

graph::ImportFacts VertexColors::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const {
  return {.exists = world.coloredVertices > 0, .count = static_cast<double>(world.coloredVertices)};
}

std::unique_ptr<Provider> VertexColors::provide(const graph::ImportRequest&) const {
  return std::make_unique<VertexColorsProvider>();
}

}  // namespace weft::imports
