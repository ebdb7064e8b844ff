// Which keys an object of a graph file may have at its place, from the tables of the reader and the registry. Does not: know
// values, or names that authors give.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/lsp/text/json_spot.h"
#include "engine/graph/registry.h"

namespace weft::app::lsp {

struct KeyDoc {
  std::string key, doc;
  std::span<const std::string_view> words{};  // that it may be, where these are few
};

// The keys of the object at the end of the way; empty where the author names them.
std::vector<KeyDoc> keysOf(const graph::Registry& registry, const Way& object);

// Documentation as Markdown; "" when the type is no import.
std::string docOfImport(const graph::Registry& registry, std::string_view type);

}  // namespace weft::app::lsp
