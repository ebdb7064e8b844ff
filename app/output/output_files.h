// Files that commands write: names with frame numbers, their folders, and that none of them is a file that is read.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "engine/text/diagnostic.h"

namespace weft::app {

// "f_%04d.png" with the frame number; the name as it is when it has no pattern. Empty when the pattern is no
// such pattern.
std::optional<std::string> outputNameOf(const std::string& pattern, std::uint32_t frame);

// ".png" of "Out.PNG": the kind of picture that a name asks for, in lower case.
std::string pictureKindOf(const std::string& path);

// Whether pictures can be written under `pattern`, from number `first` on; makes the first one's folder. W180
// if not.
bool checkOutput(const std::string& pattern, std::uint32_t first, bool several,
                 text::Diagnostics& diagnostics);

// Makes the folder of a file. False after W180.
bool makeFolderOf(const std::string& path, text::Diagnostics& diagnostics);

// What one option has a run write: a file, or the frames of a pattern.
struct OutputFile {
  std::string option;   // "-o", for messages
  std::string pattern;  // empty: nothing
  std::uint32_t first = 0, last = 0;
};
// That no output is one of the files that the run reads, or another output, however it is spelled and whatever links lead to
// it. Devices and pipes may be anything. False after W180.
bool checkDistinct(std::span<const OutputFile> outputs, std::span<const std::string> inputs,
                   text::Diagnostics& diagnostics);

// Files whose names a command makes itself: each is nothing yet or a plain file, so that no pipe is waited for and no device
// written to. False after W180.
bool checkMadeFiles(std::span<const std::string> paths, text::Diagnostics& diagnostics);
// That there is no file of these names yet. False after W180.
bool checkFree(std::span<const std::string> paths, text::Diagnostics& diagnostics);

}  // namespace weft::app
