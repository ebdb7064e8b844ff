// Things the viewer can do, by name: whoever does one adds it, keys (app/view/key_bindings.h) and panels run
// it. Does not: know keys, or keep what is asked for: run() does it at once.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace weft::app {

class Actions {
 public:
  // Replaces what had the name. What `function` captures must live as long as this.
  void add(std::string name, std::function<void()> function) {
    functions_[std::move(name)] = std::move(function);
  }
  bool has(std::string_view name) const { return functions_.contains(name); }
  // False when nobody added it.
  bool run(std::string_view name) const {
    const auto found = functions_.find(name);
    if (found == functions_.end()) return false;
    found->second();
    return true;
  }

 private:
  std::map<std::string, std::function<void()>, std::less<>> functions_;
};

}  // namespace weft::app
