// Files that commands write: names with frame numbers, their folders, and that none of them is a file that is
// read. Does not: write them (app/output/picture_writer.h does), or decide which frames.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "engine/base/diagnostic.h"

namespace weft::app {

// "f_%04d.png" with the frame number; the name as it is when it has no pattern. Empty when the pattern is no
// such pattern.
std::optional<std::string> outputNameOf(const std::string& pattern, std::uint32_t frame);

// ".png" of "Out.PNG": the kind of picture that a name asks for, in lower case.
std::string pictureKindOf(const std::string& path);

// Whether pictures can be written under `pattern`, from number `first` on; makes the first one's folder. W180
// if not.
bool checkOutput(const std::string& pattern, std::uint32_t first, bool several,
                 base::Diagnostics& diagnostics);

// Makes the folder of one file. False after W180.
bool makeFolderOf(const std::string& path, base::Diagnostics& diagnostics);
// The folders of all frames, where the number is part of a folder's name.
bool makeFolders(const std::string& pattern, std::uint32_t first, std::uint32_t last,
                 base::Diagnostics& diagnostics);

// What one option has a run write: a file, or the frames of a pattern.
struct OutputFile {
  std::string option;   // "-o", as it stands in messages
  std::string pattern;  // empty: nothing
  std::uint32_t first = 0, last = 0;
};
// That no output is one of the files that the run reads, or another output, by whatever name or link. Only
// files count: devices and pipes are nobody's. False after W180.
bool checkDistinct(std::span<const OutputFile> outputs, std::span<const std::string> inputs,
                   base::Diagnostics& diagnostics);

// Files whose names a command makes itself, for the option `option`: each is nothing yet or a plain file, so that no pipe is
// waited for and no device written to, and none of the files that the run reads. False after W180.
bool checkMadeFiles(std::span<const std::string> paths, std::span<const std::string> inputs,
                    const std::string& option, base::Diagnostics& diagnostics);

}  // namespace weft::app
