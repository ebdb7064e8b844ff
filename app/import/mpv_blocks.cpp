// The blocks of a user shader of mpv: passes, textures with their texels, and parameters. Declared in mpv.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <functional>

#include "app/import/mpv.h"
#include "app/import/text.h"
#include "engine/assets/images/half.h"
#include "engine/base/chars.h"
#include "engine/base/nearest.h"

namespace weft::convert {

namespace {

using base::Place;

constexpr std::size_t kMaxBlocks = 256;

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && base::isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && base::isSpace(text.back())) text.remove_suffix(1);
  return text;
}

// `least` to `most` numbers apart by spaces, from `low` to `high`; nothing when there is anything else.
std::optional<std::vector<double>> numbersIn(std::string_view text, std::size_t least, std::size_t most,
                                             bool whole = false, double low = -HUGE_VAL,
                                             double high = HUGE_VAL) {
  std::vector<double> numbers;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(" \t"), text.size());
    double x = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + end, x);
    if (error != std::errc() || rest != text.data() + end || !std::isfinite(x) || x < low || x > high ||
        (whole && x != std::floor(x)))
      return std::nullopt;
    numbers.push_back(x);
    text.remove_prefix(end);
  }
  return numbers.size() >= least && numbers.size() <= most ? std::optional(numbers) : std::nullopt;
}

// A format of texels: channels, and how one is stored. Formats of 16 and 32 bit floats both hold 32 bits, those with hf halves.
struct TexelFormat {
  std::size_t channels = 0, bytes = 0;  // bytes: of a channel
  float (*decode)(std::uint32_t bits) = nullptr;
};

std::optional<TexelFormat> formatOf(std::string_view name) {
  static constexpr TexelFormat kKinds[] = {
      {0, 1, [](std::uint32_t bits) { return static_cast<float>(bits) / 255.0f; }},
      {0, 2, [](std::uint32_t bits) { return static_cast<float>(bits) / 65535.0f; }},
      {0, 2, [](std::uint32_t bits) { return assets::halfToFloat(static_cast<std::uint16_t>(bits)); }},
      {0, 4, [](std::uint32_t bits) { return std::bit_cast<float>(bits); }}};
  for (const std::string_view channels : {"rgba", "rgb", "rg", "r"}) {
    if (!name.starts_with(channels)) continue;
    const std::string_view rest = name.substr(channels.size());
    const int kind = rest == "8"                      ? 0
                     : rest == "16"                   ? 1
                     : rest == "16hf"                 ? 2
                     : rest == "16f" || rest == "32f" ? 3
                                                      : -1;
    if (kind < 0) return std::nullopt;
    TexelFormat format = kKinds[kind];
    format.channels = channels.size();
    return format;
  }
  return std::nullopt;
}

// Fills `texture.image` from hexadecimal digits, or returns what is wrong.
std::string readTexels(MpvTexture& texture, std::string_view hex) {
  if (texture.format.empty()) return fmt::format("the texture '{}' has no //!FORMAT", texture.name);
  const auto format = formatOf(texture.format);
  if (!format)
    return fmt::format(
        "the texture '{}' has the format '{}', which is none of r rg rgb rgba with 8, 16, 16f, 16hf or 32f",
        texture.name, texture.format.substr(0, 20));
  std::uint64_t expected = 2 * format->channels * format->bytes;
  for (const int side : texture.size) expected *= static_cast<std::uint64_t>(side);
  if (hex.size() != expected)
    return fmt::format("the texture '{}' has {} hexadecimal digits, and {} texels of {} take {}",
                       texture.name, hex.size(), fmt::join(texture.size, " x "), texture.format, expected);
  if (hex.find_first_not_of("0123456789abcdefABCDEF") != hex.npos)
    return fmt::format("the texture '{}' has digits that are not hexadecimal", texture.name);
  if (texture.dimensions != 2) return {};
  ConvertedImage& image = texture.image;
  image.width = texture.size[0];
  image.height = texture.size[1];
  const auto width = static_cast<std::size_t>(image.width), height = static_cast<std::size_t>(image.height);
  for (std::size_t i = 0; i < width * height; ++i)
    for (std::size_t c = 0; c < 4; ++c) {
      float number = c == 3 ? 1.0f : 0.0f;
      if (c < format->channels) {
        const std::size_t texel = (height - 1 - i / width) * width + i % width;
        const char* digits = hex.data() + 2 * format->bytes * (texel * format->channels + c);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < format->bytes; ++k) {
          std::uint32_t byte = 0;
          std::from_chars(digits + 2 * k, digits + 2 * k + 2, byte, 16);
          bits |= byte << (8 * k);
        }
        number = format->decode(bits);
      }
      if (format->bytes == 1)
        image.bytes.push_back(static_cast<std::uint8_t>(std::lround(number * 255.0f)));
      else
        image.floats.push_back(number);
    }
  return {};
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
    while (at_ < out_.lines.size() && !isHeader(at_)) ++at_;
    for (std::size_t blocks = 0; at_ < out_.lines.size(); ++blocks) {
      if (blocks == kMaxBlocks) {
        fail(at_, "the file has too many blocks", fmt::format("split the file: at most {}", kMaxBlocks));
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
      fail(0, "the file has no //!HOOK", "write a header //!HOOK MAIN before each pass");
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    return std::move(out_);
  }

 private:
  bool isHeader(std::size_t line) const { return trimmed(out_.lines[line]).starts_with("//!"); }
  std::string_view wordAt(std::size_t line) const {
    const std::string_view text = trimmed(out_.lines[line]).substr(3);
    return text.substr(
        0, static_cast<std::size_t>(std::ranges::find_if_not(text, base::isIdentChar) - text.begin()));
  }
  MpvText restAt(std::size_t line) const {
    const std::string_view whole = out_.lines[line];
    const std::size_t behind = whole.find("//!") + 3 + wordAt(line).size();
    const std::string_view rest = trimmed(whole.substr(behind));
    const std::size_t column = rest.empty() ? behind : static_cast<std::size_t>(rest.data() - whole.data());
    return {std::string(rest), placeOf(line, column + 1)};
  }
  Place placeOf(std::size_t line, std::size_t column = 1) const {
    return {file_, static_cast<std::uint32_t>(line + 1), static_cast<std::uint32_t>(column)};
  }
  void fail(std::size_t line, std::string message, std::string hint, std::size_t column = 1) {
    refuse(diagnostics_, base::Code::badMpvHeader, placeOf(line, column), std::move(message),
           std::move(hint));
  }
  void wrongNumbers(std::string_view expected) {
    fail(at_, fmt::format("//!{} has wrong numbers", wordAt(at_)), std::string(expected));
  }

  // Reads the headers of a block, each by what is said of its word, and skips the lines behind them; returns where these begin.
  using Handler = std::function<void(MpvText&& rest)>;
  std::size_t readHeaders(std::initializer_list<std::pair<std::string, Handler>> handlers) {
    for (; at_ < out_.lines.size() && isHeader(at_); ++at_) {
      const std::string word(wordAt(at_));
      const auto* handler = std::ranges::find(handlers, word, &std::pair<std::string, Handler>::first);
      if (handler != handlers.end()) {
        handler->second(restAt(at_));
        continue;
      }
      std::vector<std::string> known;
      for (const auto& [name, ignored] : handlers) known.push_back(name);
      fail(at_, fmt::format("unknown header //!{}", word), base::nearestHint(word, known));
    }
    const std::size_t body = at_;
    while (at_ < out_.lines.size() && !isHeader(at_)) ++at_;
    return body;
  }
  // The lines behind the headers are no GLSL: all of them as one.
  std::string takeData(std::size_t body, const char* between) {
    std::string text;
    for (std::size_t line = body; line < at_; ++line) {
      out_.data[line] = true;
      text += between;
      text += trimmed(out_.lines[line]);
    }
    return text;
  }

  // Handlers of headers.
  Handler nameInto(std::function<void(MpvText&&)> take) {
    return [this, take = std::move(take)](MpvText&& rest) {
      const bool good = !rest.text.empty() && base::isIdentStart(rest.text[0]) && rest.text.size() <= 64 &&
                        std::ranges::all_of(rest.text, base::isIdentChar);
      if (good)
        take(std::move(rest));
      else
        fail(at_, "a header lacks a name", "write letters, digits and '_'", rest.place.column);
    };
  }
  static Handler into(std::optional<MpvText>& text) {
    return [&text](MpvText&& rest) { text = std::move(rest); };
  }
  static Handler into(std::string& text) {
    return [&text](MpvText&& rest) { text = std::move(rest.text); };
  }
  Handler into(std::optional<double>& number) {
    return [this, &number](MpvText&& rest) {
      if (const auto numbers = numbersIn(rest.text, 1, 1))
        number = (*numbers)[0];
      else
        wrongNumbers("one number");
    };
  }
  Handler wordInto(bool& flag, const char* on, const char* off) {
    return [this, &flag, on, off](MpvText&& rest) {
      flag = rest.text == on;
      if (!flag && rest.text != off)
        fail(at_, fmt::format("//!{} has an unknown word", wordAt(at_)),
             fmt::format("write {} or {}", on, off), rest.place.column);
    };
  }

  void readHook() {
    MpvHook hook{.place = placeOf(at_), .headerLine = at_};
    const std::size_t errors = diagnostics_.errorCount();
    const auto readOffset = [&](MpvText&& rest) {
      const auto numbers = numbersIn(rest.text, 2, 2);
      if (numbers)
        std::ranges::copy(*numbers, hook.offset);
      else if (rest.text != "ALIGN")
        wrongNumbers("two numbers of texels, or ALIGN");
    };
    const auto readComponents = [&](MpvText&& rest) {
      if (const auto numbers = numbersIn(rest.text, 1, 1, false, 1, 4))
        hook.components = static_cast<int>((*numbers)[0]);
      else
        wrongNumbers("a number from 1 to 4");
    };
    std::string description;  // which the graph has no place for
    readHeaders({{"HOOK", nameInto([&](MpvText&& rest) { hook.hooks.push_back(std::move(rest)); })},
                 {"BIND", nameInto([&](MpvText&& rest) { hook.binds.push_back(std::move(rest)); })},
                 {"SAVE", nameInto([&](MpvText&& rest) { hook.save = std::move(rest); })},
                 {"DESC", into(description)},
                 {"OFFSET", readOffset},
                 {"WIDTH", into(hook.width)},
                 {"HEIGHT", into(hook.height)},
                 {"WHEN", into(hook.when)},
                 {"COMPONENTS", readComponents},
                 {"COMPUTE", [&](MpvText&& rest) { readCompute(hook, rest); }}});
    // Behind an unknown header the block is something else.
    if (hook.hooks.empty() && diagnostics_.errorCount() == errors)
      fail(hook.headerLine, "a pass has no //!HOOK", "write //!HOOK MAIN, for example");
    out_.hooks.push_back(std::move(hook));
  }

  void readCompute(MpvHook& hook, const MpvText& rest) {
    const auto numbers = numbersIn(rest.text, 2, 4, true, 1, 1024);
    if (!numbers || numbers->size() == 3)
      return wrongNumbers(
          "two or four whole numbers from 1 to 1024: width and height of a block, then threads");
    hook.compute = true;
    for (std::size_t i = 0; i < 2; ++i) {
      hook.block[i] = static_cast<int>((*numbers)[i]);
      hook.threads[i] = static_cast<int>(numbers->size() == 4 ? (*numbers)[2 + i] : (*numbers)[i]);
    }
    if (hook.threads[0] * hook.threads[1] > 1024) wrongNumbers("at most 1024 threads in a block");
  }

  void readTexture() {
    MpvTexture texture{.place = placeOf(at_)};
    const std::size_t errors = diagnostics_.errorCount();
    const auto readSize = [&](MpvText&& rest) {
      const auto numbers = numbersIn(rest.text, 1, 3, true, 1, 16384);
      if (!numbers) return wrongNumbers("one to three whole numbers from 1 to 16384");
      texture.dimensions = static_cast<int>(numbers->size());
      std::ranges::transform(*numbers, texture.size, [](double x) { return static_cast<int>(x); });
    };
    const std::size_t body =
        readHeaders({{"TEXTURE", nameInto([&](MpvText&& rest) { texture.name = rest.text; })},
                     {"SIZE", readSize},
                     {"FORMAT", into(texture.format)},
                     {"FILTER", wordInto(texture.linear, "LINEAR", "NEAREST")},
                     {"BORDER", wordInto(texture.repeat, "REPEAT", "CLAMP")}});
    const std::string hex = takeData(body, "");
    if (diagnostics_.errorCount() > errors) return;
    if (std::string wrong = readTexels(texture, hex); !wrong.empty())
      return fail(body - 1, std::move(wrong),
                  "write as many bytes in hexadecimal as SIZE and FORMAT ask for");
    out_.textures.push_back(std::move(texture));
  }

  void readParameter() {
    MpvParameter parameter{.place = placeOf(at_)};
    std::size_t typeLine = at_;
    const auto readType = [&](MpvText&& rest) {
      typeLine = at_;
      parameter.type = rest.text;
      // How often it may change means nothing here.
      for (const std::string_view often : {"DYNAMIC ", "CONSTANT "})
        if (parameter.type.starts_with(often))
          parameter.type = trimmed(std::string_view(rest.text).substr(often.size()));
    };
    const std::size_t body =
        readHeaders({{"PARAM", nameInto([&](MpvText&& rest) { parameter.name = rest.text; })},
                     {"DESC", into(parameter.description)},
                     {"TYPE", readType},
                     {"MINIMUM", into(parameter.min)},
                     {"MAXIMUM", into(parameter.max)}});
    const auto initial = numbersIn(takeData(body, " "), 1, 1);
    if (parameter.type != "float" && parameter.type != "int" && parameter.type != "uint")
      return fail(typeLine,
                  fmt::format("the parameter '{}' has the type '{}'", parameter.name, parameter.type),
                  "write float, int or uint, or a #define");
    if (!initial)
      return fail(body - 1, fmt::format("the parameter '{}' has no default", parameter.name),
                  "write one number on the line behind the headers");
    parameter.initial = (*initial)[0];
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
