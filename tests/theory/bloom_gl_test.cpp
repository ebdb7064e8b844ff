// Bloom: what is below the threshold is left alone; light moves and is not made or lost; what is not a number
// stays where it is. And fog, on the same plane: Beer's law, at distances known to the test.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tests/theory/lab.h"

namespace bloom_test {

using namespace weft::theory;

namespace {

using Sets = std::vector<weft::graph::Setting>;

constexpr std::uint32_t kWidth = 384, kHeight = 256;

// Scene-referred values out of the composite: a linear curve whose white is 32, sRGB encoded in full
// precision.
struct Radiance {
  Picture panels;
  std::uint32_t width = 0;
  double at(std::uint32_t x, std::uint32_t y, int channel = 1) const {
    const double c = panels.at(2 * width + x, y)[channel];
    return 32 * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
  }
  double mean() const {
    double sum = 0;
    for (std::uint32_t y = 0; y < panels.height; ++y)
      for (std::uint32_t x = 0; x < width; ++x) sum += at(x, y);
    return sum / (width * panels.height);
  }
};

Setup setupOf(Sets sets, std::uint32_t width = kWidth, std::uint32_t height = kHeight) {
  return {
      .graph = "tests/theory/impulse_exact.json", .width = width, .height = height, .sets = std::move(sets)};
}

Radiance render(Sets sets, std::uint32_t width = kWidth, std::uint32_t height = kHeight) {
  Lab lab(setupOf(std::move(sets), width, height));
  lab.frame(0);
  Radiance result{lab.read("panels"), width};
  CHECK(lab.reports() == "");
  return result;
}

Sets with(Sets sets, const Sets& more) {
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

constexpr double kValue = 24;  // below the white of the curve

// Mean of the picture over that without bloom, averaged over places of the square at least 64 pixels from the
// borders.
double keptBy(const Sets& sets, double background) {
  double kept = 0;
  int places = 0;
  for (const int x : {64, 101, 177, 230, 319})
    for (const int y : {64, 123, 191}) {
      const Sets all = with(sets, {{"plane.at", fmt::format("[{}, {}]", x, y)},
                                   {"plane.value", fmt::format("{}", kValue)},
                                   {"plane.background", fmt::format("{}", background)}});
      kept += render(with(all, {{"bloom", "true"}})).mean() / render(all).mean();
      ++places;
    }
  return kept / places;
}

}  // namespace

TEST_CASE("bloom at threshold 0 and full strength keeps the mean within 0.15 %") {
  const Sets sets{{"bloom_strength", "1"}, {"threshold", "0"}, {"firefly", "false"}};
  const double kept = keptBy(sets, 0);
  MESSAGE("mean kept: ", kept);
  CHECK(std::abs(kept - 1) < 0.0015);
}

TEST_CASE(
    "bloom with a threshold keeps the mean within 0.01 %; firefly weights cost at most what is above the "
    "threshold") {
  const double background = 0.05, above = (kValue - 1) / (kWidth * kHeight),
               mean = background + (kValue - background) / (kWidth * kHeight);
  for (const std::string strength : {"0.05", "0.5", "1"}) {
    const Sets sets{{"bloom_strength", strength}, {"threshold", "1"}};
    const double kept = keptBy(with(sets, {{"firefly", "false"}}), background);
    const double tamed = keptBy(with(sets, {{"firefly", "true"}}), background);
    CAPTURE(strength);
    MESSAGE("strength ", strength, ": mean kept ", kept, ", with firefly weights ", tamed);
    CHECK(std::abs(kept - 1) < 1e-4);
    CHECK(tamed < 1.001);
    CHECK(tamed > 1 - std::stod(strength) * above / mean - 1e-4);
  }
}

TEST_CASE("at every size the halo stands where its light is, and has all of it") {
  // Odd in the picture, or where it is halved; with a narrow halo, and with the default's in the middle and in two corners.
  for (const auto& [width, height] : {std::pair{384u, 256u},
                                      {633u, 350u},
                                      {360u, 202u},
                                      {321u, 127u},
                                      {255u, 383u},
                                      {480u, 270u},
                                      {1280u, 720u}})
    for (const double share : {0.0, 0.3, 0.48, 0.485, 0.62, 0.9999}) {
      const bool narrow = share == 0.3 || share == 0.62;
      const auto x = static_cast<std::uint32_t>(share * width),
                 y = static_cast<std::uint32_t>(share * height);
      const Radiance picture = render({{"bloom", "true"},
                                       {"bloom_strength", "1"},
                                       {"threshold", "0"},
                                       {"firefly", "false"},
                                       {"plane.at", fmt::format("[{}, {}]", x, y)},
                                       {"plane.value", "24"},
                                       {"scatter", narrow ? "0.3" : "0.7"}},
                                      width, height);
      double sum = 0, across = 0, along = 0;
      for (std::uint32_t row = 0; row < height; ++row)
        for (std::uint32_t column = 0; column < width; ++column) {
          const double light = picture.at(column, row);
          sum += light;
          across += light * column;
          along += light * row;
        }
      CAPTURE(width);
      CAPTURE(x);
      CHECK(std::abs(sum / kValue - 1) < (narrow ? 0.06 : 0.02));
      if (share < 0.1 || share > 0.9) continue;  // a border cuts the halo
      CHECK(std::abs(across / sum - x) < 1);
      CHECK(std::abs(along / sum - y) < 1);
    }
}

TEST_CASE("a picture below the threshold is the same with bloom and without, at any strength") {
  const Sets sets{{"plane.value", "0.45"}, {"plane.background", "0.2"}, {"plane.side", "40"}};
  const Radiance without = render(sets);
  const Radiance bloomed =
      render(with(sets, {{"bloom", "true"}, {"bloom_strength", "1"}, {"threshold", "1"}}));
  double worst = 0;
  for (std::uint32_t y = 0; y < kHeight; ++y)
    for (std::uint32_t x = 0; x < kWidth; ++x)
      worst = std::max(worst, std::abs(without.at(x, y) - bloomed.at(x, y)));
  CHECK(worst == 0);
}

TEST_CASE("bloom of strength 0 is not drawn") {
  Lab lab(setupOf({{"bloom", "true"}, {"bloom_strength", "0"}}));
  lab.frame(0);
  CHECK(lab.passNames().find("glow") == std::string::npos);
  Lab drawn(setupOf({{"bloom", "true"}}));
  drawn.frame(0);
  CHECK(drawn.passNames().find("glow") != std::string::npos);
}

TEST_CASE(
    "a texel that is not a number counts as black, an infinite one as the largest half: no filter spreads "
    "them") {
  const Sets effects[] = {
      {{"bloom", "true"}, {"bloom_strength", "1"}, {"threshold", "0"}},
      {{"dof", "true"}, {"focal_length", "200"}, {"focus_distance", "5"}, {"plane.distance", "50"}},
      {{"motion_blur", "true"}, {"plane.motion", "[20, 9]"}, {"shutter", "360"}},
      {{"auto_exposure", "true"}}};
  for (const Sets& effect : effects)
    for (const auto& [bad, same] : {std::pair<std::string, std::string>{"nan", "0"}, {"infinite", "65504"}}) {
      const Sets sets = with(effect, {{"plane.background", "0.25"}, {"plane.at", "[100, 77]"}});
      const Radiance found = render(with(sets, {{"bad", bad}}), 200, 150),
                     wanted = render(with(sets, {{"plane.value", same}}), 200, 150);
      double worst = 0;
      for (std::uint32_t y = 0; y < 150; ++y)
        for (std::uint32_t x = 0; x < 200; ++x) {
          const double difference = std::abs(found.at(x, y) - wanted.at(x, y));
          worst = difference <= worst ? worst : difference;  // a NaN stays
        }
      CAPTURE(effect[0].name);
      CAPTURE(bad);
      CHECK(worst < 1e-3);
    }
}

TEST_CASE("fog of density 0 is the identity") {
  const Sets sets{{"plane.background", "0.7"}, {"plane.distance", "30"}};
  const Radiance off = render(sets), on = render(with(sets, {{"fog", "true"}, {"fog_density", "0"}}));
  CHECK(off.panels.texels == on.panels.texels);
}

TEST_CASE("fog: Beer and Lambert's law along the ray, at every distance") {
  const double fog = 0.4, density = 0.03;
  double before = 1e9;
  for (const double distance : {0.5, 3.0, 20.0, 60.0, 400.0}) {
    const Radiance picture = render({{"plane.background", "2"},
                                     {"plane.value", "2"},
                                     {"plane.distance", fmt::format("{}", distance)},
                                     {"fog", "true"},
                                     {"fog_density", "0.03"},
                                     {"fog_color", "[0.4, 0.4, 0.4]"}},
                                    96, 64);
    for (const auto& [x, y] : {std::pair{48u, 32u}, {0u, 0u}, {95u, 10u}}) {
      // The length of the ray: the view is 60 degrees high.
      const double half = std::tan(M_PI / 6), u = ((x + 0.5) / 96 * 2 - 1) * half * 1.5,
                   v = ((y + 0.5) / 64 * 2 - 1) * half;
      const double through = std::exp(-density * distance * std::sqrt(1 + u * u + v * v));
      CAPTURE(distance);
      CHECK(picture.at(x, y) == doctest::Approx(fog + (2 - fog) * through).epsilon(2e-3));
    }
    CHECK(picture.at(48, 32) < before);
    before = picture.at(48, 32);
  }
  // The sky is infinitely far, or let through.
  const Sets sky{
      {"plane.background", "2"}, {"fog", "true"}, {"fog_density", "0.03"}, {"fog_color", "[0.4, 0.4, 0.4]"}};
  CHECK(render(sky, 96, 64).at(48, 32) == doctest::Approx(0.4).epsilon(2e-3));
  CHECK(render(with(sky, {{"fog_sky", "0"}}), 96, 64).at(48, 32) == doctest::Approx(2).epsilon(2e-3));
}

TEST_CASE("fog before the sky: a layer around the eye, thickest at the horizon, alike above and below") {
  const double fog = 0.4, density = 0.03, layer = 8;
  const Radiance picture = render({{"plane.background", "2"},
                                   {"fog", "true"},
                                   {"fog_density", "0.03"},
                                   {"fog_layer", "8"},
                                   {"fog_color", "[0.4, 0.4, 0.4]"}},
                                  96, 64);
  for (const std::uint32_t y : {0u, 8u, 20u, 29u, 31u, 34u, 45u, 63u}) {
    const double half = std::tan(M_PI / 6), u = (70.5 / 96 * 2 - 1) * half * 1.5,
                 v = ((y + 0.5) / 64 * 2 - 1) * half;
    const double range = layer * std::sqrt(1 + u * u + v * v) / std::abs(v);
    CAPTURE(y);
    CHECK(picture.at(70, y) == doctest::Approx(fog + (2 - fog) * std::exp(-density * range)).epsilon(3e-3));
  }
}

TEST_CASE("fog that thins out with height: the optical depth is the integral of the density along the ray") {
  const double density = 0.05, distance = 40;
  // The last three: so high above the fog that at the eye there is none that a float can tell, and so deep in it that no float holds its
  // extinction.
  for (const auto& [falloff, base] : {std::pair{0.2, -3.0}, std::pair{0.2, 3.0}, std::pair{5.0, -25.0},
                                      std::pair{1.0, -150.0}, std::pair{2.0, 50.0}}) {
    CAPTURE(falloff);
    CAPTURE(base);
    const Radiance picture = render({{"plane.background", "2"},
                                     {"plane.value", "2"},
                                     {"plane.distance", "40"},
                                     {"fog", "true"},
                                     {"fog_density", "0.05"},
                                     {"fog_falloff", std::to_string(falloff)},
                                     {"fog_base", std::to_string(base)},
                                     {"fog_color", "[0, 0, 0]"}},
                                    96, 64);
    for (const std::uint32_t y : {0u, 10u, 31u, 32u, 50u, 63u}) {
      const double half = std::tan(M_PI / 6), u = (48.5 / 96 * 2 - 1) * half * 1.5,
                   v = ((y + 0.5) / 64 * 2 - 1) * half;
      const double length = distance * std::sqrt(1 + u * u + v * v);
      double depth = 0;
      constexpr int kSteps = 2000;
      for (int i = 0; i < kSteps; ++i)  // the eye is at height 0
        depth += density * std::exp(-falloff * ((i + 0.5) / kSteps * distance * v - base)) * length / kSteps;
      CAPTURE(y);
      CHECK(picture.at(48, y) == doctest::Approx(2 * std::exp(-depth)).epsilon(3e-3));
    }
  }
}

}  // namespace bloom_test
