#include "engine/assets/cube_lut.h"

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "tests/temporary_folder.h"

using namespace weft;
using assets::CubeLut;

static std::optional<CubeLut> read(std::string_view text, text::Diagnostics& diagnostics) {
  return assets::readCubeLut(text, "test.cube", diagnostics);
}

// The one diagnostic of a text that must fail.
static text::Diagnostic cubeFailure(std::string_view text) {
  text::Diagnostics diagnostics;
  CHECK_FALSE(read(text, diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == text::Code::notACubeTable);
  return diagnostics.items()[0];
}

TEST_CASE("a 3D table with comments, a title, a domain and carriage returns") {
  text::Diagnostics diagnostics;
  std::string text =
      "# by hand\r\nTITLE \"warm look\"\r\nLUT_3D_SIZE 2\r\nDOMAIN_MIN 0 -1 0\r\nDOMAIN_MAX 1 +2.5 "
      "4e0\r\n\r\n";
  for (int i = 0; i < 8; ++i) text += fmt::format("{} {} {}\r\n", i & 1, (i >> 1) & 1, (i >> 2) * 0.5);
  const auto lut = read(text, diagnostics);
  REQUIRE(lut);
  CHECK(diagnostics.empty());
  CHECK(lut->dimensions == 3);
  CHECK(lut->size == 2);
  CHECK(lut->domainMin == std::array<float, 3>{0, -1, 0});
  CHECK(lut->domainMax == std::array<float, 3>{1, 2.5f, 4});
  REQUIRE(lut->texels.size() == 24);
  CHECK(lut->texels[3] == 1);  // red is fastest
  CHECK(lut->texels[23] == 0.5f);
}

TEST_CASE("a 1D table, without a final newline, from a file") {
  const TemporaryFolder folder;
  text::Diagnostics diagnostics;
  const auto lut = assets::loadCubeLut(
      folder.write("a.cube", "LUT_1D_SIZE 3\nLUT_1D_INPUT_RANGE 0 2\n0 0 0\n.5 .5 .5\n1 1 1"), diagnostics);
  REQUIRE(lut);
  CHECK(lut->dimensions == 1);
  CHECK(lut->domainMax[2] == 2);
  CHECK(lut->texels.size() == 9);
  CHECK_FALSE(assets::loadCubeLut(folder.at("missing.cube"), diagnostics));
  CHECK(diagnostics.contains(text::Code::unreadableFile));
}

TEST_CASE(
    "what programs write: a byte order mark, a title without quotes, curves before a cube, video range") {
  text::Diagnostics diagnostics;
  std::string text =
      "\xef\xbb\xbfTITLE Log To Screen\nLUT_IN_VIDEO_RANGE\nLUT_OUT_VIDEO_RANGE\nLUT_1D_SIZE "
      "3\nLUT_1D_INPUT_RANGE 0 2\n"
      "LUT_3D_SIZE 2\nLUT_3D_INPUT_RANGE 0 4\n0 0 0\n1 1 1\n4 4 4\n";
  for (int i = 0; i < 8; ++i)
    text += i == 7 ? "0.91886608 0.91886608 0.91886608\n" : "0.06256109 0.06256109 0.06256109\n";
  const auto lut = read(text, diagnostics);
  REQUIRE_MESSAGE(lut, diagnostics.text());
  CHECK(lut->dimensions == 3);
  CHECK(lut->domainMax[0] == 4);
  REQUIRE(lut->shaper);
  CHECK(lut->shaper->dimensions == 1);
  CHECK(lut->shaper->texels == std::vector<float>{0, 0, 0, 1, 1, 1, 4, 4, 4});
  // 64 of 1023 is black, 940 white: ITU-R BT.709.
  CHECK(lut->shaper->domainMin[0] == doctest::Approx(-64.0 / 876));
  CHECK(lut->shaper->domainMax[0] == doctest::Approx((2 * 1023 - 64.0) / 876));
  CHECK(lut->texels[0] == doctest::Approx(0).epsilon(1e-5));
  CHECK(lut->texels[21] == doctest::Approx(1).epsilon(1e-5));
  CHECK(cubeFailure("LUT_1D_SIZE 2\nLUT_3D_SIZE 2\n0 0 0\n1 1 1\n0 0 0\n").message.find("10 rows") !=
        std::string::npos);
}

TEST_CASE("every mistake names its line") {
  CHECK(cubeFailure("").message.find("neither") != std::string::npos);
  CHECK(cubeFailure("LUT_3D_SIZE 2\n0 0 0\n").message.find("8 rows") != std::string::npos);
  CHECK(cubeFailure("LUT_1D_SIZE 2\n0 0 0\n1 1 1\n2 2 2\n").place.line == 4);
  CHECK(cubeFailure("LUT_1D_SIZE 2\n0 0 0\n1 x 1\n").place.line == 3);
  CHECK(cubeFailure("LUT_1D_SIZE 2\n0 0 0\n1 nan 1\n").found == "nan");
  CHECK(cubeFailure("LUT_1D_SIZE 2\n0 0\n1 1 1\n").place.line == 2);
  CHECK(cubeFailure("LUT_1D_SIZE 2\nLUT_1D_SIZE 2\n0 0 0\n1 1 1\n").place.line == 2);
  CHECK(cubeFailure("0 0 0\n").message.find("before") != std::string::npos);
  CHECK(cubeFailure("LUT_2D_SIZE 4\n").message.find("LUT_2D_SIZE") != std::string::npos);
  CHECK(cubeFailure("LUT_3D_SIZE 1000000000\n").message.find("256") != std::string::npos);
  CHECK(cubeFailure("LUT_3D_SIZE 2.5\n").found == "2.5");
  CHECK(cubeFailure("LUT_1D_SIZE 2\nDOMAIN_MIN 1 1 1\n0 0 0\n1 1 1\n").message.find("DOMAIN_MIN") !=
        std::string::npos);
  CHECK(cubeFailure("LUT_1D_SIZE 2\n0 0 0\nDOMAIN_MIN 0 0 0\n1 1 1\n").place.line == 3);
}

TEST_CASE("a file of another kind, or a table full of rubbish, is reported once") {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "rubbish\n";
  CHECK(cubeFailure(text).place.line == 1);
  CHECK(cubeFailure("LUT_3D_SIZE 2\n" + text).place.line == 2);
}
