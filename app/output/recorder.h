// A numbered sequence of presented pictures. One recording at a time; the first file that cannot be written
// ends it, with the reason, and nothing else. Does not: keep time (app/view/frame_clock.h does), or encode
// video.
#pragma once

#include <cstdint>
#include <string>

#include "app/output/picture_writer.h"
#include "engine/base/diagnostic.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"

namespace weft::app {

class Recorder {
 public:
  // Frames go to `pattern` ("out/f_%04d.png", or .exr), numbered from 0. An empty pattern makes a new folder,
  // record_N, here. False with W180 when the folder cannot be made or the pattern is none.
  bool start(const std::string& pattern, base::Diagnostics& diagnostics);
  // Says how many frames there are, on standard output, and what is wrong with them (W207).
  void stop(base::Diagnostics& diagnostics);
  bool active() const { return active_; }
  std::uint32_t frames() const { return frames_; }
  const std::string& pattern() const { return pattern_; }

  // The presented picture is the next frame. Stops after an error.
  void add(runtime::Renderer& renderer, base::Diagnostics& diagnostics);

 private:
  PictureWriter writer_;
  std::string pattern_;
  std::uint32_t frames_ = 0;
  bool active_ = false;
};

// A name for a picture of frame `frame` that no file here has yet: weft_00012.png, weft_00012_2.png.
std::string screenshotName(std::uint32_t frame, const char* extension);

}  // namespace weft::app
