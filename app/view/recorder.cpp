#include "app/view/recorder.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>

#include "app/output_files.h"

namespace weft::app {

bool Recorder::start(const std::string& pattern, base::Diagnostics& diagnostics) {
  pattern_ = pattern;
  std::error_code ignored;
  for (int i = 1; pattern_.empty(); ++i)
    if (const std::string folder = fmt::format("record_{}", i); !std::filesystem::exists(folder, ignored))
      pattern_ = folder + "/f_%05d.png";
  frames_ = 0;
  active_ = checkOutput(pattern_, 0, true, diagnostics);
  return active_;
}

void Recorder::stop() {
  if (!active_) return;
  active_ = false;
  fmt::print("wrote {} frames to {}\n", frames_, pattern_);
  std::fflush(stdout);
}

void Recorder::add(runtime::Renderer& renderer, base::Diagnostics& diagnostics) {
  if (!active_) return;
  if (savePresented(renderer, *outputNameOf(pattern_, frames_), diagnostics))
    ++frames_;
  else
    stop();
}

std::string screenshotName(std::uint32_t frame, const char* extension) {
  std::error_code ignored;
  std::string name = fmt::format("weft_{:05}{}", frame, extension);
  for (int i = 2; std::filesystem::exists(name, ignored); ++i)
    name = fmt::format("weft_{:05}_{}{}", frame, i, extension);
  return name;
}

}  // namespace weft::app
