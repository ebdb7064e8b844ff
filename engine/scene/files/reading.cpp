#include "engine/scene/files/reading.h"

#include <fmt/format.h>

#include "engine/base/nearest.h"

namespace weft::scene {

base::Diagnostic& failAt(base::Diagnostics& diagnostics, base::Code code, const base::JsonValue& value,
                         std::string message, std::string hint) {
  base::Diagnostic& d = diagnostics.error(code, value.place, std::move(message));
  d.hint = std::move(hint);
  return d;
}

void failTooMany(base::Diagnostics& diagnostics, const base::JsonValue& value, std::string message,
                 std::size_t most, std::string found, std::string hint) {
  base::Diagnostic& d =
      failAt(diagnostics, base::Code::badSceneValue, value, std::move(message), std::move(hint));
  d.expected = fmt::format("at most {} in all", most);
  d.found = std::move(found);
}

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
      failAt(diagnostics, base::Code::unknownSceneList, item, fmt::format("unknown draw list '{}'", *name),
             base::nearestHint(*name, drawListNames()));
  }
  return mask;
}

void SceneGrid::read(SceneFields& fields) {
  constexpr base::NumberRange kCount{.min = 1, .max = 65536, .whole = true};
  if (const auto given = fields.triple("count", kCount))
    for (std::size_t i = 0; i < 3; ++i) count[i] = static_cast<int>((*given)[i]);
  fields.read("spacing", kSize, spacing);
}

}  // namespace weft::scene
