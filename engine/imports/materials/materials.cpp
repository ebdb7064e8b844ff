#include "engine/imports/materials/materials.h"

#include "engine/imports/material_textures.h"
#include "engine/imports/row_table.h"

namespace weft::imports {

namespace {

struct MaterialRow {
  const scene::Material* material = nullptr;
  std::uint32_t albedoMap = kNoMap, normalMap = kNoMap, metallicRoughnessMap = kNoMap, occlusionMap = kNoMap,
                emissiveMap = kNoMap;
};

const Columns<MaterialRow>& materialColumns() {
  using Row = MaterialRow;
  static const Columns<Row> columns = {
      column<Row, [](const Row& row) { return row.material->albedo; }>(
          "albedo", "linear; factor of its map; F0 of a metal"),
      column<Row, [](const Row& row) { return row.material->metallic; }>("metallic", "factor of its map"),
      column<Row, [](const Row& row) { return row.material->emissive; }>(
          "emissive", "radiance, scene-referred; factor of its map"),
      column<Row, [](const Row& row) { return row.material->roughness; }>("roughness",
                                                                          "perceptual; factor of its map"),
      column<Row, [](const Row& row) { return row.material->specular; }>("specular", "Blinn–Phong: linear"),
      column<Row, [](const Row& row) { return row.material->shininess; }>("shininess",
                                                                          "Blinn–Phong: exponent"),
      column<Row, [](const Row& row) { return row.material->alpha; }>("alpha", "factor of the map's"),
      column<Row, [](const Row& row) { return row.material->alphaCutoff; }>(
          "alpha_cutoff", "over 0: holes where alpha is below"),
      column<Row, [](const Row& row) { return row.material->normalScale; }>("normal_scale",
                                                                            "of the map's x and y"),
      column<Row, [](const Row& row) { return row.material->occlusionStrength; }>("occlusion_strength",
                                                                                  "0 to 1"),
      column<Row, &Row::albedoMap>("albedo_map", "array << 16 | layer of @material_maps; 0xffffffff: none"),
      column<Row, &Row::normalMap>("normal_map", "tangent space"),
      column<Row, &Row::metallicRoughnessMap>("metallic_roughness_map", "metallic in b, roughness in g"),
      column<Row, &Row::occlusionMap>("occlusion_map", "in r"),
      column<Row, &Row::emissiveMap>("emissive_map", ""),
      column<Row, [](const Row& row) { return std::uint32_t{row.material->blinnPhong}; }>(
          "blinn_phong", "1: specular and shininess are what the file has"),
      column<Row, [](const Row& row) { return std::uint32_t{row.material->doubleSided}; }>("double_sided",
                                                                                           "0 or 1")};
  return columns;
}

std::vector<MaterialRow> rowsOf(const scene::Scene& scene) {
  const std::vector<std::uint32_t> maps = mapsOf(batchTextures(scene), scene.textures.size());
  const auto mapOf = [&](std::uint32_t texture) {
    return texture == assets::kNoRow ? kNoMap : maps[texture];
  };
  std::vector<MaterialRow> rows;
  for (const scene::Material& material : scene.materials.rows())
    rows.push_back({.material = &material,
                    .albedoMap = mapOf(material.albedoMap),
                    .normalMap = mapOf(material.normalMap),
                    .metallicRoughnessMap = mapOf(material.metallicRoughnessMap),
                    .occlusionMap = mapOf(material.occlusionMap),
                    .emissiveMap = mapOf(material.emissiveMap)});
  return rows;
}

class MaterialsProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const auto rows = [&] { return rowsOf(frame.world.scene()); };
    return table_.get(layout, frame.world.sceneGeneration(), rows, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  RowTable<MaterialRow> table_{"materials", materialColumns()};
};

}  // namespace

graph::ImportType Materials::reflect() const {
  return {.name = "materials",
          .kind = graph::ImportKind::buffer,
          .doc = "The scene's materials, one row each; shaders/scene/materials.glsl reads them.",
          .columns = tell(materialColumns())};
}

graph::ImportFacts Materials::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const {
  return {.exists = true, .count = static_cast<double>(world.materials)};
}

std::unique_ptr<Provider> Materials::provide(const graph::ImportRequest&) const {
  return std::make_unique<MaterialsProvider>();
}

}  // namespace weft::imports
