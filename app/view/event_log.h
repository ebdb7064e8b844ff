// What the viewer did, a line each on standard output, for scripts that drive it (`weft view --events`):
// "event 12 click 376 40", with the number of the frame that is drawn next. docs/viewer.md lists the words. A
// line is written when the thing is done, so a script waits for it instead of for a time. Does not: say what
// is wrong (diagnostics do).
#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <string_view>

#include "app/output/standard_streams.h"

namespace weft::app {

class EventLog {
 public:
  explicit EventLog(bool on) : on_(on) {}

  void say(std::uint32_t frame, std::string_view what) const {
    if (!on_) return;
    print(fmt::format("event {} {}\n", frame, what));
    flushPrinted();
  }

 private:
  bool on_;
};

}  // namespace weft::app
