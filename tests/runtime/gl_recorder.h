// Records the GL calls of the frame loop, in their order, by putting functions of its own into glad's table of function
// pointers: beginnings and ends of debug groups (a step has one), barriers, and copies between textures; gl_replay.h judges them.
// One recorder at a time.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <string>
#include <vector>

namespace weft::runtime::test {

struct GlCall {
  enum class Kind : std::uint8_t { group, group_end, barrier, texture_barrier, copy };
  Kind kind = Kind::group;
  GLbitfield bits = 0;  // of a barrier
  std::string name{};   // of a group; of a copy: "glBlitNamedFramebuffer"
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
