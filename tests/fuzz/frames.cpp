// Sets of frames, of few digits: a long set takes long.
#include <algorithm>

#include "app/output/frame_set.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  if (std::ranges::count_if(input, [](char c) { return c >= '0' && c <= '9'; }) > 6) return;
  std::vector<std::uint32_t> frames, again;
  if (!app::takeFrames(std::string(input), frames).empty()) return;
  expect(!frames.empty() && app::takeFrames(app::framesText(frames), again).empty() && again == frames,
         "a set that is printed as it is read");
}

}  // namespace weft::fuzz
