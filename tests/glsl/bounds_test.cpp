#include "engine/glsl/bounds.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <set>

#include "tests/gl/documented.h"

using namespace weft::glsl;
using weft::base::Code;
using weft::base::Diagnostics;
using weft::base::Limit;
namespace fs = std::filesystem;

namespace {

std::string times(const std::string& text, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += text;
  return all;
}

// "#define M1 M0+M0", "#define M2 M1+M1" …: `line` with $ for the number and % for the one before.
std::string chain(const std::string& line, int count) {
  std::string all;
  for (int i = 1; i <= count; ++i)
    for (const char c : line + "\n")
      all += c == '$' ? std::to_string(i) : c == '%' ? std::to_string(i - 1) : std::string(1, c);
  return all;
}

struct Measured {
  std::shared_ptr<const ShaderSource> source;
  ShaderSize size;
  Diagnostics diagnostics;
  bool good = false;
};

Measured measure(const std::string& text, const std::vector<Define>& defines = {}) {
  SourceLoader loader({std::string(WEFT_SOURCE_DIR) + "/shaders"});
  Measured m;
  m.source = loader.loadText(text, "bomb.frag.glsl", m.diagnostics);
  REQUIRE_MESSAGE(m.source, m.diagnostics.text());
  m.size = measureShader(*m.source, defines);
  m.good = checkShaderSize(m.size, *m.source, m.diagnostics);
  return m;
}

std::string inMain(const std::string& body) {
  return "out vec4 result;\nvoid main() {\n" + body + "\n}\n";
}

// Which limit a message is about.
Limit limitOf(const std::string& message) {
  const auto has = [&](const char* words) { return message.find(words) != std::string::npos; };
  if (has("nested too deeply")) return Limit::shader_depth;
  if (has("too many cases")) return Limit::shader_cases;
  if (has("array")) return Limit::shader_array;
  return has("the shader is too large") ? Limit::shader_bytes : Limit::shader_tokens;
}

void refuses(const std::string& text, const std::string& message, std::uint32_t line) {
  const Measured m = measure(text);
  CHECK_FALSE(m.good);
  CHECK(isUnusual(m.size));
  bool found = false;
  for (const auto& d : m.diagnostics.items())
    if (d.code == Code::shaderTooLarge && d.message.find(message) != std::string::npos) {
      found = true;
      CHECK_MESSAGE(d.place.line == line, weft::base::format(d));
      CHECK(*d.place.file == "bomb.frag.glsl");
      const Limit limit = limitOf(message);
      CHECK(d.expected.starts_with("at most " + std::to_string(weft::base::limitOf(limit)) + " "));
      CHECK_FALSE(d.found.empty());
      CHECK(d.hint.find("--limit " + std::string(weft::base::nameOf(limit)) + "=") != std::string::npos);
    }
  CHECK_MESSAGE(found, message << "\n" << m.diagnostics.text());
}

}  // namespace

TEST_CASE("what kills or stalls a driver is reported with its place instead of being compiled") {
  refuses(inMain("float a = 1.0;\nresult = vec4(" + times("a + ", 100000) + "a);"), "nested too deeply", 4);
  refuses(inMain("result = vec4(" + times("(", 3000) + "1.0" + times(")", 3000) + ");"), "nested too deeply",
          3);
  refuses(inMain("result = vec4(" + times("true ? 1.0 : ", 3000) + "1.0);"), "nested too deeply", 3);
  refuses(inMain("result = vec4(" + times("-", 3000) + "1.0);"), "nested too deeply", 3);
  refuses(inMain(times("{", 3000) + times("}", 3000)), "nested too deeply", 3);
  refuses(inMain(times("if (true) ", 3000) + "result = vec4(1.0);"), "nested too deeply", 3);
  refuses(inMain(times("if (result.x > 1.0) result = vec4(1.0); else ", 3000) + "result = vec4(1.0);"),
          "nested too deeply", 3);
  refuses("#define F(x) x\n" + inMain("result = vec4(" + times("F(", 600) + "1.0" + times(")", 600) + ");"),
          "macro 'F' expands to too much", 4);
  refuses("#if " + times("(", 3000) + "1" + times(")", 3000) + "\n#endif\n" + inMain(""), "nested too deeply",
          1);
  refuses("#define M0 a\n" + chain("#define M$ M%+M%", 24) + inMain("float a = 1.0;\nresult = vec4(M24);"),
          "macro 'M24' expands to too much", 29);
  refuses("#define M0(x) x\n" + chain("#define M$(x) M%(x) M%(x)", 40) + inMain("M40()"),
          "macro 'M40' expands to too much", 44);
  refuses("#define D(x) x x\n" + inMain(times("D(", 30) + "{}" + times(")", 30)),
          "macro 'D' expands to too much", 4);
  refuses("float f0(float x) { return x; }\n" +
              chain("float f$(float x) { return f%(x) + f%(x + 1.0); }", 24) +
              inMain("result = vec4(f24(1.0));"),
          "the function 'main' is too long", 27);
  refuses("float f0(float x) { return x; }\n" + chain("float f$(float x) { return f%(x); }", 1000) +
              inMain("result = vec4(f1000(1.0));"),
          "the function 'main' is too long", 1003);
  refuses(times("// nothing\n", 100000) + inMain("result = vec4(1.0);"), "the shader is too large", 0);
  std::string cases;
  for (int i = 0; i < 20000; ++i) cases += "case " + std::to_string(i) + ": result = vec4(1.0); break;\n";
  refuses(inMain("switch (int(result.x)) {\n" + cases + "}"), "a switch has too many cases", 3);
}

TEST_CASE("the message is that of docs/errors.md") {
  SourceLoader loader({"tests/bad_shaders"});
  Diagnostics diagnostics;
  const auto source = loader.load("w203_doubling.frag.glsl", diagnostics);
  REQUIRE_MESSAGE(source, diagnostics.text());
  CHECK_FALSE(checkShaderSize(measureShader(*source, {}), *source, diagnostics));
  weft::gl::test::checkDocumented(diagnostics, Code::shaderTooLarge);
}

TEST_CASE("arrays are counted where they are declared, blocks aside") {
  refuses(inMain("float a[100000];\na[int(result.x)] = 1.0;"), "the array 'a' is too large", 3);
  refuses("const int kHigh = 300;\n#define WIDE (kHigh * 4)\n" +
              inMain("vec3 b = vec3(0.0), c[kHigh][WIDE + 1];"),
          "the array 'c' is too large", 5);
  refuses("float[200][200] a;\n" + inMain(""), "the array 'a' is too large", 1);
  refuses(
      "struct S0 { float a, b; };\n" + chain("struct S$ { S% a; S% b[2]; };", 10) + inMain("const S10 s;"),
      "the array 's' is too large", 14);
  refuses(inMain("for (float a[100000], b = 0.0; b < 1.0; ++b) {}\n"), "the array 'a' is too large", 3);
  refuses(inMain("if (result.x > 1.0) float a[100000];"), "the array 'a' is too large", 3);
  refuses(inMain("switch (1) {\ncase 0:\n  float a[100000];\n}"), "the array 'a' is too large", 5);
  refuses("const float kTable[] = float[](" + times("1.0, ", 5000) + "1.0);\n" + inMain(""),
          "an array is too large", 1);
  refuses("const float kTable[] = {" + times("1.0, ", 5000) + "1.0};\n" + inMain(""), "an array is too large",
          1);
  for (const char* block : {"buffer", "uniform"}) {
    const Measured m =
        measure("layout(std430) " + std::string(block) + " Table { float a[100000]; vec4 b[]; } t;\n" +
                inMain("float a[4], c = t.a[70000];"));
    CHECK_MESSAGE(m.good, m.diagnostics.text());
    CHECK(m.size.array.count == 4);
    CHECK_FALSE(isUnusual(m.size));
  }
  const Measured row = measure("struct Row { float a[50000]; };\nbuffer Table { Row rows[100]; };\n" +
                               inMain("float x = rows[5000].a[70000];"));
  CHECK_MESSAGE(row.good, row.diagnostics.text());
  const Measured unknown = measure(inMain("float a[gl_MaxDrawBuffers];"));
  CHECK(unknown.good);
  CHECK(unknown.size.uncertain);
  CHECK(isUnusual(unknown.size));
}

TEST_CASE("many small arrays or switches are unusual, and allowed") {
  const Measured arrays = measure(inMain(times("{ float a[100]; a[int(result.x)] = 1.0; }\n", 11)));
  CHECK_MESSAGE(arrays.good, arrays.diagnostics.text());
  CHECK(arrays.size.allElements == 1100);
  CHECK(isUnusual(arrays.size));
  CHECK_FALSE(isUnusual(measure(inMain(times("{ float a[100]; a[int(result.x)] = 1.0; }\n", 9))).size));
  const std::string few = "switch (int(result.x)) {" + times("case 1: break;", 41) + "}\n";
  CHECK(isUnusual(measure(inMain(times(few, 10))).size));
  CHECK_FALSE(isUnusual(measure(inMain(times(few, 9))).size));
}

TEST_CASE("what is not compiled is not counted, and what only the driver knows is") {
  const std::string bomb = "float f() { return " + times("1.0 + ", 20000) + "1.0; }\n";
  CHECK(measure("#if 0\n" + bomb + "#endif\n" + inMain("")).good);
  CHECK(measure("#ifdef HAS_BOMB\n" + bomb + "#endif\n" + inMain("")).good);
  CHECK_FALSE(measure("#ifdef HAS_BOMB\n" + bomb + "#endif\n" + inMain(""), {{"HAS_BOMB", "1"}}).good);
  CHECK_FALSE(
      measure("#if defined(HAS_BOMB) && N * 2 >= 6 && __VERSION__ == 450\n" + bomb + "#endif\n" + inMain(""),
              {{"HAS_BOMB", "1"}, {"N", "3"}})
          .good);
  CHECK(
      measure("#if N == 2\n" + bomb + "#elif N == 3\n#else\n" + bomb + "#endif\n" + inMain(""), {{"N", "3"}})
          .good);
  CHECK_FALSE(
      measure("#if N == 2\n#elif N == 3\n#else\n" + bomb + "#endif\n" + inMain(""), {{"N", "4"}}).good);
  CHECK_FALSE(measure("#ifdef GL_ARB_something\n" + bomb + "#endif\n" + inMain("")).good);
  CHECK_FALSE(measure("#ifdef GL_ARB_something\n#else\n" + bomb + "#endif\n" + inMain("")).good);
  CHECK(measure("/* " + bomb + "*/ // " + times("a + ", 100000) + "\n" + inMain("")).good);
  CHECK_FALSE(measure("// one \\\n two \n" + bomb + inMain("")).good);
  CHECK_FALSE(measure("/* */" + bomb + inMain("")).good);
  // Macros that are not used, and a name that stands for itself.
  CHECK(measure("#define M0 a\n" + chain("#define M$ M%+M%", 60) + inMain("")).good);
  CHECK(measure("#define a a + a\n" + inMain("float b = a;")).good);
  CHECK(measure("#define F(x) F(x, x)\n" + inMain("F(1)")).good);
  CHECK(measure("#define CAT(a, b) a##b\n#define AB 3\n" + inMain("float x[CAT(A, B)];")).size.array.count ==
        3);
  const Measured cut = measure("#define F(x) x\n" + inMain("float x = F(\n#line 5\n1.0);"));
  CHECK(cut.size.uncertain);
}

TEST_CASE("counts are those of the text") {
  const Measured m = measure("#define TWICE(x) ((x) + (x))\n" + inMain("result = vec4(TWICE(TWICE(1.0)));"));
  CHECK(m.size.tokens.count == 41);
}

TEST_CASE("functions in a circle are named") {
  const Measured m = measure(
      "float g(float x);\nfloat f(float x) { return g(x); }\nfloat h(float x) { return x; }\n"
      "float g(float x) { return h(f(x)); }\n" +
      inMain("result = vec4(f(1.0));"));
  CHECK(m.size.circle == std::vector<std::string>{"f", "g", "f"});
  CHECK(m.size.circleAt.line == 2);
  CHECK(measure("float f(float x) { return f(x); }\n" + inMain("")).size.circle ==
        std::vector<std::string>{"f", "f"});
  // Overloads are no circle.
  CHECK(measure("float f(float x) { return x; }\nvec2 f(vec2 x) { return vec2(f(x.x), f(x.y)); }\n" +
                inMain(""))
            .size.circle.empty());
}

TEST_CASE("a zero byte, an include and a limit") {
  SourceLoader loader({std::string(WEFT_SOURCE_DIR) + "/shaders"});
  Diagnostics diagnostics;
  CHECK_FALSE(
      loader.loadText(std::string("void main() {\n  int a;\0 }\n", 27), "zero.frag.glsl", diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == Code::shaderDoesNotCompile);
  CHECK(diagnostics.items()[0].place.line == 2);
  CHECK(diagnostics.items()[0].place.column == 9);
}

// Shaders that have more to do than others: all that light surfaces by everything there is, the one that lists a sphere's
// neighbours, and those that go through such a list. Above an eighth a shader is tried first in a process of its own.
const std::set<std::string> kLarge = {"lighting.frag.glsl",  "transparent.frag.glsl", "forward.frag.glsl",
                                      "billboard.frag.glsl", "mesh.frag.glsl",        "lists.comp.glsl",
                                      "billboard.vert.glsl", "look.frag.glsl"};
// Spheres, lit by everything at once, are above it: docs/limits.md says by what. tests/app/hostile/shaders.py draws variants
// that are not.
const std::set<std::string> kLargest = {"billboard.frag.glsl", "mesh.frag.glsl"};

double mostOf(const std::string& name) {
  return kLargest.contains(name) ? 1.0 / 6 : kLarge.contains(name) ? 1.0 / 8 : 1.0 / 16;
}

// The bundled shaders, and those of the tests, stay far below every limit.
TEST_CASE("every shader of the tree is a usual one") {
  std::size_t seen = 0;
  ShaderShare largest;
  std::string which;
  for (const char* folder :
       {"shaders", "tests/theory/shaders", "tests/golden/shaders", "tests/runtime/shaders"}) {
    const std::string root = std::string(WEFT_SOURCE_DIR) + "/" + folder;
    SourceLoader loader({root, std::string(WEFT_SOURCE_DIR) + "/shaders"});
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      const std::string name = entry.path().filename();
      if (!name.ends_with(".frag.glsl") && !name.ends_with(".comp.glsl") && !name.ends_with(".vert.glsl"))
        continue;
      Diagnostics diagnostics;
      const auto source = loader.load(entry.path(), diagnostics);
      REQUIRE_MESSAGE(source, diagnostics.text());
      std::vector<Define> defines;
      for (const std::string& word : source->identifiers)
        if (word.starts_with("HAS_")) defines.push_back({word, "1"});
      const ShaderSize size = measureShader(*source, defines);
      const ShaderShare share = largestShare(size);
      CHECK_MESSAGE(share.share < mostOf(name),
                    name << ": " << share.share << " of " << weft::base::nameOf(share.limit));
      CHECK_MESSAGE((kLargest.contains(name) || !isUnusual(size)), name);
      // Shadows of meshes stand in place of a shadow map of the sun.
      std::erase_if(defines, [](const Define& define) { return define.name == "HAS_SUN_MAP"; });
      CHECK_MESSAGE(
          largestShare(measureShader(*source, defines)).share < (kLarge.contains(name) ? 0.2 : 1.0 / 16),
          name);
      if (share.share > largest.share) {
        largest = share;
        which = name;
      }
      ++seen;
    }
  }
  CHECK(seen > 50);
  MESSAGE("nearest: " << which << ", " << largest.share << " of " << weft::base::nameOf(largest.limit));
}
