// Fixed-function state: rectangles on 16 by 16 texels against what OpenGL 4.5 core, 17.3, says of them, worked out here.
#include <array>
#include <functional>

#include "tests/runtime/stage.h"

namespace frame_draw_state_test {

using namespace weft;
using namespace weft::runtime::test;

namespace {

struct Texel {
  float depth = 0;
  int stencil = 8;
  std::array<float, 4> color{1, 1, 1, 1};
};

class Reference {
 public:
  Texel& at(int x, int y) { return texels_[static_cast<std::size_t>(16 * y + x)]; }
  void rect(int x0, int y0, int x1, int y1, const std::function<void(Texel&)>& draw) {
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) draw(at(x, y));
  }

 private:
  std::array<Texel, 256> texels_;
};

Reference makeReference(int reference) {
  Reference r;
  r.rect(2, 0, 10, 16, [](Texel& t) {  // mark: nothing is nearer yet
    t.stencil = (t.stencil & ~3) | (5 & 3);
    t.depth = 0.5F;
  });
  r.rect(6, 0, 14, 16, [](Texel& t) {  // fail
    if (!((24 & 15) < (t.stencil & 15)))
      t.stencil = (t.stencil + 1) & 255;
    else if (!(0.25F > t.depth))
      t.stencil = ~t.stencil & 255;
    else
      t = {0.25F, 0, t.color};
  });
  r.rect(0, 0, 4, 16, [](Texel& t) { t.stencil -= 1; });  // backs
  r.rect(0, 0, 16, 8, [&](Texel& t) {                     // blend
    if (t.stencil == reference) t.color = {1 - 0.25F * 0.5F, 1, 1 - 0.75F * 0.5F, 1 * 0.25F};
  });
  r.rect(3, 9, 7, 11, [](Texel& t) { t.color.fill(7); });     // view
  r.rect(12, 12, 16, 16, [](Texel& t) { t.color.fill(3); });  // clamped; clipped draws nothing
  r.rect(0, 6, 16, 7, [](Texel& t) { t.color.fill(9); });     // plain
  return r;
}

void compare(Stage& stage, int reference) {
  Reference r = makeReference(reference);
  const std::vector<float> color = stage.read("color"), stencil = stage.read("values");
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      CAPTURE(x);
      CAPTURE(y);
      const auto at = static_cast<std::size_t>(16 * y + x) * 4;
      CHECK(stencil[at] == static_cast<float>(r.at(x, y).stencil));
      if (x == 0 && y == 15) continue;  // means of the samples, below
      for (std::size_t c = 0; c < 4; ++c) CHECK(color[at + c] == doctest::Approx(r.at(x, y).color[c]));
    }
  const std::size_t mean = 16 * 15 * 4;
  CHECK(color[mean] == 0.5F);     // two of four samples
  CHECK(color[mean + 1] > 0.2F);  // half of them, as the device rounds it
  CHECK(color[mean + 1] < 0.8F);
}

}  // namespace

TEST_CASE("each pass draws under the state that it says, and under no other") {
  const CleanScope clean;
  Stage stage("tests/runtime/graphs/state.json", 16, 16, "scenes/empty.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  compare(stage, 9);
  stage.settings.sets = {{"reference", "246"}};
  REQUIRE_MESSAGE(stage.apply(), stage.diagnostics.text());
  stage.run(1);
  compare(stage, 246);
}

}  // namespace frame_draw_state_test
