// Files that commands write: names with frame numbers, their folders, and that none of them is a file that is read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::app {

// "f_%04d.png" with the frame number; a name without % as it is. Empty when that is no pattern.
std::optional<std::string> outputNameOf(const std::string& pattern, std::uint32_t frame);

// Whether pictures can be written under `pattern`, from number `first` on; makes their folder. W180 if not.
bool checkOutput(const std::string& pattern, std::uint32_t first, bool several,
                 text::Diagnostics& diagnostics);

// W180 at `path`. Returns false.
template <class... Args>
bool refuseOutput(text::Diagnostics& diagnostics, text::Saying<Args...> what, const std::string& path,
                  Args&&... args) {
  diagnostics.error<Args...>(what, {path}, std::forward<Args>(args)...);
  return false;
}
// The text of app/FILE of the data folder with words in it replaced. Nothing after W001: it is not there.
std::optional<std::string> filledIn(const std::string& file,
                                    const std::vector<std::pair<std::string_view, std::string>>& words,
                                    text::Diagnostics& diagnostics);
// Makes the folder of a file. False after W180.
bool makeFolderOf(const std::string& path, text::Diagnostics& diagnostics);

// What one option has a run write: a file, or the frames of a pattern.
struct OutputFile {
  // What may be there: anything; a plain file or nothing, for a name that the command makes up, so that no pipe is waited for, no
  // device written to, and no link followed that a stranger left; nothing.
  enum class Over { anything, file, nothing };

  std::string option;   // "-o", for messages
  std::string pattern;  // empty: nothing is written
  Over over = Over::anything;
  std::string inside{};  // a folder that the person named: no folder below it may be a link, either
};
// Checks that no output is one of the files that were read so far, of `inputs`, or another output, however it is spelled and
// whatever links lead to it; a pattern is that of every frame. False after W180.
bool checkDistinct(std::span<const OutputFile> outputs, text::Diagnostics& diagnostics,
                   std::span<const std::string> inputs = {});

}  // namespace weft::app
