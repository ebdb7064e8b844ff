// KHR_debug: the driver's messages as diagnostics (W120), debug groups and object labels. A message that
// repeats is kept once with a count. Groups name the pass in which a message was raised, and show in apitrace
// and RenderDoc.
#pragma once

#include <glad/gl.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::gl {

// Messages of one context. The driver says them on the thread of the call that they are about.
class DebugLog {
 public:
  DebugLog() = default;
  DebugLog(const DebugLog&) = delete;
  DebugLog& operator=(const DebugLog&) = delete;

  // Registers with the current context, which must not outlive this log; synchronous. Notifications are filtered out, and
  // so are the shader compiler's errors, which Program reports with true places.
  void install();
  // What the callback does; public for tests.
  void record(GLenum type, GLenum severity, std::string_view text);

  // Adds a W120 for each message that is new since the last drain: an error for high severity or type error, else a warning.
  // The text says how often the message was seen ("seen 12 times").
  void drain(text::Diagnostics& diagnostics);
  void clear();

 private:
  friend class DebugGroup;
  struct Message {
    GLenum type = 0, severity = 0;  // GL_DEBUG_*
    std::string text;
    std::string group;  // innermost debug group when it was first raised (the pass), or empty
    std::uint64_t count = 1;
  };
  std::vector<Message> messages_;
  std::size_t drained_ = 0;
  std::vector<std::string_view> groups_;
};

// A debug group for the lifetime of the object. `name` must outlive it. Groups nest in order of construction.
class DebugGroup {
 public:
  DebugGroup(DebugLog& log, std::string_view name);
  ~DebugGroup();
  DebugGroup(const DebugGroup&) = delete;
  DebugGroup& operator=(const DebugGroup&) = delete;

 private:
  DebugLog& log_;
};

// glObjectLabel, cut to the driver's greatest length. `identifier` is GL_TEXTURE, GL_BUFFER, …; the object
// must exist (bound once, or made by glCreate*).
void labelObject(GLenum identifier, GLuint id, std::string_view label);

// What glGetIntegerv says of a name with one value.
GLint integerOf(GLenum name);

// "GL_INVALID_OPERATION", "GL_RGBA16F", …: the enums this room meets; "0x1234" for others.
std::string enumName(GLenum value);

// Reads and clears glGetError; the names of all flags, joined by ", ", or "".
std::string takeErrors();

}  // namespace weft::gl
