#include "engine/text/files/text_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "engine/text/files/file.h"
#include "engine/text/limits.h"

namespace weft::text {

void reportTooLarge(const Place& place, std::uint64_t bytes, Diagnostics& diagnostics) {
  reportLimit(diagnostics, place, "the file is too large", kMaxTextBytes, "bytes of one JSON or .cube file",
              bytes)
      .found = fmt::format("{} bytes", bytes);
}

std::optional<std::string> readTextFile(const std::string& path, Diagnostics& diagnostics, Code code,
                                        const Place& place) {
  const std::uint64_t most = raised(kMaxTextBytes);
  bool tooLarge = false;
  std::uint64_t found = 0;  // of a pipe: so far
  const auto within = [&](std::uint64_t bytes, std::uint64_t total) {
    found = std::max(bytes, total);
    tooLarge = found > most;
    return !tooLarge;
  };
  std::optional<std::string> bytes = readFile(path, diagnostics, code, place, within);
  if (tooLarge) reportTooLarge({std::make_shared<const std::string>(path), 0, 0}, found, diagnostics);
  return bytes;
}

}  // namespace weft::text
