// The import `material_maps`: the textures of the scene's materials, in arrays by size and kind.
#include "engine/imports/builtin.h"
#include "engine/imports/scene_tables.h"

namespace weft::imports {

namespace {

class MaterialMapsProvider : public Provider {
 public:
  explicit MaterialMapsProvider(const graph::ImportRequest& request) : element_(graph::elementOf(request)) {}
  gl::TextureRef texture(const Frame& frame, text::Diagnostics& diagnostics) override {
    return frame.tables.textures().array(frame.world.scene(), frame.world.sceneGeneration(), element_,
                                         diagnostics);
  }
  std::uint64_t generation(const Frame& frame) override { return frame.world.sceneGeneration(); }
  bool isStill(const World&) const override { return true; }

 private:
  std::uint32_t element_;
};

class MaterialMaps : public ImportOf<MaterialMapsProvider> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "material_maps",
            .kind = graph::ImportKind::texture,
            .doc =
                "The textures of the scene's materials, all levels, batched by size: an array of 8 "
                "sampler2DArray, which shaders/scene/materials.glsl looks up. Not there when no material "
                "has one.",
            .array = kMaterialArrays};
  }

  graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts& world, Files&) const override {
    const WorldFacts::Maps& maps = world.maps;
    return {.exists = maps.arrays > 0,
            .format = graph::Format::rgba8,
            .width = maps.width,
            .height = maps.height,
            .layers = maps.layers,
            .mips = maps.mips,
            .layered = true,
            .count = static_cast<double>(maps.arrays)};
  }
};

}  // namespace

std::unique_ptr<Import> makeMaterialMaps() {
  return std::make_unique<MaterialMaps>();
}

}  // namespace weft::imports
