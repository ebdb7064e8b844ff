// The plug-ins of one kind that an engine knows, pass types or imports, by the name that each reflects.
#pragma once

#include <cassert>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace weft::graph {

template <class PlugIn>
class PlugIns {
 public:
  void add(std::unique_ptr<PlugIn> plugIn) {
    std::string name = plugIn->reflect().name;
    assert(!find(name) && "a plug-in of this name is already registered");
    entries_.emplace_back(std::move(name), std::move(plugIn));
  }
  // Null for a name that is unknown.
  const PlugIn* find(std::string_view name) const {
    for (const auto& [known, plugIn] : entries_)
      if (known == name) return plugIn.get();
    return nullptr;
  }
  auto reflect() const {
    std::vector<decltype(std::declval<const PlugIn&>().reflect())> all;
    for (const auto& [name, plugIn] : entries_) all.push_back(plugIn->reflect());
    return all;
  }

 private:
  std::vector<std::pair<std::string, std::unique_ptr<PlugIn>>> entries_;
};

}  // namespace weft::graph
