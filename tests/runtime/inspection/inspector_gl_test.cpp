// What the inspector reads and shows is what a pass wrote, also where the storage holds something else at the frame's end.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "engine/runtime/inspection/inspector.h"
#include "tests/runtime/stage.h"

namespace inspection_inspector_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

constexpr const char* kGraph = "tests/theory/inspect.json";

std::array<double, 4> valueAt(const Inspector& inspector, std::uint32_t x, std::uint32_t y) {
  const auto texel = inspector.texel(x, y);
  REQUIRE(texel.has_value());
  return texel->value;
}

void look(Stage& stage, Inspector& inspector, const InspectTarget& target) {
  REQUIRE_MESSAGE(inspector.watch(stage.execution(), target), target.resource);
  stage.run();
}

std::array<int, 3> pixel(GLuint canvas, std::uint32_t x, std::uint32_t y) {
  std::uint8_t one[4] = {};
  glGetTextureSubImage(canvas, 0, static_cast<GLint>(x), static_cast<GLint>(y), 0, 1, 1, 1, GL_RGBA,
                       GL_UNSIGNED_BYTE, 4, one);
  return {one[0], one[1], one[2]};
}

}  // namespace

TEST_CASE("a resource is read where it was written, although its storage is used again") {
  const CleanScope clean;
  Stage stage(kGraph, 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const graph::Plan& plan = stage.execution().plan();
  const auto index = [&](const char* name) {
    return static_cast<std::size_t>(std::ranges::find(plan.graph->resourceNames, name) -
                                    plan.graph->resourceNames.begin());
  };
  Inspector inspector(stage.renderer().device());
  CHECK_FALSE(stage.execution().watched());
  look(stage, inspector, {.resource = "first"});
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 8; ++x) {
      if ((x == 1 || x == 2) && y == 1) continue;
      CHECK(valueAt(inspector, x, y) == std::array<double, 4>{double(x), double(y), 1, 1});
    }
  CHECK(std::isnan(valueAt(inspector, 1, 1)[0]));
  CHECK(std::isinf(valueAt(inspector, 2, 1)[1]));
  CHECK(inspector.texel(1, 1)->text() == "nan, 1, 1, 1");
  CHECK(inspector.texel(2, 1)->text() == "2, inf, 1, 1");
  // One texel, read right there.
  const std::uint32_t writer = plan.firstStep[index("first")];
  std::string read;
  stage.execution().watch({.after = [&](std::uint32_t step) {
    if (step != writer) return;
    const gl::TextureRef first = stage.execution().texture(static_cast<std::uint32_t>(index("first")));
    read = readTexel(first, 0, 0, 3, 2, 4).text() + "; " + readTexel(first, 0, 0, 1, 1, 2).text();
  }});
  stage.run();
  stage.execution().watch({});
  CHECK(read == "3, 2, 1, 1; nan, 1");
  CHECK_FALSE(inspector.texel(8, 0).has_value());

  look(stage, inspector, {.resource = "second"});
  CHECK(valueAt(inspector, 7, 3) == std::array<double, 4>{28, 12, 4, 4});
  CHECK(inspector.copies() == 2);

  const auto whole = gl::readFloats(stage.texture("second"));
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 8; ++x)
      for (std::size_t c = 0; c < 4; ++c) {
        const double expected = whole[(std::size_t{y} * 8 + x) * 4 + c];
        const double found = valueAt(inspector, x, y)[c];
        CHECK((found == expected || (std::isnan(found) && std::isnan(expected))));
      }

  // `shown_ids` takes the storage of `shown`: at the end of the frame the one name gives the other's texels.
  REQUIRE(plan.storageOf[index("shown")] == plan.storageOf[index("shown_ids")]);
  const auto end = gl::readTexture(stage.texture("shown"), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  const auto ids = gl::readTexture(stage.texture("shown_ids"), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  CHECK(end == ids);
  look(stage, inspector, {.resource = "shown"});
  const auto shown = gl::readTexture(inspector.picture(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  CHECK(shown != ids);
  CHECK(valueAt(inspector, 8, 4)[0] == doctest::Approx(128.0 / 255));  // texel (4, 2) of `first`, of 8
  look(stage, inspector, {.resource = "shown_ids"});
  CHECK(gl::readTexture(inspector.picture(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE) == ids);
  inspector.release(stage.execution());
  CHECK_FALSE(stage.execution().watched());
}

TEST_CASE("levels, layers, integers, depth, stencil, buffers") {
  const CleanScope clean;
  Stage stage(kGraph, 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  Inspector inspector(stage.renderer().device());
  for (std::uint32_t layer = 0; layer < 2; ++layer)
    for (std::uint32_t mip = 0; mip < 3; ++mip) {
      look(stage, inspector, {.resource = "chain", .mip = mip, .layer = layer});
      CHECK(inspector.picture().desc.width == 8u >> mip);
      CHECK(valueAt(inspector, 0, 1) == std::array<double, 4>{0, 1, 10.0 * mip + 100.0 * layer, 1});
      CHECK(valueAt(inspector, 0, 1)[2] ==
            gl::readFloats(stage.texture("chain"), mip, layer)[(8u >> mip) * 4 + 2]);
    }
  // After the pass that writes level 0 of layer 0 the rest is not there yet, but that one is.
  look(stage, inspector, {.resource = "chain", .pass = "chain[0,0]"});
  CHECK(valueAt(inspector, 3, 0) == std::array<double, 4>{3, 0, 0, 1});

  look(stage, inspector, {.resource = "ids"});
  CHECK(inspector.texel(6, 2)->text() == "26");
  CHECK(inspector.texel(7, 3)->text() == "4294967295");
  look(stage, inspector, {.resource = "deep"});
  CHECK(valueAt(inspector, 3, 2)[0] == 0.25);
  CHECK(inspector.texel(3, 2)->text() == "0.25");
  look(stage, inspector, {.resource = "deep", .stencil = true});
  CHECK(inspector.texel(3, 2)->text() == "77");

  look(stage, inspector, {.resource = "table"});
  CHECK(inspector.bufferBytes() == 64);
  CHECK(inspector.picture().id == 0);
  const auto bytes = inspector.bytes(8, 12);
  REQUIRE(bytes.size() == 12);
  float squares[3];
  std::memcpy(squares, bytes.data(), 12);
  CHECK(squares[0] == 4);
  CHECK(squares[1] == 9);
  CHECK(squares[2] == 16);
  CHECK(inspector.bytes(60, 100).size() == 4);
  CHECK(inspector.bytes(64, 4).empty());
  CHECK_FALSE(inspector.watch(stage.execution(), {.resource = "nothing"}));
  CHECK_FALSE(inspector.watch(stage.execution(), {.resource = "ids", .pass = "nothing"}));
}

TEST_CASE("what is shown: range, marks, zoom; the same as a pass with the shader") {
  const CleanScope clean;
  Stage stage(kGraph, 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  Inspector inspector(stage.renderer().device());
  text::Diagnostics diagnostics;
  look(stage, inspector, {.resource = "shown"});
  const auto shown = gl::readTexture(inspector.picture(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  look(stage, inspector, {.resource = "first"});
  InspectView view{.low = 0, .high = 8, .encode = false, .texelsPerPixel = 0.5};
  GLuint canvas = inspector.draw(view, 16, 8, diagnostics);
  REQUIRE_MESSAGE(canvas != 0, diagnostics.text());
  std::vector<std::byte> drawn(shown.size());
  glGetTextureImage(canvas, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(drawn.size()), drawn.data());
  CHECK(drawn == shown);
  CHECK(pixel(canvas, 8, 4) == std::array<int, 3>{128, 64, 32});  // texel (4, 2): 4/8, 2/8, 1/8
  CHECK(pixel(canvas, 2, 2) == std::array<int, 3>{255, 0, 255});  // NaN
  CHECK(pixel(canvas, 4, 2) == std::array<int, 3>{0, 255, 255});  // infinite
  view.channel = InspectChannel::green;
  view.highlight = false;
  canvas = inspector.draw(view, 16, 8, diagnostics);
  CHECK(pixel(canvas, 8, 4) == std::array<int, 3>{64, 64, 64});
  view.ev = 1;
  canvas = inspector.draw(view, 16, 8, diagnostics);
  CHECK(pixel(canvas, 8, 4) == std::array<int, 3>{128, 128, 128});
  // As a direction, of texel (0, 0): 0, 0, 1; as a motion, of (4, 0): to the right.
  const auto shownAs = [&](InspectColors colors, std::uint32_t x, std::uint32_t y) {
    return pixel(inspector.draw({.high = 1, .colors = colors, .highlight = false}, 8, 4, diagnostics), x, y);
  };
  CHECK(shownAs(InspectColors::direction, 0, 0) == std::array<int, 3>{128, 128, 255});
  CHECK(shownAs(InspectColors::motion, 4, 0) == std::array<int, 3>{255, 0, 0});
  // Zoomed out, one texel that is no number still shows.
  canvas = inspector.draw({.high = 8, .texelsPerPixel = 4}, 2, 1, diagnostics);
  CHECK(pixel(canvas, 0, 0) == std::array<int, 3>{255, 0, 255});
  // Beyond the texture: the board.
  canvas = inspector.draw({.x = 100, .y = 100}, 4, 4, diagnostics);
  CHECK(pixel(canvas, 1, 1)[0] == pixel(canvas, 1, 1)[2]);

  const auto statistics = inspector.measure();
  REQUIRE(statistics.has_value());
  CHECK(statistics->nan == 1);
  CHECK(statistics->infinite == 1);
  CHECK(statistics->texels == 32);
  CHECK(statistics->high[0] == 7);
  CHECK(statistics->low[2] == 1);
  CHECK(statistics->mean[2] == 1);

  look(stage, inspector, {.resource = "ids"});
  canvas =
      inspector.draw({.high = 40, .colors = InspectColors::scale, .encode = false, .texelsPerPixel = 0.5}, 16,
                     8, diagnostics);
  const auto ids = gl::readTexture(stage.texture("shown_ids"), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE);
  glGetTextureImage(canvas, 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(drawn.size()), drawn.data());
  CHECK(drawn == ids);
  // Reversed depth 0.25 with the near plane at 0.1 is 0.4 away.
  look(stage, inspector, {.resource = "deep"});
  canvas = inspector.draw({.high = 1, .encode = false, .depth = true, .nearPlane = 0.1f}, 8, 4, diagnostics);
  CHECK(pixel(canvas, 3, 2) == std::array<int, 3>{102, 102, 102});
  CHECK(diagnostics.empty());
}

TEST_CASE("an inspector changes nothing but itself: the picture, and a graph replaced under it") {
  const CleanScope clean;
  Stage stage("graphs/glow.json", 64, 36);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const auto before = stage.pixels();
  Inspector inspector(stage.renderer().device());
  look(stage, inspector, {.resource = "glow", .mip = 2});
  CHECK(inspector.picture().desc.width == 8);
  CHECK(stage.pixels() == before);
  stage.settings.screenWidth = 128;
  REQUIRE(stage.apply());
  CHECK_FALSE(stage.execution().watched());
  look(stage, inspector, {.resource = "glow", .mip = 2});
  CHECK(inspector.picture().desc.width == 16);
  text::Diagnostics diagnostics;
  CHECK(inspector.draw({}, 20, 10, diagnostics) != 0);
  stage.run();
  CHECK(inspector.copies() == 3);
}

}  // namespace inspection_inspector_test
