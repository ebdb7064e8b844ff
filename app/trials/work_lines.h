// How far a command is that renders the same graph again and again: a bar on a terminal, elsewhere a line every ten seconds, on
// standard error. Nothing where it is quick. Does not: know what is rendered.
#pragma once

#include <chrono>

#include "app/output/progress.h"
#include "app/output/standard_streams.h"

namespace weft::app {

class WorkLines {
 public:
  // `unit`: "runs".
  WorkLines(std::uint64_t total, const char* unit) : progress_{.total = total, .unit = unit} {}

  void countOne() {
    ++progress_.done;
    progress_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const bool last = progress_.done == progress_.total;
    if (last && !shown_) return;
    const std::string text = lines_.after(progress_);
    shown_ = shown_ || !text.empty();
    if (!text.empty()) printError(text);
  }

 private:
  Progress progress_;
  ProgressLines lines_{isTerminal()};
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  bool shown_ = false;
};

}  // namespace weft::app
