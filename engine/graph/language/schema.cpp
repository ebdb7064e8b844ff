#include "engine/graph/language/schema.h"

#include <nlohmann/json.hpp>

#include "engine/graph/language/format.h"
#include "engine/graph/language/keys.h"

namespace weft::graph {

namespace {

using Json = nlohmann::ordered_json;

Json reference(std::string_view name) {
  return Json{{"$ref", "#/$defs/" + std::string(name)}};
}

template <class Words>
Json enumOf(const Words& words) {
  Json list = Json::array();
  for (const auto& word : words) list.push_back(std::string(word));
  return Json{{"enum", list}};
}

// The schema of one value; the tables' texts are constants of this program and well formed.
Json shapeOf(const KeySpec& spec) {
  Json shape = spec.schema[0] == '@' ? reference(spec.schema.substr(1)) : Json::parse(spec.schema);
  shape["description"] = std::string(spec.doc);
  return shape;
}

Json objectOf(std::span<const KeySpec> keys, const char* description, bool closed = true) {
  Json properties = Json::object(), required = Json::array();
  for (const KeySpec& spec : keys) {
    properties[std::string(spec.key)] = shapeOf(spec);
    if (spec.required) required.push_back(std::string(spec.key));
  }
  Json object = {{"description", description}, {"type", "object"}, {"properties", properties}};
  if (!required.empty()) object["required"] = required;
  if (closed)
    object["additionalProperties"] = false;
  else
    object["additionalProperties"] = reference("value");
  return object;
}

Json namedBy(std::string_view shape, const char* description) {
  return {{"description", description},
          {"type", "object"},
          {"propertyNames", reference("name")},
          {"additionalProperties", reference(shape)}};
}

Json passChange();
Json like();

Json definitions() {
  Json defs;
  defs["name"] = {{"description", "letters, digits and '_'; not mip, layer, face, stencil, x, y, z, w"},
                  {"type", "string"},
                  {"pattern", "^[A-Za-z_][A-Za-z0-9_]*$"},
                  {"not", {{"enum", {"mip", "layer", "face", "stencil", "x", "y", "z", "w"}}}}};
  const Json item = {{"type", {"number", "boolean", "string"}}};
  defs["value"] = {
      {"description", "a number, a boolean, a list of 1 to 4 numbers, or a string that holds an expression"},
      {"anyOf",
       {Json{{"type", {"number", "boolean", "string"}}},
        Json{{"type", "array"}, {"items", item}, {"minItems", 1}, {"maxItems", 4}}}}};
  defs["reference"] = {
      {"description", "name{.mip[..]|.layer[..]|.face[..]|[k]|.stencil} @-n as words if condition ?"},
      {"type", "string"},
      {"minLength", 1}};
  defs["slots"] = namedBy(
      "reference", "references, by the names the shader gives its samplers, images, blocks and outputs");
  defs["resets"] = {
      {"anyOf", {Json{{"type", "string"}}, Json{{"type", "array"}, {"items", {{"type", "string"}}}}}}};
  const Json bound = {{"type", {"number", "string"}}};
  defs["ranges"] = {
      {"description", "\"index\": [first, last] or [first, last, step]"},
      {"type", "object"},
      {"minProperties", 1},
      {"propertyNames", reference("name")},
      {"additionalProperties", {{"type", "array"}, {"items", bound}, {"minItems", 2}, {"maxItems", 3}}}};
  defs["format"] = enumOf(formatNames());
  defs["view"] = enumOf(kViewWords);
  defs["parameterType"] = enumOf(kParameterTypes);
  defs["parameter"] = objectOf(kParameterKeys, "something a person may change");
  defs["texture"] = objectOf(kTextureKeys, "a texture");
  defs["buffer"] = objectOf(kBufferKeys, "a buffer");
  defs["import"] = objectOf(kImportKeys, "something the program provides; other keys are arguments", false);
  defs["input"] = objectOf(kInputKeys, "something the including file provides");
  defs["resource"] = {
      {"anyOf",
       {reference("texture"), reference("buffer"), reference("import"), reference("input"),
        reference("reference"),
        Json{{"description", "alternatives: the first whose condition holds and which has a version"},
             {"type", "array"},
             {"items", reference("reference")},
             {"minItems", 1}}}}};
  defs["shaders"] = objectOf(kShaderKeys, "the two shaders of a draw");
  defs["state"] = objectOf(kStateKeys, "fixed-function state");
  defs["pass"] = objectOf(kPassKeys, "a pass");
  defs["like"] = like();
  defs["include"] = objectOf(kIncludeKeys, "the passes of another file, under a prefix");
  defs["change"] = {{"description", "in an overlay: the keys that change, null to take away"},
                    {"type", {"object", "null"}}};
  defs["passChange"] = passChange();
  return defs;
}

// Stanzas of overlays: any key of passes and includes, null to take one away.
Json passChange() {
  Json properties = Json::object();
  for (const auto keys : {kPassKeys, kIncludeKeys})
    for (const KeySpec& spec : keys)
      if (!properties.contains(std::string(spec.key)))
        properties[std::string(spec.key)] = {{"description", std::string(spec.doc)}};
  for (const KeySpec& spec : kPlaceKeys) properties[std::string(spec.key)] = shapeOf(spec);
  return {{"description", "in an overlay: changes, removes, moves or adds a pass or an include"},
          {"type", "object"},
          {"properties", properties},
          {"additionalProperties", false}};
}

// A pass that takes over the keys of another: any of its own, null to take one away.
Json like() {
  Json properties = Json::object();
  for (const KeySpec& spec : kPassKeys)
    properties[std::string(spec.key)] = {{"description", std::string(spec.doc)}};
  for (const char* key : {"name", "like"}) properties[key]["type"] = "string";
  return {{"description", "a pass like another above it"},
          {"type", "object"},
          {"properties", properties},
          {"required", {"name", "like"}},
          {"additionalProperties", false}};
}

// What holds for a file that is no overlay and no preset.
Json plainGraph() {
  const auto map = [](const char* shape) {
    return Json{
        {"type", "object"}, {"propertyNames", reference("name")}, {"additionalProperties", reference(shape)}};
  };
  const Json stanza = {{"anyOf", {reference("pass"), reference("like"), reference("include")}}};
  return {{"required", {"passes"}},
          {"properties",
           {{"parameters", map("parameter")},
            {"let", map("value")},
            {"resources", map("resource")},
            {"passes", {{"type", "array"}, {"items", stanza}}}}}};
}

}  // namespace

std::string graphSchema() {
  Json schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"}, {"title", "Weft graph"}};
  schema.update(objectOf(
      kGraphKeys, "A frame: resources, passes, and which pass reads and writes what. Comments are allowed."));
  schema.erase("required");
  schema["if"] = {{"not", {{"anyOf", {Json{{"required", {"extends"}}}, Json{{"required", {"set"}}}}}}}};
  schema["then"] = plainGraph();
  schema["$defs"] = definitions();
  return schema.dump(2) + "\n";
}

}  // namespace weft::graph
