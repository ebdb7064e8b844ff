#include "engine/scene/files/reading.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "scene_sentences.h"

namespace weft::scene {

std::optional<std::uint8_t> readLists(text::JsonFields& fields, const std::string& what,
                                      text::Diagnostics& diagnostics) {
  const text::JsonValue* lists = fields.array("lists");
  if (!lists) return {};
  std::uint8_t mask = 0;
  for (const text::JsonValue& item : lists->items) {
    const auto name = text::readText(item, fmt::format("a draw list of {}", what), diagnostics);
    if (!name) continue;
    if (const auto list = findDrawList(*name))
      mask = static_cast<std::uint8_t>(mask | maskOf(*list));
    else
      diagnostics.error(say::unknownDrawList, item.place, *name, text::nearestHint(*name, drawListNames()));
  }
  return mask;
}

std::vector<std::string> readTags(text::JsonFields& fields, const std::string& what,
                                  text::Diagnostics& diagnostics) {
  std::vector<std::string> tags;
  const text::JsonValue* all = fields.array("tags");
  for (std::size_t i = 0; all && i < all->items.size(); ++i) {
    const auto tag = text::readText(all->items[i], fmt::format("a tag of {}", what), diagnostics);
    if (tag && (tag->empty() || !std::ranges::all_of(*tag, text::isIdentChar)))
      diagnostics.error(say::noTag, all->items[i].place, *tag);
    if (tag) tags.push_back(*tag);
  }
  return tags;
}

void SceneGrid::read(SceneFields& fields) {
  constexpr text::NumberRange kCount{.min = 1, .max = 65536, .whole = true};
  fields.read("count", kCount, count);
  fields.read("spacing", kSize, spacing);
}

}  // namespace weft::scene
