// Records the GL calls of the frame loop, in their order, by putting functions of its own into glad's table of function
// pointers: beginnings and ends of debug groups (a step has one), barriers, copies between textures, and calls that set state. Does not: judge them
// (gl_replay.h), look into GL, or record draws. One recorder at a time.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <string>
#include <vector>

namespace weft::runtime::test {

struct GlCall {
  enum class Kind : std::uint8_t { group, group_end, barrier, texture_barrier, copy, state };
  Kind kind = Kind::state;
  GLbitfield bits = 0;  // of a barrier
  std::string name{};   // of a group; of a copy: "glBlitNamedFramebuffer"; of a state: "glBindSampler 3"
  std::string value{};  // that the state is set to
  bool bySideEffect = false;  // the call sets another state too, and that is this one
};

class GlRecorder {
 public:
  GlRecorder();   // every call goes through the recorder from here on
  ~GlRecorder();  // and to GL again
  GlRecorder(const GlRecorder&) = delete;
  GlRecorder& operator=(const GlRecorder&) = delete;

  void start();  // forgets everything
  const std::vector<GlCall>& calls() const;
};

}  // namespace weft::runtime::test
