// What there is to say: about the files as they are, the environment last asked for, the last change made in the window, and
// what the driver or a frame said, once each. What was said can be dismissed; it comes back when it is said again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::app::ui {

class Log {
 public:
  enum Topic : std::uint8_t { kFiles, kEnvironment, kChange, kPast };

  void set(Topic topic, std::vector<text::Diagnostic> items);
  void addPast(const text::Diagnostics& diagnostics);  // keeps the last hundred
  void dismiss() {                                     // all there is now
    for (Entry& entry : entries_) entry.dismissed = true;
  }
  std::size_t errors() const;  // that are not dismissed
  // What is not dismissed: errors, warnings, notes; within each the newest first, what was set together in its order. Without `all`, only
  // what stands on screen while the panels are hidden.
  std::vector<const text::Diagnostic*> shown(bool all) const;

 private:
  struct Entry {
    Topic topic;
    std::uint64_t said;  // when, in calls
    text::Diagnostic item;
    bool dismissed = false;
  };
  std::vector<Entry> entries_;
  std::uint64_t calls_ = 0;
};

}  // namespace weft::app::ui
