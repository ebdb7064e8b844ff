#include "engine/assets/images/zlib_stream.h"

#include <zlib.h>

#include <cstdlib>

namespace weft::assets {

unsigned char* compressFast(unsigned char* bytes, int size, int* packed, int /*quality*/) {
  uLongf length = ::compressBound(static_cast<uLong>(size));
  auto* stream = static_cast<unsigned char*>(std::malloc(length));
  if (stream && ::compress2(stream, &length, bytes, static_cast<uLong>(size), Z_BEST_SPEED) != Z_OK) {
    std::free(stream);
    stream = nullptr;
  }
  *packed = stream ? static_cast<int>(length) : 0;
  return stream;
}

}  // namespace weft::assets
