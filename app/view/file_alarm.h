// Wakes the loop that sleeps in GLFW when a descriptor becomes readable, from a thread that does nothing else: GLFW waits for its
// own events only. It does not read the descriptor; until somebody does, it rings now and then.
#pragma once

#include <functional>
#include <thread>

namespace weft::app {

class FileAlarm {
 public:
  // `ring` is called on the thread. -1: no descriptor.
  FileAlarm(int descriptor, std::function<void()> ring);
  ~FileAlarm();
  FileAlarm(const FileAlarm&) = delete;
  FileAlarm& operator=(const FileAlarm&) = delete;

 private:
  int stop_ = -1;
  std::thread thread_;
};

}  // namespace weft::app
