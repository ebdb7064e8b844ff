#include "engine/graph/language/keys.h"

#include <algorithm>
#include <deque>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "engine/text/json/edit.h"

namespace weft::graph {

namespace {

using Json = nlohmann::ordered_json;

const Json& schema() {
  static const Json parsed = text::loadJson(kGraphSchema);
  return parsed;
}

std::vector<std::string_view> textsOf(const Json& list) {
  std::vector<std::string_view> texts;
  for (const Json& text : list) texts.push_back(text.get_ref<const std::string&>());
  return texts;
}

unsigned typesOf(const Json& types) {
  constexpr std::string_view kTypes[] = {"null", "boolean", "number", "string", "array", "object"};
  if (types.is_string()) return 1u << (std::ranges::find(kTypes, types.get<std::string>()) - kTypes);
  unsigned all = 0;
  for (const Json& type : types) all |= typesOf(type);
  return all;
}

const Shape& shapeOfJson(const Json& json);

void addKeys(Shape& shape, const Json& object) {
  const Json none = Json::array();
  for (const auto& [key, value] : object.at("properties").items()) {
    const Shape& of = shapeOfJson(value);
    shape.keys.push_back({key, value.at("description").get_ref<const std::string&>(), false, of.words, &of});
  }
  for (const Json& from : {object, object.value("then", Json::object())})
    for (const Json& key : from.value("required", none))
      std::ranges::find(shape.keys, key.get<std::string>(), &KeySpec::key)->required = true;
}

Shape makeShape(const Json& json) {
  static std::deque<std::vector<std::string_view>> words;
  Shape shape;
  if (const auto doc = json.find("description"); doc != json.end())
    shape.doc = doc->get_ref<const std::string&>();
  if (json.contains("type")) shape.types = typesOf(json["type"]);
  if (json.contains("properties")) addKeys(shape, json);
  if (const auto others = json.find("additionalProperties"); others != json.end() && others->is_object())
    shape.others = &shapeOfJson(*others);
  if (json.contains("items")) shape.items = &shapeOfJson(json["items"]);
  shape.minItems = json.value("minItems", shape.minItems);
  shape.maxItems = json.value("maxItems", shape.maxItems);
  if (json.contains("anyOf"))
    for (const Json& each : json["anyOf"]) shape.anyOf.push_back(&shapeOfJson(each));
  for (const char* key : {"enum", "examples"})
    if (json.contains(key)) {
      shape.words = words.emplace_back(textsOf(json[key]));
      shape.open = key == std::string_view("examples");
    }
  if (json.contains("enum") || json.contains("const")) shape.types = typesOf("string");
  return shape;
}

// The shapes live as long as the program.
const Shape& shapeOfJson(const Json& json) {
  static std::map<const Json*, Shape> known;
  if (const auto type = json.find("$ref"); type != json.end())
    return shapeOf(
        std::string_view(type->get_ref<const std::string&>()).substr(std::string_view("#/$defs/").size()));
  const auto [at, fresh] = known.try_emplace(&json);
  if (fresh) at->second = makeShape(json);
  return at->second;
}

}  // namespace

const KeySpec* Shape::find(std::string_view key) const {
  const auto found = std::ranges::find(keys, key, &KeySpec::key);
  return found == keys.end() ? nullptr : &*found;
}

const Shape& shapeOfFile(bool changes) {
  static const Shape whole = [] {
    Shape shape = shapeOfJson(schema());
    const Json& then = schema().at("then");
    const auto required = textsOf(then.at("required"));
    for (KeySpec& spec : shape.keys) {
      const std::string key(spec.key);
      if (then.at("properties").contains(key)) spec.shape = &shapeOfJson(then["properties"][key]);
      spec.required = std::ranges::find(required, key) != required.end();
    }
    return shape;
  }();
  return changes ? shapeOfJson(schema()) : whole;
}

const Shape& shapeOf(std::string_view kind) {
  static std::map<std::string, Shape, std::less<>> known;
  const auto [at, fresh] = known.try_emplace(std::string(kind));
  if (fresh) {
    const Json& json = schema().at("$defs").at(at->first);
    at->second = makeShape(json);
    at->second.kind = at->first;
  }
  return at->second;
}

const KeySpec* findStateKey(std::string_view path) {
  const bool factors = path.starts_with("blend.") && path.find('.') != path.rfind('.');
  const char* const kind = path.starts_with("stencil.back.") ? "stencilFace"
                           : path.starts_with("stencil.")    ? "stencil"
                           : factors                         ? "blending"
                                                             : nullptr;
  return kind ? shapeOf(kind).find(path.substr(path.rfind('.') + 1))
              : shapeOf("state").find(path.substr(0, path.find('.')));
}

std::span<const std::string_view> stateWords(std::string_view path) {
  const KeySpec* const key = findStateKey(path);
  return key ? key->words : std::span<const std::string_view>();
}

std::span<const KeySpec> placeKeys() {
  static const std::vector<KeySpec> keys = [] {
    std::vector<KeySpec> own = shapeOf("passChange").keys;
    for (const char* kind : {"pass", "include"})
      for (const KeySpec& other : shapeOf(kind).keys)
        std::erase_if(own, [&](const KeySpec& each) { return each.key == other.key; });
    return own;
  }();
  return keys;
}

}  // namespace weft::graph
