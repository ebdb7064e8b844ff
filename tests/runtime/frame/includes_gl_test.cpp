// What an include has of its own: the size of its screen, and its camera. Its picture is that of its file rendered by itself, byte for
// byte.
#include "engine/scene/files/scene_file.h"
#include "tests/runtime/stage.h"

namespace frame_includes_test {

using namespace weft;
using namespace weft::runtime;
using namespace weft::runtime::test;

namespace {

constexpr std::uint32_t kSheetWidth = 96, kSheetHeight = 64;
constexpr const char* kPart = "tests/runtime/graphs/seen_part.json";

void runTo(Stage& stage, std::uint32_t first, std::uint32_t last) {
  for (std::uint32_t frame = first; frame <= last; ++frame) stage.run(frame);
}

}  // namespace

TEST_CASE("an include with a screen of its own is its file rendered at that size, also after another size") {
  context();
  const CleanScope scope;
  Stage whole("tests/runtime/graphs/seen_smaller.json", kSheetWidth, kSheetHeight);
  REQUIRE_MESSAGE(whole.load(), whole.diagnostics.text());
  runTo(whole, 0, 2);
  Stage half(kPart, kSheetWidth / 2, kSheetHeight / 2);
  REQUIRE_MESSAGE(half.load(), half.diagnostics.text());
  runTo(half, 0, 2);
  CHECK(whole.read("part.sum") == half.read("sum"));

  whole.settings.sets = {{"scale", "1"}};
  REQUIRE_MESSAGE(whole.apply(), whole.diagnostics.text());
  runTo(whole, 3, 4);
  Stage full(kPart, kSheetWidth, kSheetHeight);
  REQUIRE_MESSAGE(full.load(), full.diagnostics.text());
  runTo(full, 3, 4);
  CHECK(whole.read("part.sum") == full.read("sum"));
}

TEST_CASE("four includes with a camera each are the pictures of the four cameras") {
  context();
  const CleanScope scope;
  Stage sheet("tests/runtime/graphs/contact_sheet.json", kSheetWidth, kSheetHeight);
  REQUIRE_MESSAGE(sheet.load(), sheet.diagnostics.text());
  runTo(sheet, 0, 2);
  std::vector<std::vector<float>> seen;
  for (const std::string camera : {"front", "left", "right", "top"}) {
    CAPTURE(camera);
    Stage alone(kPart, kSheetWidth / 2, kSheetHeight / 2);
    text::Diagnostics diagnostics;
    auto scene = scene::loadScene(sourcePath("scenes/spheres.json"), diagnostics, nullptr,
                                  {.camera = camera, .materials = ""});
    REQUIRE_MESSAGE(scene, diagnostics.text());
    alone.world.setScene(*std::move(scene));
    REQUIRE_MESSAGE(alone.load(), alone.diagnostics.text());
    runTo(alone, 0, 2);
    seen.push_back(alone.read("sum"));
    CHECK(sheet.read(camera + ".sum") == seen.back());
  }
  CHECK(seen[1] != seen[2]);  // the spheres stand in another order from there
}

}  // namespace frame_includes_test
