#include "app/output/frame_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "engine/text/chars.h"

namespace weft::app {

std::string takeFrames(const std::string& text, std::vector<std::uint32_t>& frames) {
  constexpr std::uint64_t kMost = 1u << 24;
  const auto numberIn = [](std::string_view digits) { return text::numberIn<std::uint32_t>(digits); };
  frames.clear();
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const std::string_view part = std::string_view(text).substr(at, end - at);
    const std::size_t dash = part.find_first_of("-:"), by = dash < part.size() ? part.find('x') : dash;
    const auto first = numberIn(part.substr(0, dash));
    const auto last = dash < part.size() ? numberIn(part.substr(dash + 1, by - dash - 1)) : first;
    const auto step = by < part.size() ? numberIn(part.substr(by + 1)) : 1;
    if (!first || !last || !step || *step == 0 || *first > *last)
      return fmt::format(
          "expected FRAME, FIRST-LAST or FIRST-LASTxSTEP, with commas between, such as 1-100x3,200: whole "
          "numbers to {}, no FIRST above its LAST, found '{}'",
          ~0u, part);
    const std::uint64_t count = std::uint64_t{(*last - *first) / *step} + 1;
    if (frames.size() + count > kMost)
      return fmt::format("expected at most {} frames in one run, found {} in '{}'", kMost, count, part);
    for (std::uint64_t i = 0; i < count; ++i)
      frames.push_back(*first + static_cast<std::uint32_t>(i) * *step);
    at = end + 1;
  }
  std::ranges::sort(frames);
  const auto twice = std::ranges::unique(frames);
  frames.erase(twice.begin(), twice.end());
  return {};
}

std::string framesText(std::span<const std::uint32_t> frames) {
  std::string out;
  for (std::size_t at = 0, end = 0; at < frames.size(); at = end) {
    end = at + 1;
    const std::uint32_t step = end < frames.size() ? frames[end] - frames[at] : 1;
    while (end < frames.size() && frames[end] - frames[end - 1] == step) ++end;
    if (end == at + 2 && step > 1) --end;
    if (!out.empty()) out += ',';
    out += std::to_string(frames[at]);
    if (end > at + 1) out += fmt::format("-{}", frames[end - 1]);
    if (end > at + 1 && step > 1) out += fmt::format("x{}", step);
  }
  return out;
}

}  // namespace weft::app
