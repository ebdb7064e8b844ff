// Models of the kind WEFT_FUZZ_KIND; of ".mtl" the materials of an OBJ.
#include <algorithm>

#include "engine/assets/models/model_file.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

namespace {

bool isSound(const assets::Model& model) {
  const auto isRow = [](std::uint32_t row, const auto& rows) {
    return row == assets::kNoRow || row < rows.size();
  };
  for (const assets::Mesh& mesh : model.meshes) {
    if (mesh.firstVertex + std::size_t{mesh.vertexCount} > model.vertices.size()) return false;
    if (mesh.firstIndex + std::size_t{mesh.indexCount} > model.indices.size()) return false;
    const auto first = model.indices.begin() + mesh.firstIndex;
    if (!std::all_of(first, first + mesh.indexCount, [&](std::uint32_t i) { return i < mesh.vertexCount; }))
      return false;
  }
  for (std::uint32_t row = 0; row < model.nodes.size(); ++row)
    if (model.nodes[row].parent != assets::kNoRow && model.nodes[row].parent >= row) return false;
  for (assets::Material material : model.materials)
    if (!std::ranges::all_of(material.maps(), [&](auto* map) { return isRow(*map, model.textures); }))
      return false;
  return std::ranges::all_of(model.instances, [&](const assets::ModelInstance& each) {
    return each.node < model.nodes.size() && each.mesh < model.meshes.size() &&
           each.material < model.materials.size() && isRow(each.skin, model.skins);
  });
}

}  // namespace

void fuzz(std::string_view input) {
  const std::string_view kind = WEFT_FUZZ_KIND;
  const GivenFile file("runtime/scenes/fuzz" WEFT_FUZZ_KIND, input);
  const GivenFile square("runtime/scenes/square.obj",
                         "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nusemtl pane\nf 1/1 2/1 3/1\n");
  text::Diagnostics said;
  const auto model = assets::loadModel(kind == ".mtl" ? square.path() : file.path(), said);
  expectAnswer(model.has_value(), said);
  expect(!model || isSound(*model), "rows that exist", said);
}

}  // namespace weft::fuzz
