// What a shader's author reads: the driver's log at the true place, in the words of docs/errors.md.
#include <doctest/doctest.h>

#include "engine/gl/messages/log.h"
#include "engine/glsl/source.h"
#include "tests/gl/documented.h"
#include "tests/temporary_folder.h"

using namespace weft::gl;
using namespace weft::glsl;
using weft::base::Code;
using weft::base::Diagnostics;
using weft::base::Severity;

TEST_CASE("logs of Mesa and NVIDIA are mapped to the true file, line and column") {
  TemporaryFolder folder;
  folder.write("a.glsl", "float a;\n  float  b;\n");
  folder.write("x.frag.glsl", "float before;\n#include \"a.glsl\"\nvoid main() {\n}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics none;
  const auto source = loader.load("x.frag.glsl", none);
  REQUIRE(source);
  // The text is: before, a, b, main, }. The driver's file number is not believed.
  Diagnostics mesa;
  CHECK(mapLog("0:10003(5): error: `foo' undeclared\n7:10004(1): warning: `bar' used uninitialized\n"
               "0:2(9): preprocessor error: bad\n",
               *source, Code::shaderDoesNotCompile, mesa) == 3);
  REQUIRE(mesa.size() == 3);
  CHECK(*mesa.items()[0].place.file == folder.at("a.glsl"));
  CHECK(mesa.items()[0].place.line == 2);
  CHECK(mesa.items()[0].place.column == 6);
  CHECK(mesa.items()[0].message == "'foo' is not declared");
  CHECK(mesa.items()[0].severity == Severity::error);
  CHECK(*mesa.items()[1].place.file == folder.at("x.frag.glsl"));
  CHECK(mesa.items()[1].place.line == 3);
  CHECK(mesa.items()[1].severity == Severity::warning);
  CHECK(*mesa.items()[2].place.file == "<defines>");
  CHECK(mesa.items()[2].place.line == 2);
  CHECK(mesa.items()[2].severity == Severity::error);

  Diagnostics nvidia;
  CHECK(mapLog("Fragment info\n-------------\n0(10002) : error C1503: undefined variable \"foo\"\n"
               "0(10005) : warning C7050: \"x\" might be used before being initialized\n",
               *source, Code::shaderDoesNotCompile, nvidia) == 2);
  REQUIRE(nvidia.size() == 2);
  CHECK(*nvidia.items()[0].place.file == folder.at("a.glsl"));
  CHECK(nvidia.items()[0].place.line == 1);
  CHECK(nvidia.items()[0].place.column == 0);
  CHECK(nvidia.items()[0].message == "'foo' is not declared");
  CHECK(nvidia.items()[1].severity == Severity::warning);
  CHECK(nvidia.items()[1].place.line == 4);

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
    CHECK_FALSE(loader.load(file, diagnostics, {std::make_shared<const std::string>("frame.json"), 5, 41}));
    CHECK(diagnostics.size() == 1);
    weft::gl::test::checkDocumented(diagnostics, code);
  }
}

TEST_CASE(
    "of overloads that do not fit the nearest are named, an undeclared name gets the nearest declared one") {
  TemporaryFolder folder;
  folder.write("a.frag.glsl", "uniform sampler2D skyy;\nvoid main() { textureSize(sky, 0); }\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("a.frag.glsl", diagnostics);
  REQUIRE(source);
  const std::string at = "0:" + std::to_string(kTextLine + 1);
  const std::string log =
      at + "(15): error: no matching function for call to `textureSize(vec2, int)'; candidates are:\n" + at +
      "(15): error:    int textureSize(sampler1D, int)\n" + at +
      "(15): error:    ivec2 textureSize(sampler2D, int)\n" + at + "(27): error: `sky' undeclared\n";
  CHECK(mapLog(log, *source, Code::shaderDoesNotCompile, diagnostics) == 2);
  CHECK(diagnostics.items()[0].message == "no matching function for call to 'textureSize(vec2, int)'");
  CHECK(diagnostics.items()[0].expected ==
        "int textureSize(sampler1D, int); ivec2 textureSize(sampler2D, int)");
  CHECK(diagnostics.items()[0].place.line == 2);
  CHECK(diagnostics.items()[1].hint == "did you mean 'skyy'?");
}
