// Opens files in the person's text editor, a program that goes on beside the viewer.
#pragma once

#include <sys/types.h>

#include <string>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::app {

class Editor {
 public:
  // `command`: of a shell, with {file} and {line}, or a program that takes `+LINE FILE`. Empty: that of VISUAL, else of EDITOR.
  explicit Editor(std::string command);

  // Starts it at a line of a file. What was done, for a person.
  std::string open(const text::Place& place);
  // What there is to say of editors that ended since the last call, because they failed; else empty.
  std::string takeFailure();

 private:
  std::string command_;
  std::vector<pid_t> running_;
};

}  // namespace weft::app
