#include "app/session/frame_limit.h"

#include <fmt/format.h>

#include "engine/base/limits.h"

namespace weft::app {

bool checkFrameCount(std::uint64_t count, const base::Where& place, const std::string& why,
                     base::Diagnostics& diagnostics, const std::string& instead) {
  constexpr std::uint64_t kMostFrames = 1'000'000;
  const std::uint64_t most = base::raised(kMostFrames);
  if (count <= most) return true;
  auto& d = diagnostics.error(base::Code::limitExceeded, place,
                              fmt::format("{} frames would run{}, and at most {} may", count, why, most));
  d.hint = base::hintToRaise(kMostFrames, count);
  if (d.hint.empty() || !instead.empty()) d.hint = instead.empty() ? "let fewer run" : instead;
  return false;
}

}  // namespace weft::app
