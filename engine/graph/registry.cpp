#include "engine/graph/registry.h"

#include <algorithm>
#include <bit>
#include <cassert>

#include "engine/text/hash.h"

namespace weft::graph {

const Value& ImportRequest::at(std::string_view argument) const {
  const auto found =
      std::ranges::find_if(arguments, [&](const auto& each) { return each.first == argument; });
  assert(found != arguments.end());
  return found->second;
}

const ImportRequest* ImportRequest::named(std::string_view argument) const {
  const auto found = std::ranges::find_if(of, [&](const auto& each) { return each.first == argument; });
  return found == of.end() ? nullptr : &found->second;
}

std::uint64_t keyOf(const ImportRequest& request) {
  std::uint64_t key = text::hashBytes(request.type);
  for (const auto& [name, value] : request.arguments) {
    key = text::hashBytes(value.symbol, text::hashBytes(name, key));
    for (std::size_t i = 0; i < value.count; ++i)
      key = text::hashCombine(key, std::bit_cast<std::uint64_t>(value.v[i] + 0.0));  // -0 is 0
    key = text::hashCombine(key, static_cast<std::uint64_t>(value.type));
  }
  for (const auto& [name, other] : request.of)
    key = text::hashCombine(text::hashBytes(name, key), keyOf(other));
  return key;
}

std::uint32_t elementOf(const ImportRequest& request) {
  const bool has = !request.arguments.empty() && request.arguments.back().first == "element";
  return has ? static_cast<std::uint32_t>(request.arguments.back().second.v[0]) : 0;
}

}  // namespace weft::graph
