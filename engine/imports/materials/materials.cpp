#include "engine/imports/materials/materials.h"

#include "engine/imports/material_textures.h"
#include "engine/imports/row_table.h"

namespace weft::imports {

namespace {

std::vector<graph::TableColumn> columns() {
  return {{"albedo", "vec3", "linear; factor of its map; F0 of a metal"},
          {"metallic", "float", "factor of its map"},
          {"emissive", "vec3", "radiance, scene-referred; factor of its map"},
          {"roughness", "float", "perceptual; factor of its map"},
          {"specular", "vec3", "Blinn–Phong: linear"},
          {"shininess", "float", "Blinn–Phong: exponent"},
          {"alpha", "float", "factor of the map's"},
          {"alpha_cutoff", "float", "over 0: holes where alpha is below"},
          {"normal_scale", "float", "of the map's x and y"},
          {"occlusion_strength", "float", "0 to 1"},
          {"albedo_map", "uint", "array << 16 | layer of @material_maps; 0xffffffff: none"},
          {"normal_map", "uint", "tangent space"},
          {"metallic_roughness_map", "uint", "metallic in b, roughness in g"},
          {"occlusion_map", "uint", "in r"},
          {"emissive_map", "uint", ""},
          {"blinn_phong", "uint", "1: specular and shininess are what the file has"},
          {"double_sided", "uint", "0 or 1"}};
}

class MaterialsProvider : public Provider {
 public:
  BufferRef buffer(const Frame& frame, const RowLayout& layout, base::Diagnostics& diagnostics) override {
    const scene::Scene& scene = frame.world.scene();
    const auto fill = [&](const RowLayout& wanted, std::vector<std::byte>& bytes) {
      write(scene, wanted, bytes);
    };
    return table_.get(layout, frame.world.sceneGeneration(), fill, diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  static void write(const scene::Scene& scene, const RowLayout& layout, std::vector<std::byte>& bytes) {
    const std::vector<std::uint32_t> maps = mapsOf(batchTextures(scene), scene.textures.size());
    const auto mapOf = [&](scene::TextureId id) {
      const scene::Texture* texture = scene.textures.find(id);
      return texture ? maps[static_cast<std::size_t>(texture - scene.textures.rows().data())] : kNoMap;
    };
    const std::span<const scene::Material> rows = scene.materials.rows();
    RowWriter writer(layout, rows.size(), bytes);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const scene::Material& material = rows[i];
      std::size_t column = 0;
      const auto put = [&](const auto& value) { writer.put(i, column++, value); };
      put(material.albedo);
      put(material.metallic);
      put(material.emissive);
      put(material.roughness);
      put(material.specular);
      put(material.shininess);
      put(material.alpha);
      put(material.alphaCutoff);
      put(material.normalScale);
      put(material.occlusionStrength);
      for (const scene::TextureId id : {material.albedoMap, material.normalMap, material.metallicRoughnessMap,
                                        material.occlusionMap, material.emissiveMap})
        put(mapOf(id));
      put(std::uint32_t{material.blinnPhong});
      put(std::uint32_t{material.doubleSided});
    }
  }

  RowTable table_{"materials"};
};

}  // namespace

graph::ImportType Materials::reflect() const {
  return {.name = "materials",
          .kind = graph::ImportKind::buffer,
          .doc = "The scene's materials, one row each; shaders/scene/materials.glsl reads them.",
          .columns = columns()};
}

graph::ImportFacts Materials::facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const {
  return {.exists = true, .count = static_cast<double>(world.materials)};
}

std::unique_ptr<Provider> Materials::provide(const graph::ImportRequest&) const {
  return std::make_unique<MaterialsProvider>();
}

}  // namespace weft::imports
