#include "app/output/recorder.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "engine/base/counted.h"
#include "engine/base/printable.h"

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

void Recorder::stop(base::Diagnostics& diagnostics) {
  if (!active_) return;
  active_ = false;
  print(fmt::format("wrote {} to {}\n", base::counted(frames_, "frame"), base::printable(pattern_)));
  flushPrinted();
  writer_.tell(diagnostics);
}

void Recorder::add(runtime::Renderer& renderer, base::Diagnostics& diagnostics) {
  if (!active_) return;
  const std::string path = *outputNameOf(pattern_, frames_);
  if (makeFolderOf(path, diagnostics) && writer_.save(renderer, path, diagnostics))
    ++frames_;
  else
    stop(diagnostics);
}

std::string screenshotName(std::uint32_t frame, const char* extension) {
  std::error_code ignored;
  std::string name = fmt::format("weft_{:05}{}", frame, extension);
  for (int i = 2; std::filesystem::exists(name, ignored); ++i)
    name = fmt::format("weft_{:05}_{}{}", frame, i, extension);
  return name;
}

}  // namespace weft::app
