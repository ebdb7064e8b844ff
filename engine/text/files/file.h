// Whole files, read and written with diagnostics instead of exceptions, and one rule for which files this process may open for
// reading, whatever names the file (a graph, an include, a shader, a scene, a library, an environment, a program binary).
//
// Only regular files are read: a pipe, a socket or a device would block for ever or never end. A path that the person gave on the
// command line may be a pipe, which is read once and kept, so that `weft render <(generate) …` works. Paths are free, as a
// compiler's are, until reading is confined to a folder (--confine). From then on only files that really lie in such a folder, or
// in an allowed one, with links followed, are read; no answer tells whether something exists outside. What the person named on the
// command line stays free. The file that was checked is the file that is opened: no other can take its place in between.
//
// All of this belongs to the process, as the command line does, and is safe from any thread. The shader compiler and libraries
// open their own files as they like.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <stop_token>
#include <string>

#include "engine/text/diagnostic.h"

namespace weft::text {

constexpr std::uint64_t kMaxTextBytes = 32ull << 20;

// The bytes of the file at `path`, or its unsaved text. On failure reports `code` at `place` (or at the file itself when
// `place` is empty); W200 when the path leads out of the folders that reading is confined to. Nothing, and no report, after a stop.
std::optional<std::string> readFile(const std::string& path, Diagnostics& diagnostics,
                                    Code code = Code::unreadableFile, const Place& place = {},
                                    const std::stop_token& stop = {});

// The same of at most `most` bytes; of a larger file `bytes` says how many it has, and nothing is reported.
std::optional<std::string> readWithin(const std::string& path, std::uint64_t most, std::uint64_t& bytes,
                                      Diagnostics& diagnostics, Code code, const Place& place,
                                      const std::stop_token& stop = {});
// The same of a JSON file or a .cube table. Code::limitExceeded for more than kMaxTextBytes, of which only the beginning is read.
std::optional<std::string> readTextFile(const std::string& path, Diagnostics& diagnostics,
                                        Code code = Code::unreadableFile, const Place& place = {});
// The same report for a text that is in memory already.
void reportTooLarge(const Place& place, std::uint64_t bytes, Diagnostics& diagnostics);

// Writes it as a PendingFile, so that a failure never leaves half a file. A file that exists keeps its permissions, a link still
// leads to it, and a device is written to directly. On failure reports Code::outputNotWritten and returns false.
bool writeFile(const std::string& path, std::span<const char> bytes, Diagnostics& diagnostics);

// The state of a file.
struct FileStamp {
  std::string path;
  std::int64_t time = -1;  // -1: not there; below: of an unsaved text
  std::uint64_t bytes = ~0ull;
  friend bool operator==(const FileStamp&, const FileStamp&) = default;
};
FileStamp stampOf(const std::string& path);

// A path that is written in a file, as seen from that file's folder. Absolute paths and "" stay as they are.
std::string besideFile(const Place& place, const std::string& path);

// A path from the root, without "." and "..", and without a slash at its end. Links are not followed.
std::string absolutePath(const std::string& path);

std::string lowerExtension(const std::string& path);  // ".png" of "a/b.PNG"; or ""

// Whether something has this path; whether that is a folder. No error is one of these.
bool isThere(const std::string& path);
bool isFolder(const std::string& path);

// The folder that holds graphs/, shaders/, scenes/ and materials/: $WEFT_DATA, else where Weft was built, else where it was
// installed. It need not be there.
std::string dataFolder();

// ---- which files may be read ----

// The person named this path on the command line: it is never outside, and may be a pipe. A folder named so is allowed.
void chooseFile(const std::string& path);

// Confines reading to `folder`, and to all other folders that were given to this function or to allowFolder().
// Returns what is wrong with the folder, as a sentence for the person who named it, or nothing.
std::optional<std::string> confineTo(const std::string& folder);
// Weft's own data, which may be read even when reading is confined. The folder need not exist yet. Does not confine.
void allowFolder(const std::string& folder);

// False when `path` leads out of the folders, whether or not a file is there. Opens nothing outside. To be called
// before a caller checks whether a file exists, or lists a folder; readFile() calls it by itself.
bool mayRead(const std::string& path);
// W200: `path`, as written, leads out of the folders.
void reportOutside(const std::string& path, Diagnostics& diagnostics, const Place& place);

// What has been opened so far, as absolute paths.
std::set<std::string> filesRead();

// Takes back all calls of the functions above. For tests.
void resetFileAccess();

// ---- texts that replace files ----

// What an editor has open and has not saved. It widens nothing that may be read. Paths are compared as absolute ones, without
// following links.
void overlayFile(const std::string& path, std::string text);
void dropOverlay(const std::string& path);

struct Overlay {
  std::shared_ptr<const std::string> text;
  std::uint64_t generation = 0;  // another one for every text
};
std::optional<Overlay> overlayOf(const std::string& path);

}  // namespace weft::text
