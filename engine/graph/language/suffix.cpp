// Declared in names.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/graph/language/names.h"
#include "engine/text/nearest.h"

namespace weft::graph {

bool hasSuffix(std::string_view name, std::string_view suffix) {
  if (!name.ends_with(suffix)) return false;
  return name.size() == suffix.size() || name[name.size() - suffix.size() - 1] == '.';
}

std::vector<std::size_t> suffixMatches(std::span<const std::string> names, std::string_view wanted) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == wanted) return {i};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (hasSuffix(names[i], wanted)) found.push_back(i);
  return found;
}

std::string commonSuffix(std::string_view a, std::string_view b) {
  std::string_view common;
  for (std::size_t dot = a.size(); dot != std::string_view::npos && dot > 0;) {
    dot = a.rfind('.', dot - 1);
    const std::string_view suffix = dot == std::string_view::npos ? a : a.substr(dot + 1);
    if (!hasSuffix(b, suffix)) break;
    common = suffix;
  }
  return std::string(common);
}

std::string suffixHint(std::string_view wanted, std::span<const std::string> names) {
  std::vector<std::string> ends(names.begin(), names.end());  // with what they end in
  for (const std::string& name : names)
    for (std::size_t dot = name.find('.'); dot != std::string::npos; dot = name.find('.', dot + 1))
      ends.push_back(name.substr(dot + 1));
  std::vector<std::size_t> ending = suffixMatches(names, wanted);
  if (ending.empty()) ending = suffixMatches(names, wanted.substr(wanted.rfind('.') + 1));
  const auto far = [&](std::size_t i) { return text::editDistance(wanted, names[i], 16); };
  if (const std::string near = ending.empty() ? text::nearestName(wanted, ends)
                                              : names[*std::ranges::min_element(ending, {}, far)];
      !near.empty())
    return fmt::format("did you mean '{}'?", near);
  // A suffix is whole parts between dots; part of a part may be what was meant.
  std::vector<std::string> holding;
  for (const std::string& name : names)
    if (wanted.size() >= 3 && name.find(wanted) != std::string::npos && holding.size() < 5)
      holding.push_back(name);
  if (!holding.empty()) return fmt::format("names that hold it: '{}'", fmt::join(holding, "', '"));
  return text::nearestHint(wanted, ends);
}

}  // namespace weft::graph
