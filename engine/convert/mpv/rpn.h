// Expressions of mpv's //!WIDTH, //!HEIGHT and //!WHEN, in reverse Polish, as expressions of Weft:
// "MAIN.w 2 *" becomes "(size(main).x * 2)". What is wrong is W225. Does not: evaluate.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "engine/convert/mpv/blocks.h"

namespace weft::convert {

// `sideOf` gives what stands for a side of a texture ("MAIN", true: its width) or for a parameter ("gain", "" when
// there is none).
struct RpnNames {
  std::function<std::string(std::string_view name, bool width)> sideOf;
  std::function<std::string(std::string_view name)> parameterOf;
};
std::optional<std::string> convertRpn(const MpvText& expression, const RpnNames& names,
                                      base::Diagnostics& diagnostics);

}  // namespace weft::convert
