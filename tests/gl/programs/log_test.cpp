// What a shader's author reads: the driver's log at the true place, with what to write for a name that is not declared.
#include <doctest/doctest.h>

#include "engine/gl/programs/program.h"
#include "engine/glsl/source.h"
#include "tests/gl/documented.h"
#include "tests/temporary_folder.h"

using namespace weft::gl;
using namespace weft::glsl;
using weft::text::Code;
using weft::text::Diagnostic;
using weft::text::Diagnostics;
using weft::text::Severity;

namespace {

// What a log says of a text; `at` 0:LINE(COLUMN) or 0(LINE) with lines of the text from 1.
Diagnostics said(const std::string& text, const std::string& log) {
  TemporaryFolder folder;
  folder.write("x.frag.glsl", text);
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("x.frag.glsl", diagnostics);
  REQUIRE(source);
  const std::size_t added = mapLog(log, *source, Code::shaderDoesNotCompile, diagnostics);
  CHECK(added == diagnostics.size());
  return diagnostics;
}

std::string mesa(int line, int column, const std::string& message) {
  return "0:" + std::to_string(kTextLine - 1 + static_cast<unsigned>(line)) + "(" + std::to_string(column) +
         "): error: " + message + "\n";
}

Diagnostic only(const Diagnostics& diagnostics) {
  REQUIRE_MESSAGE(diagnostics.size() == 1, diagnostics.text());
  return diagnostics.items()[0];
}

}  // namespace

TEST_CASE("logs of Mesa and NVIDIA are mapped to the true file, line and column") {
  TemporaryFolder folder;
  folder.write("a.glsl", "float a;\n  float  b;\n");
  folder.write("x.frag.glsl", "float before;\n#include \"a.glsl\"\nvoid main() {\n}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics none;
  const auto source = loader.load("x.frag.glsl", none);
  REQUIRE(source);
  // The text is: before, a, b, main, }. The driver's file number is not believed.
  Diagnostics said;
  CHECK(mapLog("0:10003(5): error: `foo' undeclared\n7:10004(1): warning: `bar' used uninitialized\n"
               "0:2(9): preprocessor error: bad\n",
               *source, Code::shaderDoesNotCompile, said) == 2);
  REQUIRE(said.size() == 2);  // of a text with errors, errors alone
  CHECK(*said.items()[0].place.file == folder.at("a.glsl"));
  CHECK(said.items()[0].place.line == 2);
  CHECK(said.items()[0].place.column == 6);
  CHECK(said.items()[0].message == "'foo' undeclared");
  CHECK(said.items()[0].severity == Severity::error);
  CHECK(*said.items()[1].place.file == "<defines>");
  CHECK(said.items()[1].place.line == 2);

  Diagnostics nvidia;
  CHECK(mapLog("Fragment info\n-------------\n0(10002) : error C1503: undefined variable \"foo\"\n"
               "0(10005) : warning C7050: \"x\" might be used before being initialized\n",
               *source, Code::shaderDoesNotCompile, nvidia) == 1);
  REQUIRE(nvidia.size() == 1);
  CHECK(*nvidia.items()[0].place.file == folder.at("a.glsl"));
  CHECK(nvidia.items()[0].place.line == 1);
  CHECK(nvidia.items()[0].place.column == 0);
  CHECK(nvidia.items()[0].message == "undefined variable \"foo\"");

  Diagnostics warned;
  CHECK(mapLog("0:10004(1): warning: `bar' used uninitialized\n", *source, Code::shaderDoesNotCompile,
               warned) == 1);
  CHECK(warned.items()[0].severity == Severity::warning);
  CHECK(*warned.items()[0].place.file == folder.at("x.frag.glsl"));
  CHECK(warned.items()[0].place.line == 3);

  Diagnostics others;
  CHECK(mapLog("ERROR: 0:10001: 'foo' : undeclared identifier\nerror: fragment shader lacks main\n  which is "
               "needed\nsomething\n",
               *source, Code::programDoesNotLink, others) == 2);
  REQUIRE(others.size() == 2);
  CHECK(*others.items()[0].place.file == folder.at("x.frag.glsl"));
  CHECK(others.items()[0].place.line == 1);
  CHECK(others.items()[1].message == "fragment shader lacks main which is needed something");
  CHECK(others.items()[1].place.line == 0);
}

TEST_CASE("the broken shaders give the messages of docs/errors.md") {
  const std::pair<const char*, Code> cases[] = {{"w100_no_such.frag.glsl", Code::unreadableShader},
                                                {"w101_include.frag.glsl", Code::missingShaderInclude},
                                                {"w102_cycle.frag.glsl", Code::shaderIncludeCycle},
                                                {"w103_brackets.frag.glsl", Code::malformedInclude},
                                                {"w106_version.frag.glsl", Code::versionInShader}};
  SourceLoader loader({"tests/bad_shaders"});
  for (const auto& [file, code] : cases) {
    Diagnostics diagnostics;
    CHECK_FALSE(loader.load(file, diagnostics, {"frame.json", 5, 41}));
    CHECK(diagnostics.size() == 1);
    weft::gl::test::checkDocumented(diagnostics, code);
  }
}

TEST_CASE("a name that is not declared gets the nearest one, for every driver") {
  const std::string text = "uniform sampler2D environment;\nvoid main() { environmnt; }\n",
                    line = std::to_string(kTextLine + 1);
  for (const std::string& log : {mesa(2, 15, "`environmnt' undeclared"),
                                 "0(" + line + ") : error C1503: undefined variable \"environmnt\"\n",
                                 "ERROR: 0:" + line + ": 'environmnt' : undeclared identifier\n"})
    CHECK(only(said(text, log)).hint == "did you mean 'environment'?");
  CHECK(only(said(text, mesa(2, 15, "no function with name 'textur'"))).hint == "did you mean 'texture'?");
  CHECK(only(said(text, mesa(2, 15, "words of a later driver about `environment'"))).hint.empty());
}

TEST_CASE("of the errors of one line that is kept which a hint can be given for") {
  const std::string text = "uniform vec2 width;\nvoid main() {\n  x = f(widht);\n  z = vec4(widht);\n}\n";
  CHECK(only(said(text, mesa(3, 7, "no matching function for call to `f(error, vec2)'") +
                            mesa(3, 9, "`widht' undeclared") + mesa(3, 7, "type mismatch")))
            .message == "'widht' undeclared");
  CHECK(said(text, mesa(3, 9, "one") + mesa(3, 9, "two") + mesa(4, 7, "three")).size() == 2);
}

TEST_CASE("words of other languages get what GLSL says") {
  CHECK(only(said("void main() { float4 c; }\n",
                  mesa(1, 22, "syntax error, unexpected NEW_IDENTIFIER, expecting ',' or ';'")))
            .hint == "GLSL says 'vec4'");
  CHECK(
      only(said("void main() { x = lerp(a, b, c); }\n", mesa(1, 19, "no function with name 'lerp'"))).hint ==
      "GLSL says 'mix'");
  CHECK(only(said("void main() { gl_FragColor = c; }\n", mesa(1, 15, "`gl_FragColor' undeclared")))
            .hint.find("out vec4 result;") != std::string::npos);
}

TEST_CASE("a member of a block with an instance name, and a declaration in a branch that is not taken") {
  CHECK(only(said("layout(std140) uniform Parameters { float gain; } params;\nvoid main() { x = gain; }\n",
                  mesa(2, 19, "`gain' undeclared")))
            .hint == "write 'params.gain': its block has an instance name");
  const std::string text =
      "#ifdef HAS_GLOW\nuniform sampler2D glow;\n#endif\nvoid main() {\n  vec4 c = texture(glow, "
      "vec2(0));\n}\n";
  CHECK(only(said(text, mesa(5, 20, "`glow' undeclared")))
            .hint.ends_with("x.frag.glsl:2, in a branch of an #if that is not taken here"));
}

TEST_CASE("a define that hides a name of the shader") {
  TemporaryFolder folder;
  folder.write("x.frag.glsl", "uniform sampler2D source;\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("x.frag.glsl", diagnostics);
  REQUIRE(source);
  const std::vector<Define> defines = {{"OTHER", "2"}, {"source", "1"}};
  mapLog(mesa(1, 19, "syntax error, unexpected INTCONSTANT, expecting ',' or ';'"), *source,
         Code::shaderDoesNotCompile, diagnostics, defines);
  CHECK(only(diagnostics).hint == "the graph defines 'source' as 1: rename the define");
}
