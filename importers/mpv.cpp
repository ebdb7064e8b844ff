// A user shader of mpv: its //! headers with places, then its graph and its shaders. Declared in import.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <memory>
#include <sstream>

#include "engine/graph/language/names.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "engine/text/printable.h"
#include "engine/text/words/words.h"
#include "import_glsl.h"
#include "importers/import.h"
#include "importers/text.h"

namespace weft::importing {

namespace {

using text::Code;
using text::Place;
using text::trimmed;

struct MpvHook {
  text::Place place;
  std::vector<PlacedText> hooks, binds;
  std::optional<PlacedText> save, width, height, when;
  double offset[2] = {0, 0};
  int components = 0;  // 0: those of what is hooked
  bool compute = false;
  int block[2] = {0, 0}, threads[2] = {0, 0};
};

struct MpvTexture {
  text::Place place;
  std::string name, format;
  std::vector<double> size = {1};
  bool linear = true, repeat = false;
  // Without a path; the lowest row is the first of the data. None of other than two dimensions.
  ConvertedImage image;
};

struct MpvParameter {
  text::Place place;
  std::string name, description, type;
  std::optional<double> min, max;
  double initial = 0;
};

struct MpvFile {
  std::vector<MpvHook> hooks;
  std::vector<MpvTexture> textures;
  std::vector<MpvParameter> parameters;
  std::vector<std::string_view> lines;  // of the text, without line ends
  std::vector<bool> data;               // by line: texels or a default, no GLSL
};

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
  return kind == "16hf" ? glm::unpackHalf1x16(static_cast<std::uint16_t>(bits)) : std::bit_cast<float>(bits);
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

// The blocks of the file. Mistakes are W225.
class MpvReader {
 public:
  MpvReader(std::string_view text, text::FileName file, text::Diagnostics& diagnostics)
      : file_(file), diagnostics_(diagnostics) {
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
      if (header.word == "FILTER") texture.linear = header.rest.text != "NEAREST";
      if (header.word == "BORDER") texture.repeat = header.rest.text == "REPEAT";
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
      if (header.word == "MINIMUM" || header.word == "MAXIMUM")
        for (const double x : numbersOf(header, {}, "write one number"))
          (header.word == "MINIMUM" ? parameter.min : parameter.max) = x;
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

  text::FileName file_;
  text::Diagnostics& diagnostics_;
  MpvFile out_;
  std::size_t at_ = 0;
};

// Those that a picture in place of a video has, in mpv's order.
const std::array<std::string, 7> kStages{"RGB",    "NATIVE",    "MAINPRESUB", "MAIN",
                                         "SCALED", "PREOUTPUT", "OUTPUT"};
constexpr std::array<std::string_view, 11> kEndings{"_texOff", "_tex", "_raw", "_pos", "_size",  "_pt",
                                                    "_map",    "_off", "_rot", "_mul", "_gather"};
// mpv's own numbers that depend on sizes, which the graph sets where the shader mentions them.
constexpr std::array<std::string_view, 2> kSizes{"input_size", "target_size"};

std::string imagePath(const MpvTexture& texture, const std::string& name) {
  return fmt::format("images/{}/{}.{}", name, texture.name, texture.image.bytes.empty() ? "exr" : "png");
}

// The text that the stage files include: its headers as #if, so that lines keep their numbers.
std::string translateText(const MpvFile& file) {
  const bool many = file.hooks.size() > 1;
  std::string text;
  std::size_t next = 0;
  for (std::size_t line = 0; line < file.lines.size(); ++line) {
    if (many && next < file.hooks.size() && file.hooks[next].place.line == line + 1) {
      text += fmt::format("#{} PASS == {}  {}", next == 0 ? "if" : "elif", next, file.lines[line]);
      ++next;
    } else if (!file.data[line]) {
      text += file.lines[line];
    }
    text += '\n';
  }
  if (many) text += "#endif\n";
  GlslText glsl(text);
  glsl.renameTaken({"uv", "result", "mpv_place", "mpvPlace", "shift", "main"});
  return glsl.changed();
}

// The names that the shader mentions, with and without mpv's endings: HOOKED_texOff and HOOKED.
std::set<std::string, std::less<>> namesMentioned(const std::string& text) {
  std::set<std::string, std::less<>> names;
  for (const glsl::Token& token : glsl::splitTokens(text)) {
    if (token.kind != glsl::TokenKind::word) continue;
    names.emplace(token.text);
    for (const std::string_view ending : kEndings)
      if (token.text.ends_with(ending))
        names.emplace(token.text.substr(0, token.text.size() - ending.size()));
  }
  return names;
}

class MpvWriter {
 public:
  MpvWriter(const MpvFile& file, const ConvertOptions& options, text::Diagnostics& diagnostics)
      : file_(file),
        options_(options),
        name_(options.name),
        diagnostics_(diagnostics),
        text_(translateText(file)),
        used_(namesMentioned(text_)),
        definesTransfer_(GlslText(text_).declares("linearize") || GlslText(text_).declares("delinearize")) {}

  // Empty after errors.
  std::optional<Converted> run() {
    const std::size_t errors = diagnostics_.errorCount();
    addSource();
    for (const MpvParameter& parameter : file_.parameters) addParameter(parameter);
    for (const MpvTexture& texture : file_.textures) addTexture(texture);
    for (const MpvHook& hook : file_.hooks) checkStages(hook);
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    for (const std::string& stage : kStages) {
      names_[stage] = names_["HOOKED"];
      for (std::size_t i = 0; i < file_.hooks.size(); ++i)
        for (const PlacedText& hook : file_.hooks[i].hooks)
          if (hook.text == stage) addPass(i, stage);
    }
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    addShow();
    Converted out{.graph = name_ + ".json"};
    out.texts.push_back({out.graph, graphText({{"name", name_},
                                               {"parameters", parameters_},
                                               {"resources", resources_},
                                               {"passes", passes_},
                                               {"present", "shown"}})});
    addShaders(out.texts);
    for (const MpvTexture& texture : file_.textures) {
      out.images.push_back(texture.image);
      out.images.back().path = imagePath(texture, name_);
    }
    return out;
  }

 private:
  struct Named {
    std::string resource, filter = " as linear";
    std::string width, height;            // expressions
    std::vector<std::string> conditions;  // of which all must hold, so that something wrote it
  };
  static Named sized(const std::string& resource, std::vector<std::string> conditions = {}) {
    return {.resource = resource,
            .width = fmt::format("size({}).x", resource),
            .height = fmt::format("size({}).y", resource),
            .conditions = std::move(conditions)};
  }

  void fail(Code code, const text::Place& place, std::string message, std::string hint) {
    refuse(diagnostics_, code, place, std::move(message), std::move(hint));
  }

  std::string fresh(const std::string& wanted) {
    return freshName(taken_, text::isGlslWord(wanted) ? wanted + "_" : wanted);
  }

  void addSource() {
    const std::string file = options_.images.empty() ? "" : options_.images.back().second;
    parameters_["picture"] = {{"type", "file"}, {"default", file}, {"label", "Picture"}};
    resources_["picture"] = {{"import", "image"}, {"file", "$picture"}};
    // With as many bits as a PNG may have; turned over.
    resources_["source"] = {{"texture", "rgba16"}, {"size", "has(picture) ? size(picture) : screen"}};
    resources_["shown"] = {{"texture", "rgba8"}, {"size", "screen"}};
    passes_.push_back({{"name", "turn"},
                       {"type", "fullscreen"},
                       {"shader", name_ + "/turn.frag.glsl"},
                       {"read", {{"source", "picture as linear ?"}}},
                       {"write", {{"result", "source"}}}});
    names_["HOOKED"] = sized("source");
  }

  void addParameter(const MpvParameter& parameter) {
    const bool real = parameter.type == "float";
    if (!taken_.insert(parameter.name).second || text::isGlslWord(parameter.name))
      return fail(Code::notAName, parameter.place,
                  fmt::format("\"{}\" cannot name a parameter", parameter.name), "give it a name of its own");
    Json& made = parameters_[parameter.name];
    made = {{"type", real ? "float" : "int"}, {"default", numberOf(parameter.initial, real)}};
    const double low = std::min(parameter.min.value_or(parameter.initial), parameter.initial);
    const double high = std::max(parameter.max.value_or(parameter.initial), parameter.initial);
    if (parameter.min && low < high) made["min"] = numberOf(low, real);
    if (parameter.max && low < high) made["max"] = numberOf(high, real);
    if (!parameter.description.empty()) made["label"] = text::printable(parameter.description);
  }

  void addTexture(const MpvTexture& texture) {
    if (texture.size.size() != 2)
      return fail(Code::mpvNotMapped, texture.place,
                  fmt::format("the texture '{}' has not two dimensions", texture.name),
                  "give it a height of 1, or lay its slices beside each other");
    if (names_.contains(texture.name))
      return fail(Code::duplicateName, texture.place,
                  fmt::format("two textures have the name '{}'", texture.name), "rename one");
    const std::string resource = fresh(texture.name);
    resources_[resource] = {{"import", "image"}, {"file", imagePath(texture, name_)}};
    names_[texture.name] = {.resource = resource,
                            .filter = fmt::format(" as {}{}", texture.linear ? "linear" : "nearest",
                                                  texture.repeat ? " wrap" : ""),
                            .width = fmt::format("{}", texture.size[0]),
                            .height = fmt::format("{}", texture.size[1])};
  }

  // A pass needs a stage that a picture has; of several, the others are left out with a warning.
  void checkStages(const MpvHook& hook) {
    const auto isStage = [](const PlacedText& text) { return contains(kStages, text.text); };
    const bool any = std::ranges::any_of(hook.hooks, isStage);
    for (const PlacedText& text : hook.hooks) {
      if (isStage(text)) continue;
      const std::string message = fmt::format("a picture has no stage '{}'", text.text);
      if (any)
        diagnostics_.add({.severity = text::Severity::warning,
                          .code = Code::mpvNotMapped,
                          .message = message,
                          .place = text.place,
                          .hint = "the pass runs at its other stages"});
      else
        fail(Code::mpvNotMapped, text.place, message,
             "hook RGB, NATIVE, MAINPRESUB, MAIN, SCALED, PREOUTPUT or OUTPUT");
    }
  }

  // What a word of an expression is in Weft: a side of a texture, a number or a parameter. Empty: none of them.
  std::string valueOf(std::string_view word) const {
    if (text::isDigit(word[0])) {
      const bool number = std::ranges::count(word, '.') <= 1 && word.size() <= 20 && word.back() != '.' &&
                          word.find_first_not_of("0123456789.") == word.npos;
      return number ? std::string(word) : std::string();
    }
    const std::size_t point = word.rfind('.');
    const std::string_view end = point == word.npos ? "" : word.substr(point + 1);
    const bool width = end == "w" || end == "width";
    if (width || end == "h" || end == "height") {
      const std::string_view name = word.substr(0, point);
      if (name == "OUTPUT") return width ? "screen.x" : "screen.y";
      const auto named = names_.find(name);
      return named == names_.end() ? "" : width ? named->second.width : named->second.height;
    }
    const auto known = std::ranges::find(file_.parameters, word, &MpvParameter::name);
    return known == file_.parameters.end() ? std::string() : fmt::format("${}", word);
  }

  // An expression in reverse Polish as one of Weft: "MAIN.w 2 *" becomes "(size(main).x * 2)".
  std::optional<std::string> expressionOf(const PlacedText& expression) {
    const auto wrong = [&](std::size_t at, std::string message) {
      fail(Code::badMpvHeader, expression.place.after(at), std::move(message),
           "write reverse Polish of numbers, NAME.w, NAME.h, + - * / % > < = !: HOOKED.w 2 * is twice the "
           "width of what is hooked");
      return std::nullopt;
    };
    const std::string_view text = expression.text;
    std::vector<std::string> stack;
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (text::isSpace(text[at])) continue;
      const std::string_view word =
          text.substr(at, std::min(text.find_first_of(" \t", at), text.size()) - at);
      const bool binary = word.size() == 1 && std::string_view("+-*/%><=").find(word[0]) != std::string::npos;
      if (binary || word == "!") {
        if (stack.size() < (binary ? 2u : 1u))
          return wrong(at, fmt::format("'{}' has too few values before it", word));
        const std::string right = binary ? std::move(stack.back()) : "0";
        if (binary) stack.pop_back();
        stack.back() = fmt::format("({} {} {})", stack.back(), word == "=" || !binary ? "==" : word, right);
      } else if (std::string value = valueOf(word); !value.empty()) {
        stack.push_back(std::move(value));
      } else {
        return wrong(at, fmt::format("'{}' is no number, no parameter and no side of a texture", word));
      }
      at += word.size();
    }
    if (stack.size() != 1)
      return wrong(0, stack.empty() ? "the expression is empty" : "values are left over");
    return stack.back();
  }

  bool isTexture(const std::string& name) const {
    return std::ranges::find(file_.textures, name, &MpvTexture::name) != file_.textures.end();
  }

  void addPass(std::size_t index, const std::string& stage) {
    const MpvHook& hook = file_.hooks[index];
    const Named hooked = names_["HOOKED"];
    std::vector<std::string> conditions;
    const auto require = [&](const std::string& condition) {
      if (!contains(conditions, condition)) conditions.push_back(condition);
    };
    Json reads = Json::object();
    for (const PlacedText& bind : hook.binds) {
      const auto found = names_.find(bind.text == stage ? "HOOKED" : bind.text);
      if (found == names_.end()) {
        return fail(Code::mpvNotMapped, bind.place,
                    fmt::format("nothing has saved a texture '{}' here", bind.text),
                    "bind HOOKED, a stage, a //!TEXTURE, or what a pass before saves");
      }
      if (!used_.contains(bind.text)) continue;
      // The shader knows a texture of the file by its own name.
      const bool ofFile = isTexture(bind.text);
      reads[ofFile ? bind.text : bind.text + "_raw"] = found->second.resource + found->second.filter;
      (ofFile ? texturesBound_ : bound_).insert(bind.text);
      if (bind.text != "HOOKED" && bind.text != stage)
        for (const std::string& each : found->second.conditions) require(each);
    }
    if (hook.when) {
      const auto when = expressionOf(*hook.when);
      if (!when) return;
      require(*when + " != 0");
    }
    std::string condition = fmt::format("{}", fmt::join(conditions, ") && ("));
    if (conditions.size() > 1) condition = "(" + condition + ")";
    const bool saves = hook.save && hook.save->text != "HOOKED" && hook.save->text != stage;
    const std::string resource = fresh(saves ? hook.save->text : stage);
    addTarget(hook, resource, hooked);
    addHook(index, reads, resource, condition);
    Named result = sized(resource, conditions);
    if (saves) {
      names_[hook.save->text] = result;
      return;
    }
    if (!condition.empty()) {  // where the pass does not run, what was there before goes on
      const std::string chosen = fresh(resource + "_or_" + hooked.resource);
      resources_[chosen] = Json::array({fmt::format("{} if {}", resource, condition), hooked.resource});
      result = sized(chosen);
    }
    if (hook.offset[0] != 0 || hook.offset[1] != 0)
      for (int axis = 0; axis < 2; ++axis)
        shift_[axis] += fmt::format("{}{} / size({}).{}", shift_[axis].empty() ? "" : " + ",
                                    hook.offset[axis], result.resource, "xy"[axis]);
    names_["HOOKED"] = names_[stage] = result;
  }

  void addTarget(const MpvHook& hook, const std::string& resource, const Named& hooked) {
    static constexpr const char* kFormats[] = {"rgba16f", "r16f", "rg16f", "rgba16f", "rgba16f"};
    // Rounds as mpv does.
    const auto side = [&](const std::optional<PlacedText>& own, const std::string& otherwise) {
      return own ? fmt::format("floor({} + 0.5)", expressionOf(*own).value_or("1")) : otherwise;
    };
    const bool same = !hook.width && !hook.height && hooked.width.ends_with(".x");
    Json size = Json::array({side(hook.width, hooked.width), side(hook.height, hooked.height)});
    if (same) size = hooked.width.substr(0, hooked.width.size() - 2);
    resources_[resource] = {{"texture", hook.compute ? "rgba16f" : kFormats[hook.components]},
                            {"size", std::move(size)}};
  }

  void addHook(std::size_t index, const Json& reads, const std::string& resource,
               const std::string& condition) {
    const MpvHook& hook = file_.hooks[index];
    Json pass = {{"name", freshName(passNames_, fmt::format("pass_{}", index + 1))},
                 {"type", hook.compute ? "compute" : "fullscreen"},
                 {"shader", fmt::format("{0}/{0}.{1}.glsl", name_, hook.compute ? "comp" : "frag")}};
    if (!condition.empty()) pass["enabled"] = condition;
    if (!reads.empty()) pass["read"] = reads;
    pass["write"] = {{hook.compute ? "out_image" : "result", resource}};
    Json defines = {{"PASS", index}};
    if (hook.compute) {
      defines.update({{"THREADS_X", hook.threads[0]}, {"THREADS_Y", hook.threads[1]}});
      for (int axis = 0; axis < 2; ++axis)
        pass["threads"].push_back(fmt::format("ceil(size({}).{} / {}) * {}", resource, "xy"[axis],
                                              hook.block[axis], hook.threads[axis]));
    }
    pass["defines"] = defines;
    Json uniforms = Json::object();
    for (const MpvParameter& parameter : file_.parameters)
      if (used_.contains(parameter.name)) uniforms[parameter.name] = "$" + parameter.name;
    for (const std::string_view size : kSizes)
      if (used_.contains(size)) uniforms[std::string(size)] = size == kSizes[0] ? "size(source)" : "screen";
    if (!uniforms.empty()) pass["parameters"] = uniforms;
    passes_.push_back(pass);
    (hook.compute ? compute_ : fragment_) = true;
  }

  void addShow() {
    Json shift = Json::array({0, 0});
    if (!shift_[0].empty()) shift = fmt::format("[{}, {}]", shift_[0], shift_[1]);
    passes_.push_back({{"name", "show"},
                       {"type", "fullscreen"},
                       {"shader", name_ + "/show.frag.glsl"},
                       {"read", {{"source", names_["HOOKED"].resource + " as linear"}}},
                       {"write", {{"result", "shown"}}},
                       {"parameters", {{"shift", shift}}}});
  }

  void addShaders(std::vector<ConvertedText>& texts) const {
    std::string members, slots;
    for (const MpvParameter& parameter : file_.parameters)
      if (used_.contains(parameter.name))
        members += fmt::format("  {} {};\n", parameter.type, parameter.name);
    for (const std::string_view size : kSizes)
      if (used_.contains(size)) members += fmt::format("  vec2 {};\n", size);
    for (const std::string& bound : bound_)
      slots += fillTemplate(templates::mpv_slot,
                            {{"@NAME@", bound}, {"@PRESENT@", glsl::presenceDefineOf(bound + "_raw")}});
    for (const std::string& texture : texturesBound_)
      slots += fmt::format("\n#ifdef {}\nuniform sampler2D {};\n#endif\n", glsl::presenceDefineOf(texture),
                           texture);
    // Unless the file has functions of these names.
    if ((used_.contains("linearize") || used_.contains("delinearize")) && !definesTransfer_)
      slots += templates::mpv_transfer;
    const auto add = [&](const std::string& file, const char* text) {
      texts.push_back({fmt::format("shaders/{}/{}", name_, file),
                       fillTemplate(text, {{"@NAME@", name_},
                                           {"@PARAMETERS@\n", parameterBlockOf(members)},
                                           {"@SLOTS@\n", slots}})});
    };
    add("mpv.glsl", templates::mpv);
    texts.push_back({fmt::format("shaders/{0}/{0}.hook.glsl", name_), text_});
    if (fragment_) add(name_ + ".frag.glsl", templates::mpv_fragment);
    if (compute_) add(name_ + ".comp.glsl", templates::mpv_compute);
    add("turn.frag.glsl", templates::mpv_turn);
    add("show.frag.glsl", templates::mpv_show);
  }

  const MpvFile& file_;
  const ConvertOptions& options_;
  const std::string& name_;
  text::Diagnostics& diagnostics_;
  const std::string text_;                         // the shader, translated
  const std::set<std::string, std::less<>> used_;  // names that it mentions
  const bool definesTransfer_;                     // functions that libplacebo would give
  std::set<std::string> bound_, texturesBound_;    // pictures that passes bind, textures of the file
  bool fragment_ = false, compute_ = false;        // some pass is
  Json parameters_ = Json::object(), resources_ = Json::object(), passes_ = Json::array();
  std::string shift_[2];
  std::map<std::string, Named, std::less<>> names_;
  std::set<std::string, std::less<>> taken_{"picture", "source", "shown"};
  std::set<std::string, std::less<>> passNames_;
};

}  // namespace

std::optional<Converted> convertMpv(std::string_view text, const std::string& file,
                                    const ConvertOptions& options, text::Diagnostics& diagnostics) {
  const auto parsed = MpvReader(text, file, diagnostics).run();
  static const std::string kPicture[] = {"picture"};
  if (!parsed || !checkImageNames(options, kPicture, diagnostics)) return std::nullopt;
  return MpvWriter(*parsed, options, diagnostics).run();
}

}  // namespace weft::importing
