#include "engine/assets/models/obj/mtl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "engine/assets/models/parts/mesh_builder.h"
#include "engine/text/chars.h"
#include "engine/text/json/dom.h"

namespace weft::assets {

using text::Code;
using text::Place;

namespace {

// What changes no picture here: the model of illumination, ambient light, refraction and what filters it.
const std::set<std::string_view> kUnseen = {"illum", "Ka", "map_Ka", "Ni", "Tf", "sharpness", "Km"};

float numberOf(std::string_view& rest, float otherwise, float most = 1) {
  const auto number = text::numberIn<float>(text::takeWord(rest));
  return number ? std::clamp(*number, 0.0f, most) : otherwise;
}

// One number is gray.
glm::vec3 colorOf(std::string_view rest, float most = 1) {
  glm::vec3 color(numberOf(rest, 0, most));
  if (text::trimmed(rest).empty()) return color;
  color.y = numberOf(rest, 0, most);
  color.z = numberOf(rest, 0, most);
  return color;
}

}  // namespace

MtlReader::MtlReader(ModelFiles& files, text::Diagnostics& diagnostics, Model& model)
    : files_(files),
      diagnostics_(diagnostics),
      model_(model),
      pool_(diagnostics),
      rows_(1),
      moves_(1, {1, 1, 0, 0}) {
  model_.materials.push_back({.name = "default", .albedo = glm::vec3(0.6f)});
}

void MtlReader::leaveOut(const std::string& what, const Place& place) {
  if (said_.insert(what).second)
    diagnostics_.warning(Code::modelPartLeftOut, place, fmt::format("{} was left out", what));
}

void MtlReader::readLibraries(const std::string& names, const Place& place) {
  if (files_.hasBeside(names)) return readLibrary(names, place);
  std::string_view rest = names;
  for (std::string_view name = text::takeWord(rest); !name.empty(); name = text::takeWord(rest))
    readLibrary(std::string(name), place);
}

void MtlReader::readLibrary(const std::string& name, const Place& place) {
  std::string path = name;
  std::ranges::replace(path, '\\', '/');
  if (!libraries_.insert(path).second) return;
  const auto bytes = files_.readOptional(path, place, Code::modelPartLeftOut, false);
  missing_ = missing_ || !bytes;
  if (!bytes) return;
  std::string_view rest = *bytes;
  if (rest.starts_with(text::kByteOrderMark)) rest.remove_prefix(text::kByteOrderMark.size());
  Place here{files_.files().back()};
  while (!rest.empty()) {
    ++here.line;
    readStatement(text::takeLine(rest), here);
  }
}

std::uint32_t MtlReader::rowOf(const std::string& name, const Place& place) {
  if (const auto known = known_.find(name); known != known_.end()) return known->second;
  if (!missing_) leaveOut(fmt::format("the material '{}', which no library of the model has,", name), place);
  return 0;
}

void MtlReader::readStatement(std::string_view rest, const Place& place) {
  const std::string key(text::takeWord(rest));
  if (key.empty() || key.starts_with('#') || kUnseen.contains(key)) return;
  if (key == "newmtl") {
    const std::string name(text::trimmed(rest));
    // The first of a name stays.
    if (!known_.try_emplace(name, static_cast<std::uint32_t>(rows_.size())).second)
      leaveOut(fmt::format("a second material '{}'", name), place);
    rows_.push_back({.place = place});
    moves_.emplace_back(1, 1, 0, 0);
    model_.materials.push_back({.name = name, .albedo = glm::vec3(0.6f), .roughness = 0.5f});
    return;
  }
  if (rows_.size() == 1) return leaveOut(fmt::format("'{}' before any 'newmtl'", key), place);
  Material& material = model_.materials.back();
  Row& row = rows_.back();
  const bool map = key.starts_with("map_");
  if (map || key == "bump" || key == "norm" || key == "disp" || key == "decal" || key == "refl") {
    readMap(map ? key.substr(4) : key, rest, place);
  } else if (key == "Kd") {
    material.albedo = colorOf(rest);
  } else if (key == "Ks") {
    material.specular = colorOf(rest);
  } else if (key == "Ke") {
    material.emissive = colorOf(rest, 1e6f);
  } else if (key == "Ns") {
    material.shininess = numberOf(rest, 0, 10000);
  } else if (key == "d" || key == "Tr") {
    const float value = numberOf(rest, key == "d" ? 1 : 0);
    material.alpha = key == "d" ? value : 1 - value;
  } else if (key == "Pr" || key == "Pm") {
    (key == "Pr" ? material.roughness : material.metallic) = numberOf(rest, key == "Pr" ? 0.5f : 0);
    row.physical = true;
  } else if (numberOf(rest, 1) != 0) {  // Blender writes sheen and clear coat of 0
    leaveOut(fmt::format("'{}' of the material '{}'", key, material.name), place);
  }
}

void MtlReader::readMap(const std::string& of, std::string_view rest, const Place& place) {
  Map map{.place = place};
  const std::string what =
      fmt::format("of the map '{}' of the material '{}'", of, model_.materials.back().name);
  while (text::trimmed(rest).starts_with('-')) {
    const std::string option(text::takeWord(rest));
    std::vector<std::string> words;
    std::string_view after = rest;
    const bool moves = option == "-o" || option == "-s" || option == "-t";
    const std::size_t most = moves ? 3 : option == "-mm" ? 2 : 1;
    while (words.size() < most) {
      const std::string word(text::takeWord(after));
      if (moves && !text::numberIn<float>(word)) break;
      words.push_back(word);
      rest = after;
    }
    const auto wordOf = [&](std::size_t i, float otherwise) {
      return i < words.size() ? text::numberIn<float>(words[i]).value_or(otherwise) : otherwise;
    };
    if (option == "-clamp") {
      map.sampler = words[0] == "on" ? clampU | clampV : repeat;
    } else if (option == "-bm") {
      map.strength = wordOf(0, 1);
    } else if (option == "-s") {
      map.move.x = wordOf(0, 1);
      map.move.y = wordOf(1, 1);
    } else if (option == "-o") {
      map.move.z = wordOf(0, 0);
      map.move.w = wordOf(1, 0);
    } else if (option != "-blendu" && option != "-blendv" && option != "-texres" && option != "-cc" &&
               !(option == "-mm" && wordOf(0, 0) == 0 && wordOf(1, 1) == 1) &&
               !(option == "-t" && wordOf(0, 0) == 0 && wordOf(1, 0) == 0)) {
      leaveOut(fmt::format("'{}' {}", option, what), place);
    }
  }
  static const std::set<std::string_view> kKnown = {"Kd",   "Ke",   "d",    "Pr", "Pm",
                                                    "bump", "Bump", "norm", "Kn"};
  if (!kKnown.contains(of))
    return leaveOut(fmt::format("the map '{}' of the material '{}'", of, model_.materials.back().name),
                    place);
  // By its own name in the folder if its path leads elsewhere: files often keep the paths of the machine that they were made on.
  std::string name(text::trimmed(rest));
  std::ranges::replace(name, '\\', '/');
  if (!files_.hasBeside(name)) name = name.substr(name.rfind('/') + 1);
  if (!images_.contains(name)) {
    auto bytes = files_.readOptional(name, place, Code::missingModelTexture, false);
    images_[name] = bytes ? pool_.put(std::move(*bytes), name, place) : kNoRow;
  }
  map.image = images_[name];
  map.name = name;
  rows_.back().maps.insert_or_assign(of == "Bump" ? "bump" : of == "Kn" ? "norm" : of, std::move(map));
}

void MtlReader::finishRow(std::size_t number) {
  Row& row = rows_[number];
  Material& material = model_.materials[number];
  if (!row.physical && !row.maps.contains("Pr") && !row.maps.contains("Pm")) toMetallicRoughness(material);
  const auto take = [&](std::string_view of) {
    const auto found = row.maps.find(of);
    return found == row.maps.end() ? nullptr : &found->second;
  };
  const auto use = [&](std::uint32_t Material::*slot, std::size_t place, const Map* map, TextureUse as) {
    if (!map) return;
    material.*slot = pool_.use(map->image, map->name, as, map->place);
    material.samplers[place] = map->sampler;
  };
  const Map *color = take("Kd"), *holes = take("d"), *rough = take("Pr"), *metal = take("Pm");
  use(&Material::albedoMap, 0, color, TextureUse::color);
  if (holes && holes->image != kNoRow) {
    // Its alpha, or its brightness where it has none.
    const int channel = pool_.hasAlpha(holes->image) ? 3 : 0;
    material.albedoMap = pool_.useMade(
        color ? color->image : kNoRow, holes->image,
        [channel](const glm::u8vec4& c, const glm::u8vec4& d) {
          return glm::u8vec4(c.r, c.g, c.b, d[channel]);
        },
        holes->name, TextureUse::color, holes->place);
    material.samplers[0] = (color ? color : holes)->sampler;
  }
  use(&Material::emissiveMap, 4, take("Ke"), TextureUse::color);
  if (take("Ke") && material.emissive == glm::vec3(0)) material.emissive = glm::vec3(1);
  const Map *normal = take("norm"), *bump = normal ? normal : take("bump");
  use(&Material::normalMap, 1, bump, normal ? TextureUse::numbers : TextureUse::bump);
  if (bump) material.normalScale = bump->strength;
  if (rough || metal) {
    if (rough) material.roughness = 1;
    if (metal) material.metallic = 1;
    const Map* either = rough ? rough : metal;
    material.metallicRoughnessMap = pool_.useMade(
        rough ? rough->image : kNoRow, metal ? metal->image : kNoRow,
        [](const glm::u8vec4& r, const glm::u8vec4& m) { return glm::u8vec4(255, r.r, m.r, 255); },
        either->name, TextureUse::numbers, either->place);
    material.samplers[2] = either->sampler;
  }
  bool first = true;
  for (const auto& [of, map] : row.maps) {
    if (!std::exchange(first, false) && moves_[number] != map.move)
      leaveOut(
          fmt::format("'-o' or '-s' of the map '{}' of the material '{}', unlike that of its other maps,", of,
                      material.name),
          map.place);
    else
      moves_[number] = map.move;
  }
}

bool MtlReader::finish(const LoadObserver& observer) {
  const std::size_t before = diagnostics_.errorCount();
  for (std::size_t i = 0; i < rows_.size(); ++i) finishRow(i);
  if (!pool_.finish(model_, observer, 0.5) || diagnostics_.errorCount() > before) return false;
  for (std::size_t i = 1; i < rows_.size(); ++i) {
    Material& material = model_.materials[i];
    material.blend = material.alpha < 1;
    if (!rows_[i].maps.contains("d") || material.albedoMap == kNoRow) continue;
    // What is hardly anywhere between is cut out, else mixed.
    const std::vector<std::uint8_t>& texels = model_.textures[material.albedoMap].image->texels;
    std::size_t between = 0;
    for (std::size_t t = 3; t < texels.size(); t += 4) between += texels[t] > 12 && texels[t] < 243 ? 1 : 0;
    material.blend = material.blend || between * 80 > texels.size();  // a twentieth
    if (!material.blend) material.alphaCutoff = 0.5f;
  }
  return true;
}

}  // namespace weft::assets
