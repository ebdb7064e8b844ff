// Sliced work on the GPU: what it gives is what the whole pass gives, nobody sees half of it, and it starts again when
// something changes.
#include <algorithm>
#include <random>
#include <set>

#include "tests/runtime/frame_allocations.h"
#include "tests/runtime/stage.h"

namespace cadence_slices_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

constexpr const char* kGraph = "tests/runtime/graphs/slices.json";
constexpr const char* kScene = "scenes/empty.json";

struct Live {
  explicit Live(std::vector<weft::graph::Setting> sets) : stage(kGraph, 8, 8, kScene) {
    load(std::move(sets));
  }
  void load(std::vector<weft::graph::Setting> sets) {
    stage.settings.sets = std::move(sets);
    REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  }
  std::vector<float> frame(bool headless = false) {
    runtime::FrameInput input = runtime::headlessFrame(stage.world, count, 60);
    input.headless = headless;
    input.time = 10 + 0.25 * count++;
    stage.run(input);
    return stage.read("out");
  }
  // The group is published, and the picture made of it.
  std::vector<float> settled() {
    std::vector<float> last;
    for (int i = 0; i < 60; ++i) last = frame();
    return last;
  }
  Stage stage;
  std::uint32_t count = 0;
};

// All texels but the first tell the same: field, mapped = 2 field, the mean of mapped, field * 1000 + mean.
float seedOf(const std::vector<float>& picture) {
  const float seed = picture[4];
  for (std::size_t i = 4; i < picture.size(); i += 4) {
    CHECK(picture[i] == seed);
    CHECK(picture[i + 1] == picture[5]);
    CHECK(picture[i + 2] == picture[6]);
    CHECK(picture[i + 3] == picture[7]);
  }
  if (seed == -1) {  // before the first publication: `first`, zeros, and a pass that waits
    CHECK(picture[5] == 0);
    CHECK(picture[6] == 0);
    return seed;
  }
  CHECK(picture[5] == 2 * seed);
  CHECK(picture[6] == 2 * seed);
  CHECK(picture[7] == 1002 * seed);
  return seed;
}

}  // namespace

TEST_CASE(
    "slices: readers see the first value, then all of the result at once, after as many frames as there are "
    "slices") {
  const CleanScope clean;
  Live live({{"n", "4"}, {"m", "3"}});
  for (int i = 0; i < 7; ++i) {  // 4 + 3 slices
    CHECK(seedOf(live.frame()) == -1);
    CHECK(live.stage.ran("field") == (i < 4));
    CHECK(live.stage.ran("map") == (i >= 4));
    CHECK_FALSE(live.stage.ran("total"));
    CHECK_FALSE(live.stage.ran("after"));
  }
  const std::vector<float> first = live.frame();
  CHECK(seedOf(first) == 1);
  CHECK(live.stage.ran("total"));
  CHECK(live.stage.ran("after"));
  CHECK_FALSE(live.stage.ran("field"));
  CHECK(first[0] == 0);   // published now
  CHECK(first[1] == -1);  // before it
  CHECK(live.frame()[0] == 0.25f);
  CHECK_FALSE(live.stage.ran("after"));
}

TEST_CASE(
    "slices: a change of a parameter starts again, and the old result stays until the new one is whole") {
  const CleanScope clean;
  Live live({{"n", "3"}, {"m", "2"}});
  CHECK(seedOf(live.settled()) == 1);
  live.load({{"n", "3"}, {"m", "2"}, {"seed", "5"}});
  for (int i = 0; i < 4; ++i) CHECK(seedOf(live.frame()) == 1);
  live.load({{"n", "3"}, {"m", "2"}, {"seed", "7"}});  // one slice before the end
  for (int i = 0; i < 5; ++i) CHECK(seedOf(live.frame()) == 1);
  const std::vector<float> turned = live.frame();
  CHECK(seedOf(turned) == 7);
  CHECK(turned[0] == 0);
  CHECK(turned[1] == 1);  // the publication before, not the 5 that was never finished
  CHECK(live.stage.execution().plan().copiesOf(live.stage.execution().plan().graph->present.resource) == 1);
}

TEST_CASE("slices: resizing starts from the first value again") {
  const CleanScope clean;
  Live live({{"n", "2"}, {"m", "2"}});
  CHECK(seedOf(live.settled()) == 1);
  live.load({{"n", "2"}, {"m", "2"}, {"size", "29"}});
  CHECK(live.frame()[4] == -1);
  CHECK(seedOf(live.settled()) == 1);
}

TEST_CASE("slices: a headless frame has everything, and its age is infinite from the start") {
  const CleanScope clean;
  Live live({{"n", "5"}, {"m", "4"}});
  const std::vector<float> picture = live.frame(true);
  CHECK(seedOf(picture) == 1);
  CHECK(picture[0] == 1);
  Live whole({});
  CHECK(whole.frame(true) == picture);
  live.load({{"n", "5"}, {"m", "4"}, {"seed", "2"}});
  CHECK(seedOf(live.frame(true)) == 2);
}

TEST_CASE("slices: any number of them gives the bytes of the whole pass, and no frame shows a mix") {
  const CleanScope clean;
  std::mt19937 random(7);
  const auto some = [&](unsigned least) { return std::to_string(least + random() % 15); };
  for (int round = 0; round < 12; ++round) {
    const std::string size = std::to_string(1 + random() % 40);
    std::vector<weft::graph::Setting> sets = {{"size", size}, {"seed", "3"}};
    Live whole(sets);
    std::vector<float> expected = whole.settled();
    for (const char* each : {"n", "m", "k"}) sets.emplace_back(each, some(each[0] == 'k' ? 0 : 1));
    Live sliced(sets);
    std::set<float> seen;
    std::vector<float> last;
    for (int i = 0; i < 60; ++i) seen.insert(seedOf(last = sliced.frame()));
    CHECK(last == expected);
    const bool isSliced = sets[2].text != "1" || sets[3].text != "1" || std::stoi(sets[4].text) > 1;
    CHECK(seen == (isSliced ? std::set<float>{-1, 3} : std::set<float>{3}));
  }
}

TEST_CASE("slices: a frame that goes on with a pass allocates nothing") {
  const CleanScope clean;
  Live live({{"n", "9"}, {"m", "9"}});
  runtime::FrameInput input = runtime::headlessFrame(live.stage.world, 0, 60);
  input.headless = false;
  text::Diagnostics diagnostics;
  std::size_t allocations = 0;
  for (int i = 0; i < 18; ++i) {
    const bool first = i % 9 < 3;  // its program is compiled by the driver, its framebuffer made
    if (!first) startCountingAllocations();
    live.stage.renderer().frame(live.stage.world, input, diagnostics);
    const std::size_t counted = first ? 0 : stopCountingAllocations();
    if (i % 9 < 8) allocations += counted;  // with the last slice another pass begins
  }
  CHECK(allocations == 0);
}

}  // namespace cadence_slices_test
