// The pipelines of the road, as far as they need no overlays: without errors and warnings in their default
// settings, and for every variant, size and disable either a graph or diagnostics with their text.
#include <filesystem>
#include <fstream>
#include <set>

#include "tests/graph/expand/support.h"

using namespace weft;
using namespace weft::graph;
using namespace weft::graph::test;

namespace {

namespace fs = std::filesystem;

// The paper files in a folder of their own, with the overlays among them written out.
std::string paperFolder() {
  const fs::path paper = WEFT_SOURCE_DIR "/tests/graph/paper";
  const fs::path folder = fs::path(WEFT_BINARY_DIR) / "expand_paper";
  fs::create_directories(folder);
  for (const char* name : {"studio.json", "ibl.json", "post.json", "bloom.json", "deferred.json", "gi.json"})
    fs::copy_file(paper / name, folder / name, fs::copy_options::overwrite_existing);
  std::ofstream(folder / "gaussian_bloom.json") << R"({
    "name": "gaussian_bloom",
    "inputs": ["hdr"], "resources": { "glow": { "texture": "r11f_g11f_b10f", "size": "size(hdr)/2" } },
    "passes": [
      { "name": "glow_prefilter", "type": "fullscreen", "shader": "bloom/prefilter.frag.glsl",
        "read": { "source": "hdr" }, "write": { "result": "glow.mip[0]" },
        "parameters": { "threshold": { "default": 1.0, "min": 0, "max": 8 } } },
      { "name": "glow_blur", "type": "fullscreen", "shader": "bloom/gaussian.frag.glsl", "repeat": { "i": [0, 3] },
        "read": { "source": "glow" }, "write": { "result": "glow" }, "parameters": { "axis": "i % 2" } } ] })";
  std::ofstream(folder / "gi_wrapper.json") << R"({
    "name": "gi_wrapper",
    "resources": {
      "hdr": { "texture": "rgba16f", "size": "screen", "clear": [0, 0, 0, 1] },
      "depth": { "texture": "depth32f", "size": "screen", "clear": 0 },
      "ldr": { "texture": "rgba8", "size": "screen" },
      "sh": ["gi.sh if $gi_sampling == textures"], "probes": ["gi.probes if $gi_sampling == buffer"] },
    "passes": [
      { "include": "ibl.json" },
      { "include": "gi.json", "bind": { "irradiance": "ibl.irradiance" } },
      { "name": "show", "type": "fullscreen", "shader": "a.frag.glsl",
        "read": { "hdr": "hdr", "depth": "depth?", "sh": "sh as linear ?",
                  "probes": "probes ?", "brdf": "ibl.brdf", "specular": "ibl.specular" },
        "write": { "result": "ldr" } } ],
    "present": "ldr" })";
  return folder.string();
}

const std::vector<std::string> kGraphs = {"studio.json", "deferred.json", "gi_wrapper.json"};

struct Source {
  std::string name;
  std::shared_ptr<const GraphDesc> desc;
};

std::vector<Source> sources() {
  std::vector<Source> all;
  text::Diagnostics diagnostics;
  const std::string folder = paperFolder();
  for (const std::string& name : kGraphs)
    all.push_back({"paper/" + name, readGraph(folder + "/" + name, diagnostics)});
  for (const char* name : {"studio.json", "glow.json"})
    all.push_back({name, readGraph(std::string(WEFT_SOURCE_DIR "/graphs/") + name, diagnostics)});
  for (const Source& source : all) REQUIRE_MESSAGE(source.desc, diagnostics.text());
  CHECK_MESSAGE(diagnostics.empty(), diagnostics.text());
  return all;
}

// A graph, or errors; every one of them says something a person can act on.
bool settles(const Source& source, const Settings& settings, const World& world = {}) {
  text::Diagnostics diagnostics;
  const auto graph = expandGraph(*source.desc, testRegistry(world), settings, diagnostics);
  CHECK((graph != nullptr) == !diagnostics.hasErrors());
  for (const text::Diagnostic& d : diagnostics.items()) {
    CHECK_MESSAGE(!d.message.empty(), source.name);
    CHECK_MESSAGE((!d.hint.empty() || d.code == text::Code::noFiniteResult), text::format(d));
  }
  if (!graph) return false;
  for (const FlatUse& use : graph->uses) {
    REQUIRE(use.resource < graph->resources.size());
    const FlatResource& resource = graph->resources[use.resource];
    CHECK(use.mip + use.mips <= resource.mips);
    CHECK(use.layer + use.layers <= resource.layers);
  }
  CHECK(graph->specs.size() == graph->passes.size());
  CHECK(graph->passNames.size() == graph->passes.size());
  CHECK(graph->resourceNames.size() == graph->resources.size());
  return true;
}

}  // namespace

TEST_CASE("the pipelines expand in their default settings without a word") {
  for (const Source& source : sources()) {
    text::Diagnostics diagnostics;
    const auto graph = expandGraph(*source.desc, testRegistry(), {}, diagnostics);
    CHECK_MESSAGE(diagnostics.empty(), source.name, "\n", diagnostics.text());
    REQUIRE(graph);
    CHECK(graph->present.resource != kNone);
  }
}

TEST_CASE("every parameter at every choice and end of its range, and every size") {
  for (const Source& source : sources()) {
    text::Diagnostics diagnostics;
    const auto plain = expandGraph(*source.desc, testRegistry(), {}, diagnostics);
    REQUIRE(plain);
    int variants = 0;
    for (const ParameterSpec& parameter : plain->parameters) {
      std::vector<std::string> values = parameter.desc.choices;
      if (parameter.desc.type == ParameterDesc::Type::boolean) values = {"true", "false"};
      if (parameter.desc.type == ParameterDesc::Type::file) values = {"a.cube"};
      if (parameter.desc.min && parameter.value.type == Value::Type::number)
        values.push_back(toText(Value::number(*parameter.desc.min)));
      if (parameter.desc.max && parameter.value.type == Value::Type::number)
        values.push_back(toText(Value::number(*parameter.desc.max)));
      for (const std::string& value : values) {
        INFO(source.name, " --set ", parameter.path, "=", value);
        CHECK(settles(source, with({{parameter.path, value}})));
        ++variants;
      }
    }
    for (const auto& [width, height] : {std::pair(1u, 1u),
                                        {2u, 1u},
                                        {1u, 7u},
                                        {31u, 17u},
                                        {640u, 360u},
                                        {1920u, 1080u},
                                        {16384u, 16384u}}) {
      INFO(source.name, " ", width, "x", height);
      Settings settings;
      settings.screenWidth = width;
      settings.screenHeight = height;
      CHECK(settles(source, settings));
      ++variants;
    }
    MESSAGE(source.name, ": ", variants, " variants");
  }
}

TEST_CASE("worlds with nothing in them") {
  for (const Source& source : sources())
    for (const double count : {0.0, 1.0, 2.0, 3.0, 1000.0}) {
      INFO(source.name, " with ", count);
      // log2ceil(0) is an author's mistake in the paper files, not ours: any diagnostic will do.
      settles(source, {},
              {.environment = false,
               .sun = false,
               .spheres = count,
               .pointLights = count,
               .shadowedLights = count});
      settles(source, {},
              {.environment = true, .sun = true, .spheres = count, .pointLights = 0, .shadowedLights = 0});
    }
}

TEST_CASE("every single and pairwise disable is a graph or a documented diagnostic") {
  for (const Source& source : sources()) {
    text::Diagnostics diagnostics;
    const auto plain = expandGraph(*source.desc, testRegistry(), {}, diagnostics);
    REQUIRE(plain);
    std::set<std::string> names;
    for (const PassSpec& spec : plain->specs) names.insert(spec.declared);
    for (const DisabledPass& pass : plain->disabled) names.insert(pass.name.substr(0, pass.name.find('[')));
    int graphs = 0, tried = 0;
    for (auto a = names.begin(); a != names.end(); ++a)
      for (auto b = a; b != names.end(); ++b) {
        INFO(source.name, " --disable ", *a, " --disable ", *b);
        graphs += settles(source, with({}, {*a, *b})) ? 1 : 0;
        ++tried;
      }
    MESSAGE(source.name, ": ", tried, " disables, ", graphs, " graphs, ", tried - graphs, " diagnosed");
    CHECK(graphs > 0);
  }
}
