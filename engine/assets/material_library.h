// Named material presets from materials/*.json: an array of {"name", "albedo", "metallic", "roughness"} and,
// when known, "category" and "source". JSON mistakes are W002..W006 with their place; W155 is a value out of
// range, W156 a name that stands twice. Does not: know textures or shader parameters.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::assets {

struct MaterialPreset {
  std::string name;               // unique in its library
  std::string category;           // may be empty
  std::array<float, 3> albedo{};  // linear sRGB primaries, 0..1: F0 of a metal, diffuse reflectance otherwise
  float metallic = 0;             // 0..1
  float roughness = 0;            // perceptual, 0..1; the GGX alpha is its square
  std::string source;  // where the values are from: "measured: ..." or "estimated: ..."; may be empty
};

struct MaterialLibrary {
  std::vector<std::string> categories;    // each once, in order of appearance
  std::vector<MaterialPreset> materials;  // in file order

  const MaterialPreset* find(std::string_view name) const;  // null when absent; linear search
  std::vector<std::string> names() const;
};

std::optional<MaterialLibrary> loadMaterialLibrary(const std::string& path, base::Diagnostics& diagnostics);
std::optional<MaterialLibrary> readMaterialLibrary(std::string_view text, const std::string& name,
                                                   base::Diagnostics& diagnostics);

}  // namespace weft::assets
