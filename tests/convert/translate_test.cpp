// Single rules of the translation: tokens, sizes, versions of what a pass reads.
#include "tests/convert/converted.h"

using namespace weft;
using namespace weft::importing;
using namespace weft::importing::test;

namespace {

std::string fragmentOf(const std::string& body, const std::string& header = "{}") {
  text::Diagnostics diagnostics;
  const auto converted = convertIsfText("/*" + header + "*/\n" + body, diagnostics);
  REQUIRE_MESSAGE(converted, diagnostics.text());
  return partOf(*converted, ".fs.glsl").substr(header.size() + 5);
}

std::string graphOf(const std::string& header, const std::string& body) {
  text::Diagnostics diagnostics;
  const auto converted = convertIsfText("/*" + header + "*/\n" + body, diagnostics);
  REQUIRE_MESSAGE(converted, diagnostics.text());
  std::string why;
  CHECK_MESSAGE(isSound(*converted, why), why);
  return partOf(*converted, "x.json");
}

bool has(const std::string& text, std::string_view part) {
  return text.find(part) != std::string::npos;
}

std::string mpvGraphOf(const std::string& text) {
  text::Diagnostics diagnostics;
  const auto converted = convertMpvText(text, diagnostics);
  REQUIRE_MESSAGE(converted, diagnostics.text());
  std::string why;
  CHECK_MESSAGE(isSound(*converted, why), why);
  return partOf(*converted, "x.json");
}

}  // namespace

TEST_CASE("a whole power of a negative number is a product, as on most devices") {
  CHECK(has(
      fragmentOf("void main() { gl_FragColor = vec4(pow(pow(x, y), 3.0), pow(x, 2.5), pow(x, n), 1.0); }"),
      "vec4(isf_pow(pow(x, y), 3.0), pow(x, 2.5), pow(x, n), 1.0)"));
  CHECK(has(fragmentOf("const float k = pow(2.0, 3.0); void main() { float pow = pow(k, 3); }"),
            "const float k = pow(2.0, 3.0); void main() { float pow = isf_pow(k, 3); }"));
}

TEST_CASE("older GLSL becomes GLSL 4.5 by tokens") {
  CHECK(fragmentOf("void main() { gl_FragColor = vec4(1.0); } // gl_FragColor\n") ==
        "void main() { isf_FragColor = vec4(1.0); } // gl_FragColor\n");
  CHECK(fragmentOf("varying vec2 at; void main() { gl_FragData[0].rgb = vec3(at, 0.0); }\n") ==
        "in vec2 at; void main() { isf_FragColor.rgb = vec3(at, 0.0); }\n");
  CHECK(fragmentOf("#version 120\n#extension GL_OES_standard_derivatives : enable\nvoid main() {}\n") ==
        "\n\nvoid main() {}\n");
  CHECK(fragmentOf(
            "struct S { float sample; }; void main() { S s; s.sample = 1.0; float sample = s.sample; }\n") ==
        "struct S { float sample_; }; void main() { S s; s.sample = 1.0; float sample_ = s.sample; }\n");
}

TEST_CASE("names that the translation needs itself move out of the way, also in macros") {
  CHECK(fragmentOf("vec2 uv;\n#define AT uv\nvoid main() { uv = AT.xy; vec2 time = uv; }\n") ==
        "vec2 uv_;\n#define AT uv_\nvoid main() { uv_ = AT.xy; vec2 time = uv_; }\n");
  // A local variable only hides it.
  CHECK(fragmentOf("void main() { vec2 uv = isf_FragNormCoord; gl_FragColor = uv.xyxy; }\n") ==
        "void main() { vec2 uv = isf_FragNormCoord; isf_FragColor = uv.xyxy; }\n");
  const std::string header =
      R"({"INPUTS": [{"NAME": "face", "TYPE": "float"}, {"NAME": "x", "TYPE": "float"}]})";
  CHECK(fragmentOf("void main() { gl_FragColor = vec4(face, x, gl_FragCoord.x, 1.0); }\n", header) ==
        "void main() { isf_FragColor = vec4(face_, x_, gl_FragCoord.x, 1.0); }\n");
}

TEST_CASE("version 1 and uniforms that the header declares anyway") {
  CHECK(fragmentOf(
            "uniform float TIME;\nvoid main() { gl_FragColor = vec4(vv_FragNormCoord, TIME, 1.0); }\n") ==
        "\nvoid main() { isf_FragColor = vec4(isf_FragNormCoord, TIME, 1.0); }\n");
}

TEST_CASE("what players declare beside an image is there, for inputs and targets and no other name") {
  const std::string header =
      R"({"INPUTS": [{"NAME": "face", "TYPE": "image"}], "PASSES": [{"TARGET": "t"}, {}]})";
  CHECK(fragmentOf("uniform vec2 _face_imgSize;\nvoid main() { gl_FragColor = vec4(_face_imgSize / "
                   "_t_imgSize, 0, 0); }\n",
                   header) == "\nvoid main() { isf_FragColor = vec4(_face_imgSize / _t_imgSize, 0, 0); }\n");
  // An image of which only the size is read is a slot all the same.
  text::Diagnostics diagnostics;
  const std::string_view fragment =
      R"(/*{"INPUTS": [{"NAME": "face", "TYPE": "image"}]}*/ void main() { gl_FragColor = vec4(_face_imgSize, 0.0, 1.0); })";
  const auto converted = convertIsfText(
      fragment, diagnostics, "void main() { isf_vertShaderInit(); gl_Position.xy /= _face_imgSize; }");
  REQUIRE_MESSAGE(converted, diagnostics.text());
  CHECK(has(partOf(*converted, "isf.glsl"),
            "uniform sampler2D face_;\n#define _face_imgSize IMG_SIZE(face_)\n"));
}

TEST_CASE("sizes become expressions") {
  const auto sized = [](const std::string& width) {
    return graphOf(
        R"({"INPUTS": [{"NAME": "n", "TYPE": "float", "DEFAULT": 2}], "PASSES": [{"TARGET": "t", "WIDTH": ")" +
            width + R"("}, {}]})",
        "void main() { gl_FragColor = IMG_THIS_PIXEL(t); }\n");
  };
  CHECK(has(sized("$WIDTH/2.0"), R"("size": ["screen.x/2.0", "screen.y"])"));
  CHECK(has(sized("MAX(1., floor($HEIGHT * .5) - $n)"),
            R"x(["max(1.0, floor(screen.y*0.5)-$n)", "screen.y"])x"));
  CHECK(has(sized("16"), R"(["16", "screen.y"])"));
}

TEST_CASE("what a pass reads is what was drawn before it, in this frame or in the last") {
  const std::string graph =
      graphOf(R"({"PASSES": [{"TARGET": "a", "PERSISTENT": true}, {"TARGET": "b"}, {}]})",
              "void main() { gl_FragColor = IMG_THIS_PIXEL(a) + IMG_THIS_PIXEL(b); }\n");
  CHECK(has(graph, R"("a": "a@-1 as linear")"));
  CHECK(has(graph, R"("a": "a as linear", "b": "b as linear")"));
  CHECK(has(graph, R"("history": 1)"));
  // What nothing has drawn yet is transparent black.
  CHECK(has(
      graphOf(R"({"PASSES": [{"TARGET": "b"}, {}]})", "void main() { gl_FragColor = IMG_THIS_PIXEL(b); }\n"),
      R"("b": "no_picture as linear")"));
}

TEST_CASE("an image has something in its place where no picture is given") {
  const std::string graph = graphOf(R"({"INPUTS": [{"NAME": "a", "TYPE": "image"}]})",
                                    "void main() { gl_FragColor = IMG_THIS_PIXEL(a); }\n");
  CHECK(has(graph, R"("a_or_none":  ["a", "no_picture"])"));
  CHECK(has(graph, R"("read": { "a": "a_or_none as linear" })"));
}

TEST_CASE("labels become words, and their numbers reach the shader") {
  const std::string graph = graphOf(
      R"({"INPUTS": [{"NAME": "m", "TYPE": "long", "VALUES": [3, 7], "LABELS": ["Soft light", "x"], "DEFAULT": 7}]})",
      "void main() { gl_FragColor = vec4(m); }\n");
  CHECK(has(graph, R"("default": "x_", "choices": ["Soft_light", "x_"])"));
  CHECK(has(graph, R"("m_value": "$m == Soft_light ? 3 : 7")"));
  CHECK(has(graph, R"("m": "$m_value")"));
}

TEST_CASE("labels that are one word as names stay as many choices as they are") {
  const std::string graph = graphOf(
      R"({"INPUTS": [{"NAME": "m", "TYPE": "long", "VALUES": [1, 2, 3, 4], "LABELS": ["a b", "a_b_2", "a-b", "a.b"], "DEFAULT": 3}]})",
      "void main() { gl_FragColor = vec4(m); }\n");
  CHECK(has(graph, R"("default": "a_b_3", "choices": ["a_b", "a_b_2", "a_b_3", "a_b_4"])"));
  CHECK(has(graph, R"("m_value": "$m == a_b ? 1 : $m == a_b_2 ? 2 : $m == a_b_3 ? 3 : 4")"));
}

TEST_CASE("reverse Polish becomes expressions") {
  const auto hooked = [](const std::string& headers) {
    return mpvGraphOf("//!HOOK MAIN\n//!BIND HOOKED\n" + headers +
                      "vec4 hook() { return HOOKED_texOff(0); }\n");
  };
  CHECK(has(hooked("//!WIDTH HOOKED.w 2 * 1 -\n"), "floor(((size(source).x * 2) - 1) + 0.5)"));
  CHECK(has(hooked("//!WHEN OUTPUT.w HOOKED.w / 1.2 >\n"), "((screen.x / size(source).x) > 1.2) != 0"));
  CHECK(has(hooked("//!WHEN HOOKED.h 0 = !\n"), "((size(source).y == 0) == 0) != 0"));
}

TEST_CASE("stages run in mpv's order, whatever the order of the file") {
  const std::string graph = mpvGraphOf(
      "//!HOOK OUTPUT\n//!BIND HOOKED\nvec4 hook() { return HOOKED_texOff(0); }\n"
      "//!HOOK RGB\n//!BIND HOOKED\nvec4 hook() { return HOOKED_texOff(0); }\n");
  const std::size_t rgb = graph.find("\"name\": \"pass_2\""), output = graph.find("\"name\": \"pass_1\"");
  REQUIRE(rgb != std::string::npos);
  REQUIRE(output != std::string::npos);
  CHECK(rgb < output);
}

TEST_CASE("texels in the file become pictures, lowest row first") {
  text::Diagnostics diagnostics;
  const auto converted = convertMpvText(
      "//!TEXTURE T\n//!SIZE 1 2\n//!FORMAT rgb8\n010203\nfffefd\n"
      "//!TEXTURE F\n//!SIZE 2 1\n//!FORMAT r16hf\n003c00b8\n"
      "//!HOOK MAIN\n//!BIND T\n//!BIND F\nvec4 hook() { return texture(T, vec2(0.5)) + texture(F, "
      "vec2(0.5)); }\n",
      diagnostics);
  REQUIRE_MESSAGE(converted, diagnostics.text());
  REQUIRE(converted->images.size() == 2);
  CHECK(converted->images[0].bytes == std::vector<std::uint8_t>{255, 254, 253, 255, 1, 2, 3, 255});
  CHECK(converted->images[1].floats == std::vector<float>{1, 0, 0, 1, -0.5, 0, 0, 1});
}

TEST_CASE("comments of // may stand before an ISF header, and keep its places") {
  text::Diagnostics diagnostics;
  const std::string body = "void main() { gl_FragColor = vec4(isf_FragNormCoord, 0.0, 1.0); }";
  const auto converted =
      convertIsfText("// Week 1\n\n// by nobody\r\n/*{ \"INPUTS\": [] }*/\n" + body, diagnostics);
  REQUIRE_MESSAGE(converted, diagnostics.text());
  CHECK(has(partOf(*converted, ".fs.glsl"), "// by nobody"));
  text::Diagnostics wrong;
  CHECK_FALSE(convertIsfText("// Week 1\n/*{ \"INPUTS\": [ { \"TYPE\": \"float\" } ] }*/\n" + body, wrong));
  REQUIRE(wrong.size() == 1);
  CHECK(wrong.items()[0].place.line == 2);
  for (const char* none : {"// only this", "//", "// a\nvoid main() {}", "/ /*{}*/"}) {
    text::Diagnostics said;
    CHECK_FALSE(convertIsfText(none, said));
    CHECK(said.contains(text::Code::notIsf));
  }
}
