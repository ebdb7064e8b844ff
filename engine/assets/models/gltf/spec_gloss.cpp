#include "engine/assets/models/gltf/spec_gloss.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/color_space.hpp>

namespace weft::assets {

namespace {

constexpr float kDielectric = 0.04f;

float brightnessOf(glm::vec3 color) {
  return std::sqrt(glm::dot(color * color, glm::vec3(0.299f, 0.587f, 0.114f)));
}

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

}  // namespace

// Whose diffuse part and reflectance along the normal are the same: the root of a quadratic. Khronos, the extension's
// examples/convert-between-workflows.
Metallic toMetallic(const SpecGloss& from) {
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

MakeTexel makeAlbedo(const SpecGloss& factors) {
  return [factors](const glm::u8vec4& diffuse, const glm::u8vec4& specular) {
    const glm::vec3 albedo = texelOf(factors, diffuse, specular).albedo;
    return toBytes({glm::convertLinearToSRGB(albedo), static_cast<float>(diffuse.a) / 255});
  };
}

MakeTexel makeMetallicRoughness(const SpecGloss& factors) {
  return [factors](const glm::u8vec4& diffuse, const glm::u8vec4& specular) {
    const Metallic texel = texelOf(factors, diffuse, specular);
    return toBytes({1, texel.roughness, texel.metallic, 1});
  };
}

}  // namespace weft::assets
