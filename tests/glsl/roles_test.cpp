// What names are in the text of a shader, in all branches and in one variant.
#include "engine/glsl/roles.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "engine/glsl/source.h"

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

bool isOnly(const ShaderRoles& roles, std::string_view name, Role role) {
  const auto found = roles.roles.find(name);
  return found != roles.roles.end() && found->second == static_cast<std::uint16_t>(role);
}

}  // namespace

TEST_CASE("each name of a shader has the role that its declaration gives it") {
  const ShaderRoles roles = rolesIn(kText);
  CHECK_FALSE(roles.unsure);
  for (const auto& [name, role] : std::initializer_list<std::pair<const char*, Role>>{
           {"source", Role::opaque},
           {"mask", Role::opaque},
           {"maps", Role::opaque},
           {"picture", Role::opaque},
           {"Parameters", Role::uniform_block},
           {"gain", Role::parameter},
           {"bias", Role::parameter},
           {"weights", Role::parameter},
           {"View", Role::uniform_block},
           {"time", Role::member},
           {"view", Role::instance},
           {"keys", Role::storage_block},
           {"items", Role::member},
           {"uv", Role::input},
           {"result", Role::output},
           {"Light", Role::structure},
           {"strength", Role::constant},
           {"table", Role::constant},
           {"later", Role::function},
           {"tone", Role::function},
           {"main", Role::function},
           {"texel", Role::variable},
           {"amount", Role::variable},
       })
    CHECK_MESSAGE(isOnly(roles, name, role), std::string(name));
  // A macro may declare what it is given.
  CHECK(roles.maybe("made", Role::opaque));
  CHECK(roles.maybe("made", Role::output));
  for (const char* name : {"commented", "color", "texture", "float", "x"})
    CHECK_MESSAGE(!roles.is(name, Role::opaque), std::string(name));
  REQUIRE(roles.parameters.size() == 3);
  CHECK(roles.parameters[0].type == "float");
  CHECK(roles.parameters[2].name == "weights");
  CHECK(roles.parameters[2].type == "vec3[4]");
  CHECK(nameOfRole(roles.roles.find("uv")->second) == "an input");
}

TEST_CASE("sizes of an array stand behind the type, behind the name, or behind both") {
  const ShaderRoles roles = rolesIn(R"(
layout(std140) uniform Parameters { vec4[4] weights; float[2] a, b[3]; vec3[N + 1][2] table; vec2 plain; };
void main() {}
)",
                                    {});
  std::vector<std::string> found;
  for (const ShaderRoles::Member& member : roles.parameters) found.push_back(member.type + " " + member.name);
  CHECK(found == std::vector<std::string>{"vec4[4] weights", "float[2] a", "float[3][2] b",
                                          "vec3[N+1][2] table", "vec2 plain"});
}

TEST_CASE("a variant knows what its macros make, which branches are taken, and what main() reaches") {
  const ShaderRoles roles = rolesIn(kText, {});
  CHECK(isOnly(roles, "made", Role::opaque));
  CHECK(roles.reachable.contains("gain"));
  CHECK(roles.reachable.contains("tone"));
  CHECK_FALSE(roles.reachable.contains("bias"));
  constexpr const char* kBranches = R"(
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
  const ShaderRoles all = rolesIn(kBranches);
  CHECK(all.is("mask", Role::opaque));
  CHECK(all.is("gain", Role::parameter));
  CHECK(all.imageFormats.at("result").size() == 2);
  const Define defines[] = {{"MODE", "1"}, {"MODE_A", "0"}, {"HAS_GAIN", "1"}};
  const ShaderRoles one = rolesIn(kBranches, defines);
  CHECK_FALSE(one.is("mask", Role::opaque));
  CHECK(one.parameters.size() == 2);
  CHECK(one.imageFormats.at("result") == std::vector<std::string>{"rgba8"});
}

TEST_CASE("what a macro stands for is declared where the macro stands") {
  const ShaderRoles roles = rolesIn(
      "#define SLOT sampler2D source\n#define MAP(n) sampler2D n##_map\n#define T vec2\n#define STRENGTH "
      "strength\n"
      "#if A\nuniform SLOT;\nuniform MAP(color);\n#endif\nin T uv;\nvoid main() { float strength = 1.0; }\n");
  CHECK(roles.maybe("source", Role::opaque));
  CHECK(roles.maybe("color", Role::opaque));
  CHECK_FALSE(roles.maybe("uv", Role::opaque));
  CHECK_FALSE(roles.maybe("strength", Role::parameter));
}

TEST_CASE("brackets that do not pair leave everything open") {
  const ShaderRoles roles = rolesIn("#if A\nvoid main() {\n#else\nvoid main() { float a;\n#endif\n}\n");
  CHECK(roles.unsure);
  CHECK(roles.maybe("whatever", Role::output));
  CHECK_FALSE(rolesIn("void main() { vec2 a[2] = { vec2(0), vec2(1) }; if (true) { } }").unsure);
}
