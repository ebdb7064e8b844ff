// What the built-in imports say of themselves and of a world, and that an embedder's stands beside them.
#include <doctest/doctest.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/assets/images/image.h"
#include "engine/imports/import.h"
#include "engine/imports/world.h"
#include "tests/temporary_folder.h"

using namespace weft;
using namespace weft::imports;
using graph::ImportKind;

namespace {

const ImportRegistry& registry() {
  static const ImportRegistry builtin = ImportRegistry::builtin();
  return builtin;
}

const Import& importOf(std::string_view name) {
  const Import* import = registry().find(name);
  REQUIRE(import);
  return *import;
}

// A request with the defaults of the type, but for one word.
graph::ImportRequest requestOf(std::string_view name, std::string_view argument = {},
                               const std::string& word = {}) {
  graph::ImportRequest request{.type = std::string(name), .arguments = {}};
  for (const graph::ImportArgument& each : importOf(name).reflect().arguments)
    request.arguments.emplace_back(each.name,
                                   each.name == argument ? graph::Value::text(word) : each.initial);
  return request;
}

graph::ImportFacts factsOf(const graph::ImportRequest& request, const WorldFacts& world) {
  Files files;
  return importOf(request.type).facts(request, world, files);
}

// Of a scene with so many spheres in `spheres`, and so many in `opaque`, in red.
WorldFacts factsWith(std::size_t spheres, std::size_t opaque) {
  scene::Scene scene;
  scene.name = "toys";
  scene.cameras.add({.name = "front"});
  scene.materials.add({.name = "red"});
  const scene::LabelId label = scene.labels.add({.names = {"ball"}, .tags = {"marked"}});
  for (std::size_t i = 0; i < spheres; ++i) scene.spheres.add({});
  for (std::size_t i = 0; i < opaque; ++i)
    scene.spheres.add(
        {.material = scene.materials.idOf(0), .label = label, .lists = maskOf(scene::DrawList::opaque)});
  return World(std::move(scene)).facts();
}

class Clouds : public Import {
 public:
  graph::ImportType reflect() const override { return {.name = "clouds", .doc = "of an embedder"}; }
  std::unique_ptr<Provider> provide(const graph::ImportRequest&) const override {
    return std::make_unique<Provider>();
  }
};

}  // namespace

TEST_CASE(
    "every built-in import is found under the name that it reflects, with a text for it and its arguments") {
  std::set<std::string> names;
  for (const graph::ImportType& type : registry().reflect()) {
    CAPTURE(type.name);
    CHECK(names.insert(type.name).second);
    CHECK_FALSE(type.doc.empty());
    for (const graph::ImportArgument& argument : type.arguments) {
      CAPTURE(argument.name);
      CHECK_FALSE(argument.doc.empty());
      const bool chosen =
          argument.choices.empty() ||
          std::ranges::find(argument.choices, argument.initial.symbol) != argument.choices.end();
      CHECK(chosen);
    }
    CHECK(importOf(type.name).provide(requestOf(type.name)));
  }
  CHECK(
      fmt::format("{}", fmt::join(names, " ")) ==
      "boxes camera cube_lut cut draw_list draw_order environment ground image joints lamps material_layers "
      "material_maps materials meshes morph_targets morph_weights mouse second_uvs spheres sun "
      "vertex_colors");
  CHECK_FALSE(registry().find("clouds"));
}

TEST_CASE("the environment is a texture with levels, and a graph that stands in for it") {
  const graph::ImportType type = importOf("environment").reflect();
  CHECK(type.kind == ImportKind::texture);
  WorldFacts world{.environment = true, .environmentWidth = 512, .environmentHeight = 256};
  const graph::ImportFacts facts = factsOf(requestOf("environment"), world);
  CHECK(facts.exists);
  CHECK(facts.fallback == "graphs/daylight.json");
  CHECK(facts.format == graph::Format::rgba16f);
  CHECK(facts.width == 512);
  CHECK(facts.height == 256);
  CHECK(facts.mips == 10);
  world.environment = false;
  CHECK_FALSE(factsOf(requestOf("environment"), world).exists);
}

TEST_CASE("spheres are a table of instances, as many as the world's list has") {
  const graph::ImportType type = importOf("spheres").reflect();
  CHECK(type.kind == ImportKind::buffer);
  CHECK(type.columns.size() == 6);
  CHECK(type.arguments.empty());
  CHECK(factsOf(requestOf("spheres"), factsWith(7, 3)).count == 7);
  CHECK(factsOf(requestOf("spheres"), {}).count == 0);
}

TEST_CASE("boxes are those of all spheres and meshes, whatever their lists") {
  CHECK(factsOf(requestOf("boxes"), factsWith(7, 3)).count == 10);
  CHECK(factsOf(requestOf("boxes"), {}).exists);
}

TEST_CASE("a draw order has eight bytes per instance of the list that it names, and room for one") {
  const graph::ImportType type = importOf("draw_order").reflect();
  CHECK(type.kind == ImportKind::buffer);
  CHECK(type.columns.empty());
  const auto lists = std::ranges::count_if(type.arguments, &graph::ImportArgument::drawList);
  CHECK(lists == 1);
  const WorldFacts world = factsWith(7, 3);
  const graph::ImportFacts facts = factsOf(requestOf("draw_order", "list", "opaque"), world);
  CHECK(facts.count == 3);
  CHECK(facts.bytes == 24);
  CHECK(factsOf(requestOf("draw_order", "list", "opaque"), {}).bytes == 8);
}

TEST_CASE("a draw list of nothing is told with the nearest word of the scene, unless no scene is known") {
  const auto of = [](std::string_view argument, const std::string& word, const WorldFacts& world) {
    return factsOf(requestOf("draw_list", argument, word), world);
  };
  const WorldFacts world = factsWith(7, 3);
  CHECK(of("of", "opaque", world).count == 3);
  CHECK(of("of", "all", world).count == 10);
  CHECK(of("tag", "marked", world).count == 3);
  CHECK(of("tag", "marked", world).problems.empty());
  const graph::ImportFacts none = of("tag", "marke", world);
  CHECK_FALSE(none.exists);
  REQUIRE(none.problems.size() == 1);
  CHECK(none.problems[0].severity == text::Severity::warning);
  CHECK(none.problems[0].code == text::Code::emptyImport);
  CHECK(none.problems[0].message.find("'toys'") != std::string::npos);
  CHECK(none.problems[0].hint == "did you mean 'marked'?");
  CHECK(of("material_name", "wood", world).problems.at(0).message.find("wood") != std::string::npos);
  CHECK(of("of", "transparent", world).problems.size() == 1);
  CHECK(of("tag", "marke", {}).problems.empty());
}

TEST_CASE("a sun is there if the scene has one, if it casts, or if the graph says where it stands") {
  const auto is = [](std::string_view argument, graph::Value value, const WorldFacts& world) {
    graph::ImportRequest request = requestOf("sun");
    for (auto& [name, given] : request.arguments)
      if (name == argument) given = value;
    return factsOf(request, world).exists;
  };
  const graph::Value yes = graph::Value::boolean(true), up{graph::Value::Type::list, 3, {0, 1, 0}, {}};
  const auto withSun = [](bool casts) {
    scene::Scene scene;
    scene.sun = scene::Sun{.shadow = casts};
    return World(std::move(scene)).facts();
  };
  CHECK(is("casting", yes, withSun(true)));
  CHECK_FALSE(is("casting", yes, withSun(false)));
  CHECK(is("casting", graph::Value::boolean(false), withSun(false)));
  CHECK_FALSE(is("casting", graph::Value::boolean(false), {}));
  CHECK(is("direction", up, {}));
}

TEST_CASE("lamps that cast shadows, or are rectangles, are tables of their own") {
  scene::Scene scene;
  scene.lamps.add({.name = "a", .shadow = true});
  scene.lamps.add({.name = "b"});
  const auto count = [&](std::string_view argument) {
    graph::ImportRequest request = requestOf("lamps");
    for (auto& [name, given] : request.arguments)
      if (name == argument) given = graph::Value::boolean(true);
    const graph::ImportFacts facts = factsOf(request, World(scene).facts());
    return facts.exists ? facts.count : 0;
  };
  CHECK(count("") == 2);
  CHECK(count("casting") == 1);
  CHECK(count("sized") == 0);
  scene.lamps.add({.name = "c", .across = {1, 0, 0}, .up = {0, 0, 1}});
  CHECK(count("sized") == 1);
}

TEST_CASE("the camera is the one view of every pass; a lens and a jitter are its arguments") {
  const graph::ImportType type = importOf("camera").reflect();
  CHECK(type.kind == ImportKind::view);
  CHECK(type.everyPass);
  std::vector<std::string> names;
  for (const auto& argument : type.arguments) names.push_back(argument.name);
  CHECK(names == std::vector<std::string>{"jitter", "focal_length", "sensor_height", "name", "position",
                                          "target", "angle", "height", "around"});
  for (const graph::ImportType& other : registry().reflect())
    CHECK(other.everyPass == (other.name == type.name));
  CHECK(factsOf(requestOf("camera"), {}).exists);
}

TEST_CASE("a table is not there without a file; a file that cannot be read is said, and is watched") {
  CHECK(importOf("cube_lut").reflect().kind == ImportKind::texture);
  const graph::ImportFacts none = factsOf(requestOf("cube_lut"), {});
  CHECK_FALSE(none.exists);
  CHECK(none.problems.empty());
  Files files;
  const graph::ImportRequest request = requestOf("cube_lut", "file", "no/such/table.cube");
  const graph::ImportFacts missing = importOf("cube_lut").facts(request, {}, files);
  CHECK_FALSE(missing.exists);
  REQUIRE(missing.problems.size() == 1);
  CHECK(missing.problems[0].code == text::Code::unreadableFile);
  CHECK(files.touched() == std::set<std::string>{"no/such/table.cube"});
}

TEST_CASE("an image is not there without a file; a sequence is watched with the picture that comes next") {
  CHECK(importOf("image").reflect().kind == ImportKind::texture);
  CHECK_FALSE(factsOf(requestOf("image"), {}).exists);
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const std::vector<std::uint8_t> texels(12, 7);
  REQUIRE(assets::savePng8(folder.at("a.1.png"), 2, 2, 3, texels, diagnostics));
  REQUIRE(assets::savePng8(folder.at("a.12.png"), 2, 2, 3, texels, diagnostics));
  REQUIRE(assets::savePng8(folder.at("a.01.png"), 2, 2, 3, texels, diagnostics));  // no number without zeros
  Files files;
  const auto request = requestOf("image", "file", folder.at("a.%d.png"));
  const graph::ImportFacts facts = importOf("image").facts(request, {}, files);
  CHECK(facts.exists);
  CHECK(facts.format == graph::Format::rgba8);
  CHECK(facts.width == 2);
  CHECK(facts.mips == 1);
  CHECK(files.touched() ==
        std::set<std::string>{folder.at("a.1.png"), folder.at("a.12.png"), folder.at("a.13.png")});
  CHECK_FALSE(importOf("image").provide(request)->isStill(World{scene::Scene{}}));
  const graph::ImportFacts missing = factsOf(requestOf("image", "file", folder.at("b.##.png")), {});
  CHECK_FALSE(missing.exists);
  REQUIRE(missing.problems.size() == 1);
  CHECK(missing.problems[0].code == text::Code::unreadableImage);
}

TEST_CASE(
    "a sequence that plays and the mouse change while a graph runs; pictures per second are not below 0") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const std::vector<std::uint8_t> texels(12, 7);
  REQUIRE(assets::savePng8(folder.at("a.1.png"), 2, 2, 3, texels, diagnostics));
  graph::ImportRequest request = requestOf("image", "file", folder.at("a.%d.png"));
  CHECK(factsOf(request, {}).changing);
  request.arguments[1].second = graph::Value::number(1);  // frame
  CHECK_FALSE(factsOf(request, {}).changing);
  CHECK_FALSE(factsOf(requestOf("image", "file", folder.at("a.1.png")), {}).changing);
  CHECK(factsOf(requestOf("mouse"), {}).changing);
  request.arguments[1].second = graph::Value::number(-1);
  request.arguments[2].second = graph::Value::number(-1);  // fps
  const graph::ImportFacts facts = factsOf(request, {});
  REQUIRE(facts.problems.size() == 1);
  CHECK(facts.problems[0].code == text::Code::badImportArgument);
  CHECK(facts.problems[0].found == "-1");
}

TEST_CASE("a cut is an event: it changes with the input, and stays in a world that nobody changes") {
  CHECK(importOf("cut").reflect().kind == ImportKind::event);
  const World world{scene::Scene{}};
  CHECK(importOf("cut").provide(requestOf("cut"))->isStill(world));
}

TEST_CASE("what may differ from frame to frame says so; none of the built-in imports remembers") {
  scene::Scene scene;
  World still{scene};
  scene.spheres.add({.velocity = {1, 0, 0}, .material = {}});
  World moving{scene};
  const std::set<std::string> always = {"environment",   "cube_lut",     "cut",           "ground",
                                        "image",         "joints",       "lamps",         "material_layers",
                                        "material_maps", "materials",    "morph_targets", "morph_weights",
                                        "second_uvs",    "vertex_colors"};
  for (const graph::ImportType& type : registry().reflect()) {
    CAPTURE(type.name);
    const auto provider = importOf(type.name).provide(requestOf(type.name));
    CHECK(provider->isStill(moving) == always.contains(type.name));
    const bool ofTheScene =
        (type.kind == ImportKind::buffer && !type.columns.empty() && type.name != "mouse") ||
        type.kind == ImportKind::list;
    CHECK(provider->isStill(still) == (always.contains(type.name) || ofTheScene));
    CHECK_FALSE(provider->remembers(moving));
  }
}

TEST_CASE("an embedder's import stands behind the built-in ones; what it leaves out has defaults") {
  ImportRegistry own = ImportRegistry::builtin();
  own.add(std::make_unique<Clouds>());
  CHECK(own.reflect().back().name == "clouds");
  const Import* clouds = own.find("clouds");
  REQUIRE(clouds);
  Files files;
  const graph::ImportRequest request{.type = "clouds", .arguments = {}};
  CHECK(clouds->facts(request, {}, files).exists);
  const auto provider = clouds->provide(request);
  const World world{scene::Scene{}};
  CHECK_FALSE(provider->isStill(world));
  CHECK_FALSE(provider->isPending(world));
  CHECK_FALSE(provider->hold());
  CHECK(provider->renew(true));
  CHECK_FALSE(provider->renew(false));
  CHECK_FALSE(registry().find("clouds"));
}

TEST_CASE("equal requests have equal keys; another type, argument or value another") {
  const auto key = [](const graph::ImportRequest& request) { return graph::keyOf(request); };
  CHECK(key(requestOf("draw_order")) == key(requestOf("draw_order", "list", "spheres")));
  CHECK(key(requestOf("draw_order")) != key(requestOf("draw_order", "list", "opaque")));
  CHECK(key(requestOf("spheres")) != key(requestOf("environment")));
  graph::ImportRequest number{.type = "a", .arguments = {{"x", graph::Value::number(1)}}};
  graph::ImportRequest word{.type = "a", .arguments = {{"x", graph::Value::text("1")}}};
  graph::ImportRequest other{.type = "a", .arguments = {{"y", graph::Value::number(1)}}};
  CHECK(key(number) != key(word));
  CHECK(key(number) != key(other));
}
