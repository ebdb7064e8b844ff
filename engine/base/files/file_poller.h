// Says which files changed by looking at them: time of change, size and identity. For those that the system
// does not tell of (engine/base/files/file_watcher.h). Looking may take as long as a network takes, so it is done
// on a thread that has nothing else to do; asking never blocks on a file. Safe from two threads. Does not:
// start a thread, or know when to look.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

namespace weft::base {

class FilePoller {
 public:
  // Replaces the set; files that stay keep what is known of them. New ones are as they are now.
  void watch(const std::vector<std::string>& files);
  bool empty() const;

  // Looks at every file. True when some changed since it was looked at last; a file that is empty now counts
  // at the second look, because it may be about to be written.
  bool look();
  // The names of the files that changed, each once, sorted; since this was asked last.
  std::set<std::string> take();

 private:
  struct Stamp {
    std::uint64_t device = 0, file = 0, bytes = 0;
    std::int64_t seconds = -1, nanoseconds = 0;  // -1: there is none
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct Known {
    Stamp stamp;
    bool emptied = false;  // at the last look
  };
  static Stamp stampOf(const std::string& file);

  mutable std::mutex mutex_;
  std::map<std::string, Known> files_;
  std::set<std::string> changed_;
};

}  // namespace weft::base
