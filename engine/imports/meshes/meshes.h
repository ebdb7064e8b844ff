// The import `meshes`: the rows of the meshes of a draw list, as a table.
#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

class Meshes : public Import {
 public:
  graph::ImportType reflect() const override;
  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files& files) const override;
  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override;
};

}  // namespace weft::imports
