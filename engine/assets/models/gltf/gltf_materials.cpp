#include "engine/assets/models/gltf/gltf_materials.h"

#include <fmt/format.h>

namespace weft::assets {

using base::Code;
using base::Diagnostics;
using base::JsonValue;

namespace {

// As glTF has it.
Material defaultMaterial(const std::string& name) {
  Material material;
  material.name = name;
  material.albedo = glm::vec3(1);
  material.metallic = material.roughness = 1;
  return material;
}

class MaterialReader {
 public:
  MaterialReader(GltfDocument& document, ModelFiles& files, TexturePool& pool, Diagnostics& diagnostics)
      : document_(document), files_(files), pool_(pool), diagnostics_(diagnostics) {}

  std::optional<GltfMaterials> read(const LoadObserver& observer, const DecodeRunner& decode) {
    const std::size_t before = diagnostics_.errorCount();
    images_.resize(document_.rows("images").size());
    const std::vector<JsonValue>& rows = document_.rows("materials");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (observer && !observer(LoadStage::decoding, 0)) return {};
      readMaterial(rows[i], i);
      if (diagnostics_.errorCount() > before) return {};
    }
    if (!pool_.decodeAll(decode, observer)) return {};
    for (Material& material : out_.materials)
      for (std::uint32_t* map : {&material.albedoMap, &material.metallicRoughnessMap, &material.normalMap,
                                 &material.occlusionMap, &material.emissiveMap})
        if (*map != kNoRow) *map = pool_.add(uses_[*map].image, uses_[*map].name, uses_[*map].srgb);
    out_.materials.push_back(defaultMaterial("default"));
    out_.uvs.emplace_back();
    return std::move(out_);
  }

 private:
  struct Image {
    bool tried = false;
    std::uint32_t number = kNoRow;  // in the pool
    std::string name;
  };
  // A map before its image is decoded.
  struct Use {
    std::uint32_t image = kNoRow;  // number in the pool
    std::string name;
    bool srgb = false;
  };

  // Put into the pool once.
  const Image& imageOf(std::uint32_t row) {
    Image& image = images_[row];
    if (image.tried) return image;
    image.tried = true;
    const JsonValue& value = document_.rows("images")[row];
    const JsonValue* uri = value.find("uri");
    const JsonValue* view = value.find("bufferView");
    image.name = document_.text(value, "name");
    if (uri && uri->text.starts_with("data:")) {
      if (image.name.empty()) image.name = fmt::format("image {}", row);
      auto bytes = decodeDataUri(uri->text);
      if (!bytes) pool_.reportMissing(image.name, "its base64 is damaged", uri->place);
      if (bytes && files_.count(bytes->size(), uri->place))
        image.number = pool_.put(std::move(*bytes), image.name, uri->place);
    } else if (uri) {
      image.name = uri->text;
      std::optional<std::string> bytes =
          files_.readOptional(uri->text, uri->place, Code::missingModelTexture, true);
      if (bytes) image.number = pool_.put(std::move(*bytes), image.name, uri->place);
    } else if (view) {
      if (image.name.empty()) image.name = fmt::format("image {}", row);
      if (const auto bytes = document_.view(view))
        image.number = pool_.put(std::string(*bytes), image.name, view->place);
    } else {
      image.name = fmt::format("image {}", row);
      pool_.reportMissing(image.name, "it has neither 'uri' nor 'bufferView'", value.place);
    }
    return image;
  }

  GltfUv uvOf(const JsonValue& info) {
    GltfUv uv;
    uv.set = static_cast<std::uint32_t>(document_.number(info, "texCoord", 0, 0, 63));
    const JsonValue* extensions = info.find("extensions");
    const JsonValue* transform = extensions ? extensions->find("KHR_texture_transform") : nullptr;
    if (!transform) return uv;
    document_.numbers(*transform, "offset", 2, uv.offset.data());
    document_.numbers(*transform, "scale", 2, uv.scale.data());
    uv.rotation = static_cast<float>(document_.number(*transform, "rotation", 0, -1e6, 1e6));
    uv.set = static_cast<std::uint32_t>(document_.number(*transform, "texCoord", uv.set, 0, 63));
    return uv;
  }

  // A row of uses_; kNoRow without a map.
  std::uint32_t mapOf(const JsonValue& object, std::string_view key, bool srgb) {
    const JsonValue* info = object.find(key);
    if (!info) return kNoRow;
    const auto texture = document_.index("textures", info->find("index"));
    if (!texture) return kNoRow;
    const GltfUv uv = uvOf(*info);
    if (uv_ && *uv_ != uv) {
      base::Diagnostic& d =
          document_.leaveOut(*info, fmt::format("'{}' of material {} was left out", key, material_));
      d.expected = "one set of texture coordinates and one transform for all maps of a material";
      d.found = "another one than that of its first map";
      return kNoRow;
    }
    uv_ = uv;
    const JsonValue& row = document_.rows("textures")[*texture];
    const auto image = document_.index("images", row.find("source"));
    if (!image) {
      if (!row.find("source"))
        pool_.reportMissing(fmt::format("texture {}", *texture), "it names no image that Weft can read",
                            row.place);
      return use({kNoRow, "missing", srgb});
    }
    const Image& found = imageOf(*image);
    return use({found.number, found.name, srgb});
  }

  std::uint32_t use(Use one) {
    uses_.push_back(std::move(one));
    return static_cast<std::uint32_t>(uses_.size() - 1);
  }

  void readMaterial(const JsonValue& value, std::size_t number) {
    material_ = number;
    uv_.reset();
    const std::string name = document_.text(value, "name");
    Material material = defaultMaterial(name.empty() ? fmt::format("material {}", number) : name);
    const JsonValue* pbr = value.find("pbrMetallicRoughness");
    float factor[4] = {1, 1, 1, 1};
    if (pbr) {
      document_.numbers(*pbr, "baseColorFactor", 4, factor);
      material.metallic = static_cast<float>(document_.number(*pbr, "metallicFactor", 1, 0, 1));
      material.roughness = static_cast<float>(document_.number(*pbr, "roughnessFactor", 1, 0, 1));
      material.albedoMap = mapOf(*pbr, "baseColorTexture", true);
      material.metallicRoughnessMap = mapOf(*pbr, "metallicRoughnessTexture", false);
    }
    material.albedo = {factor[0], factor[1], factor[2]};
    material.normalMap = mapOf(value, "normalTexture", false);
    if (const JsonValue* info = value.find("normalTexture"))
      material.normalScale = static_cast<float>(document_.number(*info, "scale", 1, -1e3, 1e3));
    material.occlusionMap = mapOf(value, "occlusionTexture", false);
    if (const JsonValue* info = value.find("occlusionTexture"))
      material.occlusionStrength = static_cast<float>(document_.number(*info, "strength", 1, 0, 1));
    material.emissiveMap = mapOf(value, "emissiveTexture", true);
    document_.numbers(value, "emissiveFactor", 3, &material.emissive.x);
    readStrength(value, material);
    const std::string mode = document_.text(value, "alphaMode");
    material.blend = mode == "BLEND";
    material.alpha = material.blend ? factor[3] : 1;
    if (mode == "MASK") {
      // The mask compares factor * texel; Weft's materials compare the texel.
      const double cutoff = document_.number(value, "alphaCutoff", 0.5, 0, 1e3);
      material.alphaCutoff = factor[3] > 0 ? static_cast<float>(cutoff / static_cast<double>(factor[3])) : 2;
    }
    const JsonValue* both = value.find("doubleSided");
    material.doubleSided = both && both->flag;
    out_.materials.push_back(std::move(material));
    out_.uvs.push_back(uv_.value_or(GltfUv{}));
  }

  void readStrength(const JsonValue& value, Material& material) {
    const JsonValue* extensions = value.find("extensions");
    const JsonValue* emissive = extensions ? extensions->find("KHR_materials_emissive_strength") : nullptr;
    if (!emissive) return;
    const double strength = document_.number(*emissive, "emissiveStrength", 1, 0, 1e9);
    material.emissive *= static_cast<float>(strength);
  }

  GltfDocument& document_;
  ModelFiles& files_;
  TexturePool& pool_;
  Diagnostics& diagnostics_;
  GltfMaterials out_;
  std::vector<Image> images_;
  std::vector<Use> uses_;
  std::size_t material_ = 0;
  std::optional<GltfUv> uv_;
};

}  // namespace

std::optional<GltfMaterials> readGltfMaterials(GltfDocument& document, ModelFiles& files, TexturePool& pool,
                                               const LoadObserver& observer, const DecodeRunner& decode,
                                               Diagnostics& diagnostics) {
  return MaterialReader(document, files, pool, diagnostics).read(observer, decode);
}

}  // namespace weft::assets
