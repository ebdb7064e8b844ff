// Frames as a Chrome trace, which Perfetto (ui.perfetto.dev) and chrome://tracing open: a row for the CPU with frames and
// passes, a row for the GPU with passes, counters of time, passes and bytes. Written as frames come, so a long session
// takes no memory. Format: "Trace Event Format", JSON object form; times in microseconds from the first frame.
// Does not: measure (frame_profiler.h does).
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/runtime/frame_profiler.h"

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
  TraceFile(std::string path, std::FILE* file) : path_(std::move(path)), file_(file) {}
  void event(const std::string& text);

  std::string path_;
  std::FILE* file_ = nullptr;
  double origin_ = 0;  // ms
  std::uint64_t frames_ = 0;
  bool first_ = true, failed_ = false;
};

}  // namespace weft::runtime
