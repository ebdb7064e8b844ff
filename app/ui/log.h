// What there is to say: about the files as they are, the environment last asked for, the last change made in the window, and
// what the driver or a frame said, once each. What was said can be dismissed; it comes back when it is said again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::app::ui {

class Log {
 public:
  enum Topic : std::size_t { kFiles, kEnvironment, kChange, kPast, kTopicCount };

  void set(Topic topic, std::vector<text::Diagnostic> items);
  void addPast(const text::Diagnostics& diagnostics);  // keeps the last hundred
  void dismiss();                                      // all there is now
  std::size_t errors() const;                          // that are not dismissed
  // What is not dismissed: errors, warnings, notes; within each the newest topic first, a topic's in their
  // order, the past backwards. Without `all`, only what stands on screen while the panels are hidden.
  std::vector<const text::Diagnostic*> shown(bool all) const;

 private:
  struct List {
    std::vector<text::Diagnostic> items;
    std::uint64_t said = 0;  // when, in calls
    bool dismissed = false;
  };
  std::array<List, kTopicCount> topics_;
  std::size_t dismissedPast_ = 0;
  std::uint64_t calls_ = 0;
};

}  // namespace weft::app::ui
