#include "engine/graph/workload/json_cursor.h"

#include <charconv>

namespace weft::graph {

namespace {

constexpr int kDeepest = 200;

void appendUtf8(std::uint32_t c, std::string& out) {
  const auto push = [&](std::uint32_t byte) { out.push_back(static_cast<char>(byte)); };
  if (c < 0x80) {
    push(c);
  } else if (c < 0x800) {
    push(0xc0 | c >> 6);
    push(0x80 | (c & 0x3f));
  } else if (c < 0x10000) {
    push(0xe0 | c >> 12);
    push(0x80 | (c >> 6 & 0x3f));
    push(0x80 | (c & 0x3f));
  } else {
    push(0xf0 | c >> 18);
    push(0x80 | (c >> 12 & 0x3f));
    push(0x80 | (c >> 6 & 0x3f));
    push(0x80 | (c & 0x3f));
  }
}

}  // namespace

void JsonCursor::fail(const std::string& why) {
  if (error_.empty()) error_ = why;
}

std::string_view JsonCursor::string(std::size_t& position) {
  if (failed()) return {};
  if (!take('"')) {
    fail("expected a string");
    return {};
  }
  position = at_ - 1;
  const std::size_t begin = at_;
  for (; at_ < text_.size(); ++at_) {
    const auto c = static_cast<unsigned char>(text_[at_]);
    if (c == '"') return text_.substr(begin, at_++ - begin);
    if (c == '\\') return unescape(begin);
    if (c < 0x20) {
      fail("control character in a string");
      return {};
    }
  }
  fail("string without an end");
  return {};
}

std::string_view JsonCursor::unescape(std::size_t begin) {
  unescaped_.assign(text_.substr(begin, at_ - begin));
  const auto hex4 = [&]() -> std::uint32_t {
    std::uint32_t value = 0;
    const char* first = text_.data() + at_;
    if (at_ + 4 > text_.size() || std::from_chars(first, first + 4, value, 16).ptr != first + 4) {
      fail("bad \\u escape");
      return 0;
    }
    at_ += 4;
    return value;
  };
  while (at_ < text_.size() && !failed()) {
    const char c = text_[at_++];
    if (c == '"') return unescaped_;
    if (static_cast<unsigned char>(c) < 0x20) break;
    if (c != '\\') {
      unescaped_.push_back(c);
      continue;
    }
    const char e = at_ < text_.size() ? text_[at_++] : '\0';
    constexpr std::string_view from = "\"\\/bfnrt", to = "\"\\/\b\f\n\r\t";
    if (const std::size_t k = from.find(e); k != std::string_view::npos && e != '\0') {
      unescaped_.push_back(to[k]);
    } else if (e == 'u') {
      std::uint32_t code = hex4();
      if (code >= 0xd800 && code < 0xdc00 && text_.substr(at_, 2) == "\\u") {
        at_ += 2;
        const std::uint32_t low = hex4();
        if (low >= 0xdc00 && low < 0xe000) code = 0x10000 + ((code - 0xd800) << 10) + (low - 0xdc00);
      }
      if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) fail("lone surrogate");
      if (!failed()) appendUtf8(code, unescaped_);
    } else {
      fail("unknown escape");
    }
  }
  fail("string without an end");
  return {};
}

double JsonCursor::number() {
  if (failed()) return 0;
  skipSpaces();
  double value = 0;
  const char* first = text_.data() + at_;
  const char* last = text_.data() + text_.size();
  // from_chars alone would take "inf" and ".5"
  const bool starts = first != last && (*first == '-' ? last - first > 1 && first[1] >= '0' && first[1] <= '9'
                                                      : *first >= '0' && *first <= '9');
  const auto result = std::from_chars(first, last, value);
  if (!starts || result.ec != std::errc{}) {
    fail("expected a number");
    return 0;
  }
  at_ += static_cast<std::size_t>(result.ptr - first);
  return value;
}

bool JsonCursor::boolean() {
  if (failed()) return false;
  skipSpaces();
  if (text_.substr(at_, 4) == "true") {
    at_ += 4;
    return true;
  }
  if (text_.substr(at_, 5) == "false") {
    at_ += 5;
    return false;
  }
  fail("expected true or false");
  return false;
}

void JsonCursor::skipValue(int depth) {
  if (failed()) return;
  if (depth > kDeepest) return fail("nested too deeply");
  std::size_t position = 0;
  switch (peek()) {
    case '{':
      object([&](std::string_view, std::size_t) { skipValue(depth + 1); });
      return;
    case '[':
      array([&] { skipValue(depth + 1); });
      return;
    case '"':
      string(position);
      return;
    case 't':
    case 'f':
      boolean();
      return;
    case 'n':
      if (text_.substr(at_, 4) != "null") return fail("expected a value");
      at_ += 4;
      return;
    default:
      number();
  }
}

void JsonCursor::finish() {
  if (!failed() && peek() != '\0') fail("text after the document");
  if (!failed() && at_ < text_.size()) fail("text after the document");
}

}  // namespace weft::graph
