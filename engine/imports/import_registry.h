// The imports an engine knows, by name. An embedder adds its own before reading graphs.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/imports/import.h"

namespace weft::imports {

class ImportRegistry {
 public:
  // The imports that have a folder here.
  static ImportRegistry builtin();

  void add(std::unique_ptr<Import> import);
  const Import* find(std::string_view name) const;
  std::vector<graph::ImportType> reflect() const;

 private:
  struct Entry {
    std::string name;
    std::unique_ptr<Import> import;
  };
  std::vector<Entry> imports_;
};

}  // namespace weft::imports
