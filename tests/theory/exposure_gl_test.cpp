// Auto-exposure: the mean is brought to the key value from eight stops either side, without passing it, at
// the speeds asked for; outliers and black do not count; a black picture is taken well.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <string>

#include "tests/theory/lab.h"

namespace exposure_test {

using namespace weft::theory;

namespace {

using Sets = std::vector<weft::graph::Setting>;

constexpr double kKey = 0.18;

Setup setupOf(double left, double right, double first, Sets more = {}) {
  Setup setup{.graph = "tests/theory/look.json", .width = 64, .height = 32};
  setup.sets = {{"bloom", "false"}, {"fxaa", "false"}, {"auto_exposure", "true"}, {"curve", "filmic"}};
  setup.sets.emplace_back("ramp.left", fmt::format("[{0}, {0}, {0}]", left));
  setup.sets.emplace_back("ramp.right", fmt::format("[{0}, {0}, {0}]", right));
  setup.sets.emplace_back("ramp.first", fmt::format("{}", first));
  setup.sets.insert(setup.sets.end(), more.begin(), more.end());
  return setup;
}

// The factor that the composite takes.
double adapted(Lab& lab) {
  return std::bit_cast<float>(lab.readBuffer("post.adapted", 4)[0]);
}

double stopsAfterOneFrame(const Setup& setup) {
  Lab lab(setup);
  lab.frame(0);
  CHECK(lab.reports() == "");
  return std::log2(adapted(lab));
}

}  // namespace

TEST_CASE("auto-exposure: the first frame is exposed at once, within a hundredth of a stop, at every level") {
  for (double level = 0.0002; level < 700; level *= 3.1) {
    CAPTURE(level);
    CHECK(std::abs(stopsAfterOneFrame(setupOf(level, level, 1)) - std::log2(kKey / level)) < 0.0126);
  }
}

TEST_CASE("auto-exposure: converges to the key value from 8 stops either side, monotonously, at its speed") {
  for (const double start : {8.0, -8.0}) {
    // Frame 0 sees a scene `start` stops brighter, and adapts to it at once.
    Lab lab(setupOf(kKey, kKey, std::exp2(start), {{"speed_up", "6"}, {"speed_down", "4"}}));
    const double speed = start > 0 ? 4 : 6;
    lab.frame(0);
    double before = std::log2(adapted(lab));
    CHECK(std::abs(before + start) < 0.0126);
    bool monotonous = true, lawful = true;
    for (std::uint32_t frame = 1; frame <= 150; ++frame) {
      lab.frame(frame);
      const double ev = std::log2(adapted(lab));
      monotonous = monotonous &&
                   (start > 0 ? ev >= before - 1e-5 && ev <= 0.0126 : ev <= before + 1e-5 && ev >= -0.0126);
      lawful = lawful && std::abs(ev + start * std::exp(-speed * frame / 60.0)) < 0.03;
      before = ev;
    }
    CAPTURE(start);
    MESSAGE("from ", start, " stops: ", before, " stops off after 150 frames");
    CHECK(monotonous);
    CHECK(lawful);
    CHECK(std::abs(before) < 0.0126);
    // And the picture is at the key value.
    const Picture picture = lab.read("post.ldr");
    CHECK(lab.reports() == "");
    const auto hable = [](double v) {
      return (v * (0.15 * v + 0.05) + 0.004) / (v * (0.15 * v + 0.5) + 0.06) - 0.02 / 0.3;
    };
    const double display = hable(3 * kKey) / hable(24), encoded = 1.055 * std::pow(display, 1 / 2.4) - 0.055;
    CHECK(std::abs(255.0 * static_cast<double>(picture.at(5, 5)[1]) - 255 * encoded) < 0.028);
  }
}

TEST_CASE(
    "auto-exposure: the mean is geometric between the percentiles; bounds hold; compensation is the exposure "
    "parameter") {
  // All of a ramp counts: the mean of log2 of a ramp from a to b, by parts.
  const double a = 0.1, b = 3.0;
  const double mean = (b * std::log2(b) - a * std::log2(a)) / (b - a) - 1 / std::log(2.0);
  CHECK(std::abs(stopsAfterOneFrame(setupOf(a, b, 1, {{"low", "0"}, {"high", "1"}})) -
                 (std::log2(kKey) - mean)) < 0.02);
  // From the 20th to the 60th percentile only.
  const double c = a + 0.2 * (b - a), d = a + 0.6 * (b - a);
  const double clipped = (d * std::log2(d) - c * std::log2(c)) / (d - c) - 1 / std::log(2.0);
  const double found = stopsAfterOneFrame(setupOf(a, b, 1, {{"low", "0.2"}, {"high", "0.6"}}));
  CHECK(std::abs(found - (std::log2(kKey) - clipped)) < 0.011);
  CHECK(std::abs(stopsAfterOneFrame(setupOf(9, 9, 1, {{"min_ev", "-2"}})) + 2) < 1e-4);
  CHECK(std::abs(stopsAfterOneFrame(setupOf(0.002, 0.002, 1, {{"max_ev", "3"}})) - 3) < 1e-4);
  CHECK(std::abs(stopsAfterOneFrame(setupOf(1, 1, 1, {{"exposure", "4"}})) - std::log2(kKey)) < 1e-5);
}

TEST_CASE("auto-exposure: a black picture changes nothing, and is no reason for anything but black") {
  Lab lab(setupOf(0, 0, 1));
  for (std::uint32_t frame = 0; frame < 3; ++frame) lab.frame(frame);
  CHECK(adapted(lab) == -1);
  const Picture picture = lab.read("post.ldr");
  for (std::uint32_t x = 0; x < picture.width; ++x) CHECK(picture.at(x, 7)[0] == 0);
  CHECK(lab.reports() == "");
}

TEST_CASE(
    "auto-exposure: after black the exposure rises evenly to its target within a quarter of a second, and "
    "stays there") {
  for (const double level : {0.02, 5.0}) {
    CAPTURE(level);
    Lab lab(setupOf(level, level, 0));  // frame 0 is black
    lab.frame(0);
    CHECK(adapted(lab) == -1);
    double before = 0;
    for (std::uint32_t frame = 1; frame <= 15; ++frame) {
      lab.frame(frame);
      const double factor = adapted(lab) * level / kKey;
      CHECK(std::abs(factor - frame / 15.0) < 0.012);
      CHECK(factor > before);
      before = factor;
    }
    for (std::uint32_t frame = 16; frame <= 18; ++frame) {
      lab.frame(frame);
      CHECK(std::abs(adapted(lab) * level / kKey - 1) < 0.012);
    }
    CHECK(lab.reports() == "");
  }
}

}  // namespace exposure_test
