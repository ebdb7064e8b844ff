#include "engine/assets/material_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <unordered_map>

#include "engine/base/files/text_file.h"
#include "engine/base/json/fields.h"

namespace weft::assets {

using base::Code;
using base::Diagnostics;
using base::JsonFields;
using base::JsonValue;

namespace {

constexpr base::NumberRange kUnit{.min = 0, .max = 1};

MaterialPreset readPreset(const JsonValue& value, std::size_t index, Diagnostics& diagnostics) {
  const JsonValue* named = value.find("name");
  const std::string what = named && named->is(JsonValue::Type::string)
                               ? fmt::format("material '{}'", named->text)
                               : fmt::format("material {}", index);
  JsonFields fields(value, what, Code::badMaterialValue, diagnostics);
  fields.require({"name", "albedo", "metallic", "roughness"});
  MaterialPreset preset;
  preset.name = fields.text("name").value_or("");
  preset.category = fields.text("category").value_or("");
  if (const auto albedo = fields.triple("albedo", kUnit))
    for (std::size_t c = 0; c < 3; ++c) preset.albedo[c] = static_cast<float>((*albedo)[c]);
  preset.metallic = static_cast<float>(fields.number("metallic", kUnit).value_or(0));
  preset.roughness = static_cast<float>(fields.number("roughness", kUnit).value_or(0));
  preset.source = fields.text("source").value_or("");
  fields.finish();
  return preset;
}

// One habit, such as bytes for albedo, makes every material wrong: the first values show it.
constexpr std::size_t kOutOfRangeTold = 12;

void appendCapped(const Diagnostics& said, Diagnostics& diagnostics) {
  std::size_t outOfRange = 0;
  base::Where last;
  for (const base::Diagnostic& d : said.items())
    if (d.code != Code::badMaterialValue || ++outOfRange <= kOutOfRangeTold) {
      diagnostics.add(d);
      last = d.place;
    }
  if (outOfRange > kOutOfRangeTold)
    diagnostics.add(
        {.severity = base::Severity::note,
         .code = Code::badMaterialValue,
         .message = fmt::format("and {} more values out of range in this file", outOfRange - kOutOfRangeTold),
         .place = last});
}

}  // namespace

const MaterialPreset* MaterialLibrary::find(std::string_view name) const {
  const auto found = std::find_if(materials.begin(), materials.end(),
                                  [&](const MaterialPreset& m) { return m.name == name; });
  return found == materials.end() ? nullptr : &*found;
}

std::vector<std::string> MaterialLibrary::names() const {
  std::vector<std::string> names;
  names.reserve(materials.size());
  for (const MaterialPreset& material : materials) names.push_back(material.name);
  return names;
}

std::optional<MaterialLibrary> readMaterialLibrary(std::string_view text, const std::string& name,
                                                   Diagnostics& diagnostics) {
  const base::PointerScope pointers(name, text, diagnostics);
  const auto root = base::parseJson(text, std::make_shared<const std::string>(name), diagnostics);
  if (!root || !base::expectType(*root, "a material library", JsonValue::Type::array, diagnostics)) return {};
  Diagnostics said;
  MaterialLibrary library;
  std::unordered_map<std::string, base::Place> places;
  for (std::size_t i = 0; i < root->items.size(); ++i) {
    const JsonValue& value = root->items[i];
    MaterialPreset preset = readPreset(value, i, said);
    const auto [before, fresh] = places.try_emplace(preset.name, value.place);
    if (!fresh && !preset.name.empty()) {
      base::Diagnostic& d = said.error(Code::duplicateMaterial, value.place,
                                       fmt::format("a second material '{}'", preset.name));
      d.hint = fmt::format("rename one; the first stands in line {}", before->second.line);
    }
    if (std::find(library.categories.begin(), library.categories.end(), preset.category) ==
        library.categories.end())
      library.categories.push_back(preset.category);
    library.materials.push_back(std::move(preset));
  }
  appendCapped(said, diagnostics);
  if (said.hasErrors()) return {};
  return library;
}

std::optional<MaterialLibrary> loadMaterialLibrary(const std::string& path, Diagnostics& diagnostics) {
  const std::optional<std::string> text = base::readTextFile(path, diagnostics);
  if (!text) return {};
  return readMaterialLibrary(*text, path, diagnostics);
}

}  // namespace weft::assets
