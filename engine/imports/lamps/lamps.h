// The import `lamps`: the scene's point and spot lights as a table, and six views of each that its shadows are drawn from.
#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

class Lamps : public Import {
 public:
  graph::ImportType reflect() const override;
  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files& files) const override;
  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override;
};

}  // namespace weft::imports
