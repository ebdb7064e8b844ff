#include <doctest/doctest.h>

#include "engine/gl/programs/program.h"
#include "tests/gl/documented.h"
#include "tests/gl/gl_test.h"
#include "tests/skip.h"
#include "tests/temporary_folder.h"

using namespace weft::gl;
using namespace weft::glsl;
using weft::gl::test::CleanScope;
using weft::text::Code;
using weft::text::Diagnostics;
using weft::text::Severity;

namespace {

constexpr const char* kTriangle =
    "out vec2 uv;\nvoid main() { uv = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2); gl_Position = vec4(uv * "
    "2 - 1, 0, 1); }\n";

std::optional<Program> compileText(std::vector<std::pair<GLenum, std::string>> stages,
                                   Diagnostics& diagnostics, std::vector<Define> defines = {},
                                   std::vector<std::string> outputs = {}) {
  SourceLoader loader({});
  std::vector<StageSource> sources;
  for (const auto& [stage, text] : stages)
    sources.push_back({stage, loader.loadText(text, "<test>", diagnostics)});
  return Program::compile(sources, defines, outputs, "test program", diagnostics);
}

}  // namespace

TEST_CASE("units and bindings are assigned by name, and hold after a binary was loaded") {
  CleanScope clean;
  Diagnostics diagnostics;
  auto program = compileText({{GL_VERTEX_SHADER, kTriangle}, {GL_FRAGMENT_SHADER, R"(
in vec2 uv;
uniform sampler2D zebra;
uniform sampler3D many[3];
uniform sampler2DShadow alpha;
layout(rgba16f) uniform writeonly image2D target_b;
layout(r32f) uniform readonly image2D target_a;
layout(std140) uniform Parameters { float threshold; vec3 tint; mat4 matrix; float weights[4]; } parameters;
layout(std140) uniform Camera { mat4 view; };
out vec4 second;
out vec4 first;
void main() {
  vec4 sum = texture(zebra, uv) + texture(many[0], uv.xyx) + texture(many[2], uv.xyx) + texture(alpha, uv.xyx);
  imageStore(target_b, ivec2(0), imageLoad(target_a, ivec2(0)));
  first = sum * parameters.threshold * parameters.weights[3];
  second = view * parameters.matrix * vec4(parameters.tint, 1);
}
)"}},
                             diagnostics, {}, {"first", "second"});
  REQUIRE_MESSAGE(program, diagnostics.text());
  std::optional<Program> loaded;
  if (const auto binary = program->binary()) {
    loaded = Program::load(*binary, false, "loaded");
    REQUIRE(loaded);
  } else {
    MESSAGE("this driver has no program binaries");
  }
  for (const Program* p : {&*program, loaded ? &*loaded : nullptr}) {
    if (!p) continue;
    const Reflection& r = p->reflection();
    REQUIRE(r.samplers.size() == 3);
    CHECK(r.samplers[0].name == "alpha");
    CHECK(r.samplers[0].type == GL_SAMPLER_2D_SHADOW);
    CHECK(r.samplers[1].name == "many");
    CHECK(r.samplers[1].arraySize == 3);
    CHECK(r.samplers[1].unit == 1);
    CHECK(r.findSampler("zebra")->unit == 4);
    GLint unit = -1;
    glGetUniformiv(p->id(), glGetUniformLocation(p->id(), "many[2]"), &unit);
    CHECK(unit == 3);
    glGetUniformiv(p->id(), r.findSampler("zebra")->location, &unit);
    CHECK(unit == 4);
    REQUIRE(r.images.size() == 2);
    CHECK(r.findImage("target_a")->unit == 0);
    CHECK(r.findImage("target_b")->unit == 1);
    REQUIRE(r.uniformBlocks.size() == 2);
    const Block* parameters = r.findUniformBlock("Parameters");
    REQUIRE(parameters);
    CHECK(r.findUniformBlock("Camera")->binding == 0);
    CHECK(parameters->binding == 1);
    CHECK(parameters->bytes == 16 + 16 + 64 + 64);
    REQUIRE(parameters->members.size() == 4);
    CHECK(parameters->find("threshold")->offset == 0);
    CHECK(parameters->find("tint")->offset == 16);
    CHECK(parameters->find("tint")->type == GL_FLOAT_VEC3);
    CHECK(parameters->find("matrix")->matrixStride == 16);
    CHECK(parameters->find("weights")->arraySize == 4);
    CHECK(parameters->find("weights")->arrayStride == 16);
    CHECK(r.findUniformBlock("Camera")->find("view")->offset == 0);
    REQUIRE(r.outputs.size() == 2);
    CHECK(r.findOutput("first")->location == 0);
    CHECK(r.findOutput("second")->location == 1);
    CHECK(r.attributes.empty());
    CHECK(r.workGroup[0] == 0);
  }
}

TEST_CASE("storage blocks give the layout of their structs") {
  CleanScope clean;
  Diagnostics diagnostics;
  auto program = compileText({{GL_COMPUTE_SHADER, R"(
layout(local_size_x = 8, local_size_y = 4) in;
struct Instance { vec3 center; float radius; vec3 previous_center; float roughness; vec3 albedo; float metallic; };
layout(std430) readonly buffer instances { Instance instance[]; };
layout(std430) buffer keys { uint total; uvec2 sort_keys[]; };
uniform int loose;
void main() {
  uint i = gl_GlobalInvocationID.x;
  sort_keys[i] = uvec2(instance[i].center.x + instance[i].radius + instance[i].previous_center.x + instance[i].roughness
    + instance[i].albedo.x + instance[i].metallic, loose);
  total = 1u;
}
)"}},
                             diagnostics);
  REQUIRE_MESSAGE(program, diagnostics.text());
  const Reflection& r = program->reflection();
  CHECK(r.workGroup[0] == 8);
  CHECK(r.workGroup[1] == 4);
  CHECK(r.workGroup[2] == 1);
  REQUIRE(r.storageBlocks.size() == 2);
  const Block* instances = r.findStorageBlock("instances");
  REQUIRE(instances);
  CHECK(instances->storage);
  CHECK(instances->binding == 0);
  const BlockMember* center = instances->find("instance[0].center");
  REQUIRE(center);
  CHECK(center->topLevelArrayStride == 48);
  CHECK(center->topLevelArraySize == 0);
  CHECK(center->type == GL_FLOAT_VEC3);
  CHECK(instances->find("instance[0].radius")->offset == 12);
  CHECK(instances->find("instance[0].metallic")->offset == 44);
  const Block* keys = r.findStorageBlock("keys");
  REQUIRE(keys);
  CHECK(keys->binding == 1);
  CHECK(keys->find("sort_keys")->arrayStride == 8);
  CHECK(keys->find("sort_keys")->arraySize == 0);
  CHECK(keys->find("sort_keys")->offset == 8);
  REQUIRE(r.looseUniforms.size() == 1);
  CHECK(r.looseUniforms[0].name == "loose");
}

TEST_CASE("compile errors stand at the true line and column of an include, all stages at once") {
  CleanScope clean;
  TemporaryFolder folder;
  folder.write(
      "bad.glsl",
      "float fine() { return 1.0; }\nfloat bad() {\n  float  x =\t 1.0;   return x + no_such_name;\n}\n");
  folder.write("x.frag.glsl",
               "#include \"bad.glsl\"\nout vec4 result;\nvoid main() { result = vec4(fine()); }\n");
  folder.write("x.vert.glsl", "void main() {\n  gl_Position = vec5(0);\n}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const StageSource stages[] = {{GL_VERTEX_SHADER, loader.load("x.vert.glsl", diagnostics)},
                                {GL_FRAGMENT_SHADER, loader.load("x.frag.glsl", diagnostics)}};
  const Define defines[] = {{"HAS_A", "1"}, {"HAS_B", "1"}};
  CHECK_FALSE(Program::compile(stages, defines, {}, "bad", diagnostics));
  bool vertex = false, fragment = false;
  for (const auto& d : diagnostics.items()) {
    CHECK(d.code == Code::shaderDoesNotCompile);
    REQUIRE(d.place.file);
    if (*d.place.file == folder.at("x.vert.glsl") && d.place.line == 2) vertex = true;
    if (*d.place.file == folder.at("bad.glsl") && d.place.line == 3 &&
        d.message.find("no_such_name") != std::string::npos) {
      fragment = true;
      CHECK(d.place.column == 33);
    }
  }
  CHECK_MESSAGE(vertex, diagnostics.text());
  CHECK_MESSAGE(fragment, diagnostics.text());
}

TEST_CASE("link errors are reported as such") {
  CleanScope clean;
  Diagnostics diagnostics;
  CHECK_FALSE(compileText(
      {{GL_VERTEX_SHADER, "out vec3 uv;\nvoid main() { uv = vec3(1); gl_Position = vec4(uv, 1); }\n"},
       {GL_FRAGMENT_SHADER, "in vec2 uv;\nout vec4 result;\nvoid main() { result = vec4(uv, 0, 1); }\n"}},
      diagnostics));
  REQUIRE(diagnostics.contains(Code::programDoesNotLink));
  CHECK(diagnostics.hasErrors());
  CHECK(diagnostics.items()[0].place.line == 1);
  CHECK(diagnostics.items()[0].place.column == 9);
  CHECK(diagnostics.items()[0].hint == "declare `out vec2 uv;` in the stage before it");
}

TEST_CASE("every code of shaders and GL has its section") {
  for (const Code code :
       {Code::unreadableShader, Code::missingShaderInclude, Code::shaderIncludeCycle, Code::malformedInclude,
        Code::shaderDoesNotCompile, Code::programDoesNotLink, Code::versionInShader, Code::noContext,
        Code::incompleteFramebuffer, Code::textureNotCreated, Code::bufferNotCreated, Code::viewNotCreated,
        Code::driverMessage})
    CHECK_MESSAGE(!weft::gl::test::sectionOf(code).empty(), weft::text::nameOf(code));
}

namespace {

// Programs that do not compile and do not link, from files of tests/bad_shaders.
Diagnostics compileBroken() {
  SourceLoader loader({"tests/bad_shaders"});
  Diagnostics diagnostics;
  const StageSource undeclared[] = {
      {GL_VERTEX_SHADER, loader.loadText(kTriangle, "<triangle>", diagnostics)},
      {GL_FRAGMENT_SHADER, loader.load("w104_undeclared.frag.glsl", diagnostics)}};
  CHECK_FALSE(Program::compile(undeclared, {}, {}, "undeclared", diagnostics));
  const StageSource semicolon[] = {
      {GL_VERTEX_SHADER, loader.loadText(kTriangle, "<triangle>", diagnostics)},
      {GL_FRAGMENT_SHADER, loader.load("w104_semicolon.frag.glsl", diagnostics)}};
  CHECK_FALSE(Program::compile(semicolon, {}, {}, "semicolon", diagnostics));
  const StageSource unlike[] = {{GL_VERTEX_SHADER, loader.load("w105_interface.vert.glsl", diagnostics)},
                                {GL_FRAGMENT_SHADER, loader.load("w105_interface.frag.glsl", diagnostics)}};
  CHECK_FALSE(Program::compile(unlike, {}, {}, "unlike", diagnostics));
  return diagnostics;
}

}  // namespace

TEST_CASE("broken shaders give their codes, at their lines") {
  CleanScope clean;
  const Diagnostics diagnostics = compileBroken();
  for (const weft::text::Diagnostic& d : diagnostics.items())
    if (d.code == Code::shaderDoesNotCompile) CHECK_MESSAGE(d.place.line > 0, weft::text::format(d));
  CHECK(diagnostics.contains(Code::shaderDoesNotCompile));
  CHECK(diagnostics.contains(Code::programDoesNotLink));
}

TEST_CASE("defines select code") {
  CleanScope clean;
  Diagnostics diagnostics;
  const std::vector<std::pair<GLenum, std::string>> stages{
      {GL_VERTEX_SHADER, kTriangle},
      {GL_FRAGMENT_SHADER,
       "#ifdef HAS_BLOOM\nuniform sampler2D bloom;\n#endif\nin vec2 uv;\nout vec4 result;\nvoid main() {\n"
       "  result = vec4(uv, 0, 1);\n#ifdef HAS_BLOOM\n  result += texture(bloom, uv);\n#endif\n}\n"}};
  const auto without = compileText(stages, diagnostics);
  const auto with = compileText(stages, diagnostics, {{"HAS_BLOOM", "1"}});
  REQUIRE(without);
  REQUIRE(with);
  CHECK(without->reflection().samplers.empty());
  CHECK(with->reflection().findSampler("bloom"));
}

TEST_CASE("a binary of another format or with damaged bytes is refused in silence" *
          doctest::test_suite("binaries")) {
  CleanScope clean;
  Diagnostics diagnostics;
  const auto program = compileText(
      {{GL_VERTEX_SHADER, kTriangle},
       {GL_FRAGMENT_SHADER, "in vec2 uv;\nout vec4 result;\nvoid main() { result = vec4(uv, 0, 1); }\n"}},
      diagnostics);
  REQUIRE(program);
  auto binary = program->binary();
  if (!binary)
    return weft::test::skipCase(
        "the driver offers no program binaries; Mesa offers them with its shader cache on");
  ProgramBinary foreign = *binary;
  foreign.format = 0x1234;
  CHECK_FALSE(Program::load(foreign, false, "foreign"));
  ProgramBinary damaged = *binary;
  damaged.bytes.resize(damaged.bytes.size() / 2);
  CHECK_FALSE(Program::load(damaged, false, "damaged"));
}

TEST_CASE("types have names and shapes") {
  CHECK(glslTypeName(GL_FLOAT_MAT4) == "mat4");
  CHECK(glslTypeName(GL_UNSIGNED_INT_SAMPLER_2D) == "usampler2D");
  CHECK(glslTypeName(GL_IMAGE_CUBE_MAP_ARRAY) == "imageCubeArray");
  CHECK(shapeOf(GL_UNSIGNED_INT_VEC2)->rows == 2);
  CHECK(shapeOf(GL_UNSIGNED_INT_VEC2)->base == GL_UNSIGNED_INT);
  CHECK(shapeOf(GL_FLOAT_MAT4x3)->columns == 4);
  CHECK_FALSE(shapeOf(GL_SAMPLER_2D));
}

TEST_CASE("a clamped shader reads and writes only what its work group shares") {
  CleanScope clean;
  constexpr const char* kBefore = R"(
layout(local_size_x = 8) in;
struct Record { float list[2]; };
shared float table[8];
shared uint counts[8];
shared vec2 pairs[8];
shared Record records[8];
#define ALIAS table
layout(std430) buffer Out { float result[8]; };
layout(std140) uniform Far { int far; };
void main() {
  int me = int(gl_LocalInvocationIndex);
  table[me] = float(me);
  counts[me] = uint(me);
  pairs[me] = vec2(me, 10.0);
  records[me].list[0] = 1.0;
  records[me].list[1] = float(me);
  barrier();
  result[me] = )";
  for (const auto& [value, expected] : std::vector<std::pair<std::string, float>>{
           {"table[far]", 7},
           {"ALIAS[me * far + far]", 7},
           {"(table)[far]", 7},
           {"float(atomicOr(counts[far], 0u))", 7},
           {"pairs[0][far]", 10},
           {"records[far].list[far]", 7},
           {"0.0; barrier(); table[far] = 3.0; barrier(); result[me] = table[7]", 3}}) {
    CAPTURE(value);
    Diagnostics diagnostics;
    SourceLoader loader({});
    const StageSource stage{GL_COMPUTE_SHADER,
                            loader.loadText(kBefore + value + ";\n}\n", "<test>", diagnostics), true};
    const auto program = Program::compile({&stage, 1}, {}, {}, "far", diagnostics);
    REQUIRE_MESSAGE(program, diagnostics.text());
    GLuint buffers[2] = {};
    const GLint far[4] = {100'000'000, 0, 0, 0};
    const float zeros[8] = {};
    glCreateBuffers(2, buffers);
    glNamedBufferStorage(buffers[0], sizeof zeros, zeros, 0);
    glNamedBufferStorage(buffers[1], sizeof far, far, 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, buffers[0]);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, buffers[1]);
    glUseProgram(program->id());
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    float results[8] = {};
    glGetNamedBufferSubData(buffers[0], 0, sizeof results, results);
    for (const float result : results) CHECK(result == expected);
    glUseProgram(0);
    glDeleteBuffers(2, buffers);
  }
}
