#include <doctest/doctest.h>

#include <filesystem>
#include <functional>
#include <set>

#include "engine/glsl/interface.h"
#include "engine/text/limits.h"
#include "tests/gl/documented.h"

using namespace weft::glsl;
using weft::text::Code;
using weft::text::Diagnostics;
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
  bool unusual = false;
  Diagnostics diagnostics;
  bool good = false;
};

Measured measure(const std::string& text, const std::vector<Define>& defines = {}) {
  SourceLoader loader({std::string(WEFT_SOURCE_DIR) + "/shaders"});
  Measured m;
  m.source = loader.loadText(text, "bomb.frag.glsl", m.diagnostics);
  REQUIRE_MESSAGE(m.source, m.diagnostics.text());
  m.unusual = isUnusual(m.source->interfaceWith(defines));
  m.good = checkShaderSize(m.source->interfaceWith(defines).size, *m.source, m.diagnostics);
  return m;
}

std::string inMain(const std::string& body) {
  return "out vec4 result;\nvoid main() {\n" + body + "\n}\n";
}

// Which limit a message is about.
std::uint64_t boundOf(const std::string& message) {
  return message.find("nested too deeply") != std::string::npos ? kMaxShaderDepth : kMaxShaderBytes;
}

void refuses(const std::string& text, const std::string& message, std::uint32_t line) {
  const Measured m = measure(text);
  CHECK_FALSE(m.good);
  CHECK(m.unusual);
  bool found = false;
  for (const auto& d : m.diagnostics.items())
    if (d.code == Code::shaderTooLarge && d.message.find(message) != std::string::npos) {
      found = true;
      CHECK_MESSAGE(d.place.line == line, weft::text::format(d));
      CHECK(*d.place.file == "bomb.frag.glsl");
      CHECK(d.expected.starts_with("at most " + std::to_string(boundOf(message)) + " "));
      CHECK_FALSE(d.found.empty());
      CHECK(d.hint.find("--limit 2") != std::string::npos);
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
  refuses("#define O0 (\n#define C0 )\n" + chain("#define O$ O% O%\n#define C$ C% C%", 10) +
              inMain("result = vec4(O10 1.0 C10);"),
          "nested too deeply", 25);
  refuses(times("// nothing\n", 100000) + inMain("result = vec4(1.0);"), "the shader is too large", 0);
}

TEST_CASE("the message is that of docs/errors.md") {
  SourceLoader loader({"tests/bad_shaders"});
  Diagnostics diagnostics;
  const auto source = loader.load("w203_nesting.frag.glsl", diagnostics);
  REQUIRE_MESSAGE(source, diagnostics.text());
  CHECK_FALSE(checkShaderSize(source->interfaceWith({}).size, *source, diagnostics));
  weft::gl::test::checkDocumented(diagnostics, Code::shaderTooLarge);
}

TEST_CASE("what drivers work long for is unusual, and tried first") {
  const auto isTried = [](const std::string& text) { return measure(text).unusual; };
  const std::string zero = "float f0(float x) { return x; }\n";
  CHECK(isTried(zero + chain("float f$(float x) { return f%(x) + f%(x + 1.0); }", 24) +
                inMain("result = vec4(f24(1.0));")));
  CHECK(isTried(zero + chain("float f$(float x) { return f%(x); }", 1000) +
                inMain("result = vec4(f1000(1.0));")));
  CHECK_FALSE(
      isTried(zero + chain("float f$(float x) { return f%(x); }", 10) + inMain("result = vec4(f10(1.0));")));
  CHECK(isTried(inMain("float a[100000];\na[int(result.x)] = 1.0;")));
  CHECK(isTried("const int kHigh = 30;\n#define WIDE (kHigh * 4)\n" +
                inMain("vec3 b = vec3(0.0), c[kHigh][WIDE + 1];")));
  CHECK(isTried("float[20][20] a;\n" + inMain("")));
  // What a group shares and what a block holds is no matter of the compiler.
  CHECK_FALSE(isTried("shared float tile[1024];\n" + inMain("tile[int(result.x)] = 1.0;")));
  for (const char* block : {"buffer", "uniform"})
    CHECK_FALSE(isTried("layout(std430) " + std::string(block) + " Table { float a[100000]; } t;\n" +
                        inMain("float c = t.a[int(result.x)];")));
  CHECK_FALSE(isTried("#define CAT(a, b) a##b\n#define AB 3\n" + inMain("float x[CAT(A, B)];")));
  CHECK(isTried("#define F(x) x\n" + inMain("float x = F(\n#line 5\n1.0);")));
  // Macros that make too much for its tokens to be counted.
  CHECK(isTried("#define F(x) x\n" +
                inMain("result = vec4(" + times("F(", 600) + "1.0" + times(")", 600) + ");")));
  CHECK(isTried("#define M0 a\n" + chain("#define M$ M%+M%", 24) +
                inMain("float a = 1.0;\nresult = vec4(M24);")));
  CHECK(isTried("#define M0(x) x\n" + chain("#define M$(x) M%(x) M%(x)", 40) + inMain("M40()")));
  CHECK(isTried("#define D(x) x x\n" + inMain(times("D(", 30) + "{}" + times(")", 30))));
  CHECK(isTried("#if " + times("(", 3000) + "1" + times(")", 3000) + "\n#endif\n" + inMain("")));
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

// Spheres and layered materials, lit by everything at once, are tried first: docs/limits.md. tests/app/hostile/shaders.py draws variants that are not.
const std::set<std::string> kUnusual = {"billboard.frag.glsl",   "mesh.frag.glsl",     "forward.frag.glsl",
                                        "transparent.frag.glsl", "lighting.frag.glsl", "rays.frag.glsl"};

// The bundled shaders, and those of the tests, stay below every limit.
TEST_CASE("every shader of the tree is a usual one") {
  std::size_t seen = 0;
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
      std::set<std::string> words;
      for (const Token& token : splitTokens(source->text))
        if (token.text.starts_with("HAS_")) words.emplace(token.text);
      std::vector<Define> defines;
      for (const std::string& word : words) defines.push_back({word, "1"});
      const Interface& interface = source->interfaceWith(defines);
      const ShaderSize& size = interface.size;
      CAPTURE(size.tokens);
      CAPTURE(size.inlined);
      CAPTURE(size.depth);
      CAPTURE(size.elements);
      CHECK_MESSAGE(checkShaderSize(size, *source, diagnostics), diagnostics.text());
      CHECK_MESSAGE((kUnusual.contains(name) || !isUnusual(interface)), name);
      ++seen;
    }
  }
  CHECK(seen > 50);
}
