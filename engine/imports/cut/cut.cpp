#include "engine/imports/cut/cut.h"

namespace weft::imports {

namespace {

class CutProvider : public Provider {
 public:
  std::uint64_t generation(const Frame& frame) override { return frame.input.cutGeneration; }
  bool isStill(const World&) const override { return true; }
};

}  // namespace

graph::ImportType Cut::reflect() const {
  return {.name = "cut",
          .kind = graph::ImportKind::event,
          .doc = "Changes when the camera jumps.",
          .arguments = {}};
}

std::unique_ptr<Provider> Cut::provide(const graph::ImportRequest&) const {
  return std::make_unique<CutProvider>();
}

}  // namespace weft::imports
