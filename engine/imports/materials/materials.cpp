// The import `materials`: the scene's materials as a table. A mesh's row says which one it has.
#include "engine/imports/builtin.h"
#include "engine/imports/material_textures.h"

namespace weft::imports {

namespace {

// With maps as @material_maps has them.
std::vector<scene::Material> rowsOf(const scene::Scene& scene) {
  const std::vector<std::uint32_t> maps = mapsOf(batchTextures(scene), scene.textures.size());
  std::vector<scene::Material> rows(scene.materials.rows().begin(), scene.materials.rows().end());
  for (scene::Material& row : rows)
    for (std::uint32_t* map :
         {&row.albedoMap, &row.normalMap, &row.metallicRoughnessMap, &row.occlusionMap, &row.emissiveMap})
      *map = *map == assets::kNoRow ? kNoMap : maps[*map];
  return rows;
}

struct MaterialTable : SceneTable<scene::Material> {
  static constexpr const char* kLabel = "materials";
  static Columns<Row> columns() {
    return {
        column<Row, &Row::albedo>("albedo", "linear; factor of its map; F0 of a metal"),
        column<Row, &Row::metallic>("metallic", "factor of its map"),
        column<Row, &Row::emissive>("emissive", "radiance, scene-referred; factor of its map"),
        column<Row, &Row::roughness>("roughness", "perceptual; factor of its map"),
        column<Row, &Row::specular>("specular", "Blinn–Phong: linear"),
        column<Row, &Row::shininess>("shininess", "Blinn–Phong: exponent"),
        column<Row, &Row::alpha>("alpha", "factor of the map's"),
        column<Row, &Row::alphaCutoff>("alpha_cutoff", "over 0: holes where alpha is below"),
        column<Row, &Row::normalScale>("normal_scale", "of the map's x and y"),
        column<Row, &Row::occlusionStrength>("occlusion_strength", "0 to 1"),
        column<Row, &Row::albedoMap>("albedo_map", "array << 16 | layer of @material_maps; 0xffffffff: none"),
        column<Row, &Row::normalMap>("normal_map", "tangent space"),
        column<Row, &Row::metallicRoughnessMap>("metallic_roughness_map", "metallic in b, roughness in g"),
        column<Row, &Row::occlusionMap>("occlusion_map", "in r"),
        column<Row, &Row::emissiveMap>("emissive_map", ""),
        column<Row, &Row::blinnPhong>("blinn_phong", "1: specular and shininess are what the file has"),
        column<Row, &Row::doubleSided>("double_sided", "0 or 1")};
  }
  static std::vector<Row> rows(const Frame& frame) { return rowsOf(frame.world.scene()); }
};

class Materials : public ImportOf<TableProvider<MaterialTable>> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "materials",
            .kind = graph::ImportKind::buffer,
            .doc = "The scene's materials, one row each; shaders/scene/materials.glsl reads them.",
            .columns = tell(MaterialTable::columns())};
  }

  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    return {.exists = true, .count = static_cast<double>(world.materials)};
  }
};

}  // namespace

std::unique_ptr<Import> makeMaterials() {
  return std::make_unique<Materials>();
}

}  // namespace weft::imports
