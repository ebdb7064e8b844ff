// Color tables: a neutral one is the identity within one step at any size and domain; axes, places between
// entries and strength are right; no file is no table, and a wrong one is said.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "engine/graph/expand/expand.h"
#include "engine/graph/read/read.h"
#include "engine/passes/pass_type.h"
#include "tests/temporary_folder.h"
#include "tests/theory/lab.h"

namespace lut_test {

using namespace weft::theory;
namespace graph = weft::graph;

namespace {

struct Rgb {
  double r, g, b;
};

std::string cube(int size, double low, double high, const std::function<Rgb(Rgb)>& f) {
  std::string text =
      fmt::format("LUT_3D_SIZE {0}\nDOMAIN_MIN {1} {1} {1}\nDOMAIN_MAX {2} {2} {2}\n", size, low, high);
  const auto at = [&](int i) { return low + (high - low) * i / (size - 1); };
  for (int b = 0; b < size; ++b)
    for (int g = 0; g < size; ++g)
      for (int r = 0; r < size; ++r) {
        const Rgb out = f({at(r), at(g), at(b)});
        text += fmt::format("{} {} {}\n", out.r, out.g, out.b);
      }
  return text;
}

std::string curves(int size, double low, double high, const std::function<Rgb(Rgb)>& f) {
  std::string text =
      fmt::format("LUT_1D_SIZE {0}\nDOMAIN_MIN {1} {1} {1}\nDOMAIN_MAX {2} {2} {2}\n", size, low, high);
  for (int i = 0; i < size; ++i) {
    const double x = low + (high - low) * i / (size - 1);
    const Rgb out = f({x, x, x});
    text += fmt::format("{} {} {}\n", out.r, out.g, out.b);
  }
  return text;
}

Picture render(const std::string& file, const char* strength = "1") {
  Setup setup{.graph = "tests/theory/look.json", .width = 256, .height = 4};
  setup.sets = {{"bloom", "false"},
                {"fxaa", "false"},
                {"curve", "linear"},
                {"composite.white", "1"},
                {"composite.dither", "false"},
                {"encoded", "true"},
                {"ramp.left", "[0, 1, 0.2]"},
                {"ramp.right", "[1, 0.3, 0.9]"},
                {"lut", file},
                {"lut_strength", strength}};
  Lab lab(setup);
  lab.frame();
  CHECK(lab.reports() == "");
  return lab.read("post.ldr");
}

double largestError(const Picture& picture, const std::function<Rgb(Rgb)>& truth) {
  double worst = 0;
  for (std::uint32_t x = 0; x < 256; ++x) {
    const double t = x / 255.0;
    const Rgb want = truth({t, 1 - 0.7 * t, 0.2 + 0.7 * t});
    const float* found = picture.at(x, 2);
    for (const auto& [is, should] : {std::pair{found[0], want.r}, {found[1], want.g}, {found[2], want.b}})
      worst = std::max(worst, 255 * std::abs(static_cast<double>(is) - should));
  }
  return worst;
}

}  // namespace

TEST_CASE("a neutral table is the identity within one step, whatever its size and domain") {
  const TemporaryFolder folder;
  const auto same = [](Rgb c) { return c; };
  CHECK(largestError(render(""), same) < 0.6);  // no table
  for (const int size : {2, 3, 17, 33})
    for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-0.5, 1.5}}) {
      const double error =
          largestError(render(folder.write("neutral.cube", cube(size, low, high, same))), same);
      CAPTURE(size);
      CAPTURE(low);
      MESSAGE("size ", size, " from ", low, ": ", error, " steps");
      CHECK(error < 1);
    }
}

TEST_CASE("red is the fastest axis; values between entries are linear; strength mixes") {
  const TemporaryFolder folder;
  const auto turned = [](Rgb c) { return Rgb{c.b, c.r, 1 - c.g}; };
  const std::string file = folder.write("turned.cube", cube(9, 0, 1, turned));
  CHECK(largestError(render(file), turned) < 1);
  CHECK(largestError(render(file, "0"), [](Rgb c) { return c; }) < 1);
  CHECK(largestError(render(file, "0.5"), [&](Rgb c) {
          const Rgb t = turned(c);
          return Rgb{(c.r + t.r) / 2, (c.g + t.g) / 2, (c.b + t.b) / 2};
        }) < 1);
  // A tent over three entries: its peak stands exactly at the middle entry, 0.5.
  const auto tent = [](Rgb c) { return Rgb{1 - 2 * std::abs(c.r - 0.5), c.g, c.b}; };
  CHECK(largestError(render(folder.write("tent.cube", cube(3, 0, 1, tent))), tent) < 1);
}

TEST_CASE("a 1D table is a curve per channel, linear between entries, at every size and domain") {
  const TemporaryFolder folder;
  const auto same = [](Rgb c) { return c; };
  const auto bent = [](Rgb c) { return Rgb{c.r * c.r, 1 - c.g, 0.25 + c.b / 2}; };
  for (const int size : {2, 3, 7, 1023, 1024, 1025, 5000, 65536})
    for (const auto& [low, high] : {std::pair{0.0, 1.0}, {-0.5, 1.5}}) {
      CAPTURE(size);
      CAPTURE(low);
      CHECK(largestError(render(folder.write("same.cube", curves(size, low, high, same))), same) < 1);
      if (size > 1000)
        CHECK(largestError(render(folder.write("bent.cube", curves(size, low, high, bent))), bent) < 1);
    }
  // A tent over three entries, in red alone: its peak stands at the middle entry.
  const auto tent = [](Rgb c) { return Rgb{1 - 2 * std::abs(c.r - 0.5), c.g, c.b}; };
  CHECK(largestError(render(folder.write("tent.cube", curves(3, 0, 1, tent))), tent) < 1);
}

TEST_CASE("curves before a cube are looked up first, each with its own domain") {
  const TemporaryFolder folder;
  const auto turned = [](Rgb c) { return Rgb{c.b, c.r, 1 - c.g}; };
  for (const auto& [entries, size] : {std::pair{2, 2}, {2, 9}, {5000, 5}, {65536, 17}}) {
    CAPTURE(entries);
    CAPTURE(size);
    const double power = entries == 2 ? 1 : 2;
    std::string text = fmt::format(
        "LUT_1D_SIZE {}\nLUT_1D_INPUT_RANGE 0 1\nLUT_3D_SIZE {}\nLUT_3D_INPUT_RANGE 0 2\n", entries, size);
    for (int i = 0; i < entries; ++i)
      text += fmt::format("{0} {0} {0}\n", 2 * std::pow(i / (entries - 1.0), power));
    const std::string whole = cube(size, 0, 1, turned);
    text += whole.substr(whole.find('\n', whole.find("DOMAIN_MAX")) + 1);
    CHECK(largestError(render(folder.write("shaper.cube", text)), [&](Rgb c) {
            return turned({std::pow(c.r, power), std::pow(c.g, power), std::pow(c.b, power)});
          }) < 1);
  }
}

TEST_CASE("a table that cannot be used is an error of the graph, before anything runs") {
  const TemporaryFolder folder;
  const auto codesOf = [](const std::string& file) {
    weft::text::Diagnostics diagnostics;
    const auto desc = graph::readGraph(std::string(WEFT_SOURCE_DIR) + "/tests/theory/look.json", diagnostics);
    REQUIRE(desc);
    graph::Settings settings;
    settings.sets = {{"lut", file}};
    const auto registry = weft::runtime::makeRegistry({}, {});
    graph::expandGraph(*desc, registry, settings, diagnostics);
    std::string codes;
    for (const auto& d : diagnostics.items())
      if (d.severity == weft::text::Severity::error) codes += weft::text::nameOf(d.code) + " ";
    return codes;
  };
  CHECK(codesOf("") == "");
  CHECK(codesOf(folder.at("missing.cube")) == "W001 ");
  CHECK(codesOf(folder.write("short.cube", "LUT_3D_SIZE 2\n0 0 0\n")) == "W154 ");
  CHECK(codesOf(folder.write("curves.cube", "LUT_1D_SIZE 2\n0 0 0\n1 1 1\n")) == "");
  CHECK(codesOf(folder.write("both.cube", "LUT_1D_SIZE 2\nLUT_3D_SIZE 2\n0 0 0\n1 1 1\n")) == "W154 ");
}

}  // namespace lut_test
