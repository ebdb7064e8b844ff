#include "engine/text/files/data_folder.h"

#include <cstdlib>
#include <filesystem>

#include "data_places.h"

namespace weft::text {

std::string dataFolder() {
  if (const char* folder = std::getenv("WEFT_DATA")) return folder;
  std::error_code ignored;
  if (std::filesystem::is_directory(WEFT_DATA_SOURCE, ignored)) return WEFT_DATA_SOURCE;
  return WEFT_DATA_INSTALLED;
}

}  // namespace weft::text
