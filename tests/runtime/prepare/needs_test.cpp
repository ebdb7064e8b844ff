// What the programs of every bundled graph need of a device, held to the least that OpenGL 4.5 gives (gl::test::kMinDevice). Without GL:
// every graph and preset, with each boolean and choice at each of its values and each pass disabled, over two scenes; with
// WEFT_ALL_VARIANTS=1 in the environment all pairs of those, too. Prints the table of what each graph needs at most. The count, which
// is made from the source, is judged by a driver: each stage of each graph's defaults is linked as a separable program, and what it
// then has active is within the same limits and, but for varyings, never more than was counted.
#include "tests/runtime/prepare/needs.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/gl/context/context.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/imports/world.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/scene/files/scene_file.h"
#include "tests/backend.h"

using namespace weft;

namespace {

const std::string kSources = std::string(WEFT_SOURCE_DIR) + "/";

struct Most {
  std::uint32_t figure = 0;
  std::string pass;
  void raise(std::uint32_t needed, const std::string& by) {
    if (needed > figure) *this = {needed, by};
  }
};

// A graph's programs over all variants that were tried.
struct Row {
  std::set<std::string> programs;
  Most locations, components, samplers, together;
  std::size_t plans = 0, beyond = 0;
};

// A variation: settings over the defaults.
struct Variation {
  std::vector<graph::Setting> sets;
  std::vector<graph::Disable> disables;
};

// What a driver finds active in one stage after linking it alone.
class Linked {
 public:
  Linked(GLenum stage, const std::string& text) {
    const char* const source = text.c_str();
    program_ = glCreateShaderProgramv(stage, 1, &source);
    GLint linked = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &linked);
    GLchar log[512] = "";
    if (!linked) glGetProgramInfoLog(program_, sizeof log, nullptr, log);
    REQUIRE_MESSAGE(linked, std::string(log));
  }
  ~Linked() { glDeleteProgram(program_); }
  Linked(const Linked&) = delete;
  Linked& operator=(const Linked&) = delete;

  // locations, components: of inputs of a fragment shader.
  gl::test::ProgramNeeds needs(GLenum stage) const {
    gl::test::ProgramNeeds found;
    each(GL_PROGRAM_INPUT, [&](const std::string& name, GLenum type, std::uint32_t elements) {
      if (stage != GL_FRAGMENT_SHADER || name.starts_with("gl_")) return;
      const auto [columns, rows] = extentOf(type);
      found.locations += columns * elements;
      found.components += columns * rows * elements;
    });
    each(GL_UNIFORM, [&](const std::string&, GLenum type, std::uint32_t elements) {
      const std::string word = wordOf(type);
      if (word == "sampler") found.samplers += elements;
      if (word == "image") found.together += elements;
    });
    GLint blocks = 0;
    glGetProgramInterfaceiv(program_, GL_SHADER_STORAGE_BLOCK, GL_ACTIVE_RESOURCES, &blocks);
    found.together += static_cast<std::uint32_t>(blocks);
    if (stage == GL_FRAGMENT_SHADER)
      each(GL_PROGRAM_OUTPUT, [&](const std::string& name, GLenum, std::uint32_t elements) {
        if (!name.starts_with("gl_")) found.together += elements;
      });
    return found;
  }

 private:
  template <class F>
  void each(GLenum interface, F&& use) const {
    GLint count = 0;
    glGetProgramInterfaceiv(program_, interface, GL_ACTIVE_RESOURCES, &count);
    for (GLuint i = 0; i < static_cast<GLuint>(count); ++i) {
      const GLenum asked[] = {GL_TYPE, GL_ARRAY_SIZE};
      GLint told[2] = {};
      glGetProgramResourceiv(program_, interface, i, 2, asked, 2, nullptr, told);
      GLchar name[256] = "";
      glGetProgramResourceName(program_, interface, i, sizeof name, nullptr, name);
      use(std::string(name), static_cast<GLenum>(told[0]), static_cast<std::uint32_t>(std::max(1, told[1])));
    }
  }

  // Columns and rows of a type of a varying.
  static std::pair<std::uint32_t, std::uint32_t> extentOf(GLenum type) {
    switch (type) {
      case GL_FLOAT:
      case GL_INT:
      case GL_UNSIGNED_INT:
        return {1, 1};
      case GL_FLOAT_VEC2:
      case GL_INT_VEC2:
      case GL_UNSIGNED_INT_VEC2:
        return {1, 2};
      case GL_FLOAT_VEC3:
      case GL_INT_VEC3:
      case GL_UNSIGNED_INT_VEC3:
        return {1, 3};
      case GL_FLOAT_VEC4:
      case GL_INT_VEC4:
      case GL_UNSIGNED_INT_VEC4:
        return {1, 4};
      case GL_FLOAT_MAT3:
        return {3, 3};
      case GL_FLOAT_MAT4:
        return {4, 4};
      case GL_FLOAT_MAT4x3:
        return {4, 3};
    }
    FAIL(fmt::format("a varying of the type {:#x}", type));
    return {};
  }

  // The ranges of the enumerants of OpenGL 4.5 core.
  static std::string wordOf(GLenum type) {
    if (type >= GL_IMAGE_1D && type <= GL_UNSIGNED_INT_IMAGE_2D_MULTISAMPLE_ARRAY) return "image";
    for (const GLenum sampler :
         {GL_SAMPLER_1D, GL_SAMPLER_2D, GL_SAMPLER_3D, GL_SAMPLER_CUBE, GL_SAMPLER_2D_SHADOW,
          GL_SAMPLER_2D_ARRAY, GL_SAMPLER_2D_ARRAY_SHADOW, GL_SAMPLER_CUBE_SHADOW, GL_SAMPLER_CUBE_MAP_ARRAY,
          GL_SAMPLER_CUBE_MAP_ARRAY_SHADOW, GL_SAMPLER_BUFFER, GL_SAMPLER_2D_MULTISAMPLE, GL_INT_SAMPLER_2D,
          GL_INT_SAMPLER_2D_ARRAY, GL_INT_SAMPLER_3D, GL_UNSIGNED_INT_SAMPLER_2D,
          GL_UNSIGNED_INT_SAMPLER_2D_ARRAY, GL_UNSIGNED_INT_SAMPLER_3D, GL_UNSIGNED_INT_SAMPLER_BUFFER})
      if (type == sampler) return "sampler";
    return "";
  }

  GLuint program_ = 0;
};

class Survey {
 public:
  // With `driver`, each program is linked, too; a context is current then.
  Survey(const std::string& graph, std::vector<std::string> presets, const std::string& scene,
         bool driver = false)
      : driver_(driver),
        sources_(runtime::shaderRootsOf(std::vector<std::string>{kSources + graph}, WEFT_SOURCE_DIR)) {
    text::Diagnostics diagnostics;
    auto loaded = scene::loadScene(kSources + scene, diagnostics);
    REQUIRE_MESSAGE(loaded.has_value(), diagnostics.text());
    registry_ = runtime::makeRegistry({}, imports::World(std::move(*loaded)).facts());
    desc_ = graph::readGraph(kSources + graph, diagnostics, {.presets = presets});
    REQUIRE_MESSAGE(desc_, diagnostics.text());
  }

  // Null where the variation has no plan; the errors are another test's matter.
  std::shared_ptr<const graph::FlatGraph> measure(const Variation& variation, Row& row) {
    text::Diagnostics diagnostics;
    graph::Settings settings;
    settings.sets = variation.sets;
    settings.disables = variation.disables;
    const auto flat = graph::expandGraph(*desc_, registry_, settings, diagnostics);
    if (!flat || diagnostics.hasErrors()) return nullptr;
    const graph::Plan plan = graph::compile(flat);
    ++row.plans;
    for (const graph::Step& step : plan.steps) {
      const graph::PassSpec& spec = flat->specs[step.pass];
      const auto type = std::ranges::find(registry_.passTypes, spec.type, &graph::PassType::name);
      REQUIRE(type != registry_.passTypes.end());
      take(runtime::programRequestOf(*flat, plan, step.pass, *type), row);
    }
    return flat;
  }

 private:
  void take(const gl::ProgramRequest& request, Row& row) {
    std::string key;
    for (const auto& stage : request.stages) key += stage.file + " ";
    for (const glsl::Define& define : request.defines) key += define.name + "=" + define.value + " ";
    const bool fresh = row.programs.insert(key).second;
    if (!fresh || request.stages.empty()) return;
    text::Diagnostics diagnostics;
    std::vector<gl::StageSource> stages;
    for (const auto& stage : request.stages)
      stages.push_back({stage.stage, stage.text.empty()
                                         ? sources_.load(stage.file, diagnostics)
                                         : sources_.loadText(stage.text, stage.file, diagnostics)});
    REQUIRE_MESSAGE(!diagnostics.hasErrors(), diagnostics.text());
    const gl::test::ProgramNeeds needs = gl::test::needsOf(stages, request.defines);
    row.locations.raise(needs.locations, request.pass);
    row.components.raise(needs.components, request.pass);
    row.samplers.raise(needs.samplers, request.pass);
    row.together.raise(needs.together, request.pass);
    if (driver_) askDriver(stages, request);
    const auto excess = gl::test::excessOf(needs, gl::test::kMinDevice);
    row.beyond += excess.has_value();
    CHECK_MESSAGE(!excess,
                  fmt::format("'{}' needs {} {}, of {}: {}", request.pass, excess ? excess->needed : 0,
                              excess ? excess->what : "", excess ? excess->allowed : 0, key));
  }

  static void askDriver(const std::vector<gl::StageSource>& stages, const gl::ProgramRequest& request) {
    for (const gl::StageSource& stage : stages) {
      const gl::test::StageNeeds counted = gl::test::needsOf(stage, request.defines);
      const gl::test::ProgramNeeds active =
          Linked(stage.stage, glsl::assembleSource(*stage.source, request.defines)).needs(stage.stage);
      CAPTURE(request.pass);
      // Of varyings the device's limits alone are asked: linked alone, a stage keeps inputs that it does not read.
      CHECK(active.samplers <= counted.samplers);
      CHECK(active.together <= counted.images + counted.storageBlocks + counted.outputs);
      CHECK(!gl::test::excessOf(active, gl::test::kMinDevice));
    }
  }

  const bool driver_;
  glsl::SourceLoader sources_;
  graph::Registry registry_;
  std::shared_ptr<const graph::GraphDesc> desc_;
};

// Each value of each parameter that chooses between programs, and each pass disabled.
std::vector<Variation> variationsOf(const graph::FlatGraph& flat) {
  std::vector<Variation> found;
  for (const graph::ParameterSpec& parameter : flat.parameters) {
    if (!parameter.structural && !parameter.desc.define) continue;
    if (parameter.desc.type == graph::ParameterDesc::Type::boolean)
      found.push_back({{{parameter.path, parameter.value.v[0] != 0 ? "false" : "true"}}, {}});
    if (parameter.desc.type == graph::ParameterDesc::Type::choice)
      for (const std::string& choice : parameter.desc.choices)
        found.push_back({{{parameter.path, choice}}, {}});
  }
  std::set<std::string> passes;
  for (const graph::PassSpec& spec : flat.specs) passes.insert(spec.declared);
  for (const std::string& pass : passes) found.push_back({{}, {graph::Disable(pass)}});
  return found;
}

void survey(const std::string& graph, const std::vector<std::string>& presets, Row& row) {
  const char* all = std::getenv("WEFT_ALL_VARIANTS");
  const bool pairs = all && *all == '1';
  for (const char* scene : {"tests/runtime/scenes/everything.json", "scenes/spheres.json"}) {
    Survey bench(graph, presets, scene);
    const auto flat = bench.measure({}, row);
    if (!flat) continue;  // a part, whose inputs only an includer binds
    const std::vector<Variation> variations = variationsOf(*flat);
    for (std::size_t i = 0; i < variations.size(); ++i) {
      bench.measure(variations[i], row);
      for (std::size_t j = i + 1; pairs && j < variations.size(); ++j) {
        Variation both = variations[i];
        both.sets.insert(both.sets.end(), variations[j].sets.begin(), variations[j].sets.end());
        both.disables.insert(both.disables.end(), variations[j].disables.begin(),
                             variations[j].disables.end());
        bench.measure(both, row);
      }
    }
  }
}

std::vector<std::string> filesIn(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(kSources + folder))
    if (entry.path().extension() == ".json") files.push_back(folder + "/" + entry.path().filename().string());
  std::ranges::sort(files);
  return files;
}

}  // namespace

TEST_CASE("needs: no program of a bundled graph asks for more than OpenGL 4.5 promises") {
  std::string table =
      fmt::format("{:<28} plans programs beyond  locations components samplers together\n", "graph");
  std::size_t surveyed = 0;
  const auto add = [&](const std::string& name, const Row& row) {
    if (row.plans == 0) return;
    ++surveyed;
    table += fmt::format("{:<28} {:5} {:8} {:6}  {:9} {:10} {:8} {:8}  {}\n", name, row.plans,
                         row.programs.size(), row.beyond, row.locations.figure, row.components.figure,
                         row.samplers.figure, row.together.figure, row.locations.pass);
  };
  for (const std::string& graph : filesIn("graphs")) {
    Row row;
    survey(graph, {}, row);
    add(graph, row);
  }
  Row presets;
  for (const std::string& preset : filesIn("graphs/presets"))
    survey(preset.ends_with("/point_probes.json") ? "graphs/studio_gi.json" : "graphs/studio.json",
           {kSources + preset}, presets);
  add("graphs/presets", presets);
  MESSAGE(table);
  CHECK(surveyed >= 8);
}

TEST_CASE("needs: a driver finds no more active than is counted") {
  text::Diagnostics diagnostics;
  const auto context = gl::createContext({.backend = gl::test::wantedBackend()}, diagnostics);
  REQUIRE_MESSAGE(context, diagnostics.text());
  std::size_t programs = 0;
  for (const std::string& graph : filesIn("graphs")) {
    Row row;
    Survey(graph, {}, "tests/runtime/scenes/everything.json", true).measure({}, row);
    programs += row.programs.size();
  }
  MESSAGE(programs << " programs");
  CHECK(programs >= 100);
}

TEST_CASE("needs: what is counted, by hand") {
  glsl::SourceLoader loader({});
  text::Diagnostics diagnostics;
  const auto needsOf = [&](GLenum stage, const std::string& text, std::vector<glsl::Define> defines = {}) {
    return gl::test::needsOf(gl::StageSource{stage, loader.loadText(text, "<text>", diagnostics)}, defines);
  };
  const std::string kText = R"(
struct Pair { vec3 a; float b[2]; };
const int kMaps = 2 + 2;
in vec2 uv;
flat in mat3 turn;
flat in Pair pair;
in vec4 unused;
#ifdef HAS_MORE
in vec3 more, most;
#endif
uniform sampler2D maps[kMaps];
uniform sampler2DShadow shadow, other;
layout(rgba8) uniform image2D target;
layout(std430) readonly buffer rows { vec4 row[]; };
layout(std430) buffer named { float value; } instances[3];
uniform Parameters { float gain; };
out vec4 result;
out uint id;
vec4 lost() { return unused + texture(other, vec3(0.0)); }
vec4 found() { return row[0] + texture(maps[1], uv) * gain; }
void main() {
  result = found() + vec4(turn[0], pair.b[1]) + texture(shadow, vec3(0.0));
#ifdef HAS_MORE
  result.xyz += more + most;
#endif
  imageStore(target, ivec2(0), vec4(instances[1].value));
  id = 1u;
}
)";
  const gl::test::StageNeeds plain = needsOf(GL_FRAGMENT_SHADER, kText);
  CHECK(plain.locations == 1 + 3 + 3);
  CHECK(plain.components == 2 + 9 + 5);
  CHECK(plain.samplers == 4 + 1);
  CHECK(plain.images == 1);
  CHECK(plain.storageBlocks == 1 + 3);
  CHECK(plain.outputs == 2);
  CHECK(needsOf(GL_FRAGMENT_SHADER, kText, {{"HAS_MORE", "1"}}).components == 16 + 6);
  const gl::test::StageNeeds vertex =
      needsOf(GL_VERTEX_SHADER,
              "out Block { vec3 at; flat int row; } made;\nin vec3 position;\nout vec2 uv;\n"
              "void main() { made.at = position; made.row = 1; uv = vec2(0); }\n");
  CHECK(vertex.locations == 3);
  CHECK(vertex.components == 6);
}
