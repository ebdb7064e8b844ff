// The materials of a glTF file. Declared in gltf_document.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/color_space.hpp>
#include <optional>
#include <tuple>
#include <utility>

#include "assets_sentences.h"
#include "engine/assets/models/gltf/gltf_document.h"
#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/assets/models/parts/texture_pool.h"

namespace weft::assets {

using text::Code;
using text::JsonValue;

namespace {

// In the order of Material::maps(). An object that begins with KHR is an extension; "": the material itself.
constexpr struct {
  std::string_view object, key;
  TextureUse use;
} kMaps[] = {{"pbrMetallicRoughness", "baseColorTexture", TextureUse::color},
             {"", "normalTexture", TextureUse::numbers},
             {"pbrMetallicRoughness", "metallicRoughnessTexture", TextureUse::numbers},
             {"", "occlusionTexture", TextureUse::numbers},
             {"", "emissiveTexture", TextureUse::color},
             {"KHR_materials_specular", "specularTexture", TextureUse::numbers},
             {"KHR_materials_specular", "specularColorTexture", TextureUse::color},
             {"KHR_materials_clearcoat", "clearcoatTexture", TextureUse::numbers},
             {"KHR_materials_clearcoat", "clearcoatRoughnessTexture", TextureUse::numbers},
             {"KHR_materials_clearcoat", "clearcoatNormalTexture", TextureUse::numbers},
             {"KHR_materials_sheen", "sheenColorTexture", TextureUse::color},
             {"KHR_materials_sheen", "sheenRoughnessTexture", TextureUse::numbers},
             {"KHR_materials_anisotropy", "anisotropyTexture", TextureUse::numbers},
             {"KHR_materials_iridescence", "iridescenceTexture", TextureUse::numbers},
             {"KHR_materials_iridescence", "iridescenceThicknessTexture", TextureUse::numbers},
             {"KHR_materials_transmission", "transmissionTexture", TextureUse::numbers},
             {"KHR_materials_volume", "thicknessTexture", TextureUse::numbers}};

constexpr struct {
  std::string_view extension, key;
  float MaterialLayers::*value;
  double min, max;
} kLayers[] = {{"KHR_materials_ior", "ior", &MaterialLayers::ior, 0, 1e3},
               {"KHR_materials_specular", "specularFactor", &MaterialLayers::specular, 0, 1},
               {"KHR_materials_clearcoat", "clearcoatFactor", &MaterialLayers::coat, 0, 1},
               {"KHR_materials_clearcoat", "clearcoatRoughnessFactor", &MaterialLayers::coatRoughness, 0, 1},
               {"KHR_materials_sheen", "sheenRoughnessFactor", &MaterialLayers::sheenRoughness, 0, 1},
               {"KHR_materials_anisotropy", "anisotropyStrength", &MaterialLayers::anisotropy, 0, 1},
               {"KHR_materials_anisotropy", "anisotropyRotation", &MaterialLayers::anisotropyTurn, -1e6, 1e6},
               {"KHR_materials_iridescence", "iridescenceFactor", &MaterialLayers::film, 0, 1},
               {"KHR_materials_iridescence", "iridescenceIor", &MaterialLayers::filmIor, 1, 1e3},
               {"KHR_materials_iridescence", "iridescenceThicknessMinimum", &MaterialLayers::filmMin, 0, 1e6},
               {"KHR_materials_iridescence", "iridescenceThicknessMaximum", &MaterialLayers::filmMax, 0, 1e6},
               {"KHR_materials_transmission", "transmissionFactor", &MaterialLayers::transmission, 0, 1},
               {"KHR_materials_volume", "thicknessFactor", &MaterialLayers::thickness, 0, 1e6}};

Material defaultMaterial(std::string name) {
  return {.name = std::move(name), .albedo = glm::vec3(1), .metallic = 1, .roughness = 1};
}

// KHR_materials_pbrSpecularGlossiness as the albedo, metallic and roughness that look the same.
struct SpecGloss {
  glm::vec3 diffuse{1}, specular{1};  // linear
  float glossiness = 1;
};

struct Metallic {
  glm::vec3 albedo{1};
  float metallic = 0, roughness = 0;
};

float brightnessOf(glm::vec3 color) {
  return std::sqrt(glm::dot(color * color, glm::vec3(0.299f, 0.587f, 0.114f)));
}

// Whose diffuse part and reflectance along the normal are the same: the root of a quadratic. Khronos, the extension's
// examples/convert-between-workflows.
Metallic toMetallic(const SpecGloss& from) {
  constexpr float kDielectric = 0.04f;
  const float left = 1 - std::max({from.specular.r, from.specular.g, from.specular.b});
  const float bright = brightnessOf(from.specular), c = kDielectric - bright;
  const float b = brightnessOf(from.diffuse) * left / (1 - kDielectric) + bright - 2 * kDielectric;
  const float root = std::sqrt(std::max(b * b - 4 * kDielectric * c, 0.0f));
  const float metallic = c > 0 ? 0 : glm::clamp((root - b) / (2 * kDielectric), 0.0f, 1.0f);
  const glm::vec3 dielectric = from.diffuse * (left / (1 - kDielectric) / std::max(1 - metallic, 1e-6f));
  const glm::vec3 metal = (from.specular - kDielectric * (1 - metallic)) / std::max(metallic, 1e-6f);
  return {glm::clamp(glm::mix(dielectric, metal, metallic * metallic), 0.0f, 1.0f), metallic,
          1 - from.glossiness};
}

// Of a texel of the diffuse map and one of the specular-glossiness map, with these factors.
Metallic texelOf(const SpecGloss& factors, const glm::u8vec4& diffuse, const glm::u8vec4& specular) {
  static const std::array<float, 256> kLinear = [] {
    std::array<float, 256> table{};
    for (std::size_t i = 0; i < table.size(); ++i) table[i] = decodeSrgb(static_cast<float>(i) / 255);
    return table;
  }();
  const auto linear = [](const glm::u8vec4& t) {
    return glm::vec3(kLinear[t.r], kLinear[t.g], kLinear[t.b]);
  };
  return toMetallic({factors.diffuse * linear(diffuse), factors.specular * linear(specular),
                     factors.glossiness * static_cast<float>(specular.a) / 255});
}

glm::u8vec4 toBytes(glm::vec4 texel) {
  return glm::u8vec4(texel * 255.0f + 0.5f);
}

class MaterialReader {
 public:
  MaterialReader(GltfDocument& document, ModelFiles& files, Model& model, bool made)
      : document_(document), files_(files), model_(model), made_(made), pool_(files) {}

  std::vector<GltfUvs> read() {
    const std::size_t before = files_.diagnostics().errorCount();
    const std::vector<JsonValue>& rows = document_.rows("materials");
    images_.resize(document_.rows("images").size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      GltfDocument::refuseUnless(!files_.stop().stop_requested());
      readMaterial(rows[i], i);
    }
    model_.materials.push_back(defaultMaterial("default"));
    uvs_.emplace_back(1);
    GltfDocument::refuseUnless(files_.diagnostics().errorCount() == before && pool_.finish(model_));
    return std::move(uvs_);
  }

 private:
  struct Image {
    bool tried = false;
    std::uint32_t number = kNoRow;  // in the pool
    std::string name = "missing";
  };

  // Put into the pool once.
  const Image& imageOf(const JsonValue& texture) {
    static const Image kNone;
    const JsonValue *webp = valueOf(texture, {"extensions", "EXT_texture_webp", "source"}),
                    *source = webp ? webp : texture.find("source");
    if (!source) return kNone;
    const std::uint32_t row = document_.index("images", *source);
    Image& image = images_[row];
    if (std::exchange(image.tried, true)) return image;
    const JsonValue& value = document_.rows("images")[row];
    const JsonValue *uri = value.find("uri"), *view = value.find("bufferView");
    image.name = textOf(value, "name", fmt::format("image {}", row));
    const JsonValue& where = uri ? *uri : view ? *view : value;
    std::optional<std::string> bytes;
    if (uri && uri->text.starts_with("data:")) {
      bytes = decodeDataUri(uri->text);
      if (!bytes) pool_.reportMissing(image.name, "its base64 is damaged", where.place);
      GltfDocument::refuseUnless(!bytes || files_.count(bytes->size(), where.place));
    } else if (uri) {
      image.name = made_ ? files_.namedBeside(uri->text) : uri->text;
      bytes = files_.readOptional(image.name, where.place, Code::missingModelTexture, !made_);
    } else if (view) {
      bytes = std::string(document_.view(*view).bytes);
    } else {
      pool_.reportMissing(image.name, "it has neither 'uri' nor 'bufferView'", where.place);
    }
    if (bytes) image.number = pool_.put(std::move(*bytes), image.name, where.place);
    return image;
  }

  // glTF 2.0, 5.26. What is made smaller is always mixed from texels and levels.
  std::uint8_t samplerOf(const JsonValue& texture) {
    const JsonValue* which = texture.find("sampler");
    if (!which) return repeat;
    const JsonValue& row = document_.rows("samplers")[document_.index("samplers", *which)];
    const auto bitsOf = [&](const char* key, std::initializer_list<std::pair<int, MapSampler>> values) {
      const JsonValue* value = row.find(key);
      for (const auto& [number, bits] : values)
        if (value && value->number == number) return int{bits};
      return 0;
    };
    return static_cast<std::uint8_t>(bitsOf("wrapS", {{33071, clampU}, {33648, mirrorU}}) |
                                     bitsOf("wrapT", {{33071, clampV}, {33648, mirrorV}}) |
                                     bitsOf("magFilter", {{9728, nearest}}));
  }

  GltfUv readUv(const JsonValue& info) {
    GltfUv uv;
    uv.set = static_cast<std::uint32_t>(document_.number(info, {"texCoord"}, 0, 0, 63));
    const JsonValue* transform = valueOf(info, {"extensions", "KHR_texture_transform"});
    if (!transform) return uv;
    document_.numbers(*transform, "offset", uv.offset);
    document_.numbers(*transform, "scale", uv.scale);
    uv.rotation = document_.number(*transform, {"rotation"}, 0, -1e6, 1e6);
    uv.set = static_cast<std::uint32_t>(document_.number(*transform, {"texCoord"}, uv.set, 0, 63));
    return uv;
  }

  void readMaterial(const JsonValue& value, std::size_t number) {
    Material material = defaultMaterial(textOf(value, "name", fmt::format("material {}", number)));
    GltfUvs uvs;
    const JsonValue* gloss = valueOf(value, {"extensions", "KHR_materials_pbrSpecularGlossiness"});
    const bool unlit = valueOf(value, {"extensions", "KHR_materials_unlit"});
    std::array<Image, kMaterialMaps> images;
    static_assert(std::size(kMaps) == kMaterialMaps);
    for (std::size_t i = 0; i < images.size(); ++i) {
      const auto& map = kMaps[i];
      const JsonValue* info =
          map.object.empty()            ? value.find(map.key)
          : gloss && (i == 0 || i == 2) ? gloss->find(i == 0 ? "diffuseTexture" : "specularGlossinessTexture")
          : map.object.starts_with("KHR") ? valueOf(value, {"extensions", map.object, map.key})
                                          : valueOf(value, {map.object, map.key});
      if (!info || (unlit && i > 0)) continue;
      const GltfUv mine = readUv(*info);
      const std::size_t most = gloss ? 1 : 2;  // maps are made of two
      auto at = std::ranges::find(uvs, mine);
      if (at == uvs.end() && uvs.size() == most) {
        document_.leaveOut(say::materialKeyLeftOut, *info, map.key, number, most);
        continue;
      }
      if (at == uvs.end()) at = uvs.insert(at, mine);
      const JsonValue& texture =
          document_.rows("textures")[document_.index("textures", document_.need(*info, "index"))];
      images[i] = imageOf(texture);
      if (!images[i].tried)
        pool_.reportMissing("a texture", "it names no image that Weft can read", texture.place);
      material.samplers[i] = samplerOf(texture) | (at == uvs.begin() ? repeat : atSecondUv);
      const TextureUse use = info->find("bump") ? TextureUse::bump : map.use;
      *material.maps()[i] = pool_.use(images[i].number, images[i].name, use, texture.place);
    }
    if (uvs.empty()) uvs.emplace_back();
    uvs_.push_back(std::move(uvs));
    std::array<float, 4> factor{1, 1, 1, 1};
    if (const JsonValue* pbr = value.find("pbrMetallicRoughness"))
      document_.numbers(*pbr, "baseColorFactor", factor);
    material.albedo = {factor[0], factor[1], factor[2]};
    material.metallic = document_.number(value, {"pbrMetallicRoughness", "metallicFactor"}, 1, 0, 1);
    material.roughness = document_.number(value, {"pbrMetallicRoughness", "roughnessFactor"}, 1, 0, 1);
    if (gloss) factor[3] = readGloss(*gloss, images[0], images[2], material);
    material.normalScale = document_.number(value, {"normalTexture", "scale"}, 1, -1e3, 1e3);
    material.occlusionStrength = document_.number(value, {"occlusionTexture", "strength"}, 1, 0, 1);
    document_.numbers(value, "emissiveFactor", {&material.emissive.x, 3});
    material.emissive *= document_.number(
        value, {"extensions", "KHR_materials_emissive_strength", "emissiveStrength"}, 1, 0, 1e9);
    if (const JsonValue* shine = valueOf(value, {"extensions", "WEFT_blinn_phong"})) {
      document_.numbers(*shine, "specular", {&material.specular.x, 3});
      material.shininess = document_.number(*shine, {"shininess"}, 0, 0, 10000);
      toMetallicRoughness(material);
    }
    const std::string mode = textOf(value, "alphaMode");
    material.blend = mode == "BLEND";
    material.alpha = material.blend ? factor[3] : 1;
    if (mode == "MASK") {
      // The mask compares factor * texel; Weft's materials compare the texel.
      const float cutoff = document_.number(value, {"alphaCutoff"}, 0.5, 0, 1e3);
      material.alphaCutoff = factor[3] > 0 ? cutoff / factor[3] : 2;
    }
    const JsonValue* both = value.find("doubleSided");
    material.doubleSided = both && both->flag;
    if (unlit) {
      material.unlit = material.blinnPhong = true;
      material.shininess = material.metallic = 1;
      material.emissive = std::exchange(material.albedo, glm::vec3(0));
      material.emissiveMap = material.albedoMap;
      material.samplers[4] = material.samplers[0];
    }
    const JsonValue* extensions = value.find("extensions");
    if (extensions && !unlit && !gloss) readLayers(*extensions, material);
    model_.materials.push_back(std::move(material));
  }

  void readLayers(const JsonValue& extensions, Material& material) {
    MaterialLayers& layers = material.layers;
    for (const auto& each : kLayers)
      layers.*each.value =
          document_.number(extensions, {each.extension, each.key}, layers.*each.value, each.min, each.max);
    if (const JsonValue* specular = extensions.find("KHR_materials_specular"))
      document_.numbers(*specular, "specularColorFactor", {&layers.specularColor.x, 3});
    if (const JsonValue* sheen = extensions.find("KHR_materials_sheen"))
      document_.numbers(*sheen, "sheenColorFactor", {&layers.sheen.x, 3});
    if (const JsonValue* volume = extensions.find("KHR_materials_volume")) {
      glm::vec3 left{1};  // of white light, after this distance
      document_.numbers(*volume, "attenuationColor", {&left.x, 3});
      const float distance = document_.number(*volume, {"attenuationDistance"}, 1e9, 0, 3.5e38);
      layers.absorption = -glm::log(glm::clamp(left, 1e-6f, 1.0f)) / std::max(distance, 1e-9f);
    }
    layers.coatNormalScale = document_.number(
        extensions, {"KHR_materials_clearcoat", "clearcoatNormalTexture", "scale"}, 1, -1e3, 1e3);
    layers.layered = layers != MaterialLayers{};
  }

  // KHR_materials_pbrSpecularGlossiness: maps are made of its two. The alpha factor.
  float readGloss(const JsonValue& value, const Image& diffuse, const Image& specular, Material& material) {
    std::array<float, 4> factor{1, 1, 1, 1};
    document_.numbers(value, "diffuseFactor", factor);
    SpecGloss gloss{.diffuse = {factor[0], factor[1], factor[2]}};
    document_.numbers(value, "specularFactor", {&gloss.specular.x, 3});
    gloss.glossiness = document_.number(value, {"glossinessFactor"}, 1, 0, 1);
    const Metallic whole = toMetallic(gloss);
    std::tie(material.albedo, material.metallic, material.roughness) =
        std::tie(whole.albedo, whole.metallic, whole.roughness);
    if (diffuse.number == kNoRow && specular.number == kNoRow) return factor[3];
    material.albedo = glm::vec3(1);
    material.metallic = material.roughness = 1;
    material.albedoMap = pool_.useMade(
        diffuse.number, specular.number,
        [gloss](const glm::u8vec4& d, const glm::u8vec4& s) {
          const glm::vec3 albedo = glm::convertLinearToSRGB(texelOf(gloss, d, s).albedo);
          return toBytes({albedo, static_cast<float>(d.a) / 255});
        },
        diffuse.name, TextureUse::color, value.place);
    material.metallicRoughnessMap = pool_.useMade(
        diffuse.number, specular.number,
        [gloss](const glm::u8vec4& d, const glm::u8vec4& s) {
          const Metallic texel = texelOf(gloss, d, s);
          return toBytes({1, texel.roughness, texel.metallic, 1});
        },
        specular.name, TextureUse::numbers, value.place);
    material.samplers[diffuse.number == kNoRow ? 0 : 2] = material.samplers[diffuse.number == kNoRow ? 2 : 0];
    return factor[3];
  }

  GltfDocument& document_;
  ModelFiles& files_;
  Model& model_;
  const bool made_;
  TexturePool pool_;
  std::vector<Image> images_;
  std::vector<GltfUvs> uvs_;  // parallel to the materials
};

}  // namespace

std::vector<GltfUvs> readMaterials(GltfDocument& document, ModelFiles& files, Model& model, bool made) {
  return MaterialReader(document, files, model, made).read();
}

}  // namespace weft::assets
