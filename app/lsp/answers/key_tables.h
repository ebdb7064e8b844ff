// Which keys an object of a graph file may have, by where it stands; from the tables of the reader and the registry.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "app/lsp/text/json_outline.h"
#include "engine/graph/registry.h"

namespace weft::app::lsp {

struct KeyDoc {
  std::string key, doc;
};

// The keys on the way from the root to a node; "[]" for items of arrays.
std::vector<std::string_view> wayTo(const Node& node);

// Empty where names are the author's.
std::vector<KeyDoc> keysOf(const graph::Registry& registry, const Node& object);

// The words of a key of "state"; empty for one that holds a value.
std::vector<std::string_view> wordsOfState(std::string_view key);

// Markdown; "" for no import.
std::string docOfImport(const graph::Registry& registry, std::string_view type);

}  // namespace weft::app::lsp
