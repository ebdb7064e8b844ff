#include <doctest/doctest.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "engine/graph/language/format.h"
#include "engine/graph/language/keys.h"
#include "engine/graph/read/read.h"
#include "engine/text/json/edit.h"
#include "tests/json_pointer.h"

using namespace weft::graph;
using weft::text::Code;
using weft::text::Diagnostics;
using Json = nlohmann::ordered_json;

namespace {

// A graph with `object` where objects of this kind stand.
struct Host {
  const char* name;
  std::span<const KeySpec> keys;
  Json (*wrap)(const Json& object);
  Json whole;  // an object of the kind that reads without errors
};

Json wrapResource(const Json& object) {
  return {{"passes", Json::array()}, {"resources", {{"r", object}}}};
}
Json wrapPass(const Json& object) {
  return {{"passes", {object}}};
}

std::vector<Host> hosts() {
  return {
      {"graph", shapeOfFile(false).keys, [](const Json& o) { return o; }, {{"passes", Json::array()}}},
      {"parameter",
       shapeOf("parameter").keys,
       [](const Json& o) {
         return Json{{"passes", Json::array()}, {"parameters", {{"p", o}}}};
       },
       {{"default", 1}}},
      {"texture", shapeOf("texture").keys, wrapResource, {{"texture", "r8"}, {"size", 1}, {"history", 1}}},
      {"buffer", shapeOf("buffer").keys, wrapResource, {{"buffer", 16}, {"history", 1}}},
      {"import", shapeOf("import").keys, wrapResource, {{"import", "camera"}}},
      {"input",
       shapeOf("input").keys,
       [](const Json& o) {
         return Json{{"passes", Json::array()}, {"inputs", Json::array({Json{{"r", o}}})}};
       },
       {{"history", 1}}},
      {"pass", shapeOf("pass").keys, wrapPass, {{"name", "p"}, {"type", "compute"}}},
      {"set", shapeOf("set").keys,
       [](const Json& o) {
         return Json{{"passes", Json::array()}, {"sets", {{"s", o}}}};
       },
       Json::object()},
      {"include", shapeOf("include").keys, wrapPass, {{"include", "absent.json"}, {"as", "absent"}}},
      {"state", shapeOf("state").keys,
       [](const Json& o) {
         return wrapPass({{"name", "p"}, {"type", "draw"}, {"state", o}});
       },
       Json::object()},
  };
}

Diagnostics diagnose(const Json& graph) {
  Diagnostics diagnostics;
  readGraphText(weft::text::dumpJson(graph, -1), "nowhere/schema_test.json", diagnostics);
  return diagnostics;
}

// The include of a file that is not there is not what these tests are about.
bool isMissingFile(const weft::text::Diagnostic& d) {
  return d.code == Code::unreadableFile;
}

}  // namespace

TEST_CASE("the words of the schema are those of the program") {
  const Json defs = weft::text::loadJson(kGraphSchema).at("$defs");
  const auto fits = [&](const Json& words, const auto& own) {
    CHECK(words == Json(std::vector<std::string>(std::begin(own), std::end(own))));
  };
  fits(defs.at("format").at("anyOf").at(1).at("enum"), formatNames());
  fits(defs.at("parameterType").at("enum"), kParameterTypes);
  fits(defs.at("pass").at("properties").at("update").at("anyOf").at(0).at("enum"), kUpdateWords);
  const Json& state = defs.at("state").at("properties");
  fits(state.at("depth_test").at("examples"), kCompareNames);
  // A pass that changes another may say what a pass may say.
  for (const KeySpec& spec : shapeOf("pass").keys)
    CHECK_MESSAGE(defs.at("passChange").at("properties").contains(spec.key), spec.key);
}

TEST_CASE("the reader knows every key of the schema, and looks at its value") {
  for (const Host& host : hosts())
    for (const KeySpec& spec : host.keys) {
      CAPTURE(host.name);
      CAPTURE(spec.key);
      // An object where none may stand, or null where one may: both have the wrong type somewhere. A key that
      // the reader forgot to read would pass in silence.
      Json object = host.whole;
      object[std::string(spec.key)] = nullptr;
      bool reported = false;
      const Diagnostics said = diagnose(host.wrap(object));
      for (const auto& d : said.items()) {
        CHECK_MESSAGE(d.code != Code::unknownKey, format(d));
        reported = reported || (d.code == Code::wrongType &&
                                weft::test::pointerTo(weft::text::dumpJson(host.wrap(object), -1), d)
                                    .ends_with("/" + std::string(spec.key)));
      }
      CHECK(reported);
    }
}

TEST_CASE("keys outside the schema are unknown") {
  for (const Host& host : hosts()) {
    CAPTURE(host.name);
    const Diagnostics whole = diagnose(host.wrap(host.whole));
    for (const auto& d : whole.items()) CHECK_MESSAGE(isMissingFile(d), format(d));
    if (std::string(host.name) == "import") continue;  // any other key is an argument
    Json object = host.whole;
    object["qwertyuiop"] = 1;
    const Diagnostics diagnostics = diagnose(host.wrap(object));
    CHECK(diagnostics.contains(Code::unknownKey));
  }
}

TEST_CASE("every reference inside the schema leads somewhere") {
  const Json schema = weft::text::loadJson(kGraphSchema);
  int found = 0;
  const auto walk = [&](const auto& self, const Json& node) -> void {
    if (node.is_object() && node.contains("$ref")) {
      const std::string target = node.at("$ref");
      CHECK_MESSAGE(schema.contains(Json::json_pointer(target.substr(1))), target);
      ++found;
    }
    if (node.is_structured())
      for (const Json& child : node) self(self, child);
  };
  walk(walk, schema);
  CHECK(found > 30);
}
