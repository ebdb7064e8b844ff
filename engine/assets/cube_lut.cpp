#include "engine/assets/cube_lut.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <span>

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

Problem readSize(const Words& words, int dimensions, int largest, CubeLut& lut) {
  if (lut.size != 0) return {"a second size; a file holds one table, 1D or 3D"};
  const std::string_view word = words.size() == 2 ? words[1] : std::string_view();
  if (!readNumber(word, lut.size) || lut.size < 2 || lut.size > largest)
    return {fmt::format("{} needs one whole number from 2 to {}", words[0], largest), std::string(word)};
  lut.dimensions = dimensions;
  return {};
}

Problem readLine(const Words& words, CubeLut& lut) {
  if (words.empty() || words[0][0] == '#' || words[0] == "TITLE") return {};
  const std::string_view key = words[0];
  if (std::string_view("0123456789+-.").find(key[0]) != std::string_view::npos) {
    std::array<float, 3> row{};
    if (Problem problem = readNumbers(words, 0, "a table row", row); !problem.message.empty()) return problem;
    if (lut.size == 0) return {"a table row before LUT_1D_SIZE or LUT_3D_SIZE"};
    if (lut.texels.size() == rowsOf(lut) * 3) return {fmt::format("more than {} table rows", rowsOf(lut))};
    lut.texels.insert(lut.texels.end(), row.begin(), row.end());
    return {};
  }
  if (!lut.texels.empty()) return {fmt::format("keyword '{}' stands after the table began", key)};
  if (key == "LUT_1D_SIZE") return readSize(words, 1, 65536, lut);
  if (key == "LUT_3D_SIZE") return readSize(words, 3, 256, lut);
  if (key == "DOMAIN_MIN") return readNumbers(words, 1, key, lut.domainMin);
  if (key == "DOMAIN_MAX") return readNumbers(words, 1, key, lut.domainMax);
  if (key != "LUT_1D_INPUT_RANGE" && key != "LUT_3D_INPUT_RANGE")
    return {fmt::format("unknown keyword '{}'", key)};
  // The pair that DaVinci Resolve writes instead of DOMAIN_MIN and DOMAIN_MAX.
  std::array<float, 2> range{};
  Problem problem = readNumbers(words, 1, key, range);
  lut.domainMin.fill(range[0]);
  lut.domainMax.fill(range[1]);
  return problem;
}

Problem checkWhole(const CubeLut& lut) {
  if (lut.size == 0) return {"neither LUT_1D_SIZE nor LUT_3D_SIZE"};
  if (lut.texels.size() != rowsOf(lut) * 3)
    return {fmt::format("the table ends early: {} rows are needed", rowsOf(lut)),
            fmt::format("{}", lut.texels.size() / 3)};
  for (std::size_t c = 0; c < 3; ++c)
    if (!(lut.domainMin[c] < lut.domainMax[c])) return {"DOMAIN_MIN is not below DOMAIN_MAX"};
  return {};
}

}  // namespace

std::optional<CubeLut> readCubeLut(std::string_view text, const std::string& name, Diagnostics& diagnostics) {
  CubeLut lut;
  Problem problem;
  std::uint32_t line = 0;
  for (; !text.empty() && problem.message.empty(); ++line)
    problem = readLine(splitWords(text::takeLine(text)), lut);
  if (problem.message.empty()) problem = checkWhole(lut);
  if (problem.message.empty()) return lut;
  diagnostics.error(text::Code::notACubeTable, {name, line}, problem.message).found = problem.found;
  return {};
}

std::optional<CubeLut> loadCubeLut(const std::string& path, Diagnostics& diagnostics) {
  const std::optional<std::string> text = text::readTextFile(path, diagnostics);
  return text ? readCubeLut(*text, path, diagnostics) : std::nullopt;
}

}  // namespace weft::assets
