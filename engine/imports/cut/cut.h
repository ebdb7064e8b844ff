#pragma once

#include "engine/imports/import.h"

namespace weft::imports {

class Cut : public Import {
 public:
  graph::ImportType reflect() const override;
  std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const override;
};

}  // namespace weft::imports
