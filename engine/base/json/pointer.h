// Where a value stands in its JSON document, as RFC 6901 writes it: "/passes/3/read/source". A large document has
// a pointer for each of its values, so a pointer is a number and the pointer of the container, which all values in
// that container share. The text is put together when it is asked for. Does not: find the value again (edit.h).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft::base {

class JsonPointer {
 public:
  // An object or an array: its place in its own container, and the keys of an object in the order of the
  // text.
  class Container;

  JsonPointer() = default;
  // The pointer of the document.
  static JsonPointer root() { return {}; }
  // The pointer of an item of an array, or of a member of an object.
  JsonPointer(std::shared_ptr<const Container> container, std::uint32_t index)
      : container_(std::move(container)), index_(index) {}

  // "" for the document. A text of more than a few thousand bytes is cut and ends in "…"; no value is found by it.
  std::string text() const;
  operator std::string() const { return text(); }
  bool empty() const { return !container_; }
  friend bool operator==(const JsonPointer& a, std::string_view b) { return a.text() == b; }

 private:
  std::shared_ptr<const Container> container_;
  std::uint32_t index_ = 0;
};

class JsonPointer::Container {
 public:
  explicit Container(JsonPointer place, bool object) : place_(std::move(place)), object_(object) {}
  // The index of the next item, or of the next member.
  std::uint32_t add() { return count_++; }
  std::uint32_t add(std::string_view key);

 private:
  friend class JsonPointer;
  JsonPointer place_;
  bool object_ = false;
  std::uint32_t count_ = 0;
  std::string keys_;                 // one after another
  std::vector<std::uint32_t> ends_;  // of each in keys_
};

}  // namespace weft::base
