#include "engine/glsl/bounds.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/glsl/structure.h"
#include "engine/glsl/tokens.h"

namespace weft::glsl {

using base::Limit;

namespace {

constexpr double kUsualShare = 1.0 / 8;  // of a limit; docs/limits.md says what lies below it

std::uint64_t lowestOf(Limit limit) {
  return std::min(base::limitOf(limit), base::allLimits()[static_cast<std::size_t>(limit)].initial);
}

struct Bound {
  Limit limit;
  const ShaderCount* count;
  std::string message;
  const char* fix;
};

std::vector<Bound> boundsOf(const ShaderSize& size) {
  const ShaderCount &tokens = size.tokens, &inlined = size.inlined, &depth = size.depth, &cases = size.cases,
                    &array = size.array;
  std::vector<Bound> bounds;
  bounds.push_back({Limit::shader_tokens, &tokens,
                    tokens.name.empty() ? "the shader is too long"
                                        : fmt::format("the macro '{}' expands to too much", tokens.name),
                    "use functions and loops instead of macros that repeat"});
  // What a text has too much of, it has too much of in its functions as well.
  if (tokens.count <= base::limitOf(Limit::shader_tokens))
    bounds.push_back(
        {Limit::shader_tokens, &inlined,
         fmt::format("the function{} is too long once every call in it is replaced by what it calls",
                     inlined.name.empty() ? "" : " '" + inlined.name + "'"),
         "call functions in a loop instead of twice in each other"});
  bounds.push_back({Limit::shader_depth, &depth, "brackets, operators or blocks are nested too deeply",
                    "split it into several statements"});
  bounds.push_back(
      {Limit::shader_cases, &cases, "a switch has too many cases", "read a table in a buffer or a texture"});
  bounds.push_back(
      {Limit::shader_array, &array,
       array.name.empty() ? "an array is too large" : fmt::format("the array '{}' is too large", array.name),
       "put it into a buffer"});
  return bounds;
}

void reportBound(Limit limit, std::uint64_t count, const base::Place& place, const std::string& message,
                 const char* fix, base::Diagnostics& diagnostics) {
  const std::uint64_t most = base::limitOf(limit);
  base::Diagnostic& error = diagnostics.error(base::Code::shaderTooLarge, place, message);
  error.expected =
      fmt::format("at most {} {}", most, base::allLimits()[static_cast<std::size_t>(limit)].counts);
  const bool cut = limit == Limit::shader_tokens && count == most + 1;
  error.found = cut ? fmt::format("more than {}", most) : fmt::format("{}", count);
  error.hint = fmt::format("{}; or {}", fix, base::hintToRaise(limit));
}

}  // namespace

ShaderSize measureShader(const ShaderSource& source, std::span<const Define> defines) {
  ShaderSize size;
  size.bytes = source.text.size();
  if (size.bytes > base::limitOf(Limit::shader_bytes)) return size;
  // Structure is looked for in texts of allowed length only, but those of the next ones are measured too.
  const std::uint64_t most = base::limitOf(Limit::shader_tokens);
  const auto deepest =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(base::limitOf(Limit::shader_depth), 5000));
  const TokenList list = expandTokens(source.text, defines, most, deepest + 1);
  size.tokens.count = list.exceeded ? most + 1 : list.tokens.size();
  size.tokens.line = list.at.line;
  size.tokens.column = list.at.column;
  size.tokens.name = list.macro;
  size.uncertain = list.uncertain;
  measureStructure(list.tokens, size);
  if (list.nested > size.depth.count)
    size.depth = {
        .count = list.nested, .line = list.nestedAt.line, .column = list.nestedAt.column, .name = {}};
  return size;
}

void reportShaderBytes(std::uint64_t bytes, const base::Place& place, base::Diagnostics& diagnostics) {
  reportBound(Limit::shader_bytes, bytes, place, "the shader is too large",
              "include less, or move tables into buffers", diagnostics);
}

bool checkShaderSize(const ShaderSize& size, const ShaderSource& source, base::Diagnostics& diagnostics) {
  bool good = size.bytes <= base::limitOf(Limit::shader_bytes);
  if (!good) reportShaderBytes(size.bytes, {source.file, 0, 0}, diagnostics);
  for (const Bound& bound : boundsOf(size)) {
    if (bound.count->count <= base::limitOf(bound.limit)) continue;
    good = false;
    reportBound(bound.limit, bound.count->count,
                bound.count->line > 0 ? source.placeOf(bound.count->line, bound.count->column)
                                      : base::Place{source.file, 0, 0},
                bound.message, bound.fix, diagnostics);
  }
  return good;
}

ShaderShare largestShare(const ShaderSize& size) {
  const auto shareOf = [](Limit limit, std::uint64_t count) {
    return ShaderShare{limit, static_cast<double>(count) / static_cast<double>(lowestOf(limit))};
  };
  ShaderShare largest = shareOf(Limit::shader_bytes, size.bytes);
  for (const Bound& bound : boundsOf(size))
    if (const ShaderShare share = shareOf(bound.limit, bound.count->count); share.share > largest.share)
      largest = share;
  return largest;
}

// Many small switches or arrays cost what a large one does.
bool isUnusual(const ShaderSize& size) {
  return size.uncertain || size.allCases > lowestOf(Limit::shader_cases) ||
         size.allElements > lowestOf(Limit::shader_array) || largestShare(size).share > kUsualShare;
}

}  // namespace weft::glsl
