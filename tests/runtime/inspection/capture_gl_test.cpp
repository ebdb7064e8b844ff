// What a capture takes of a frame is what the viewer's inspector shows of it, bit for bit, for every version after every writer.
#include <algorithm>
#include <cstring>
#include <map>
#include <set>

#include "engine/runtime/inspection/inspector.h"
#include "tests/runtime/stage.h"

namespace inspection_capture_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

struct Seen {
  assets::Image8 picture;
  assets::ImageF values;
  std::vector<std::byte> bytes;
};

Seen seenIn(Inspector& inspector) {
  text::Diagnostics diagnostics;
  if (inspector.picture().id == 0)
    return {.picture = {}, .values = {}, .bytes = inspector.bytes(0, inspector.bufferBytes())};
  auto picture = inspector.drawWhole(inspector.fittedView(), diagnostics);
  auto values = inspector.values();
  REQUIRE_MESSAGE(picture.has_value(), diagnostics.text());
  REQUIRE(values.has_value());
  return {std::move(*picture), std::move(*values), {}};
}

// NaN equals itself.
bool areSame(const Seen& a, const Seen& b) {
  return a.picture.width == b.picture.width && a.picture.texels == b.picture.texels &&
         a.values.channels == b.values.channels && a.values.texels.size() == b.values.texels.size() &&
         (a.values.texels.empty() || std::memcmp(a.values.texels.data(), b.values.texels.data(),
                                                 a.values.texels.size() * sizeof(float)) == 0) &&
         a.bytes == b.bytes;
}

std::map<std::size_t, Seen> captureAll(Stage& stage, const std::vector<CaptureItem>& items) {
  Inspector inspector(stage.renderer().device());
  std::map<std::size_t, Seen> seen;
  watchItems(stage.execution(), inspector, items,
             [&](std::size_t item) { seen.insert_or_assign(item, seenIn(inspector)); });
  stage.run();
  inspector.release(stage.execution());
  return seen;
}

}  // namespace

TEST_CASE("every version after every writer is captured in one frame as the inspector shows it") {
  const std::string patterns[] = {"*"};
  for (const auto& [graph, least] :
       {std::pair("tests/theory/inspect.json", 13), std::pair("graphs/glow.json", 11)}) {
    CAPTURE(graph);
    const CleanScope clean;
    Stage stage(graph, 32, 18);
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    const std::vector<CaptureItem> items = captureItems(stage.execution().plan(), patterns);
    CHECK(static_cast<int>(items.size()) >= least);
    const auto captured = captureAll(stage, items);
    REQUIRE(captured.size() == items.size());
    Inspector inspector(stage.renderer().device());
    for (std::size_t i = 0; i < items.size(); ++i) {
      CAPTURE(items[i].target.resource);
      CAPTURE(items[i].target.pass);
      CAPTURE(items[i].target.mip);
      REQUIRE(inspector.watch(stage.execution(), items[i].target));
      stage.run();
      CHECK(areSame(captured.at(i), seenIn(inspector)));
    }
    inspector.release(stage.execution());
  }
}

TEST_CASE(
    "values are those that the passes wrote: floats, whole numbers, depth, stencil, levels and layers") {
  const CleanScope clean;
  Stage stage("tests/theory/inspect.json", 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const graph::Plan& plan = stage.execution().plan();
  const auto valuesOf = [&](const char* text) {
    const auto pick = graph::parsePick(text);
    REQUIRE(pick.has_value());
    text::Diagnostics diagnostics;
    const auto item = captureItemOf(plan, *pick, diagnostics);
    REQUIRE_MESSAGE(item.has_value(), diagnostics.text());
    return captureAll(stage, {*item}).at(0).values;
  };
  const assets::ImageF first = valuesOf("first");
  REQUIRE(first.width == 8);
  REQUIRE(first.channels == 4);
  CHECK(first.texels[0] == 0);  // top row first: y is 3
  CHECK(first.texels[1] == 3);
  CHECK(first.texels[7 * 4] == 7);
  const assets::ImageF chain = valuesOf("chain.mip[1].layer[1]");
  CHECK(chain.width == 4);
  const auto whole = gl::readFloats(stage.texture("chain"), 1, 1);
  for (std::size_t x = 0; x < 4; ++x) CHECK(chain.texels[x * 4] == whole[(3 * 4 + x) * 4]);
  const assets::ImageF ids = valuesOf("ids");
  CHECK(ids.channels == 1);
  const auto numbers = gl::readFloats(stage.texture("ids"));
  CHECK(ids.texels[0] == numbers[std::size_t{3} * 8 * 4]);
  CHECK(valuesOf("deep.stencil").texels == std::vector<float>(32, 77));
  const assets::ImageF deep = valuesOf("deep");
  REQUIRE(deep.texels.size() == 32);
  for (std::size_t i = 0; i < 32; ++i) CHECK(deep.texels[i] == static_cast<float>(i % 8 + 1) / 16.0f);
}

TEST_CASE("what cannot be picked is said, with what there is") {
  const CleanScope clean;
  Stage stage("tests/theory/inspect.json", 16, 16);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  const auto said = [&](const char* text) {
    const auto pick = graph::parsePick(text);
    REQUIRE(pick.has_value());
    text::Diagnostics diagnostics;
    CHECK_FALSE(captureItemOf(stage.execution().plan(), *pick, diagnostics));
    REQUIRE(diagnostics.items().size() == 1);
    return diagnostics.items()[0];
  };
  CHECK(said("frist").code == text::Code::unknownResource);
  CHECK(said("frist").hint == "did you mean 'first'?");
  CHECK(said("first#2").expected == "#1 to #1");
  CHECK(said("chain.mip[3]").expected == "level 0 to 2");
  CHECK(said("chain.layer[2]").expected == "layer 0 to 1");
  CHECK(said("first.stencil").code == text::Code::badSelector);
  CHECK(said("first@-1").code == text::Code::noHistory);
  CHECK(said("first after two").code == text::Code::unknownPass);
  CHECK(said("first after two").expected == "one");
}

}  // namespace inspection_capture_test
