#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

class Silhouettes : public Import {
 public:
  graph::ImportType reflect() const override;
  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files& files) const override;
  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override;
};

}  // namespace weft::imports
