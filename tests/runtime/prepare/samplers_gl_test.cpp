// What a sampler finds outside 0..1 and what its comparison says, against values worked out by hand.
#include <array>

#include "tests/runtime/stage.h"

namespace prepare_samplers_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

// One channel of the only row of a texture.
template <std::size_t n>
void checkChannel(Stage& stage, const char* resource, std::size_t channel,
                  const std::array<float, n>& expected) {
  const std::vector<float> texels = stage.read(resource);
  REQUIRE(texels.size() == n * 4);
  for (std::size_t i = 0; i < n; ++i)
    CHECK_MESSAGE(texels[i * 4 + channel] == expected[i],
                  resource << ", texel " << i << ", channel " << channel);
}

}  // namespace

TEST_CASE("outside 0..1 a lookup finds the edge, the texture again, its mirror image or the border") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/samplers.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  constexpr float a = 0.25f, b = 0.5f, c = 0.75f, d = 1;
  checkChannel<12>(stage, "nearest", 0, {a, a, a, a, a, b, c, d, d, d, d, d});
  checkChannel<12>(stage, "nearest", 1, {a, b, c, d, a, b, c, d, a, b, c, d});
  checkChannel<12>(stage, "nearest", 2, {d, c, b, a, a, b, c, d, d, c, b, a});
  checkChannel<12>(stage, "nearest", 3, {9, 9, 9, 9, a, b, c, d, 9, 9, 9, 9});
  // Between two texels: their mean, also of a texel and the border.
  checkChannel<12>(stage, "others", 0, {9, 9, 9, 9, 4.625f, 0.375f, 0.625f, 0.875f, 5, 9, 9, 9});
  constexpr float most = 4000000000.0f;
  checkChannel<12>(stage, "others", 1, {most, most, most, most, 1, 2, 3, 4, most, most, most, most});
  checkChannel<12>(stage, "others", 2, {-3, -3, -3, -3, -1, -2, -3, -4, -3, -3, -3, -3});
}

TEST_CASE("a depth sampler compares as the reference says") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/samplers.json", 8, 8);
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  // 0.5 against 0.25, 0.5, 0.75, 1; left and right of them the edge, or the border.
  checkChannel<6>(stage, "first", 0, {0, 0, 1, 1, 1, 1});   // less_equal
  checkChannel<6>(stage, "first", 1, {0, 0, 0, 1, 1, 1});   // less
  checkChannel<6>(stage, "first", 2, {0, 0, 1, 1, 1, 1});   // less_equal
  checkChannel<6>(stage, "first", 3, {0, 0, 1, 0, 0, 0});   // equal
  checkChannel<6>(stage, "second", 0, {1, 1, 0, 0, 0, 0});  // greater
  checkChannel<6>(stage, "second", 1, {1, 1, 1, 0, 0, 0});  // greater_equal
  checkChannel<6>(stage, "second", 2, {1, 1, 0, 1, 1, 1});  // not_equal
  checkChannel<6>(stage, "second", 3, {1, 1, 1, 1, 1, 1});  // always
  checkChannel<6>(stage, "third", 0, {0, 0, 0, 0, 0, 0});   // never
  checkChannel<6>(stage, "third", 1, {1, 0, 1, 1, 1, 1});   // less_equal, and outside a depth of 1
}

}  // namespace prepare_samplers_test
