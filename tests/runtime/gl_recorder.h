// Records the GL calls of the frame loop by putting functions of its own into glad's table of function pointers:
// glMemoryBarrier with its bits, and state calls that set what is current already. What is current is followed from the
// calls alone; unknown at start(). Does not: look into GL, or record draws. One recorder at a time.
#pragma once

#include <glad/gl.h>

#include <string>
#include <vector>

namespace weft::runtime::test {

class GlRecorder {
 public:
  GlRecorder();   // every call goes through the recorder from here on
  ~GlRecorder();  // and to GL again
  GlRecorder(const GlRecorder&) = delete;
  GlRecorder& operator=(const GlRecorder&) = delete;

  void start();  // forgets everything
  const std::vector<GLbitfield>& barriers() const;
  // "glUseProgram 7" for each call that changed nothing.
  const std::vector<std::string>& redundant() const;
  std::size_t stateCalls() const;
};

}  // namespace weft::runtime::test
