// The blocks of a user shader of mpv: passes, textures with their texels, and parameters. Declared in mpv.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <sstream>

#include "app/import/mpv.h"
#include "engine/assets/images/half.h"
#include "engine/graph/language/names.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"

namespace weft::importing {

namespace {

using text::Place;
using text::trimmed;

// Of the numbers of a header: how many, and which.
struct NumberRule {
  std::size_t min = 1, max = 1;
  bool whole = false;
  double low = -HUGE_VAL, high = HUGE_VAL;
};

// Numbers apart by spaces; nothing when there is anything else.
std::optional<std::vector<double>> numbersIn(const std::string& text, const NumberRule& rule) {
  std::vector<double> numbers;
  std::istringstream in(text);
  for (double x = 0; in >> x;) numbers.push_back(x);
  const auto fits = [&](double x) {
    return x >= rule.low && x <= rule.high && (!rule.whole || x == std::floor(x));
  };
  const bool good = in.eof() && numbers.size() >= rule.min && numbers.size() <= rule.max;
  return good && std::ranges::all_of(numbers, fits) ? std::optional(numbers) : std::nullopt;
}

// The bytes of a number in a format such as rgba16hf, by what follows the channels. 16f and 32f both hold 32 bits, 16hf halves.
std::size_t bytesOf(std::string_view kind) {
  return kind == "8" ? 1 : kind == "16" || kind == "16hf" ? 2 : kind == "16f" || kind == "32f" ? 4 : 0;
}

float decode(std::uint32_t bits, std::string_view kind) {
  if (kind == "8") return static_cast<float>(bits) / 255.0f;
  if (kind == "16") return static_cast<float>(bits) / 65535.0f;
  return kind == "16hf" ? assets::halfToFloat(static_cast<std::uint16_t>(bits)) : std::bit_cast<float>(bits);
}

// Fills `texture.image` from hexadecimal digits, or returns what is wrong.
std::string readTexels(MpvTexture& texture, std::string_view hex) {
  const std::string_view format = texture.format;
  const std::size_t channels = std::min(format.find_first_not_of("rgba"), format.size());
  const std::string_view kind = format.substr(channels);
  const std::size_t bytes = bytesOf(kind);
  if (!std::string_view("rgba").starts_with(format.substr(0, channels)) || channels == 0 || bytes == 0)
    return fmt::format("the texture '{}' has no FORMAT of r rg rgb rgba with 8, 16, 16f, 16hf or 32f",
                       texture.name);
  double expected = 2.0 * static_cast<double>(channels * bytes);
  for (const double side : texture.size) expected *= side;
  if (static_cast<double>(hex.size()) != expected)
    return fmt::format("the texture '{}' has {} hexadecimal digits, and {} texels of {} take {}",
                       texture.name, hex.size(), fmt::join(texture.size, " x "), format, expected);
  if (hex.find_first_not_of("0123456789abcdefABCDEF") != hex.npos)
    return fmt::format("the texture '{}' has digits that are not hexadecimal", texture.name);
  if (texture.size.size() != 2) return {};
  ConvertedImage& image = texture.image;
  image.width = static_cast<int>(texture.size[0]);
  image.height = static_cast<int>(texture.size[1]);
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < width * height; ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      float number = c == 3 ? 1.0f : 0.0f;
      if (c < channels) {
        const std::size_t texel = (height - 1 - i / width) * width + i % width;
        const char* digits = hex.data() + 2 * bytes * (texel * channels + c);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < bytes; ++k) {
          std::uint32_t byte = 0;
          std::from_chars(digits + 2 * k, digits + 2 * k + 2, byte, 16);
          bits |= byte << (8 * k);
        }
        number = decode(bits, kind);
      }
      if (bytes == 1)
        image.bytes.push_back(static_cast<std::uint8_t>(std::lround(number * 255.0f)));
      else
        image.floats.push_back(number);
    }
  return {};
}

class FileReader {
 public:
  FileReader(std::string_view text, std::shared_ptr<const std::string> file, text::Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {
    while (!text.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      out_.lines.push_back(text.substr(0, end));
      if (out_.lines.back().ends_with('\r')) out_.lines.back().remove_suffix(1);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    out_.data.resize(out_.lines.size());
  }

  std::optional<MpvFile> run() {
    const std::size_t errors = diagnostics_.errorCount();
    while (at_ < out_.lines.size() && !isHeader(at_)) ++at_;
    while (at_ < out_.lines.size()) {
      const std::string_view word = wordAt(at_);
      if (word == "TEXTURE")
        readTexture();
      else if (word == "PARAM")
        readParameter();
      else
        readHook();
    }
    if (out_.hooks.empty() && diagnostics_.errorCount() == errors)
      fail(placeOf(0), "the file has no //!HOOK", "write a header //!HOOK MAIN before each pass");
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    return std::move(out_);
  }

 private:
  struct Header {
    std::string_view word;
    PlacedText rest;
    Place place;
  };
  struct Block {
    std::vector<Header> headers;
    std::size_t body = 0;  // the line behind them
    bool good = true;
  };

  bool isHeader(std::size_t line) const { return trimmed(out_.lines[line]).starts_with("//!"); }
  std::string_view wordAt(std::size_t line) const {
    const std::string_view text = trimmed(out_.lines[line]).substr(3);
    return {text.begin(), std::ranges::find_if_not(text, text::isIdentChar)};
  }
  Place placeOf(std::size_t line, std::size_t column = 1) const {
    return {file_, static_cast<std::uint32_t>(line + 1), static_cast<std::uint32_t>(column)};
  }
  void fail(const Place& place, std::string message, std::string hint) {
    refuse(diagnostics_, text::Code::badMpvHeader, place, std::move(message), std::move(hint));
  }

  // The headers of a block, all of which are among `known`; the lines behind them are skipped.
  Block readBlock(std::vector<std::string> known) {
    constexpr std::array<std::string_view, 5> kNamed{"HOOK", "BIND", "SAVE", "TEXTURE", "PARAM"};
    Block block;
    const std::size_t errors = diagnostics_.errorCount();
    for (; at_ < out_.lines.size() && isHeader(at_); ++at_) {
      const std::string_view line = out_.lines[at_], word = wordAt(at_);
      const std::size_t behind = line.find("//!") + 3 + word.size();
      const std::string_view rest = trimmed(line.substr(behind));
      const std::size_t column = rest.empty() ? behind : static_cast<std::size_t>(rest.data() - line.data());
      block.headers.push_back({word, {std::string(rest), placeOf(at_, column + 1)}, placeOf(at_)});
      if (!contains(known, word))
        fail(placeOf(at_), fmt::format("unknown header //!{}", word), text::nearestHint(word, known));
      else if (contains(kNamed, word) && (!graph::isIdent(rest) || rest.size() > 64))
        fail(placeOf(at_, column + 1), "a header lacks a name", "write letters, digits and '_'");
    }
    block.body = at_;
    while (at_ < out_.lines.size() && !isHeader(at_)) ++at_;
    block.good = diagnostics_.errorCount() == errors;
    return block;
  }
  // The lines behind the headers are no GLSL: all of them as one.
  std::string takeData(std::size_t body, const char* between) {
    std::string text;
    for (std::size_t line = body; line < at_; ++line) {
      out_.data[line] = true;
      text.append(between).append(trimmed(out_.lines[line]));
    }
    return text;
  }
  std::vector<double> numbersOf(const Header& header, const NumberRule& rule, const char* expected) {
    if (auto numbers = numbersIn(header.rest.text, rule)) return *numbers;
    fail(header.place, fmt::format("//!{} has wrong numbers", header.word), expected);
    return {};
  }
  std::optional<double> numberOf(const Header& header) {
    const std::vector<double> numbers = numbersOf(header, {}, "write one number");
    return numbers.empty() ? std::nullopt : std::optional(numbers[0]);
  }
  bool isWord(const Header& header, const char* on, const char* off) {
    if (header.rest.text != on && header.rest.text != off)
      fail(header.rest.place, fmt::format("//!{} has an unknown word", header.word),
           fmt::format("write {} or {}", on, off));
    return header.rest.text == on;
  }

  void readHook() {
    MpvHook hook{.place = placeOf(at_)};
    const Block block = readBlock(
        {"HOOK", "BIND", "SAVE", "DESC", "OFFSET", "WIDTH", "HEIGHT", "WHEN", "COMPONENTS", "COMPUTE"});
    for (const Header& header : block.headers) {
      if (header.word == "HOOK") hook.hooks.push_back(header.rest);
      if (header.word == "BIND") hook.binds.push_back(header.rest);
      if (header.word == "SAVE") hook.save = header.rest;
      if (header.word == "WIDTH") hook.width = header.rest;
      if (header.word == "HEIGHT") hook.height = header.rest;
      if (header.word == "WHEN") hook.when = header.rest;
      if (header.word == "COMPUTE") readCompute(hook, header);
      if (header.word == "OFFSET" && header.rest.text != "ALIGN")
        std::ranges::copy(numbersOf(header, {.min = 2, .max = 2}, "two numbers of texels, or ALIGN"),
                          hook.offset);
      if (header.word == "COMPONENTS")
        for (const double x : numbersOf(header, {.low = 1, .high = 4}, "a number from 1 to 4"))
          hook.components = static_cast<int>(x);
    }
    if (hook.hooks.empty() && block.good)
      fail(hook.place, "a pass has no //!HOOK", "write //!HOOK MAIN, for example");
    out_.hooks.push_back(std::move(hook));
  }

  void readCompute(MpvHook& hook, const Header& header) {
    constexpr const char* kExpected =
        "two or four whole numbers from 1 to 1024: width and height of a block, then threads, at most 1024";
    std::vector<double> numbers =
        numbersOf(header, {.min = 2, .max = 4, .whole = true, .low = 1, .high = 1024}, kExpected);
    if (numbers.empty()) return;
    if (numbers.size() == 2) numbers.insert(numbers.end(), {numbers[0], numbers[1]});
    if (numbers.size() == 3 || numbers[2] * numbers[3] > 1024)
      return fail(header.place, "//!COMPUTE has wrong numbers", kExpected);
    hook.compute = true;
    for (std::size_t i = 0; i < 2; ++i) {
      hook.block[i] = static_cast<int>(numbers[i]);
      hook.threads[i] = static_cast<int>(numbers[2 + i]);
    }
  }

  void readTexture() {
    MpvTexture texture{.place = placeOf(at_)};
    const std::size_t errors = diagnostics_.errorCount();
    const Block block = readBlock({"TEXTURE", "SIZE", "FORMAT", "FILTER", "BORDER"});
    for (const Header& header : block.headers) {
      if (header.word == "TEXTURE") texture.name = header.rest.text;
      if (header.word == "FORMAT") texture.format = header.rest.text;
      if (header.word == "FILTER") texture.linear = isWord(header, "LINEAR", "NEAREST");
      if (header.word == "BORDER") texture.repeat = isWord(header, "REPEAT", "CLAMP");
      if (header.word == "SIZE")
        texture.size = numbersOf(header, {.max = 3, .whole = true, .low = 1, .high = 16384},
                                 "one to three whole numbers from 1 to 16384");
    }
    const std::string hex = takeData(block.body, "");
    if (diagnostics_.errorCount() > errors) return;
    if (std::string wrong = readTexels(texture, hex); !wrong.empty())
      return fail(placeOf(block.body - 1), std::move(wrong),
                  "write as many bytes in hexadecimal as SIZE and FORMAT ask for");
    out_.textures.push_back(std::move(texture));
  }

  void readParameter() {
    MpvParameter parameter{.place = placeOf(at_)};
    Place typePlace = parameter.place;
    const Block block = readBlock({"PARAM", "DESC", "TYPE", "MINIMUM", "MAXIMUM"});
    for (const Header& header : block.headers) {
      if (header.word == "PARAM") parameter.name = header.rest.text;
      if (header.word == "DESC") parameter.description = header.rest.text;
      if (header.word == "MINIMUM") parameter.min = numberOf(header);
      if (header.word == "MAXIMUM") parameter.max = numberOf(header);
      if (header.word != "TYPE") continue;
      typePlace = header.place;
      // How often it may change ("DYNAMIC float") means nothing here.
      parameter.type = header.rest.text.substr(header.rest.text.rfind(' ') + 1);
    }
    const auto initial = numbersIn(takeData(block.body, " "), {});
    if (parameter.type != "float" && parameter.type != "int" && parameter.type != "uint")
      return fail(typePlace,
                  fmt::format("the parameter '{}' has the type '{}'", parameter.name, parameter.type),
                  "write float, int or uint, or a #define");
    if (!initial)
      return fail(placeOf(block.body - 1), fmt::format("the parameter '{}' has no default", parameter.name),
                  "write one number on the line behind the headers");
    parameter.initial = (*initial)[0];
    out_.parameters.push_back(std::move(parameter));
  }

  std::shared_ptr<const std::string> file_;
  text::Diagnostics& diagnostics_;
  MpvFile out_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<MpvFile> readMpvFile(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   text::Diagnostics& diagnostics) {
  return FileReader(text, file, diagnostics).run();
}

}  // namespace weft::importing
