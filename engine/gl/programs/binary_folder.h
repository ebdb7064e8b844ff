// The folder of program binaries, kept below a size: what was not used for longest goes first. Several
// processes may write, use and remove at once. Only files that Weft wrote are ever removed: they have a name
// of 32 hex digits and
// ".bin", and begin with kBinaryMagic. Does not: know what stands behind the magic (program_cache.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace weft::gl {

constexpr std::string_view kBinaryMagic = "WEFTBIN1";
constexpr std::size_t kBinaryKeyLength = 32;

struct BinaryFolderUse {
  std::uint64_t bytes = 0;    // of the binaries that are there
  std::uint64_t removed = 0;  // files
};

// Above `most` bytes, removes binaries until an eighth of it is free.
BinaryFolderUse pruneBinaries(const std::string& folder, std::uint64_t most);

// Says that a binary was used now.
void touchBinary(const std::string& path);

}  // namespace weft::gl
