// The pass types an engine knows, by name. An embedder adds its own before reading graphs.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/passes/pass_type.h"

namespace weft::passes {

class PassRegistry {
 public:
  // fullscreen, compute, draw, blit, mipmap
  static PassRegistry builtin();

  void add(std::unique_ptr<PassType> type);
  const PassType* find(std::string_view name) const;
  std::vector<graph::PassType> reflect() const;

 private:
  struct Entry {
    std::string name;
    std::unique_ptr<PassType> type;
  };
  std::vector<Entry> types_;
};

}  // namespace weft::passes
