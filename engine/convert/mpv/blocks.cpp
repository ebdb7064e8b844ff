#include "engine/convert/mpv/blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "engine/base/chars.h"
#include "engine/base/nearest.h"
#include "engine/convert/mpv/texture_data.h"

namespace weft::convert {

namespace {

using base::Code;
using base::Place;

constexpr std::size_t kMostBlocks = 256;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && base::isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && base::isSpace(text.back())) text.remove_suffix(1);
  return text;
}

// Numbers apart by spaces; nothing when there is anything else.
std::optional<std::vector<double>> numbersIn(std::string_view text) {
  std::vector<double> numbers;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    double number = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + end, number);
    if (error != std::errc() || rest != text.data() + end || !std::isfinite(number)) return std::nullopt;
    numbers.push_back(number);
    text.remove_prefix(end);
  }
  return numbers;
}

class FileReader {
 public:
  FileReader(std::string_view text, std::shared_ptr<const std::string> file, base::Diagnostics& diagnostics)
      : file_(std::move(file)), diagnostics_(diagnostics) {
    while (!text.empty()) {
      const std::size_t end = text.find('\n');
      std::string_view line = text.substr(0, end);
      if (line.ends_with('\r')) line.remove_suffix(1);
      out_.lines.push_back(line);
      text = end == text.npos ? std::string_view() : text.substr(end + 1);
    }
    out_.data.resize(out_.lines.size());
  }

  std::optional<MpvFile> run() {
    const std::size_t errors = diagnostics_.errorCount();
    std::size_t blocks = 0;
    while (at_ < out_.lines.size() && !isHeader(at_)) ++at_;
    while (at_ < out_.lines.size()) {
      if (++blocks > kMostBlocks) {
        fail(at_, 1, "the file has too many blocks", fmt::format("at most {}", kMostBlocks),
             "split the file");
        break;
      }
      const std::string_view word = wordAt(at_);
      if (word == "TEXTURE")
        readTexture();
      else if (word == "PARAM")
        readParameter();
      else
        readHook();
    }
    if (out_.hooks.empty() && diagnostics_.errorCount() == errors)
      fail(0, 1, "the file has no //!HOOK", "a header //!HOOK MAIN before each pass", "");
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    return std::move(out_);
  }

 private:
  bool isHeader(std::size_t line) const { return trimmed(out_.lines[line]).starts_with("//!"); }
  std::string_view wordAt(std::size_t line) const {
    std::string_view text = trimmed(out_.lines[line]).substr(3);
    std::size_t end = 0;
    while (end < text.size() && base::isIdentChar(text[end])) ++end;
    return text.substr(0, end);
  }
  MpvText restAt(std::size_t line) const {
    const std::string_view whole = out_.lines[line], word = wordAt(line);
    const std::size_t behind = whole.find("//!") + 3 + word.size();
    const std::string_view rest = trimmed(whole.substr(behind));
    const std::size_t column = rest.empty() ? behind : static_cast<std::size_t>(rest.data() - whole.data());
    return {std::string(rest), placeOf(line, column + 1)};
  }
  Place placeOf(std::size_t line, std::size_t column = 1) const {
    return {file_, static_cast<std::uint32_t>(line + 1), static_cast<std::uint32_t>(column)};
  }
  void fail(std::size_t line, std::size_t column, std::string message, std::string expected,
            std::string hint) {
    auto& d = diagnostics_.error(Code::badMpvHeader, placeOf(line, column), std::move(message));
    d.expected = std::move(expected);
    if (line < out_.lines.size()) d.found = std::string(trimmed(out_.lines[line]).substr(0, 80));
    d.hint = hint.empty() ? "the manual of mpv describes the headers under --glsl-shaders" : std::move(hint);
  }
  void wrongNumbers(std::string_view expected) {
    fail(at_, 1, fmt::format("//!{} has wrong numbers", wordAt(at_)), std::string(expected), "");
  }
  void unknown(std::span<const std::string> known) {
    const std::string word(wordAt(at_));
    fail(at_, 1, fmt::format("unknown header //!{}", word), fmt::format("one of {}", joined(known)),
         base::nearestHint(word, known));
  }
  static std::string joined(std::span<const std::string> words) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "" : ", ") + word;
    return out;
  }
  // The lines up to the next header.
  std::size_t skipBody() {
    const std::size_t begin = at_;
    while (at_ < out_.lines.size() && !isHeader(at_)) ++at_;
    return begin;
  }
  bool isNameText(const MpvText& text) {
    const bool good = !text.text.empty() && base::isIdentStart(text.text[0]) && text.text.size() <= 64 &&
                      std::ranges::all_of(text.text, base::isIdentChar);
    if (!good) fail(at_, text.place.column, "a header lacks a name", "letters, digits and '_'", "");
    return good;
  }

  void readHook() {
    static const std::array<std::string, 12> kKnown{"HOOK",       "BIND",    "SAVE",    "DESC",
                                                    "OFFSET",     "WIDTH",   "HEIGHT",  "WHEN",
                                                    "COMPONENTS", "COMPUTE", "TEXTURE", "PARAM"};
    MpvHook hook{.place = placeOf(at_), .headerLine = at_};
    const std::size_t errors = diagnostics_.errorCount();
    for (; at_ < out_.lines.size() && isHeader(at_); ++at_) {
      const std::string_view word = wordAt(at_);
      MpvText rest = restAt(at_);
      const auto numbers = numbersIn(rest.text);
      if (word == "HOOK") {
        if (isNameText(rest)) hook.hooks.push_back(std::move(rest));
      } else if (word == "BIND") {
        if (isNameText(rest)) hook.binds.push_back(std::move(rest));
      } else if (word == "SAVE") {
        if (isNameText(rest)) hook.save = std::move(rest);
      } else if (word == "DESC") {
        hook.description = rest.text;
      } else if (word == "WIDTH") {
        hook.width = std::move(rest);
      } else if (word == "HEIGHT") {
        hook.height = std::move(rest);
      } else if (word == "WHEN") {
        hook.when = std::move(rest);
      } else if (word == "OFFSET") {
        if (rest.text == "ALIGN") continue;
        if (!numbers || numbers->size() != 2) {
          wrongNumbers("two numbers of texels, or ALIGN");
          continue;
        }
        std::ranges::copy(*numbers, hook.offset);
      } else if (word == "COMPONENTS") {
        if (!numbers || numbers->size() != 1 || (*numbers)[0] < 1 || (*numbers)[0] > 4)
          wrongNumbers("a number from 1 to 4");
        else
          hook.components = static_cast<int>((*numbers)[0]);
      } else if (word == "COMPUTE") {
        readCompute(hook, numbers);
      } else {
        unknown(kKnown);
      }
    }
    skipBody();
    // Behind an unknown header the block is something else.
    if (hook.hooks.empty() && diagnostics_.errorCount() == errors)
      fail(hook.headerLine, 1, "a pass has no //!HOOK", "//!HOOK MAIN, for example", "");
    if (out_.hooks.size() < kMostBlocks) out_.hooks.push_back(std::move(hook));
  }

  void readCompute(MpvHook& hook, const std::optional<std::vector<double>>& numbers) {
    const bool good =
        numbers && (numbers->size() == 2 || numbers->size() == 4) &&
        std::ranges::all_of(*numbers, [](double x) { return x >= 1 && x <= 1024 && x == std::floor(x); });
    if (!good)
      return wrongNumbers(
          "two or four whole numbers from 1 to 1024: width and height of a block, then threads");
    hook.compute = true;
    for (std::size_t i = 0; i < 2; ++i) {
      hook.block[i] = static_cast<int>((*numbers)[i]);
      hook.threads[i] = numbers->size() == 4 ? static_cast<int>((*numbers)[2 + i]) : hook.block[i];
    }
    if (hook.threads[0] * hook.threads[1] > 1024) wrongNumbers("at most 1024 threads in a block");
  }

  void readTexture() {
    static const std::array<std::string, 5> kKnown{"TEXTURE", "SIZE", "FORMAT", "FILTER", "BORDER"};
    MpvTexture texture{.place = placeOf(at_)};
    const std::size_t errors = diagnostics_.errorCount();
    for (; at_ < out_.lines.size() && isHeader(at_); ++at_) {
      const std::string_view word = wordAt(at_);
      const MpvText rest = restAt(at_);
      if (word == "TEXTURE") {
        if (isNameText(rest)) texture.name = rest.text;
      } else if (word == "SIZE") {
        const auto numbers = numbersIn(rest.text);
        const bool good = numbers && !numbers->empty() && numbers->size() <= 3 &&
                          std::ranges::all_of(
                              *numbers, [](double x) { return x >= 1 && x <= 16384 && x == std::floor(x); });
        if (!good) {
          wrongNumbers("one to three whole numbers from 1 to 16384");
          continue;
        }
        texture.dimensions = static_cast<int>(numbers->size());
        for (std::size_t i = 0; i < numbers->size(); ++i) texture.size[i] = static_cast<int>((*numbers)[i]);
      } else if (word == "FORMAT") {
        texture.format = rest.text;
      } else if (word == "FILTER" && (rest.text == "LINEAR" || rest.text == "NEAREST")) {
        texture.linear = rest.text == "LINEAR";
      } else if (word == "BORDER" && (rest.text == "CLAMP" || rest.text == "REPEAT")) {
        texture.repeat = rest.text == "REPEAT";
      } else if (word == "FILTER" || word == "BORDER") {
        fail(at_, rest.place.column, fmt::format("//!{} has an unknown word", word),
             word == "FILTER" ? "LINEAR or NEAREST" : "CLAMP or REPEAT", "");
      } else {
        unknown(kKnown);
      }
    }
    const std::size_t begin = skipBody();
    std::string hex;
    for (std::size_t line = begin; line < at_; ++line) {
      out_.data[line] = true;
      hex += trimmed(out_.lines[line]);
    }
    if (diagnostics_.errorCount() > errors) return;
    const std::string wrong = readTextureBytes(texture, hex);
    if (!wrong.empty())
      return fail(begin - 1, 1, wrong, "as many bytes in hexadecimal as SIZE and FORMAT ask for", "");
    out_.textures.push_back(std::move(texture));
  }

  void readParameter() {
    static const std::array<std::string, 5> kKnown{"PARAM", "DESC", "TYPE", "MINIMUM", "MAXIMUM"};
    MpvParameter parameter{.place = placeOf(at_)};
    std::size_t typeLine = at_;
    for (; at_ < out_.lines.size() && isHeader(at_); ++at_) {
      const std::string_view word = wordAt(at_);
      const MpvText rest = restAt(at_);
      if (word == "PARAM") {
        if (isNameText(rest)) parameter.name = rest.text;
      } else if (word == "DESC") {
        parameter.description = rest.text;
      } else if (word == "TYPE") {
        typeLine = at_;
        parameter.type = rest.text;
        // How often it may change means nothing here.
        for (const std::string_view often : {"DYNAMIC ", "CONSTANT "})
          if (parameter.type.starts_with(often))
            parameter.type = trimmed(parameter.type.substr(often.size()));
      } else if (word == "MINIMUM" || word == "MAXIMUM") {
        const auto numbers = numbersIn(rest.text);
        if (numbers && numbers->size() == 1)
          (word == "MINIMUM" ? parameter.min : parameter.max) = (*numbers)[0];
        else
          wrongNumbers("one number");
      } else {
        unknown(kKnown);
      }
    }
    const std::size_t begin = skipBody();
    std::string text;
    for (std::size_t line = begin; line < at_; ++line) {
      out_.data[line] = true;
      text += ' ';
      text += trimmed(out_.lines[line]);
    }
    const auto numbers = numbersIn(text);
    if (parameter.type != "float" && parameter.type != "int" && parameter.type != "uint")
      return fail(typeLine, 1,
                  fmt::format("the parameter '{}' has the type '{}'", parameter.name, parameter.type),
                  "float, int or uint", "write a #define, or make it a number");
    if (!numbers || numbers->size() != 1)
      return fail(begin - 1, 1, fmt::format("the parameter '{}' has no default", parameter.name),
                  "one number on the line behind the headers", "");
    parameter.initial = (*numbers)[0];
    out_.parameters.push_back(std::move(parameter));
  }

  std::shared_ptr<const std::string> file_;
  base::Diagnostics& diagnostics_;
  MpvFile out_;
  std::size_t at_ = 0;
};

}  // namespace

std::optional<MpvFile> readMpvFile(std::string_view text, const std::shared_ptr<const std::string>& file,
                                   base::Diagnostics& diagnostics) {
  return FileReader(text, file, diagnostics).run();
}

}  // namespace weft::convert
