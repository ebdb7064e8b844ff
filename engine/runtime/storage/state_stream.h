// The state of a run as bytes. One function of each class carries its members, in one order, to the bytes or back from them.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace weft::runtime {

class StateStream {
 public:
  StateStream() = default;  // writes
  explicit StateStream(std::string_view bytes)
      : loading_(true), rest_(bytes) {}  // reads; `bytes` must outlive this

  bool loading() const { return loading_; }
  // False once bytes were missing or a value could not be: the state is half read then, and no value may be used.
  bool good() const { return good_; }
  void require(bool right) { good_ = good_ && right; }
  bool atEnd() const { return rest_.empty(); }

  template <class Number>
  void carry(Number& value) {
    static_assert(std::is_arithmetic_v<Number> && !std::is_same_v<Number, bool>);
    if (!loading_) return put(std::as_bytes(std::span(&value, 1)));
    if (const auto bytes = take(sizeof value); good_) std::memcpy(&value, bytes.data(), sizeof value);
  }
  void carry(bool& value) {
    unsigned char byte = value ? 1 : 0;
    carry(byte);
    require(byte <= 1);
    value = byte == 1;
  }
  // A number that says something only together with what the process knows: `here` is taken from it in the bytes.
  template <class Number>
  void carryFrom(Number here, Number& value) {
    Number there = value - here;
    carry(there);
    value = there + here;
  }

  void put(std::span<const std::byte> bytes) {
    bytes_.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  }
  // The next bytes; none of them, and not good(), when there are fewer.
  std::span<const std::byte> take(std::size_t count) {
    require(count <= rest_.size());
    if (!good_) return {};
    const auto taken = std::as_bytes(std::span(rest_.data(), count));
    rest_.remove_prefix(count);
    return taken;
  }
  std::string bytes() && { return std::move(bytes_); }

 private:
  bool loading_ = false, good_ = true;
  std::string bytes_;
  std::string_view rest_;
};

}  // namespace weft::runtime
