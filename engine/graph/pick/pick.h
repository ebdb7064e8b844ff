// What a person names to look at in a graph that runs: `hdr`, `hdr#1`, `glow.mip[2]`, `sky.face[4]`, `depth.stencil`, `adapted@-1`,
// `hdr after bloom`. Does not: know what there is (find_pick.h does).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace weft::graph {

struct Pick {
  std::string text;           // as written
  std::string name;           // of a resource, or any unique suffix: "hdr", "maps[2]"
  std::uint32_t version = 0;  // k of #k, from 1; 0: the last
  std::uint32_t mip = 0;
  std::uint32_t layer = 0;    // array layer, cube * 6 + face, or slice of a 3D texture
  std::uint32_t history = 0;  // n of @-n
  bool stencil = false;
  std::string pass;      // after which to look, or any unique suffix; "": the last that writes it
  std::string option{};  // that names it, for messages: "-o"
  friend bool operator==(const Pick&, const Pick&) = default;
};

// name ["#" k] { ".mip[" i "]" | ".layer[" i "]" | ".face[" i "]" | ".stencil" } ["@-" n] [" after " pass]. Nothing when `text` is
// spelled in another way.
std::optional<Pick> parsePick(std::string_view text);

// Whether `text` matches `pattern`, in which * stands for any letters and ? for one.
bool matchesPattern(std::string_view pattern, std::string_view text);

}  // namespace weft::graph
