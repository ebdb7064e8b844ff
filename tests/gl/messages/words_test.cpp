// Messages of shader compilers in plain words, from logs as drivers write them. No OpenGL.
#include "engine/gl/messages/words.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "engine/gl/messages/log.h"
#include "tests/temporary_folder.h"

using namespace weft::gl;
using namespace weft::glsl;
using weft::base::Code;
using weft::base::Diagnostic;
using weft::base::Diagnostics;

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
  REQUIRE(diagnostics.size() == 1);
  return diagnostics.items()[0];
}

}  // namespace

TEST_CASE("a missing semicolon is reported where it is missing") {
  const std::string text = "void main() {\n  float x = 1.0  // one\n\n  // then\n  x = 2.0;\n}\n";
  const Diagnostic d =
      only(said(text, mesa(5, 2, "syntax error, unexpected IDENTIFIER, expecting ',' or ';'")));
  CHECK(d.message == "syntax error at 'x'");
  CHECK(d.expected == "',' or ';'");
  CHECK(d.hint == "put ';' at the end of line 2");
  CHECK(d.place.line == 5);
  CHECK(d.place.column == 3);
}

TEST_CASE("tokens of the grammar become what stands there") {
  const auto at = [](const std::string& line, int column, const std::string& message) {
    return only(said(line + "\n", mesa(1, column, "syntax error, unexpected " + message)));
  };
  Diagnostic d = at("void main() { vec5 color = 1; }", 20, "NEW_IDENTIFIER, expecting ',' or ';'");
  CHECK(d.message == "syntax error at 'color', a name that is not declared");
  CHECK(d.hint == "'vec5' is no type: did you mean 'vec2' or 'vec3' or 'vec4'?");
  d = at("void main() { unifrom float x; }", 23, "BASIC_TYPE_TOK, expecting ',' or ';'");
  CHECK(d.message == "syntax error at 'float', a type");
  CHECK(d.hint == "'unifrom' is no type: did you mean 'uniform'?");
  d = at("void main() { x = vec4(1.0 2.0); }", 28, "FLOATCONSTANT, expecting ')' or ','");
  CHECK(d.message == "syntax error at '2.0', a number");
  CHECK(d.expected == "')' or ','");
  CHECK(d.hint == "put ',' before it");
  d = at("void main() { x = 1 @ 2; }", 21, "invalid token, expecting ',' or ';'");
  CHECK(d.message == "syntax error at '@', a character that GLSL does not use");
  d = at("void main() { else x = 1; }", 15, "ELSE");
  CHECK(d.message == "syntax error at 'else'");
  CHECK(d.expected.empty());
  d = at("void main() { x = vec2(1, 1)); }", 29, "')', expecting ',' or ';'");
  CHECK(d.hint == "one ')' too many");
  d = at("void main() { x = f(1; }", 22, "';', expecting ')' or ','");
  CHECK(d.hint == "put ')' before it");
  d = at("void main() { ", 14, "end of file");
  CHECK(d.message == "syntax error at the end of the file");
  CHECK(d.hint == "a '{' is never closed");
  d = at("void main() { } }", 17, "'}', expecting end of file");
  CHECK(d.hint == "one '}' too many");
  d = at("result = x; }", 1, "IDENTIFIER, expecting end of file");
  CHECK(d.hint == "it stands outside of all functions: one '}' above it is too many");
}

TEST_CASE("where a macro moves columns no token is made up, and what nobody knows stays as it is") {
  Diagnostic d =
      only(said("A float x; B\n", mesa(1, 3, "syntax error, unexpected FLOATCONSTANT, expecting ','")));
  CHECK(d.message == "syntax error at a number");
  d = only(said("x\n", mesa(1, 1, "syntax error, unexpected SOME_NEW_THING, expecting ','")));
  CHECK(d.message == "syntax error, unexpected SOME_NEW_THING, expecting ','");
  d = only(said("x\n", mesa(1, 1, "syntax error, unexpected ',', expecting SOME_NEW_THING")));
  CHECK(d.message == "syntax error, unexpected ',', expecting SOME_NEW_THING");
  d = only(said("x\n", mesa(1, 1, "words of a later driver about `x'")));
  CHECK(d.message == "words of a later driver about 'x'");
}

TEST_CASE("NVIDIA's and glslang's syntax errors are reported in the same words") {
  const std::string line = std::to_string(kTextLine);
  Diagnostic d = only(said(
      "void main() { x = 1 }\n",
      "0(" + line + ") : error C0000: syntax error, unexpected '}', expecting ',' or ';' at token \"}\"\n"));
  CHECK(d.message == "syntax error at '}'");
  CHECK(d.expected == "',' or ';'");
  d = only(said(
      "void main() { x y }\n",
      "0(" + line + ") : error C0000: syntax error, unexpected identifier, expecting ';' at token \"y\"\n"));
  CHECK(d.message == "syntax error at 'y'");
  d = only(said(
      "void main() { x = 1 }\n",
      "ERROR: 0:" + line + ": '' :  syntax error, unexpected RIGHT_BRACE, expecting COMMA or SEMICOLON\n"));
  CHECK(d.message == "syntax error at '}'");
  CHECK(d.expected == "',' or ';'");
}

TEST_CASE("undeclared names are reported alike for every driver, with the nearest declared one") {
  const std::string text = "uniform sampler2D environment;\nvoid main() { environmnt; retrun; }\n",
                    line = std::to_string(kTextLine + 1);
  for (const std::string& log : {mesa(2, 15, "`environmnt' undeclared"),
                                 "0(" + line + ") : error C1503: undefined variable \"environmnt\"\n",
                                 "ERROR: 0:" + line + ": 'environmnt' : undeclared identifier\n"}) {
    const Diagnostic d = only(said(text, log));
    CHECK(d.message == "'environmnt' is not declared");
    CHECK(d.hint == "did you mean 'environment'?");
  }
  CHECK(only(said(text, mesa(2, 27, "`retrun' undeclared"))).hint == "did you mean 'return'?");
  const Diagnostic d = only(said(text, mesa(2, 15, "no function with name 'textur'")));
  CHECK(d.message == "there is no function 'textur'");
  CHECK(d.hint == "did you mean 'texture'?");
}

TEST_CASE("what a program lacks as a whole says what to write") {
  const std::string text = "in vec2 vUv;\nout vec4 result;\nvoid main() { result = vec4(vUv, uv); }\n";
  CHECK(only(said(text, mesa(3, 36, "`uv' undeclared"))).hint ==
        "a fullscreen pass has it from 0 to 1: declare 'in vec2 uv;'");
  const Diagnostic input =
      only(said(text, "error: fragment shader input `vUv' has no matching output in the previous stage\n"));
  CHECK(input.message == "no shader before the fragment shader writes its input 'vUv'");
  CHECK(input.hint.starts_with("a fullscreen pass has one input, 'in vec2 uv;'"));
  const Diagnostic group =
      only(said(text, "error: compute shader must contain a fixed or a variable local group size\n"));
  CHECK(group.message == "the compute shader does not say how large a group is");
  CHECK(group.expected == "layout(local_size_x = 8, local_size_y = 8) in;");
}

TEST_CASE("what only follows from another error is left out, but never the only error") {
  const std::string text = "void main() {\n  x = f(y);\n  z = vec4(y);\n}\n";
  CHECK(only(said(text, mesa(2, 7, "no matching function for call to `f(error, vec2)'") +
                            mesa(2, 9, "`y' undeclared") +
                            mesa(2, 3, "value of type vec4 cannot be assigned to variable of type error") +
                            mesa(2, 7, "type mismatch")))
            .message == "'y' is not declared");
  CHECK(said(text, mesa(2, 9, "`y' undeclared") +
                       mesa(3, 7, "cannot construct `vec4' from a non-numeric data type"))
            .size() == 2);
  CHECK(said(text, mesa(2, 7, "no matching function for call to `f(error)'")).size() == 1);
}

TEST_CASE("of many forms of a function those that are like the call are named, and the others counted") {
  const std::string text = "void main() { texture(map, 1.0); }\n";
  std::string log =
      mesa(1, 15, "no matching function for call to `texture(sampler2D, float)'; candidates are:");
  for (const char* form :
       {"vec4 texture(sampler1D, float)", "vec4 texture(sampler2D, vec2)", "vec4 texture(sampler3D, vec3)",
        "vec4 texture(sampler2D, vec2, float)", "float texture(sampler2DShadow, vec3)"})
    log += mesa(1, 15, std::string("   ") + form);
  CHECK(only(said(text, log)).expected ==
        "vec4 texture(sampler2D, vec2); vec4 texture(sampler2D, vec2, float); vec4 texture(sampler1D, "
        "float); or one of 2 "
        "others");
}

TEST_CASE("words of other languages get what GLSL says") {
  Diagnostic d = only(said("void main() { float4 c; }\n",
                           mesa(1, 22, "syntax error, unexpected NEW_IDENTIFIER, expecting ',' or ';'")));
  CHECK(d.hint == "'float4' is no type: GLSL says 'vec4'");
  d = only(said("void main() { x = lerp(a, b, c); }\n", mesa(1, 19, "no function with name 'lerp'")));
  CHECK(d.hint == "GLSL says 'mix'");
  d = only(said("void main() { gl_FragColor = c; }\n", mesa(1, 15, "`gl_FragColor' undeclared")));
  CHECK(d.hint.find("out vec4 result;") != std::string::npos);
}

TEST_CASE("a member of a block with an instance name says so") {
  const std::string text =
      "layout(std140) uniform Parameters { float gain; vec3 tint; } params;\nuniform sampler2D gian;\nvoid "
      "main() { x = gain; }\n";
  const Diagnostic d = only(said(text, mesa(3, 19, "`gain' undeclared")));
  CHECK(d.message ==
        "'gain' is not declared by itself: its block 'Parameters' has the instance name 'params'");
  CHECK(d.hint == "write 'params.gain', or take 'params' away behind the block");
}

TEST_CASE("a define that hides a name of the shader is told apart from a syntax error") {
  TemporaryFolder folder;
  folder.write("x.frag.glsl", "uniform sampler2D source;\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("x.frag.glsl", diagnostics);
  REQUIRE(source);
  const std::vector<Define> defines = {{"OTHER", "2"}, {"source", "1"}};
  mapLog(mesa(1, 19, "syntax error, unexpected INTCONSTANT, expecting ',' or ';'"), *source,
         Code::shaderDoesNotCompile, diagnostics, defines);
  const Diagnostic d = only(diagnostics);
  CHECK(d.message == "'source' is a name of the shader, and the graph defines it as 1");
  CHECK(d.hint == "rename the define, such as 'source_MODE'");
}

TEST_CASE("the scan finds instance names of blocks, and the words of layout() of images") {
  TemporaryFolder folder;
  folder.write("x.comp.glsl",
               "layout(std430) buffer Rows { float value[]; } rows;\nlayout(std140) uniform Parameters { "
               "float gain; };\n"
               "layout(rgba16f, binding = 1) uniform writeonly image2D result;\nuniform sampler2D map;\n"
               "struct Row { float gain; } row;\nvoid main() {}\n");
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("x.comp.glsl", diagnostics);
  REQUIRE(source);
  CHECK(source->parts.instanceOf == decltype(source->parts.instanceOf){{"Rows", "rows"}});
  CHECK(source->parts.blockOf == decltype(source->parts.blockOf){{"value", "Rows"}});
  REQUIRE(source->parts.imageFormats.size() == 1);
  const auto& formats = source->parts.imageFormats.at("result");
  CHECK(std::find(formats.begin(), formats.end(), "rgba16f") != formats.end());
}

TEST_CASE("what an error kept from being computed is not said to be uninitialized") {
  const std::string text = "void main() {\n  vec3 c = texture2D(a, b).rgb;\n  float x = c.x;\n}\n";
  const std::string line = std::to_string(kTextLine + 2);
  const Diagnostics both = said(text, mesa(2, 12, "no function with name 'texture2D'") + "0:" + line +
                                          "(13): warning: `c' used uninitialized\n");
  CHECK(only(both).message == "there is no function 'texture2D'");
  CHECK(said(text, "0:" + line + "(13): warning: `c' used uninitialized\n").size() == 1);
}

TEST_CASE("a character that is not ASCII is blamed, and not the end of the file") {
  const Diagnostic d = only(said("void main() {\n  float x = f(0.3\xC2\xA0, 1.0);\n}\n",
                                 mesa(2, 18, "syntax error, unexpected end of file, expecting ')' or ','")));
  CHECK(d.message == "U+00A0 is no plain space");
  CHECK(d.hint == "write a plain space in its place");
  CHECK(d.place.line == 2);
  CHECK(d.place.column == 18);
  // In a comment it is none of a compiler's business.
  const Diagnostic other = only(said("void main() {\n  float x = f(1.0;  // d\xC3\xA9j\xC3\xA0\n}\n",
                                     mesa(2, 17, "syntax error, unexpected ';', expecting ')' or ','")));
  CHECK(other.message == "syntax error at ';'");
}

TEST_CASE("a declaration that a conditional leaves out, and a conditional without its end") {
  const std::string text =
      "#ifdef HAS_glow\nuniform sampler2D glow;\n#endif\nvoid main() {\n  vec4 c = texture(glow, "
      "vec2(0));\n}\n";
  const Diagnostic d = only(said(text, mesa(5, 20, "`glow' undeclared")));
  CHECK(d.message == "'glow' is not declared");
  CHECK(d.hint == "its declaration stands under `#ifdef HAS_glow`, which does not hold here");
  const Diagnostic open =
      only(said("void main() {\n#if A\n#if B\n#endif\n#else\n}\n", mesa(6, 1, "Unterminated #if")));
  CHECK(open.message == "the conditional that opens here is never closed");
  CHECK(open.place.line == 2);
  CHECK(open.hint == "write '#endif' behind what it guards");
}

TEST_CASE("a name that the pass has and the shader does not, and vectors of another length") {
  const std::string text =
      "uniform sampler2D src;\nvoid main() {\n  vec4 c = texelFetch(source, ivec2(0), 0);\n}\n";
  TemporaryFolder folder;
  folder.write("x.frag.glsl", text);
  SourceLoader loader({folder.path().string()});
  Diagnostics diagnostics;
  const auto source = loader.load("x.frag.glsl", diagnostics);
  REQUIRE(source);
  const Define defines[] = {{"HAS_SOURCE", "1"}};
  mapLog(mesa(3, 23, "`source' undeclared"), *source, Code::shaderDoesNotCompile, diagnostics, defines);
  CHECK(only(diagnostics).hint ==
        "the pass has 'source' as a slot or a parameter: declare it, or give it there the name that it has "
        "here");
  const auto hint = [&](const std::string& message) { return only(said(text, mesa(3, 3, message))).hint; };
  CHECK(hint("initializer of type vec4 cannot be assigned to variable of type vec3") ==
        "write '.xyz' behind the value, or declare a vec4");
  CHECK(hint("value of type float cannot be assigned to variable of type vec2") ==
        "write 'vec2(…)' around the value");
  CHECK(hint("initializer of type mat4 cannot be assigned to variable of type vec3").empty());
}
