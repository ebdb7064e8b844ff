#include "engine/imports/builtin.h"

namespace weft::imports {

namespace {

class CutProvider : public Provider {
 public:
  std::uint64_t generation(const Frame& frame) override { return frame.input.cutGeneration; }
  bool isStill(const World&) const override { return true; }
};

class Cut : public ImportOf<CutProvider> {
 public:
  graph::ImportType reflect() const override {
    return {.name = "cut",
            .kind = graph::ImportKind::event,
            .doc = "Changes when the camera jumps.",
            .arguments = {}};
  }
};

}  // namespace

std::unique_ptr<Import> makeCut() {
  return std::make_unique<Cut>();
}

}  // namespace weft::imports
