#include "engine/glsl/bounds.h"

#include <fmt/format.h>

#include "engine/base/limits.h"

namespace weft::glsl {

namespace {

bool checkBound(std::uint64_t bound, const char* counts, std::uint64_t count, const base::Place& place,
                const std::string& message, const char* fix, base::Diagnostics& diagnostics) {
  const std::uint64_t most = base::raised(bound);
  if (count <= most) return true;
  base::Diagnostic& error = diagnostics.error(base::Code::shaderTooLarge, place, message);
  error.expected = fmt::format("at most {} {}", most, counts);
  const bool cut = bound == kMostShaderTokens;
  error.found = cut ? fmt::format("more than {}", most) : fmt::format("{}", count);
  error.hint = fix;
  if (const std::string raise = base::hintToRaise(bound); !raise.empty()) error.hint += "; or " + raise;
  return false;
}

}  // namespace

void reportShaderBytes(std::uint64_t bytes, const base::Place& place, base::Diagnostics& diagnostics) {
  checkBound(kMostShaderBytes, "bytes of one shader with what it includes", bytes, place,
             "the shader is too large", "include less, or move tables into buffers", diagnostics);
}

bool checkShaderSize(const ShaderSize& size, const ShaderSource& source, base::Diagnostics& diagnostics) {
  const auto placeOf = [&](const ShaderCount& count) { return source.placeOf(count.line, count.column); };
  const base::Place file{source.file, 0, 0};
  bool good = size.bytes <= base::raised(kMostShaderBytes);
  reportShaderBytes(size.bytes, file, diagnostics);
  good &= checkBound(
      kMostShaderTokens, "tokens of one shader after its macros", size.tokens.count, placeOf(size.tokens),
      size.tokens.name.empty() ? "the shader is too long"
                               : fmt::format("the macro '{}' expands to too much", size.tokens.name),
      "use functions and loops instead of macros that repeat", diagnostics);
  good &= checkBound(kMostShaderDepth, "brackets, operators or blocks around one another", size.depth.count,
                     placeOf(size.depth), "brackets, operators or blocks are nested too deeply",
                     "split it into several statements", diagnostics);
  return good;
}

bool isUnusual(const Interface& interface) {
  constexpr std::uint64_t kUsualTokens = 12'000, kUsualDepth = 60, kUsualCases = 50, kUsualElements = 128;
  const ShaderSize& size = interface.size;
  return interface.unsure || size.tokens.count > kUsualTokens || size.inlined > kUsualTokens ||
         size.depth.count > kUsualDepth || size.cases > kUsualCases || size.elements > kUsualElements;
}

}  // namespace weft::glsl
