// Wakes the loop that sleeps in GLFW when a descriptor becomes readable, or when a look at what no descriptor
// tells of finds something, from a thread that does nothing else: GLFW waits for its own events only. Does
// not: read the descriptor; until somebody does, it rings now and then.
#pragma once

#include <functional>
#include <thread>

namespace weft::app {

class FileAlarm {
 public:
  // `ring` and `look` are called on the thread, `look` about twice a second; it returns whether to ring. -1:
  // no descriptor.
  FileAlarm(int descriptor, std::function<bool()> look, std::function<void()> ring);
  ~FileAlarm();
  FileAlarm(const FileAlarm&) = delete;
  FileAlarm& operator=(const FileAlarm&) = delete;

 private:
  int stop_ = -1;
  std::thread thread_;
};

}  // namespace weft::app
