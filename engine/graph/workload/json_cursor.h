// A forward-only reader of JSON text for forms that are known in advance: no document, no allocation per
// value. The first syntax error stops it: failed() stays true, and every later call returns at once. Does not
// know comments.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace weft::graph {

class JsonCursor {
 public:
  explicit JsonCursor(std::string_view text) : text_(text) {}

  bool failed() const { return !error_.empty(); }
  const std::string& error() const { return error_; }
  std::size_t position() const { return at_; }
  void moveTo(std::size_t position) { at_ = position; }

  // Over spaces, then true and past `c` when it is next.
  bool take(char c) {
    skipSpaces();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  char peek() {
    skipSpaces();
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  // A string without its quotes. Valid until the next call; start of the token in `position`.
  std::string_view string(std::size_t& position);
  double number();
  bool boolean();
  void skipValue(int depth = 0);
  void finish();  // fails unless only spaces are left
  void fail(const std::string& why);

  // For each member of an object, f(key, position of the key); f must read the value.
  template <class F>
  void object(F&& f) {
    if (failed()) return;
    if (!take('{')) return fail("expected an object");
    if (take('}')) return;
    do {
      std::size_t position = 0;
      const std::string_view key = string(position);
      if (!failed() && !take(':')) fail("expected ':'");
      if (failed()) return;
      f(key, position);
      if (failed()) return;
    } while (take(','));
    if (!take('}')) fail("expected ',' or '}'");
  }

  // For each element of an array, f(); f must read the element.
  template <class F>
  void array(F&& f) {
    if (failed()) return;
    if (!take('[')) return fail("expected an array");
    if (take(']')) return;
    do {
      f();
      if (failed()) return;
    } while (take(','));
    if (!take(']')) fail("expected ',' or ']'");
  }

 private:
  void skipSpaces() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\n' || text_[at_] == '\r' || text_[at_] == '\t'))
      ++at_;
  }
  std::string_view unescape(std::size_t begin);

  std::string_view text_;
  std::size_t at_ = 0;
  std::string error_, unescaped_;
};

}  // namespace weft::graph
