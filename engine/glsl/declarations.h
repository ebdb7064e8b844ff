// Elements of the variables that a shader declares outside its blocks, and constants that name their sizes. A
// part of shader_bounds, not for others.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/glsl/bounds.h"
#include "engine/glsl/tokens.h"

namespace weft::glsl {

// Writes ShaderSize::array, and `uncertain` where the size of an array is no constant that is understood.
class DeclarationCount {
 public:
  explicit DeclarationCount(ShaderSize& size) : size_(size) {}
  // What stands before a '{' at file level: a struct's members are counted where it is used, a block's are
  // not.
  void openBody(std::span<const Token> before);
  void closeBody();
  // A statement without its ';': a declaration, or something else that is passed over.
  void add(std::span<const Token> statement);
  // An array's elements, written one by one.
  void noteTable(std::uint64_t elements, const Token& at) { note(elements, at, {}); }

 private:
  std::optional<std::int64_t> valueOf(std::span<const Token> tokens) const;
  // "[4][n]" from `at` on: the product; behind them, `at` is moved. Nothing when a size is not known.
  std::optional<std::uint64_t> dimensions(std::span<const Token> tokens, std::size_t& at) const;
  void note(std::uint64_t elements, const Token& at, std::string_view name);
  void take(std::uint64_t elements, const Token& name);

  ShaderSize& size_;
  std::unordered_map<std::string_view, std::uint64_t> structs_;  // elements of one
  std::unordered_map<std::string_view, std::int64_t> constants_;
  enum class Body : std::uint8_t { none, block, members } body_ = Body::none;
  std::string_view struct_;  // whose body is read, or whose body was the last
};

}  // namespace weft::glsl
