// Which files this process may open for reading: one rule, whatever names the file (a graph, an include, an
// overlay, a shader, a #include, a table, a scene, a library, a preset, an environment, a program binary).
//
// Only regular files are read. A pipe, a socket or a device would block for ever or never end. The one exception
// is a path that the person gave on the command line: it may be a pipe, the first time it is opened, so that
// `weft render <(generate) …` works. Whoever opens it again (a reload of the viewer) gets the refusal. The
// exception is a matter of the process, as the command line is; so it stands here, not in every function that reads.
//
// Paths are free, as a compiler's are, until a folder is confined (--confine). Then only what really lies in
// such a folder or in an allowed one is looked at. Every step of a path is judged, with links followed, before
// it is looked at: whether something exists outside can not be told from an answer. What the person named on the
// command line is free.
//
// There is no moment between the judgement and the opening: what was judged is what is opened.
// Safe from any thread. Does not: restrict writing, or stop the shader compiler and libraries from opening
// their own files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/base/diagnostic.h"

namespace weft::base {

// The person named this path on the command line: it is never outside, and may be a pipe once. A folder that
// is named is an allowed one. Called twice for one path, it may be a pipe twice.
void chooseFile(const std::string& path);

// Confines reading to `folder` and those confined or allowed besides. Returns what is wrong with it, as a
// sentence for the person who named it, or nothing.
std::optional<std::string> confineTo(const std::string& folder);
// May be read even then: Weft's own data. It need not exist yet. Confines nothing.
void allowFolder(const std::string& folder);

// In an allowed folder, and not what the person named: limits of what is read are for the files of others.
bool isOwnData(const std::string& path);

// False when `path` leads out of the folders, whether or not something is there. Looks at no step outside.
// For whoever is to look whether a file exists, or to list a folder; readFile() asks by itself.
bool mayRead(const std::string& path);
// W200: `path`, as written, leads out of the folders.
void reportOutside(const std::string& path, Diagnostics& diagnostics, const Place& place);

// Everything as before the first call of the above. For tests.
void resetFileAccess();

struct OpenedFile {
  enum class State : std::uint8_t {
    open,
    outside,
    missing,
    directory,
    device,
    pipe,
    pipe_again,
    socket,
    unreadable
  };
  State state = State::unreadable;
  int descriptor = -1;      // the caller's to close, when open; does not block
  bool endless = false;     // a pipe, whose end is known when it comes
  std::uint64_t bytes = 0;  // of a regular file
  int error = 0;            // errno, when unreadable
};
OpenedFile openFile(const std::string& path);

}  // namespace weft::base
