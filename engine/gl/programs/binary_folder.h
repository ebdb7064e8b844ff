// The folder of program binaries, kept below a size: what was not used for longest goes first. Several processes may
// write, use and remove at once. Only files with a name of 32 hex digits and ".bin" are ever removed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace weft::gl {

constexpr std::size_t kBinaryKeyLength = 32;

struct BinaryFolderUse {
  std::uint64_t bytes = 0;    // of the binaries that are there
  std::uint64_t removed = 0;  // files
};

// Above `most` bytes, removes binaries until an eighth of it is free.
BinaryFolderUse pruneBinaries(const std::string& folder, std::uint64_t most);

}  // namespace weft::gl
