// What a shader declares and uses, in all branches and in one variant.
#include "engine/glsl/interface.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <string>

using namespace weft::glsl;

namespace {

constexpr const char* kText = R"(
// uniform sampler2D commented;
#define DECLARE(type, name) uniform type name;
#define GAIN 2.0
precision highp float;
uniform sampler2D source, mask;
uniform sampler2D maps[4];
layout(std140) uniform Parameters {
  float gain, bias;
  layout(offset = 16) vec3 weights[4];
};
layout(std140) uniform View { float time; } view;
layout(std430) readonly buffer keys { uvec2 items[]; } sorted;
layout(rgba8) writeonly uniform image2D picture;
DECLARE(sampler2D, made)
in vec2 uv;
layout(location = 0) out vec4 result;
struct Light { vec3 color; };
const float strength = 0.5, table[2] = float[2](1.0, 2.0);
float later(float x);
vec4 tone(in vec4 color, const float amount) { return color * amount; }
float unused() { return bias; }
void main() {
  vec4 texel = texture(source, uv) * gain;
  for (int i = 0; i < 4; ++i) { texel += vec4(i); }
  result = tone(texel, strength * GAIN);
}
)";

std::vector<std::string> typesOf(const Interface& interface, std::string_view owner) {
  std::vector<std::string> types;
  for (const Declaration& each : interface.declarations)
    if (each.owner == owner)
      types.push_back(std::string(each.type) + each.array + " " + std::string(each.name));
  return types;
}

}  // namespace

TEST_CASE("each name of a shader has the role that its declaration gives it") {
  const Interface interface = readInterface(kText, {}, Branches::all);
  CHECK_FALSE(interface.unsure);
  for (const auto& [name, role] : std::initializer_list<std::pair<const char*, Role>>{
           {"source", Role::sampler},     {"mask", Role::sampler},   {"maps", Role::sampler},
           {"made", Role::sampler},       {"picture", Role::image},  {"Parameters", Role::uniform_block},
           {"gain", Role::member},        {"bias", Role::member},    {"weights", Role::member},
           {"View", Role::uniform_block}, {"time", Role::member},    {"keys", Role::storage_block},
           {"items", Role::member},       {"uv", Role::input},       {"result", Role::output},
           {"Light", Role::structure},    {"color", Role::field},    {"strength", Role::constant},
           {"table", Role::constant},     {"later", Role::function}, {"tone", Role::function},
           {"main", Role::function},      {"texel", Role::variable}, {"amount", Role::variable},
       }) {
    const Declaration* found = interface.find(name);
    REQUIRE_MESSAGE(found, std::string(name));
    CHECK_MESSAGE(found->role == role, std::string(name));
  }
  for (const char* name : {"commented", "texture", "float", "x", "view"})
    CHECK_MESSAGE(!interface.find(name), std::string(name));
  CHECK(typesOf(interface, "Parameters") ==
        std::vector<std::string>{"float gain", "float bias", "vec3[4] weights"});
  CHECK(interface.find("View")->instance == "view");
  CHECK(interface.find("time")->instance == "view");
  CHECK(interface.find("maps")->elements == 4);
  CHECK(interface.find("items")->elements == 0);
  CHECK(interface.find("table")->elements == 2);
  const Declaration& picture = *interface.find("picture");
  CHECK(std::ranges::find(picture.layout, "rgba8") != picture.layout.end());
  CHECK_FALSE(picture.reads);
  CHECK(picture.writes);
  CHECK(picture.at.line == 14);
}

TEST_CASE("sizes of an array stand behind the type, behind the name, or behind both") {
  const Interface interface = readInterface(R"(
const int N = 2;
layout(std140) uniform Parameters { vec4[4] weights; float[2] a, b[3]; vec3[N + 1][2] table; vec2 plain; };
void main() {}
)",
                                            {});
  CHECK(typesOf(interface, "Parameters") == std::vector<std::string>{"vec4[4] weights", "float[2] a",
                                                                     "float[3][2] b", "vec3[N+1][2] table",
                                                                     "vec2 plain"});
  CHECK(interface.find("b")->elements == 6);
  CHECK(interface.find("table")->elements == 6);
}

TEST_CASE("a variant knows what its macros make, which branches are taken, and what main() reaches") {
  const Interface whole = readInterface(kText, {});
  CHECK(whole.find("made", Role::sampler));
  CHECK(whole.isLive("gain"));
  CHECK(whole.isLive("tone"));
  CHECK(whole.isLive("strength"));
  CHECK_FALSE(whole.isLive("bias"));
  CHECK_FALSE(whole.isLive("mask"));
  const std::string branches = R"(
#if MODE == MODE_A
layout(rgba16f) writeonly uniform image2D result;
#else
layout(rgba8) writeonly uniform image2D result;
#endif
#ifdef HAS_MASK
uniform sampler2D mask;
#endif
layout(std140) uniform Parameters {
#ifdef HAS_GAIN
  float gain;
#endif
  float bias;
};
void main() { imageStore(result, ivec2(0), vec4(bias)); }
)";
  const Interface all = readInterface(branches, {}, Branches::all);
  CHECK(all.find("mask", Role::sampler));
  CHECK(all.find("gain", Role::member));
  const Define defines[] = {{"MODE", "1"}, {"MODE_A", "0"}, {"HAS_GAIN", "1"}};
  const Interface one = readInterface(branches, defines);
  CHECK_FALSE(one.find("mask"));
  CHECK(typesOf(one, "Parameters").size() == 2);
  CHECK(one.find("result", Role::image)->layout.front() == "rgba8");
}

TEST_CASE("what a macro stands for is declared where the macro stands") {
  const std::string text =
      "#define SLOT sampler2D source\n#define MAP(n) sampler2D n##_map\n#define T vec2\n#define STRENGTH "
      "strength\n"
      "#if A\nuniform SLOT;\nuniform MAP(color);\n#endif\nin T uv;\nvoid main() { float strength = 1.0; }\n";
  const Interface interface = readInterface(text, {}, Branches::all);
  CHECK(interface.find("source", Role::sampler));
  CHECK(interface.find("color_map", Role::sampler));
  CHECK(interface.find("uv", Role::input));
  CHECK(interface.find("strength")->role == Role::variable);
}

TEST_CASE("a text that is not read whole leaves everything open") {
  CHECK(readInterface("#if A\nvoid main() {\n#else\nvoid main() { float a;\n#endif\n}\n", {}, Branches::all)
            .unsure);
  CHECK(readInterface("void main() {} }", {}).unsure);
  CHECK(readInterface("void main() {} float a", {}).isLive("whatever"));
  CHECK_FALSE(readInterface("void main() { vec2 a[2] = { vec2(0), vec2(1) }; if (true) { } }", {}).unsure);
}
