// The composite's look on ramps of known values: curves against their definitions, and of every effect the
// property that makes it that effect. Values are 8-bit steps, read before anti-aliasing.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "tests/theory/lab.h"

namespace look_test {

using namespace weft::theory;

namespace {

using Sets = std::vector<weft::graph::Setting>;
using Color = std::array<double, 3>;

constexpr std::uint32_t kWidth = 128, kHeight = 64;

double decode(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double encode(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

Sets ramp(Color left, Color right, Sets more = {}) {
  const auto list = [](Color c) { return fmt::format("[{}, {}, {}]", c[0], c[1], c[2]); };
  Sets sets{{"bloom", "false"}, {"fxaa", "false"}, {"ramp.left", list(left)}, {"ramp.right", list(right)}};
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

// A linear curve that ends at 1.
Sets plain(Color left, Color right, Sets more = {}) {
  Sets sets =
      ramp(left, right,
           {{"curve", "linear"}, {"composite.white", "1"}, {"fxaa", "false"}, {"composite.white", "1"}});
  sets.insert(sets.end(), more.begin(), more.end());
  return sets;
}

Picture render(Sets sets, std::uint32_t frame = 0, std::uint32_t width = kWidth) {
  Lab lab({.graph = "tests/theory/look.json", .width = width, .height = kHeight, .sets = std::move(sets)});
  lab.frame(frame);
  CHECK(lab.reports() == "");
  return lab.read("post.ldr");
}

double step(const Picture& picture, std::uint32_t x, std::uint32_t y, int channel) {
  return 255.0 * static_cast<double>(picture.at(x, y)[channel]);
}

double largestDifference(const Picture& a, const Picture& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i)
    largest = std::max(largest,
                       255.0 * std::abs(static_cast<double>(a.texels[i]) - static_cast<double>(b.texels[i])));
  return largest;
}

Color meanOf(const Picture& picture) {
  Color mean{};
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c)
        mean[static_cast<std::size_t>(c)] += step(picture, x, y, c) / (picture.width * picture.height);
  return mean;
}

Color constantThrough(Color value, Sets more) {
  return meanOf(render(plain(value, value, std::move(more))));
}

// ---- the curves as published, in double precision, on a gray

double reinhard(double x, double white) {
  return x * (1 + x / (white * white)) / (1 + x);
}

double aces(double x, double white) {
  const double v = x * 6.6 / white;
  return v * (2.51 * v + 0.03) / (v * (2.43 * v + 0.59) + 0.14);
}

// A gray passes both matrices of AgX unchanged, up to the rounding of their published digits.
double agx(double x) {
  const double v = std::clamp((std::log2(std::max(x, 1e-10)) + 12.47393) / (12.47393 + 4.026069), 0.0, 1.0);
  const double curve = 15.5 * std::pow(v, 6) - 40.14 * std::pow(v, 5) + 31.96 * std::pow(v, 4) -
                       6.868 * std::pow(v, 3) + 0.4298 * v * v + 0.1191 * v - 0.00232;
  return std::pow(std::max(curve, 0.0), 2.2);
}

double neutral(double x) {
  const double low = x - (x < 0.08 ? x - 6.25 * x * x : 0.04), start = 0.76, d = 1 - start;
  return low < start ? low : 1 - d * d / (low + d - start);
}

double curveOf(const std::string& name, double x) {
  double y = 0;
  if (name == "linear") y = x / 8;
  if (name == "reinhard") y = reinhard(x, 8);
  if (name == "aces") y = aces(x, 8);
  if (name == "agx") y = agx(x);
  if (name == "neutral") y = neutral(x);
  return std::clamp(y, 0.0, 1.0);
}

// Linear sRGB, with luminance 1, of a light on the locus that shaders/composite/white_balance.glsl describes.
Color lightOf(double kelvin) {
  const auto locus = [](double t) {
    return std::pair{(0.860117757 + 1.54118254e-4 * t + 1.28641212e-7 * t * t) /
                         (1 + 8.42420235e-4 * t + 7.08145163e-7 * t * t),
                     (0.317398726 + 4.22806245e-5 * t + 4.20481691e-8 * t * t) /
                         (1 - 2.89741816e-5 * t + 1.61456053e-7 * t * t)};
  };
  const double x65 = 0.3127, y65 = 0.3290, d65 = -2 * x65 + 12 * y65 + 3;
  const auto [u0, v0] = locus(6504);
  auto [u, v] = locus(kelvin);
  u += 4 * x65 / d65 - u0;
  v += 6 * y65 / d65 - v0;
  const double d = 2 * u - 8 * v + 4, x = 3 * u / d, y = 2 * v / d, X = x / y, Z = (1 - x - y) / y;
  return {3.2409699 * X - 1.5373832 - 0.4986108 * Z, -0.9692436 * X + 1.8759675 + 0.0415551 * Z,
          0.0556301 * X - 0.2039770 + 1.0569715 * Z};
}

}  // namespace

TEST_CASE("curves: each is its published formula within one step, rises, and ends within 0..1") {
  for (const std::string name : {"linear", "reinhard", "aces", "agx", "neutral"}) {
    const Picture picture =
        render(ramp({0, 0, 0}, {6, 6, 6}, {{"curve", name}, {"composite.dither", "false"}}));
    double worst = 0, before = -1;
    bool rises = true;
    for (std::uint32_t x = 0; x < kWidth; ++x) {
      const double found = step(picture, x, 3, 1),
                   truth = 255 * encode(curveOf(name, 6.0 * x / (kWidth - 1)));
      worst = std::max(worst, std::abs(found - truth));
      rises = rises && found >= before;
      before = found;
    }
    CAPTURE(name);
    MESSAGE(name, ": largest difference ", worst, " steps");
    CHECK(worst < 0.75);  // half a step is rounding
    CHECK(rises);
    CHECK(step(picture, 0, 3, 1) == 0);
  }
}

TEST_CASE("every effect at its neutral values is the identity") {
  const Color left{0, 0.1, 0.9}, right{1, 0.6, 0.05};
  const Sets quiet{{"composite.dither", "false"}};
  const Picture off = render(plain(left, right, quiet));
  for (const Sets& on :
       {Sets{{"grading", "true"}}, Sets{{"white_balance", "true"}},
        Sets{{"vignette", "true"}, {"vignette_stops", "0"}}, Sets{{"grain", "true"}, {"grain_strength", "0"}},
        Sets{{"aberration", "true"}, {"aberration_px", "0"}}}) {
    Sets all = quiet;
    all.insert(all.end(), on.begin(), on.end());
    CAPTURE(on[0].name);
    // One step where the exact value lies on the border between two of them.
    const Picture with = render(plain(left, right, all));
    CHECK(largestDifference(off, with) < 1.01);
    const Color a = meanOf(off), b = meanOf(with);
    for (std::size_t c = 0; c < 3; ++c) CHECK(std::abs(a[c] - b[c]) < 0.001);
  }
}

TEST_CASE(
    "white balance: the light it is set to turns gray; a higher setting warms the picture, positive tint is "
    "magenta") {
  for (const double kelvin : {2500.0, 4000.0, 6504.0, 9000.0, 15000.0}) {
    Color light = lightOf(kelvin);
    for (double& c : light) c = std::max(c, 0.0) * 0.2;
    const Color found =
        constantThrough(light, {{"white_balance", "true"}, {"temperature", fmt::format("{}", kelvin)}});
    CAPTURE(kelvin);
    CHECK(std::abs(found[0] - found[1]) < 0.001);
    CHECK(std::abs(found[2] - found[1]) < 0.001);
    CHECK(std::abs(found[1] - 255 * encode(0.2)) < 0.025);
  }
  const auto gray = [](const char* name, const char* value) {
    return constantThrough({0.2, 0.2, 0.2}, {{"white_balance", "true"}, {name, value}});
  };
  const Color warm = gray("temperature", "9000"), cold = gray("temperature", "4500");
  CHECK(warm[0] > warm[1] + 2);
  CHECK(warm[1] > warm[2] + 2);
  CHECK(cold[0] < cold[1] - 2);
  CHECK(cold[1] < cold[2] - 2);
  const Color magenta = gray("tint", "40"), green = gray("tint", "-40");
  CHECK(magenta[1] < std::min(magenta[0], magenta[2]) - 2);
  CHECK(green[1] > std::max(green[0], green[2]) + 2);
}

TEST_CASE("grading: what each control does to known values") {
  const auto graded = [](Color value, const char* name, const char* setting) {
    return constantThrough(value, {{"grading", "true"}, {name, setting}});
  };
  const Color gray = graded({0.8, 0.2, 0.1}, "composite.saturation", "0");
  const double luminance = 0.2126 * 0.8 + 0.7152 * 0.2 + 0.0722 * 0.1;
  for (const double c : gray) CHECK(std::abs(c - 255 * encode(luminance)) < 0.035);
  CHECK(std::abs(graded({0.18, 0.18, 0.18}, "composite.contrast", "1.6")[0] - 255 * encode(0.18)) < 0.017);
  CHECK(std::abs(graded({0.36, 0.09, 0.18}, "composite.contrast", "2")[0] - 255 * encode(0.72)) < 0.035);
  CHECK(std::abs(graded({0.36, 0.09, 0.18}, "composite.contrast", "2")[1] - 255 * encode(0.045)) < 0.032);
  CHECK(std::abs(graded({0, 0, 0}, "composite.lift", "[0.2, 0.2, 0.2]")[2] - 255 * encode(0.2)) < 0.025);
  CHECK(std::abs(graded({1, 1, 1}, "composite.lift", "[0.2, 0.2, 0.2]")[2] - 255) < 0.001);
  CHECK(std::abs(graded({0.25, 0.25, 0.25}, "composite.gamma", "[2, 1, 1]")[0] - 255 * encode(0.5)) < 0.001);
  CHECK(std::abs(graded({0.25, 0.25, 0.25}, "composite.gain", "[1, 2, 1]")[1] - 255 * encode(0.5)) < 0.001);
}

TEST_CASE("vignette: nothing at the center, the stops asked for at the corners") {
  const Picture picture =
      render(plain({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5},
                   {{"vignette", "true"}, {"vignette_stops", "2"}, {"composite.dither", "false"}}));
  CHECK(std::abs(step(picture, kWidth / 2, kHeight / 2, 1) - 255 * encode(0.5)) < 0.6);
  const double radius =
      std::hypot(kWidth - 1, kHeight - 1) / std::hypot(kWidth, kHeight);  // of a corner texel's center
  for (const std::uint32_t x : {0u, kWidth - 1})
    for (const std::uint32_t y : {0u, kHeight - 1})
      CHECK(std::abs(step(picture, x, y, 1) - 255 * encode(0.5 * std::exp2(-2 * radius * radius))) < 0.6);
}

TEST_CASE(
    "grain has zero mean at every level, its strength, a new pattern per frame and the same for the same "
    "frame") {
  for (const double level : {0.01, 0.1, 0.5, 0.9, 0.99}) {
    const Sets sets = plain({level, level, level}, {level, level, level},
                            {{"grain", "true"}, {"grain_strength", "0.2"}, {"encoded", "true"}});
    double mean = 0, low = 1e9, high = -1e9;
    constexpr std::uint32_t kFrames = 4;
    for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
      const Picture picture = render(sets, frame);
      mean += meanOf(picture)[0] / kFrames;
      for (std::uint32_t i = 0; i < kWidth * kHeight; ++i) {
        low = std::min(low, 255.0 * static_cast<double>(picture.texels[i * 4]));
        high = std::max(high, 255.0 * static_cast<double>(picture.texels[i * 4]));
      }
    }
    const double reach = 255 * 0.2 * 4 * level * (1 - level);
    // Triangular noise: deviation reach / sqrt(6), averaged over the pixels; five of the mean's deviations.
    const double allowed = 5 * (reach / std::sqrt(6.0) + 0.5) / std::sqrt(double{kFrames} * kWidth * kHeight);
    CAPTURE(level);
    CHECK(std::abs(mean - 255 * level) < allowed);
    CHECK(high <= 255 * level + reach + 1.01);
    CHECK(high >= 255 * level + 0.8 * reach - 1);
    CHECK(low <= 255 * level - 0.8 * reach + 1);
  }
  const Sets sets = plain({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}, {{"grain", "true"}});
  CHECK(largestDifference(render(sets, 3), render(sets, 3)) == 0);
  CHECK(largestDifference(render(sets, 3), render(sets, 4)) > 4);
}

TEST_CASE("aberration: green stays, red and blue part by the pixels asked for, a flat picture stays flat") {
  const Sets quiet{{"composite.dither", "false"}};
  Sets on{{"composite.dither", "false"}, {"aberration", "true"}, {"aberration_px", "4"}};
  CHECK(largestDifference(render(plain({0.3, 0.5, 0.2}, {0.3, 0.5, 0.2}, quiet)),
                          render(plain({0.3, 0.5, 0.2}, {0.3, 0.5, 0.2}, on))) < 1.01);
  on.push_back({"encoded", "true"});
  // Depth is 0 everywhere, so this is the sky.
  const Picture picture = render(plain({0, 0, 0}, {1, 1, 1}, on));
  const double slope = 255.0 / (kWidth - 1);  // steps per pixel
  for (const std::uint32_t x : {24u, 40u, 88u, 104u}) {
    const double shift = 4 * (x + 0.5 - kWidth / 2.0) / (0.5 * std::hypot(kWidth, kHeight)) * slope;
    CAPTURE(x);
    CHECK(std::abs(step(picture, x, kHeight / 2, 1) - x * slope) < 0.6);
    CHECK(std::abs(step(picture, x, kHeight / 2, 0) - (x * slope - shift)) < 0.5);
    CHECK(std::abs(step(picture, x, kHeight / 2, 2) - (x * slope + shift)) < 0.55);
  }
}

TEST_CASE("aberration: white lines spread into a spectrum without gaps, as many wavelengths add up") {
  // A brute-force sum over 400 wavelengths, each of which draws the line as much larger or smaller as its place between -2 and 2 says. Red
  // weighs them by a triangle around 1, green around 0, blue around -1.
  constexpr std::uint32_t kWide = 256;
  constexpr int kLine = 236, kBroad = 3;
  Setup setup{.graph = "tests/theory/impulse_exact.json", .width = kWide, .height = kWide};
  setup.sets = {{"bloom", "false"},
                {"dof", "false"},
                {"aberration", "true"},
                {"aberration_px", "8"},
                {"composite.dither", "false"},
                {"curve", "linear"},
                {"exposure", "0"},
                {"plane.value", "0.5"},
                {"plane.background", "0"},
                {"plane.side", std::to_string(kBroad)},
                {"plane.at", "[" + std::to_string(kLine) + ", 127]"}};
  Lab lab(setup);
  lab.frame(0);
  const Picture panels = lab.read("panels");
  CHECK(lab.reports() == "");
  const double corner = 0.5 * std::hypot(kWide, kWide);
  // impulse_exact.json has a linear curve that ends at 32. The picture between the texels of a square of light, linear as a sampler makes it.
  const auto light = [&](double x, double y) {
    const auto texel = [&](int ix, int iy) {
      return ix >= kLine && ix < kLine + kBroad && iy >= 127 && iy < 127 + kBroad ? 0.5 : 0.0;
    };
    const double fx = x - 0.5, fy = y - 0.5;
    const int ix = static_cast<int>(std::floor(fx)), iy = static_cast<int>(std::floor(fy));
    const double ax = fx - ix, ay = fy - iy;
    return (1 - ay) * ((1 - ax) * texel(ix, iy) + ax * texel(ix + 1, iy)) +
           ay * ((1 - ax) * texel(ix, iy + 1) + ax * texel(ix + 1, iy + 1));
  };
  double worst = 0, found[3] = {}, expected[3] = {};
  for (int y = 120; y < 138; ++y)
    for (std::uint32_t x = 200; x < kWide; ++x) {
      const double px = (x + 0.5 - kWide / 2.0) / corner * 8, py = (y + 0.5 - kWide / 2.0) / corner * 8;
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int k = -400; k <= 400; ++k) {
          const double shift = k / 200.0, weight = std::max(1 - std::abs(shift - (1 - c)), 0.0) / 200;
          if (weight > 0) sum += weight * light(x + 0.5 - shift * px, y + 0.5 - shift * py);
        }
        const double value =
            32 * decode(static_cast<double>(panels.at(2 * kWide + x, static_cast<std::uint32_t>(y))[c]));
        worst = std::max(worst, std::abs(value - sum));
        found[c] += value;
        expected[c] += sum;
      }
    }
  MESSAGE("worst ", worst, "; light kept ", found[0] / expected[0], ", ", found[1] / expected[1], ", ",
          found[2] / expected[2]);
  CHECK(worst < 0.01);
  for (int c = 0; c < 3; ++c) {
    CHECK(found[c] == doctest::Approx(expected[c]).epsilon(0.02));
    CHECK(
        found[c] ==
        doctest::Approx(0.5 * kBroad * kBroad).epsilon(0.15));  // a larger picture of the light is as bright
  }
}

TEST_CASE(
    "dither: a ramp over 8 steps, averaged over blocks of 16 x 16, is within 0.1 step RMS of the true one") {
  constexpr std::uint32_t kWide = 768;  // six blocks to a step
  const double low = 100 / 255.0, high = 108 / 255.0;
  const auto rms = [&](const char* dither) {
    const Picture picture = render(
        plain({low, low, low}, {high, high, high}, {{"encoded", "true"}, {"composite.dither", dither}}), 0,
        kWide);
    double sum = 0;
    int blocks = 0;
    for (std::uint32_t by = 0; by + 16 <= kHeight; by += 16)
      for (std::uint32_t bx = 0; bx + 16 <= kWide; bx += 16, ++blocks) {
        double found = 0, truth = 0;
        for (std::uint32_t i = 0; i < 256; ++i) {
          found += step(picture, bx + i % 16, by + i / 16, 1) / 256;
          truth += (100 + 8.0 * (bx + i % 16) / (kWide - 1)) / 256;
        }
        sum += (found - truth) * (found - truth);
      }
    return std::sqrt(sum / blocks);
  };
  const double with = rms("true"), without = rms("false");
  MESSAGE("RMS with dither ", with, ", without ", without);
  CHECK(with < 0.008);
  CHECK(without > 0.2);
}

}  // namespace look_test
