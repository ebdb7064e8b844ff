#include "engine/imports/material_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdlib>
#include <span>

#include "engine/assets/images/image.h"

namespace weft::imports {

namespace {

constexpr std::size_t kMaxLayers = 2048;  // that every OpenGL 4.5 takes

std::uint64_t texelsOf(const MaterialArray& array) {
  return std::uint64_t{array.width} * array.height * array.textures.size();
}

// How far a texture of one size is from an array of another, in halvings of both axes.
int distanceOf(const MaterialArray& a, const MaterialArray& b) {
  const auto log = [](std::uint32_t side) { return static_cast<int>(std::bit_width(side)); };
  return std::abs(log(a.width) - log(b.width)) + std::abs(log(a.height) - log(b.height));
}

}  // namespace

std::vector<MaterialArray> batchTextures(const scene::Scene& scene) {
  std::vector<MaterialArray> arrays;
  const std::span<const scene::Texture> textures = scene.textures.rows();
  for (std::uint32_t row = 0; row < textures.size(); ++row) {
    const scene::Texture& texture = textures[row];
    if (!texture.image) continue;
    const auto width = static_cast<std::uint32_t>(texture.image->width);
    const auto height = static_cast<std::uint32_t>(texture.image->height);
    auto found = std::ranges::find_if(arrays, [&](const MaterialArray& each) {
      return each.width == width && each.height == height && each.srgb == texture.srgb &&
             each.textures.size() < kMaxLayers;
    });
    if (found == arrays.end())
      found = arrays.insert(arrays.end(),
                            {.width = width, .height = height, .srgb = texture.srgb, .textures = {}});
    found->textures.push_back(row);
  }
  std::ranges::stable_sort(
      arrays, [](const MaterialArray& a, const MaterialArray& b) { return texelsOf(a) > texelsOf(b); });
  std::vector<MaterialArray> rest;
  if (arrays.size() > kMaterialArrays) {
    rest.assign(arrays.begin() + kMaterialArrays, arrays.end());
    arrays.resize(kMaterialArrays);
    // One array of each kind stays, whatever its size.
    const auto hasKind = [&](bool srgb) {
      return std::ranges::any_of(arrays, [&](const MaterialArray& each) { return each.srgb == srgb; });
    };
    const auto other =
        std::ranges::find_if(rest, [&](const MaterialArray& each) { return !hasKind(each.srgb); });
    if (other != rest.end()) std::swap(*other, arrays.back());
  }
  for (const MaterialArray& array : rest) {
    MaterialArray* nearest = nullptr;
    for (MaterialArray& each : arrays)
      if (each.srgb == array.srgb && (!nearest || distanceOf(each, array) < distanceOf(*nearest, array)))
        nearest = &each;
    if (nearest)
      nearest->textures.insert(nearest->textures.end(), array.textures.begin(), array.textures.end());
  }
  return arrays;
}

std::vector<std::uint32_t> mapsOf(const std::vector<MaterialArray>& arrays, std::size_t textures) {
  std::vector<std::uint32_t> maps(textures, kNoMap);
  for (std::uint32_t a = 0; a < arrays.size(); ++a)
    for (std::uint32_t layer = 0; layer < arrays[a].textures.size(); ++layer)
      maps[arrays[a].textures[layer]] = a << 16 | layer;
  return maps;
}

bool MaterialTextures::renew(const scene::Scene& scene, text::Diagnostics& diagnostics) {
  std::vector<std::uint64_t> contents;
  for (const scene::Texture& texture : scene.textures.rows()) contents.push_back(texture.content);
  if (contents == contents_) return true;
  arrays_.clear();
  for (const MaterialArray& array : batchTextures(scene)) {
    const auto layers = static_cast<std::uint32_t>(array.textures.size());
    auto texture =
        gl::Texture::create({.target = GL_TEXTURE_2D_ARRAY,
                             .format = static_cast<GLenum>(array.srgb ? GL_SRGB8_ALPHA8 : GL_RGBA8),
                             .width = array.width,
                             .height = array.height,
                             .layers = layers,
                             .mips = gl::mipsOf(array.width, array.height)},
                            fmt::format("material maps {}", arrays_.size()), diagnostics);
    if (!texture) return false;
    for (std::uint32_t layer = 0; layer < layers; ++layer) {
      const assets::Image8& image = *scene.textures.rows()[array.textures[layer]].image;
      const auto send = [&](const assets::Image8& picture) {
        gl::uploadTexture(texture->ref(), 0, layer, GL_RGBA, GL_UNSIGNED_BYTE,
                          std::as_bytes(std::span(picture.texels)));
      };
      const auto width = static_cast<int>(array.width), height = static_cast<int>(array.height);
      if (image.width == width && image.height == height)
        send(image);
      else
        send(assets::resize(image, width, height, array.srgb));
    }
    glGenerateTextureMipmap(texture->id());
    arrays_.push_back(std::move(*texture));
  }
  contents_ = std::move(contents);
  return true;
}

gl::TextureRef MaterialTextures::array(const scene::Scene& scene, std::uint64_t generation,
                                       std::uint32_t element, text::Diagnostics& diagnostics) {
  if (generation_ != generation) {
    if (!renew(scene, diagnostics)) return {};
    generation_ = generation;
  }
  if (element < arrays_.size()) return arrays_[element].ref();
  if (!white_) {
    const gl::TextureDesc one{.target = GL_TEXTURE_2D_ARRAY};
    if (!gl::remake(white_, one, "no material map", diagnostics)) return {};
    constexpr std::array<std::uint8_t, 4> kWhite = {255, 255, 255, 255};
    gl::uploadTexture(white_.ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE, std::as_bytes(std::span(kWhite)));
  }
  return white_.ref();
}

}  // namespace weft::imports
