#include "engine/graph/language/keys.h"

#include <algorithm>
#include <deque>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace weft::graph {

namespace {

using Json = nlohmann::ordered_json;

const Json& schema() {
  static const Json parsed = Json::parse(kGraphSchema);
  return parsed;
}

std::vector<std::string_view> textsOf(const Json& list) {
  std::vector<std::string_view> texts;
  for (const Json& text : list) texts.push_back(text.get_ref<const std::string&>());
  return texts;
}

// The words of a value: those of its type, or its examples.
std::span<const std::string_view> wordsOf(const Json& shape) {
  static std::deque<std::vector<std::string_view>> kept;
  if (const auto type = shape.find("$ref"); type != shape.end())
    return wordsOf(schema().at(Json::json_pointer(type->get<std::string>().substr(1))));
  for (const char* key : {"enum", "examples"})
    if (const auto words = shape.find(key); words != shape.end()) return kept.emplace_back(textsOf(*words));
  return {};
}

std::vector<KeySpec> keysIn(const Json& object) {
  std::vector<KeySpec> keys;
  std::vector<std::string_view> required;
  if (const auto list = object.find("required"); list != object.end()) required = textsOf(*list);
  for (const auto& [key, shape] : object.at("properties").items())
    keys.push_back({key, shape.at("description").get_ref<const std::string&>(),
                    std::ranges::find(required, key) != required.end(), wordsOf(shape)});
  return keys;
}

// The keys of one kind of objects, as long as the program lives.
std::span<const KeySpec> keysOf(const char* kind) {
  static std::deque<std::vector<KeySpec>> kept;
  return kept.emplace_back(keysIn(schema().at("$defs").at(kind)));
}

std::span<const KeySpec> keysOfGraph() {
  static std::vector<KeySpec> keys = keysIn(schema());
  for (const std::string_view key : textsOf(schema().at("then").at("required")))
    std::ranges::find(keys, key, &KeySpec::key)->required = true;
  return keys;
}

// What a stanza of an overlay may say that no pass and no include says.
std::span<const KeySpec> keysOfPlaces() {
  static std::vector<KeySpec> keys = keysIn(schema().at("$defs").at("passChange"));
  for (const auto others : {kPassKeys, kIncludeKeys})
    for (const KeySpec& other : others)
      std::erase_if(keys, [&](const KeySpec& each) { return each.key == other.key; });
  return keys;
}

}  // namespace

const std::span<const KeySpec> kGraphKeys = keysOfGraph();
const std::span<const KeySpec> kParameterKeys = keysOf("parameter");
const std::span<const KeySpec> kTextureKeys = keysOf("texture");
const std::span<const KeySpec> kBufferKeys = keysOf("buffer");
const std::span<const KeySpec> kImportKeys = keysOf("import");
const std::span<const KeySpec> kInputKeys = keysOf("input");
const std::span<const KeySpec> kPassKeys = keysOf("pass");
const std::span<const KeySpec> kIncludeKeys = keysOf("include");
const std::span<const KeySpec> kShaderKeys = keysOf("shaders");
const std::span<const KeySpec> kStateKeys = keysOf("state");
const std::span<const KeySpec> kPlaceKeys = keysOfPlaces();

}  // namespace weft::graph
