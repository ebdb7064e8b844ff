#include "app/session/frame_limit.h"

#include <fmt/format.h>

#include "engine/base/limits.h"

namespace weft::app {

bool checkFrameCount(std::uint64_t count, const base::Where& place, const std::string& why,
                     base::Diagnostics& diagnostics, const std::string& instead) {
  const std::uint64_t limit = base::limitOf(base::Limit::frames);
  if (count <= limit) return true;
  diagnostics
      .error(base::Code::limitExceeded, place,
             fmt::format("{} frames would run{}, the limit 'frames' is {}", count, why, limit))
      .hint = base::hintToRaise(base::Limit::frames, count) + instead;
  return false;
}

}  // namespace weft::app
