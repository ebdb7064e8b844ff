#include "engine/scene/files/lists.h"

#include <fmt/format.h>

#include "engine/base/nearest.h"
#include "engine/scene/files/reading.h"

namespace weft::scene {

std::optional<std::uint8_t> readLists(base::JsonFields& fields, const std::string& what,
                                      base::Diagnostics& diagnostics) {
  const base::JsonValue* lists = fields.array("lists");
  if (!lists) return {};
  std::uint8_t mask = 0;
  for (const base::JsonValue& item : lists->items) {
    const auto name = base::readText(item, fmt::format("a draw list of {}", what), diagnostics);
    if (!name) continue;
    if (const auto list = findDrawList(*name))
      mask = static_cast<std::uint8_t>(mask | maskOf(*list));
    else
      failAt(diagnostics, base::Code::unknownSceneList, item, fmt::format("unknown draw list '{}'", *name))
          .hint = base::nearestHint(*name, drawListNames());
  }
  return mask;
}

}  // namespace weft::scene
