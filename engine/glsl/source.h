// Makes the text that a driver takes of GLSL files: expands #include, keeps a table of lines, and finds the true file,
// line and column for a message in a driver's log (docs/shaders.md). Needs no context and makes no GL call. Lines are
// numbered through the expanded text, and the table knows their files; the file numbers of #line are not used, because
// drivers lose them (workarounds.md: source-numbers-lost). A file enters a stage once: a later #include of it is dropped,
// or guarded when the first is inside an #if. What the text declares is read when it is asked for (interface.h).
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/text/diagnostic.h"
#include "engine/text/files/file_cache.h"

namespace weft::glsl {

struct Conditions;
struct Interface;

struct Define {
  std::string name, value;
  friend bool operator==(const Define&, const Define&) = default;
};

// One stage's file with its includes expanded; immutable and shared between variants.
struct ShaderSource {
  struct Run {  // from `textLine` of the text on: `line`, `line` + 1, … of `file`
    std::uint32_t textLine = 1, file = 0, line = 1;
  };
  text::FileName file;  // the stage's own file, as opened
  std::string text;     // no #version, no defines, no #line
  std::vector<text::FileName> files;
  std::vector<Run> runs;   // by textLine
  std::uint64_t hash = 0;  // of text
  // What the text declares and uses with these defines, and in all branches of every #if at once; read when first asked for. The first
  // stays valid until another variant of the same text is asked for.
  const Interface& interfaceWith(std::span<const Define> defines) const;
  const Interface& ofAllBranches() const;
  const Conditions& conditions() const;  // of the text, read when first asked for
  // Where a line of the text (from 1) was written.
  text::Place placeOf(std::uint32_t textLine, std::uint32_t column = 0) const;
  text::Place placeOfMain() const;  // of the first line where there is none

 private:
  mutable std::map<std::string, std::shared_ptr<const Interface>> known_;  // by defines
  mutable std::shared_ptr<const Interface> allBranches_;
  mutable std::shared_ptr<const Conditions> conditions_;
};

// The GLSL files below folders, as paths relative to their folder, sorted, each once. Folders that may not be read are left
// out, and no more than 10,000 files and folders of each are looked at.
std::vector<std::string> shadersBelow(std::span<const std::string> folders);

// Reads, expands and caches. One per set of roots; not thread-safe.
class SourceLoader {
 public:
  // `roots` are searched in order for includes that are not found beside the including file; then, in order, the folders that
  // have in them the place of that file in its own root.
  explicit SourceLoader(std::vector<std::string> roots) : roots_(std::move(roots)) {}

  // The stage file `path`, below the first root that has it, else as the path says. "../" and absolute paths may lead
  // out of the roots (W200 where reading is confined: engine/text/files/file.h). `place` is that of the path in
  // the graph file, for the message when the file cannot be read (W100). Problems inside (W101 include not found,
  // W102 include cycle, W103 malformed include, W106 #version) are reported all at once and give null. A file is
  // expanded again only when the size or the time of a file that took part has changed.
  std::shared_ptr<const ShaderSource> load(const std::string& path, text::Diagnostics& diagnostics,
                                           const text::Place& place = {});
  // The same for text in memory, named `name` in messages; its includes are searched in the roots only.
  std::shared_ptr<const ShaderSource> loadText(std::string_view text, const std::string& name,
                                               text::Diagnostics& diagnostics);
  // Where load() would find `path`, or nullopt. `before` gets the places where it was looked for in vain.
  std::optional<std::string> locate(const std::string& path, std::set<std::string>* before = nullptr) const;
  // Forgets everything (files will be read again).
  void clear() { files_.clear(); }
  const std::vector<std::string>& roots() const { return roots_; }
  // Forgets everything when they are others: names may lead to other files.
  void setRoots(std::vector<std::string> roots) {
    if (roots == roots_) return;
    roots_ = std::move(roots);
    clear();
  }
  // The files to watch: every path that was read or looked for since forgetTouched(), whether or not it exists.
  const std::set<std::string>& touched() const { return files_.touched(); }
  void forgetTouched() { files_.forgetTouched(); }

 private:
  friend class IncludeExpander;
  std::shared_ptr<const ShaderSource> answer(const std::string& key);
  std::shared_ptr<const ShaderSource> expand(const std::string& key, const text::FileStamp& own,
                                             std::string_view text, text::Diagnostics& diagnostics);
  void reportMissing(const std::string& path, text::Diagnostics& diagnostics, const text::Place& place);

  std::vector<std::string> roots_;
  text::FileCache files_;
};

// "#version 450 core", the defines in the given order, then the source, whose first line the driver calls
// kTextLine. Lower numbers in a log are those of the version and the defines.
constexpr std::uint32_t kTextLine = 10001;
std::string assembleSource(const ShaderSource& source, std::span<const Define> defines);

// The text with the indices of what a work group shares kept within their arrays. Software drivers do so with all other arrays, but here
// they read and write whatever memory there is. Lines stay.
std::string clampShared(std::string_view text);

}  // namespace weft::glsl
