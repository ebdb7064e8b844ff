// Pictures into a film: ffmpeg, a program of its own, gets them one after another. The film is in its place when it is whole.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"
#include "engine/text/diagnostic.h"
#include "engine/text/files/pending_file.h"

namespace weft::app {

// Whether a name asks for one: .mp4 (H.264), .mkv (FFV1, which loses nothing).
bool isVideo(const std::string& path);

// False after W180, as all of these.
class Video {
 public:
  // Null after W180: no ffmpeg, an odd size of an .mp4, no place for the file.
  static std::unique_ptr<Video> start(const std::string& path, std::uint32_t width, std::uint32_t height,
                                      double fps, text::Diagnostics& diagnostics);
  ~Video();  // ends ffmpeg and removes the film, unless it is finished

  bool add(const assets::Image8& picture, text::Diagnostics& diagnostics);  // RGBA, of that size
  bool finish(text::Diagnostics& diagnostics);

 private:
  explicit Video(const std::string& path) : path_(path), file_(path, false) {}
  bool run(std::vector<std::string> command, text::Diagnostics& diagnostics);
  bool refuse(const std::string& why, const std::string& hint, text::Diagnostics& diagnostics) const;
  bool end(bool early, text::Diagnostics& diagnostics);

  std::string path_;
  text::PendingFile file_;
  pid_t process_ = -1;
  int pipe_ = -1;    // to it
  int errors_ = -1;  // a file in memory with what it says
};

}  // namespace weft::app
