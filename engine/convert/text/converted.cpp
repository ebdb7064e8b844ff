#include "engine/convert/text/converted.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/nearest.h"

namespace weft::convert {

bool checkImageNames(const ConvertOptions& options, std::span<const std::string> known,
                     base::Diagnostics& diagnostics) {
  bool good = true;
  for (const auto& [name, file] : options.images) {
    if (std::ranges::find(known, name) != known.end()) continue;
    good = false;
    auto& d = diagnostics.error(base::Code::unknownParameter,
                                base::placeOfOption(fmt::format("--image {}=…", name)),
                                fmt::format("the file has no image '{}'", name));
    d.expected = known.empty() ? "no --image: the file reads none" : "the name of an image of the file";
    d.hint = base::nearestHint(name, known);
  }
  return good;
}

}  // namespace weft::convert
