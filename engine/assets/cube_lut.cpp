#include "engine/assets/cube_lut.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>

#include "engine/text/files/text_file.h"

namespace weft::assets {

using text::Code;
using text::Diagnostics;

namespace {

constexpr int kMaxSize1d = 65536, kMaxSize3d = 256;
constexpr std::size_t kMaxMessages = 20;  // a wrong file would otherwise give one per line

struct Word {
  std::string_view text;
  std::uint32_t column = 0;
};

std::vector<Word> splitWords(std::string_view line) {
  std::vector<Word> words;
  for (std::size_t at = 0; at < line.size();) {
    at = line.find_first_not_of(" \t\r", at);
    if (at == std::string_view::npos) break;
    std::size_t end = line.find_first_of(" \t\r", at);
    if (end == std::string_view::npos) end = line.size();
    words.push_back({line.substr(at, end - at), static_cast<std::uint32_t>(at + 1)});
    at = end;
  }
  return words;
}

class Reader {
 public:
  Reader(const std::string& name, Diagnostics& diagnostics)
      : file_(std::make_shared<const std::string>(name)), diagnostics_(diagnostics) {}

  std::optional<CubeLut> read(std::string_view text) {
    for (std::size_t at = 0; at < text.size() && errors_ < kMaxMessages;) {
      std::size_t end = text.find('\n', at);
      if (end == std::string_view::npos) end = text.size();
      ++line_;
      readLine(text.substr(at, end - at));
      at = end + 1;
    }
    if (errors_ == 0) checkWhole();
    if (errors_ > 0) return {};
    return std::move(lut_);
  }

 private:
  void fail(std::uint32_t column, std::string message, std::string found = "") {
    ++errors_;
    diagnostics_.error(Code::notACubeTable, {file_, line_, column}, std::move(message)).found =
        std::move(found);
  }

  void readLine(std::string_view line) {
    const std::vector<Word> words = splitWords(line);
    if (words.empty() || words[0].text[0] == '#') return;
    const std::string_view key = words[0].text;
    const char first = key[0];
    if ((first >= '0' && first <= '9') || first == '-' || first == '+' || first == '.')
      return readTriple(words, 0, "a table row", nullptr);
    if (key == "TITLE") return;
    if (!lut_.texels.empty())
      return fail(words[0].column, fmt::format("keyword '{}' stands after the table began", key));
    if (key == "LUT_1D_SIZE") return readSize(words, 1, kMaxSize1d);
    if (key == "LUT_3D_SIZE") return readSize(words, 3, kMaxSize3d);
    if (key == "DOMAIN_MIN") return readTriple(words, 1, "DOMAIN_MIN", &lut_.domainMin);
    if (key == "DOMAIN_MAX") return readTriple(words, 1, "DOMAIN_MAX", &lut_.domainMax);
    if (key == "LUT_1D_INPUT_RANGE" || key == "LUT_3D_INPUT_RANGE") return readRange(words);
    fail(words[0].column, fmt::format("unknown keyword '{}'", key));
    // A file of another kind altogether is reported once.
    if (lut_.size == 0) errors_ = kMaxMessages;
  }

  void readSize(const std::vector<Word>& words, int dimensions, int largest) {
    if (lut_.size != 0 && lut_.dimensions != dimensions)
      return fail(words[0].column,
                  "a 1D and a 3D table in one file; export the 3D table alone, or split the file");
    if (lut_.size != 0) return fail(words[0].column, "a second size");
    int size = 0;
    const std::string_view text = words.size() == 2 ? words[1].text : std::string_view();
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (error != std::errc() || end != text.data() + text.size() || size < 2 || size > largest)
      return fail(words.size() > 1 ? words[1].column : words[0].column,
                  fmt::format("{} needs one whole number from 2 to {}", words[0].text, largest),
                  std::string(text));
    lut_.dimensions = dimensions;
    lut_.size = size;
    expected_ = dimensions == 1 ? static_cast<std::size_t>(size)
                                : static_cast<std::size_t>(size) * static_cast<std::size_t>(size) *
                                      static_cast<std::size_t>(size);
    lut_.texels.reserve(dimensions == 1 ? expected_ * 3 : 0);
  }

  std::optional<float> readNumber(const Word& word) {
    std::string_view text = word.text;
    if (text.starts_with('+')) text.remove_prefix(1);
    float value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error == std::errc() && end == text.data() + text.size() && std::isfinite(value)) return value;
    fail(word.column, "not a finite number", std::string(word.text));
    return {};
  }

  // Three numbers from words[first]; to `domain`, or appended to the table.
  void readTriple(const std::vector<Word>& words, std::size_t first, const char* what,
                  std::array<float, 3>* domain) {
    if (words.size() != first + 3)
      return fail(words[0].column, fmt::format("{} needs three numbers", what),
                  fmt::format("{}", words.size() - first));
    std::array<float, 3> values{};
    for (std::size_t c = 0; c < 3; ++c) {
      const std::optional<float> value = readNumber(words[first + c]);
      if (!value) return;
      values[c] = *value;
    }
    if (domain) {
      *domain = values;
      return;
    }
    if (lut_.size == 0) return fail(words[0].column, "a table row before LUT_1D_SIZE or LUT_3D_SIZE");
    if (lut_.texels.size() == expected_ * 3)
      return fail(words[0].column, fmt::format("more than {} table rows", expected_));
    lut_.texels.insert(lut_.texels.end(), values.begin(), values.end());
  }

  // The pair that DaVinci Resolve writes instead of DOMAIN_MIN and DOMAIN_MAX.
  void readRange(const std::vector<Word>& words) {
    if (words.size() != 3) return fail(words[0].column, fmt::format("{} needs two numbers", words[0].text));
    const std::optional<float> low = readNumber(words[1]), high = readNumber(words[2]);
    if (!low || !high) return;
    lut_.domainMin.fill(*low);
    lut_.domainMax.fill(*high);
  }

  void checkWhole() {
    if (lut_.size == 0) return fail(0, "neither LUT_1D_SIZE nor LUT_3D_SIZE");
    if (lut_.texels.size() != expected_ * 3)
      return fail(0, fmt::format("the table ends early: {} rows are needed", expected_),
                  fmt::format("{}", lut_.texels.size() / 3));
    for (std::size_t c = 0; c < 3; ++c)
      if (!(lut_.domainMin[c] < lut_.domainMax[c])) return fail(0, "DOMAIN_MIN is not below DOMAIN_MAX");
  }

  std::shared_ptr<const std::string> file_;
  Diagnostics& diagnostics_;
  std::uint32_t line_ = 0;
  std::size_t errors_ = 0, expected_ = 0;
  CubeLut lut_;
};

}  // namespace

std::optional<CubeLut> readCubeLut(std::string_view text, const std::string& name, Diagnostics& diagnostics) {
  return Reader(name, diagnostics).read(text);
}

std::optional<CubeLut> loadCubeLut(const std::string& path, Diagnostics& diagnostics) {
  const std::optional<std::string> text = text::readTextFile(path, diagnostics);
  if (!text) return {};
  return readCubeLut(*text, path, diagnostics);
}

}  // namespace weft::assets
