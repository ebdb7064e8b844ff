#include "app/lsp/texts.h"

#include <algorithm>
#include <filesystem>

#include "engine/glsl/tokens.h"
#include "engine/text/json/report.h"

namespace weft::app::lsp {

namespace fs = std::filesystem;

namespace {

using Type = JsonValue::Type;

// UTF-16 code units of a byte of UTF-8: those of its character at the first byte, 0 at the others.
std::uint32_t unitsOf(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return (byte & 0xC0) == 0x80 ? 0 : byte >= 0xF0 ? 2 : 1;
}

// Whether the cursor is in the value, which it may leave behind a missing quote or bracket.
bool isIn(const JsonValue& value, std::size_t offset) {
  if (!value.is(Type::object) && !value.is(Type::array) && !value.is(Type::string))
    return rangeOf(value).holds(offset);
  return value.begin < offset && (offset < value.end || (!value.closed && offset <= value.end));
}

}  // namespace

std::string pathBeside(const std::string& file, std::string_view path) {
  return text::absolutePath((fs::path(file).parent_path() / path).string());
}

std::string pathOfUri(std::string_view uri) {
  if (!uri.starts_with("file://")) return "";
  // The path begins behind the host, which is taken for this one.
  const std::size_t slash = uri.find('/', 7);
  const std::string path = text::unescapeUri(uri.substr(slash));
  return path.find('\0') == path.npos ? fs::path(path).lexically_normal().string() : "";
}

Range rangeOf(const JsonValue& value) {
  return {value.begin, value.end};
}
Range inside(const JsonValue& string) {
  if (!string.is(Type::string)) return rangeOf(string);
  return {string.begin + std::size_t{1}, string.end - std::size_t{string.closed}};
}
Range inside(const JsonMember& key) {
  return {key.begin + std::size_t{1}, key.end - std::size_t{key.closed}};
}

std::string_view textOf(const JsonValue& object, std::string_view key) {
  const JsonValue* const value = object.find(key);
  return value ? std::string_view(value->text) : std::string_view();
}

const JsonValue* Spot::stanza() const {
  return values.size() > 2 && keys[0] == "passes" && values[2]->is(Type::object) ? values[2] : nullptr;
}

Spot spotAt(const text::JsonTree& tree, std::size_t offset) {
  Spot spot;
  spot.inComment = std::ranges::any_of(
      tree.comments, [&](const Range& comment) { return comment.begin < offset && offset <= comment.end; });
  for (const JsonValue* next = &tree.root; next;) {
    const JsonValue& around = *next;
    spot.values.push_back(std::exchange(next, nullptr));
    std::string_view key = "[]";
    for (const JsonValue& item : around.items)
      if (!item.is(Type::absent) && isIn(item, offset)) next = &item;
    for (const JsonMember& member : around.members) {
      if (inside(member).holds(offset)) {
        spot.key = &member;
        return spot;
      }
      if (!member.hasValue || !isIn(member.value, offset)) continue;
      next = &member.value;
      key = member.key;
    }
    if (next) spot.keys.push_back(key);
    // A pass in a group counts as one of the file.
    if (spot.keys.size() == 4 && spot.keys[0] == "passes" && spot.keys[2] == "passes" &&
        spot.keys[3] == "[]") {
      spot.keys.resize(2);
      spot.values.erase(spot.values.begin() + 1, spot.values.begin() + 3);
    }
  }
  return spot;
}

Text::Text(std::string path, std::string bytes) : path_(std::move(path)), bytes_(std::move(bytes)) {
  for (std::size_t at = 0; (at = bytes_.find('\n', at)) != bytes_.npos;) lines_.push_back(++at);
}

std::size_t Text::lineOf(std::size_t offset) const {
  return static_cast<std::size_t>(std::ranges::upper_bound(lines_, offset) - lines_.begin());
}

std::size_t Text::offsetOf(const Json& position) const {
  const auto numberOf = [&](const char* key) { return position.at(key).get_ref<const std::uint64_t&>(); };
  const std::uint64_t line = numberOf("line"), units = numberOf("character");
  if (line >= lines_.size()) return bytes_.size();
  std::size_t at = lines_[line];
  const auto isInside = [&] { return at < bytes_.size() && bytes_[at] != '\n' && bytes_[at] != '\r'; };
  // A position in the middle of a surrogate pair is before it.
  for (std::uint64_t passed = 0; isInside() && passed + unitsOf(bytes_[at]) <= units; ++at)
    passed += unitsOf(bytes_[at]);
  return at;
}

Json Text::toJson(const Range& range) const {
  const auto json = [&](std::size_t offset) {
    const std::size_t line = lineOf(offset) - 1;
    std::uint32_t units = 0;
    for (std::size_t at = lines_[line]; at < std::min(offset, bytes_.size()); ++at)
      units += unitsOf(bytes_[at]);
    return Json{{"line", line}, {"character", units}};
  };
  return {{"start", json(range.begin)}, {"end", json(range.end)}};
}

text::Place Text::placeOf(std::size_t offset) const {
  const std::size_t line = lineOf(offset);
  return {path_, static_cast<std::uint32_t>(line), static_cast<std::uint32_t>(offset - lines_[line - 1] + 1)};
}

const text::JsonTree& Text::json() const {
  if (!json_)
    json_ = text::parseJsonTree(std::string_view(bytes_).substr(0, isLarge() ? kBeginning : bytes_.size()));
  return *json_;
}

const std::vector<GlslWord>& Text::words() const {
  if (words_) return *words_;
  words_.emplace();
  bool include = false;
  const std::vector<glsl::Token> tokens = glsl::splitTokens(bytes_);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const glsl::Token& token = tokens[i];
    if (token.first) include = token.is("#") && i + 1 < tokens.size() && tokens[i + 1].is("include");
    if (include || token.kind != glsl::TokenKind::word) continue;
    const auto begin = static_cast<std::size_t>(token.text.data() - bytes_.data());
    words_->push_back({token.text, {begin, begin + token.text.size()}, i > 0 && tokens[i - 1].is(".")});
  }
  return *words_;
}

const GlslWord* Text::wordAt(std::size_t offset) const {
  const auto found =
      std::ranges::find_if(words(), [&](const GlslWord& word) { return word.range.holds(offset); });
  return found == words().end() ? nullptr : &*found;
}

const glsl::Interface& Text::glsl() const {
  if (!glsl_) glsl_ = glsl::readInterface(bytes_, {}, glsl::Branches::all);
  return *glsl_;
}

std::size_t Text::offsetOf(const glsl::Token& token) const {
  return text::offsetOf(bytes_, {{}, token.line, token.column});
}

std::optional<Range> Text::rangeOf(const glsl::Declaration& declaration) const {
  const std::size_t begin = offsetOf(declaration.at);
  if (bytes_.compare(begin, declaration.name.size(), declaration.name) != 0) return std::nullopt;
  return Range{begin, begin + declaration.name.size()};
}

std::string_view Text::statementOf(const glsl::Declaration& declaration) const {
  const std::size_t begin = offsetOf(declaration.begin), end = offsetOf(declaration.end);
  return std::string_view(bytes_).substr(begin, std::max(begin, end + declaration.end.is(";")) - begin);
}

void Texts::open(const std::string& path, std::string text, std::int64_t version) {
  text::overlayFile(path, text);
  opened_[path] = {version, std::make_shared<const Text>(path, std::move(text))};
}

void Texts::close(const std::string& path) {
  text::dropOverlay(path);
  opened_.erase(path);
}

std::shared_ptr<const Text> Texts::of(const std::string& path) const {
  if (const auto found = opened_.find(path); found != opened_.end()) return found->second.text;
  const auto read = [](const std::string& file, text::Diagnostics& said) {
    auto text = text::readTextFile(file, said);
    return text ? std::optional(std::make_shared<const Text>(file, *std::move(text))) : std::nullopt;
  };
  text::Diagnostics ignored;
  const auto known = onDisk_.get<std::shared_ptr<const Text>>(path, read, ignored);
  return known ? *known : nullptr;
}

}  // namespace weft::app::lsp
