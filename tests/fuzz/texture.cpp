// Pictures in a glTF file, of any kind that it may have.
#include "engine/assets/models/model_file.h"
#include "tests/assets/models/gltf_maker.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  test::GltfMaker maker;
  maker.square();
  test::json& document = maker.document;
  const std::string bytes = test::GltfMaker::base64(std::string(input));
  document["images"] = {{{"uri", "data:image/png;base64," + bytes}}};
  document["textures"] = {{{"source", 0}, {"extensions", {{"EXT_texture_webp", {{"source", 0}}}}}}};
  document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  document["meshes"][0]["primitives"][0]["material"] = 0;
  const GivenFile file("runtime/scenes/fuzz.gltf", maker.gltf());
  text::Diagnostics said;
  const auto model = assets::loadModel(file.path(), said);
  expectAnswer(model.has_value(), said);
}

}  // namespace weft::fuzz
