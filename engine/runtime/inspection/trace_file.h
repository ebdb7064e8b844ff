// Frames as a Chrome trace, which Perfetto (ui.perfetto.dev) and chrome://tracing open: a row for the CPU with frames and
// passes, a row for the GPU with passes, counters of time, passes and bytes. Written as frames come, so a long session
// takes no memory; into a file beside its name that close() renames, so there is never half of one. Format: "Trace Event Format", JSON object form; times in microseconds from the first frame.
// Does not: measure (frame_profiler.h does).
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/runtime/inspection/frame_profiler.h"

namespace weft::runtime {

class TraceFile {
 public:
  // Null after W180.
  static std::unique_ptr<TraceFile> create(const std::string& path, base::Diagnostics& diagnostics);
  ~TraceFile();  // closes
  TraceFile(const TraceFile&) = delete;
  TraceFile& operator=(const TraceFile&) = delete;

  void add(const FrameProfile& profile);
  // Ends the document. False after W180: not everything could be written.
  bool close(base::Diagnostics& diagnostics);

  const std::string& path() const { return path_; }
  std::uint64_t frames() const { return frames_; }

 private:
  TraceFile(std::string path, std::string target, std::string temporary, std::FILE* file)
      : path_(std::move(path)), target_(std::move(target)), temporary_(std::move(temporary)), file_(file) {}
  void put(const std::string& text);
  void event(const std::string& text);

  std::string path_;       // as it was named
  std::string target_;     // where that leads to, through links
  std::string temporary_;  // what is written; `target_` itself when that is a device or a pipe
  std::FILE* file_ = nullptr;
  double origin_ = 0;  // ms
  std::uint64_t frames_ = 0;
  bool first_ = true;
  int failure_ = 0;  // the reason of the first write that failed
};

}  // namespace weft::runtime
