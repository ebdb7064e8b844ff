// Which keys an object of a graph file may have at its place, from the tables of the reader and the registry. Declared in features.h.
#include <algorithm>

#include "app/lsp/answers/features.h"
#include "engine/graph/language/keys.h"

namespace weft::app::lsp {

namespace {

void append(std::vector<KeyDoc>& out, std::span<const graph::KeySpec> specs) {
  for (const graph::KeySpec& spec : specs)
    if (std::ranges::find(out, spec.key, &KeyDoc::key) == out.end())
      out.push_back({std::string(spec.key), std::string(spec.doc), spec.words});
}

std::vector<KeyDoc> keysOfResource(const graph::Registry& registry, const JsonValue& object) {
  std::vector<KeyDoc> keys;
  if (const JsonValue* import = object.find("import")) {
    append(keys, graph::kImportKeys);
    for (const graph::ImportType& type : registry.imports)
      if (type.name == import->text)
        for (const graph::ImportArgument& argument : type.arguments)
          keys.push_back({argument.name, argument.doc, {}});
    return keys;
  }
  const bool texture = object.find("texture"), buffer = object.find("buffer"), input = object.find("input");
  const bool any = texture || buffer || input;
  if (texture || !any) append(keys, graph::kTextureKeys);
  if (buffer || !any) append(keys, graph::kBufferKeys);
  if (!any) append(keys, graph::kImportKeys);
  if (input || !any) append(keys, graph::kInputKeys);
  return keys;
}

// The keys of a stanza, without those that only other types of passes take.
std::vector<KeyDoc> keysOfStanza(const graph::Registry& registry, const JsonValue& object,
                                 const JsonValue& root) {
  std::vector<KeyDoc> keys;
  if (object.find("include")) {
    append(keys, graph::kIncludeKeys);
  } else {
    append(keys, graph::kPassKeys);
    const auto type = std::ranges::find(registry.passTypes, textOf(object, "type"), &graph::PassType::name);
    if (type != registry.passTypes.end())
      std::erase_if(keys, [&](const KeyDoc& key) {
        if (std::ranges::find(type->keys, key.key) != type->keys.end()) return false;
        if (key.key == "shader") return type->shader == graph::ShaderShape::none;
        return std::ranges::any_of(registry.passTypes, [&](const graph::PassType& other) {
          return std::ranges::find(other.keys, key.key) != other.keys.end();
        });
      });
    else if (object.members.size() <= 1)
      append(keys, graph::kIncludeKeys);
  }
  if (root.find("extends")) append(keys, graph::kPlaceKeys);
  return keys;
}

}  // namespace

std::vector<KeyDoc> keysOf(const graph::Registry& registry, const Way& steps) {
  const std::vector<std::string_view> way = keysOn(steps);
  const JsonValue& object = *steps.back().value;
  std::vector<KeyDoc> keys;
  if (way.empty()) {
    append(keys, graph::kGraphKeys);
  } else if (way[0] == "parameters" && way.size() == 2) {
    append(keys, graph::kParameterKeys);
  } else if (way[0] == "resources" && way.size() == 2) {
    return keysOfResource(registry, object);
  } else if (way[0] == "passes" && way.size() == 2) {
    return keysOfStanza(registry, object, *steps.front().value);
  } else if (way[0] == "passes" && way.size() == 3 && way[2] == "state") {
    append(keys, graph::kStateKeys);
  } else if (way[0] == "passes" && way.size() == 3 && way[2] == "shader") {
    append(keys, graph::kShaderKeys);
  } else if (way[0] == "passes" && way.size() == 4 && way[2] == "parameters") {
    append(keys, graph::kParameterKeys);
  }
  return keys;
}

}  // namespace weft::app::lsp
