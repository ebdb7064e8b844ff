// What GL calls read and write, and whether a barrier is missing between them, by the rules of OpenGL 4.5 core, 7.12.2. Knows no plan: a draw or
// dispatch touches what is bound to what its program declares, as introspection has it, and every other call what it names.
//  (a) What a shader stored into an image or a block must be made visible to each later use, by the bit of that use.
//  (b) A store waits for every earlier access to the same memory, by SHADER_IMAGE_ACCESS or SHADER_STORAGE.
// Calls of one debug group (a pass) are one. The specification names no bit for glCopyImageSubData and glGenerateTextureMipmap: they need those of all
// ways in which a driver may do them. Does not: look at coherence inside a pass, or at what the CPU writes through maps. One at a time.
#pragma once

#include <glad/gl.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace weft::runtime::test {

// Levels and layers of a texture, or bytes of a buffer. A number stands for one object, also when GL uses its name again.
struct GlSpan {
  std::uint64_t object = 0;
  std::int64_t begin = 0, end = 0;  // levels, bytes
  std::int64_t layer = 0, layers = 1;
  friend auto operator<=>(const GlSpan&, const GlSpan&) = default;
};

struct GlEvent {
  enum class Kind : std::uint8_t { touch, barrier, frame };
  Kind kind = Kind::touch;
  GLbitfield bits = 0;     // of a barrier; of a touch: those that it needs after a store
  bool store = false;      // by a shader; `bits` is the one bit that it waits for
  std::uint32_t pass = 0;  // number of the debug group, into names()
  GlSpan span{};
};

// Notes events from its construction on. GL must be loaded; objects that are older are seen whole.
class GlTrace {
 public:
  GlTrace();
  ~GlTrace();
  GlTrace(const GlTrace&) = delete;
  GlTrace& operator=(const GlTrace&) = delete;

  void beginFrame();
  const std::vector<GlEvent>& events() const;
  const std::vector<std::string>& passes() const;  // the names of debug groups, by GlEvent::pass
  std::string nameOf(const GlSpan& span) const;
};

// A bit that is left out when events are judged: of the barrier of that number in each frame, counted from 0; before the first frame, from
// kBeforeFrames.
constexpr std::size_t kBeforeFrames = 1'000'000;
struct LeftOut {
  std::size_t barrier = ~std::size_t{0};
  GLbitfield bit = 0;
};
// The first use that lacks a barrier, in words, or "".
std::string findHazard(const GlTrace& trace, const LeftOut& leftOut = {});

}  // namespace weft::runtime::test
