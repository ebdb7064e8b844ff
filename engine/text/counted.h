// Numbers of things in messages: "1 pass", "2 passes". Does not: know words whose plural is of another kind.
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

namespace weft::text {

// `noun` in the singular: "case", "pass", "order".
inline std::string counted(std::uint64_t count, std::string_view noun) {
  const bool hisses =
      noun.ends_with('s') || noun.ends_with('x') || noun.ends_with("ch") || noun.ends_with("sh");
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : hisses ? "es" : "s");
}

}  // namespace weft::text
