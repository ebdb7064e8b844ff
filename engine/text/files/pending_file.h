// A file that is written beside its place, under a name that says so (".f_0001.png.part"), and is put there when it is whole.
// Processes that write one file do so one after another. What a process that was killed has left is removed by the next one
// that writes the file.
#pragma once

#include <span>
#include <string>

namespace weft::text {

class PendingFile {
 public:
  // Behind a link stands the file that is meant. A device or a pipe is written itself. `wait`: for another process that writes the
  // same file; else the error is EWOULDBLOCK.
  explicit PendingFile(const std::string& path, bool wait = true);
  ~PendingFile();  // removes it, unless it was put in place
  PendingFile(const PendingFile&) = delete;
  PendingFile& operator=(const PendingFile&) = delete;

  const std::string& name() const { return name_; }  // where the bytes are until then
  int error() const { return error_; }               // an errno; 0: none so far
  // Each does nothing and is false after an error.
  bool write(std::span<const char> bytes);
  bool putInPlace();

 private:
  void open(bool wait);

  std::string target_, name_;
  bool special_ = false;  // a device or a pipe
  unsigned mode_ = 0;     // of the file that is replaced
  int descriptor_ = -1;   // open, and locked, until the file is in place
  int error_ = 0;
};

}  // namespace weft::text
