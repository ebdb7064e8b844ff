// What stb calls to compress a PNG, in place of its own compressor: zlib, at its fastest level.
#pragma once

namespace weft::assets {

// A zlib stream of `size` bytes, allocated by malloc, its length in `packed`; null when memory is short. stb's `quality` is
// not looked at.
unsigned char* compressFast(unsigned char* bytes, int size, int* packed, int quality);

}  // namespace weft::assets
