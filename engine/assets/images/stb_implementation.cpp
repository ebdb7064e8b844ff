// The one translation unit that holds stb_image, stb_image_write and stb_image_resize, so that sanitizers see them too.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768  // kMaxImageSide
#include <stb/stb_image.h>

// In place of stb's own compressor: zlib, at its fastest level. A stream allocated by malloc, null when memory is short.
#include <zlib.h>

#include <cstdlib>

static unsigned char* compressFast(unsigned char* bytes, int size, int* packed, int /*quality*/) {
  uLongf length = ::compressBound(static_cast<uLong>(size));
  auto* stream = static_cast<unsigned char*>(std::malloc(length));
  if (stream && ::compress2(stream, &length, bytes, static_cast<uLong>(size), Z_BEST_SPEED) != Z_OK) {
    std::free(stream);
    stream = nullptr;
  }
  *packed = stream ? static_cast<int>(length) : 0;
  return stream;
}
#define STBIW_ZLIB_COMPRESS compressFast
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#define STB_IMAGE_RESIZE_IMPLEMENTATION
#include <stb/stb_image_resize.h>
