// Sets of frames.
#include "app/output/frame_set.h"
#include "tests/fuzz/fuzz.h"

namespace weft::fuzz {

void fuzz(std::string_view input) {
  std::vector<std::uint32_t> frames, again;
  if (!app::takeFrames(std::string(input), frames).empty()) return;
  expect(!frames.empty() && app::takeFrames(app::framesText(frames), again).empty() && again == frames,
         "a set that is printed as it is read");
}

}  // namespace weft::fuzz
