// The import `materials`: the scene's materials as a table. A mesh's row says which one it has.
#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

class Materials : public Import {
 public:
  graph::ImportType reflect() const override;
  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files& files) const override;
  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override;
};

}  // namespace weft::imports
