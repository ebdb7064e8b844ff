#include "engine/assets/cube_lut.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>

#include "assets_sentences.h"
#include "engine/text/chars.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Diagnostics;

namespace {

using Words = std::vector<std::string_view>;

Words splitWords(std::string_view line) {
  Words words;
  for (auto word = text::takeWord(line); !word.empty(); word = text::takeWord(line)) words.push_back(word);
  return words;
}

template <class T>
bool readNumber(std::string_view word, T& out) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto number = text::numberIn<T>(word);
  out = number.value_or(out);
  return number.has_value();
}

struct Problem {
  std::string message, found{};  // none when `message` is empty
};

// As many numbers as `out` has, from words[first] to the last word.
Problem readNumbers(const Words& words, std::size_t first, std::string_view what, std::span<float> out) {
  if (words.size() != first + out.size())
    return {fmt::format("{} needs {} numbers", what, out.size()), fmt::format("{}", words.size() - first)};
  for (std::size_t i = 0; i < out.size(); ++i)
    if (!readNumber(words[first + i], out[i])) return {"not a finite number", std::string(words[first + i])};
  return {};
}

std::size_t rowsOf(const CubeLut& lut) {
  const auto n = static_cast<std::size_t>(lut.size);
  return lut.dimensions == 1 ? n : n * n * n;
}

// A file as far as it was read: its tables, 0 entries where it has none.
struct CubeFile {
  CubeLut curves{.dimensions = 1}, cube;
  std::optional<std::array<float, 3>> domainMin{}, domainMax{};  // of the table that is looked up first
  bool videoIn = false, videoOut = false;
};

Problem readSize(const Words& words, int largest, CubeLut& lut) {
  if (lut.size != 0) return {"a second size; a file holds one table of each kind"};
  const std::string_view word = words.size() == 2 ? words[1] : std::string_view();
  if (!readNumber(word, lut.size) || lut.size < 2 || lut.size > largest)
    return {fmt::format("{} needs one whole number from 2 to {}", words[0], largest), std::string(word)};
  return {};
}

Problem readRow(const Words& words, CubeFile& file) {
  std::array<float, 3> row{};
  if (Problem problem = readNumbers(words, 0, "a table row", row); !problem.message.empty()) return problem;
  const std::size_t needed = rowsOf(file.curves) + rowsOf(file.cube);
  if (needed == 0) return {"a table row before LUT_1D_SIZE or LUT_3D_SIZE"};
  const bool inCurves = file.curves.texels.size() < rowsOf(file.curves) * 3;
  std::vector<float>& texels = inCurves ? file.curves.texels : file.cube.texels;
  if (!inCurves && texels.size() == rowsOf(file.cube) * 3)
    return {fmt::format("more than {} table rows", needed)};
  texels.insert(texels.end(), row.begin(), row.end());
  return {};
}

Problem readLine(const Words& words, CubeFile& file) {
  if (words.empty() || words[0][0] == '#' || words[0] == "TITLE") return {};
  const std::string_view key = words[0];
  if (std::string_view("0123456789+-.").find(key[0]) != std::string_view::npos) return readRow(words, file);
  if (!file.curves.texels.empty() || !file.cube.texels.empty())
    return {fmt::format("keyword '{}' stands after the table began", key)};
  if (key == "LUT_1D_SIZE") return readSize(words, 65536, file.curves);
  if (key == "LUT_3D_SIZE") return readSize(words, 256, file.cube);
  if (key == "LUT_IN_VIDEO_RANGE" || key == "LUT_OUT_VIDEO_RANGE") {
    (key == "LUT_IN_VIDEO_RANGE" ? file.videoIn : file.videoOut) = true;
    return {};
  }
  const bool low = key == "DOMAIN_MIN";
  if (low || key == "DOMAIN_MAX") {
    std::array<float, 3> domain{};
    Problem problem = readNumbers(words, 1, key, domain);
    (low ? file.domainMin : file.domainMax) = domain;
    return problem;
  }
  if (key != "LUT_1D_INPUT_RANGE" && key != "LUT_3D_INPUT_RANGE")
    return {fmt::format("unknown keyword '{}'", key)};
  // The pair that DaVinci Resolve writes instead of DOMAIN_MIN and DOMAIN_MAX.
  std::array<float, 2> range{};
  Problem problem = readNumbers(words, 1, key, range);
  CubeLut& lut = key == "LUT_1D_INPUT_RANGE" ? file.curves : file.cube;
  lut.domainMin.fill(range[0]);
  lut.domainMax.fill(range[1]);
  return problem;
}

Problem checkWhole(CubeFile& file) {
  const std::size_t needed = rowsOf(file.curves) + rowsOf(file.cube);
  const std::size_t found = (file.curves.texels.size() + file.cube.texels.size()) / 3;
  if (needed == 0) return {"neither LUT_1D_SIZE nor LUT_3D_SIZE"};
  if (found != needed)
    return {fmt::format("the table ends early: {} rows are needed", needed), fmt::format("{}", found)};
  CubeLut& first = file.curves.size != 0 ? file.curves : file.cube;
  first.domainMin = file.domainMin.value_or(first.domainMin);
  first.domainMax = file.domainMax.value_or(first.domainMax);
  for (const CubeLut* lut : {&file.curves, &file.cube})
    for (std::size_t c = 0; c < 3; ++c)
      if (!(lut->domainMin[c] < lut->domainMax[c])) return {"DOMAIN_MIN is not below DOMAIN_MAX"};
  return {};
}

// From the codes of video, 64 to 940 of 1023 (ITU-R BT.709), to the whole range.
void fromVideo(std::span<float> values) {
  for (float& value : values) value = (value * 1023 - 64) / 876;
}

CubeLut toLut(CubeFile file) {
  CubeLut &last = file.cube.size != 0 ? file.cube : file.curves,
          &first = file.curves.size != 0 ? file.curves : file.cube;
  if (file.videoOut) fromVideo(last.texels);
  if (file.videoIn) {
    fromVideo(first.domainMin);
    fromVideo(first.domainMax);
  }
  if (&first != &last) last.shaper = std::make_shared<const CubeLut>(std::move(first));
  return std::move(last);
}

}  // namespace

std::optional<CubeLut> readCubeLut(std::string_view text, const std::string& name, Diagnostics& diagnostics) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  CubeFile file;
  Problem problem;
  std::uint32_t line = 0;
  for (; !text.empty() && problem.message.empty(); ++line)
    problem = readLine(splitWords(text::takeLine(text)), file);
  if (problem.message.empty()) problem = checkWhole(file);
  if (problem.message.empty()) return toLut(std::move(file));
  diagnostics.error(say::notACubeTable, {name, line}, problem.message, problem.found);
  return {};
}

std::optional<CubeLut> loadCubeLut(const std::string& path, Diagnostics& diagnostics) {
  const std::optional<std::string> text = text::readTextFile(path, diagnostics);
  return text ? readCubeLut(*text, path, diagnostics) : std::nullopt;
}

}  // namespace weft::assets
