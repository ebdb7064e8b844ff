// Which files this process may open for reading: one rule, whatever names the file (a graph, an include, an
// overlay, a shader, a #include, a table, a scene, a library, a preset, an environment, a program binary).
//
// Only regular files are read. A pipe, a socket or a device would block for ever or never end. The one exception
// is a path that the person gave on the command line: it may be a pipe, the first time it is opened, so that
// `weft render <(generate) …` works. A second opening (a reload of the viewer) is refused. The exception belongs to
// the process, as the command line does; so it is kept here, and not in every function that reads.
//
// Paths are free, as a compiler's are, until reading is confined to a folder (--confine). From then on only files
// that really lie in such a folder, or in an allowed one, with links followed, are read; no answer tells whether something exists
// outside. What the person named on the command line stays free.
//
// The file that was checked is the file that is opened: no other can take its place in between.
// Safe from any thread. The shader compiler and libraries open their own files as they like.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "engine/text/diagnostic.h"

namespace weft::text {

// The person named this path on the command line: it is never outside, and may be a pipe once. A folder that is
// named so is an allowed one. A path that is named twice may be a pipe twice.
void chooseFile(const std::string& path);

// Confines reading to `folder`, and to all other folders that were given to this function or to allowFolder().
// Returns what is wrong with the folder, as a sentence for the person who named it, or nothing.
std::optional<std::string> confineTo(const std::string& folder);
// Weft's own data, which may be read even when reading is confined. The folder need not exist yet. Does not confine.
void allowFolder(const std::string& folder);

// Whether `path` lies in an allowed folder and was not named by the person. Limits of size are for the other files.
bool isOwnData(const std::string& path);

// False when `path` leads out of the folders, whether or not a file is there. Opens nothing outside. To be called
// before a caller checks whether a file exists, or lists a folder; readFile() calls it by itself.
bool mayRead(const std::string& path);
// W200: `path`, as written, leads out of the folders.
void reportOutside(const std::string& path, Diagnostics& diagnostics, const Place& place);

// Takes back all calls of the functions above. For tests.
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

}  // namespace weft::text
