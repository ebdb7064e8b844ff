#include "app/lsp/text/texts.h"

#include <algorithm>
#include <filesystem>

#include "engine/glsl/tokens.h"
#include "engine/text/files/file.h"

namespace weft::app::lsp {

namespace {

using Type = JsonValue::Type;

// Whether the cursor is in the value, which it may leave behind a missing quote or bracket.
bool isIn(const JsonValue& value, std::size_t offset) {
  if (!value.is(Type::object) && !value.is(Type::array) && !value.is(Type::string))
    return rangeOf(value).holds(offset);
  return value.begin < offset && (offset < value.end || (!value.closed && offset <= value.end));
}

}  // namespace

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

std::vector<std::string_view> keysOn(const Way& way) {
  std::vector<std::string_view> keys;
  for (std::size_t i = 1; i < way.size(); ++i)
    keys.push_back(way[i].member ? std::string_view(way[i].member->key) : "[]");
  return keys;
}

Spot spotAt(const text::JsonTree& tree, std::size_t offset) {
  Spot spot;
  spot.inComment = std::ranges::any_of(
      tree.comments, [&](const Range& comment) { return comment.begin < offset && offset <= comment.end; });
  for (Step step{&tree.root}; step.value;) {
    spot.way.push_back(step);
    const JsonValue& around = *step.value;
    step = {};
    for (const JsonValue& item : around.items)
      if (!item.is(Type::absent) && isIn(item, offset)) step = {&item};
    for (const JsonMember& member : around.members) {
      spot.inKey = inside(member).holds(offset);
      if (spot.inKey || (member.hasValue && isIn(member.value, offset))) step = {&member.value, &member};
      if (spot.inKey) break;
    }
    if (!spot.inKey) continue;
    spot.way.push_back(step);
    return spot;
  }
  spot.atKey = spot.value().is(Type::object);
  return spot;
}

GlslOutline::GlslOutline(std::string_view text) {
  const auto beginOf = [&](const glsl::Token& token) {
    return static_cast<std::size_t>(token.text.data() - text.data());
  };
  const auto rangeOf = [&](const glsl::Token& token) {
    return Range{beginOf(token), beginOf(token) + token.text.size()};
  };
  const std::vector<glsl::Token> tokens = glsl::splitTokens(text);
  std::vector<glsl::Token> code;  // without directives
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    if (tokens[i].kind == glsl::TokenKind::word)
      words.push_back({tokens[i].text, rangeOf(tokens[i]), i > 0 && tokens[i - 1].is(".")});
    if (!tokens[i].first || !tokens[i].is("#")) {
      code.push_back(tokens[i]);
      continue;
    }
    const std::size_t hash = i, begin = beginOf(tokens[hash]);
    const std::size_t line = std::min(text.find('\n', begin), text.size());
    const bool include = i + 1 < tokens.size() && tokens[i + 1].is("include");
    for (; i + 1 < tokens.size() && !tokens[i + 1].first; ++i)
      if (!include && i > hash && tokens[i + 1].kind == glsl::TokenKind::word)
        words.push_back({tokens[i + 1].text, rangeOf(tokens[i + 1]), tokens[i].is(".")});
    if (i >= hash + 2 && tokens[hash + 1].is("define"))
      names.push_back(
          {{}, tokens[hash + 2].text, rangeOf(tokens[hash + 2]), {}, text.substr(begin, line - begin)});
    const std::size_t open = include ? text.find('"', begin) : line;
    const std::size_t close = open < line ? text.find('"', open + 1) : line;
    if (close < line) includes.push_back({text.substr(open + 1, close - open - 1), {open + 1, close}});
  }
  using enum glsl::Role;
  for (const glsl::Declaration& each : glsl::readInterface(code).declarations) {
    constexpr glsl::Role kShown[] = {sampler, image,  uniform,       input,
                                     output,  member, uniform_block, storage_block};
    if (std::ranges::find(kShown, each.role) == std::end(kShown)) continue;
    const std::size_t begin = beginOf(each.begin), end = beginOf(each.end) + (each.end.is(";") ? 1 : 0);
    names.push_back({each.role, each.name, rangeOf(each.at),
                     each.role == member ? each.owner : std::string_view(), text.substr(begin, end - begin)});
  }
  std::ranges::stable_sort(names, {}, [](const GlslName& name) { return name.range.begin; });
}

const GlslName* GlslOutline::find(std::string_view name) const {
  const auto found = std::ranges::find(names, name, &GlslName::name);
  return found == names.end() ? nullptr : &*found;
}

const GlslWord* GlslOutline::wordAt(std::size_t offset) const {
  const auto found =
      std::ranges::find_if(words, [&](const GlslWord& word) { return word.range.holds(offset); });
  return found == words.end() ? nullptr : &*found;
}

const text::JsonTree& Text::json() const {
  if (!json_) json_ = text::parseJsonTree(bytes_);
  return *json_;
}

const GlslOutline& Text::glsl() const {
  if (!glsl_) glsl_.emplace(bytes_);
  return *glsl_;
}

std::string_view Text::written(const JsonValue& string) const {
  const Range range = inside(string);
  return std::string_view(bytes_).substr(range.begin, range.end - range.begin);
}

Texts::~Texts() {
  for (const auto& [path, version] : opened_) text::dropOverlay(path);
}

void Texts::open(const std::string& path, std::string text, std::int64_t version) {
  opened_[path] = version;
  replace(path, std::move(text));
}

void Texts::replace(const std::string& path, std::string text) {
  if (!isOpen(path)) return;
  text::overlayFile(path, text);
  texts_[path] = std::make_shared<const Text>(path, std::move(text));
}

void Texts::change(const std::string& path, const Position& start, const Position& end,
                   const std::string& text) {
  const auto found = texts_.find(path);
  if (found == texts_.end()) return;
  const LineMap& map = found->second->map();
  const std::size_t from = map.offsetOf(start), to = map.offsetOf(end);
  if (to < from) return;
  std::string bytes = found->second->bytes();
  replace(path, std::move(bytes.replace(from, to - from, text)));
}

void Texts::setVersion(const std::string& path, std::int64_t version) {
  if (const auto found = opened_.find(path); found != opened_.end()) found->second = version;
}

void Texts::close(const std::string& path) {
  text::dropOverlay(path);
  opened_.erase(path);
  texts_.erase(path);
}

std::shared_ptr<const Text> Texts::of(const std::string& path) const {
  if (const auto found = texts_.find(path); found != texts_.end()) return found->second;
  std::error_code ec;
  const auto time = std::filesystem::last_write_time(path, ec);
  const auto bytes = ec ? 0 : std::filesystem::file_size(path, ec);
  if (ec) return nullptr;
  Known& known = onDisk_[path];
  const auto stamp = static_cast<std::int64_t>(time.time_since_epoch().count());
  if (known.text && known.time == stamp && known.bytes == bytes) return known.text;
  text::Diagnostics ignored;
  auto text = text::readTextFile(path, ignored);
  if (!text) return nullptr;
  known = {std::make_shared<const Text>(path, *std::move(text)), stamp, bytes};
  return known.text;
}

}  // namespace weft::app::lsp
