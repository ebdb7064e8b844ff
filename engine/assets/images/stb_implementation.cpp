// The one translation unit that holds stb_image, stb_image_write and stb_image_resize, so that sanitizers see them too.
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 32768  // kMaxImageSide
#include <stb/stb_image.h>

#include "engine/assets/images/zlib_stream.h"
#define STBIW_ZLIB_COMPRESS weft::assets::compressFast
#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#define STB_IMAGE_RESIZE_IMPLEMENTATION
#include <stb/stb_image_resize.h>
