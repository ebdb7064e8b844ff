// A frame that became obsolete under way: its picture and its histories are dropped, and every later frame is what it is
// without that frame.
#include <cstdint>
#include <vector>

#include "tests/runtime/stage.h"

using namespace weft;
using namespace weft::runtime::test;

namespace {

runtime::FrameReport frame(Stage& stage, std::uint32_t number, int obsoleteAfter) {
  runtime::FrameInput input = runtime::headlessFrame(stage.world, number, 60);
  int asked = 0;
  if (obsoleteAfter >= 0) input.obsolete = [&] { return asked++ >= obsoleteAfter; };
  text::Diagnostics said;
  const runtime::FrameReport report = stage.renderer().frame(stage.world, input, said);
  CHECK_MESSAGE(said.empty(), said.text());
  return report;
}

}  // namespace

TEST_CASE("obsolete: frames after it are those of a run without it") {
  const CleanScope clean;
  constexpr std::uint32_t kFrames = 6, kObsolete = 3;
  for (const int after : {-1, 0, 1, 2, 3, 4}) {
    CAPTURE(after);
    Stage stage("tests/runtime/graphs/obsolete.json", 8, 8, "scenes/empty.json");
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
    float step = 0;
    for (std::uint32_t n = 0; n < kFrames; ++n) {
      const bool stops = n == kObsolete && after >= 0, whole = !stops || after > 3;  // of four passes
      if (whole) step = 2 * step + 1;
      const runtime::FrameReport report = frame(stage, n, n == kObsolete ? after : -1);
      CHECK(report.whole == whole);
      CHECK(stage.ran("next") == (!stops || after > 0));
      CHECK(stage.ran("keep") == (!stops || after > 1));
      CHECK(stage.ran("show") == whole);
      if (whole) CHECK(stage.value() == 10 * step + 0.5f);
    }
  }
}

TEST_CASE("obsolete: of the studio picture nothing runs on, and what adapts stays where it was") {
  const CleanScope clean;
  Stage stage("graphs/studio.json", 96, 54);
  stage.settings.sets = {{"auto_exposure", "true"}};
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  frame(stage, 0, -1);
  const std::vector<std::uint8_t> whole = stage.pixels();
  CHECK_FALSE(frame(stage, 1, 0).whole);
  CHECK_FALSE(stage.ran("post.exposure.adapt"));
  CHECK_FALSE(stage.ran("post.display.composite"));
  CHECK_FALSE(stage.ran("post.fxaa.smooth"));
  CHECK(frame(stage, 2, -1).whole);
  CHECK(stage.pixels() == whole);  // the light stands still
}
