// The pass types that come with Weft. Each is in a folder of its own, which alone knows its name.
#pragma once

#include <memory>
#include <utility>

#include "engine/passes/pass_type.h"

namespace weft::passes {

// One that says always the same, and has no state.
class BuiltinPass final : public PassType {
 public:
  using Execute = void (*)(const PassContext&);
  BuiltinPass(graph::PassType reflected, Execute run) : reflected_(std::move(reflected)), execute_(run) {}
  graph::PassType reflect() const override { return reflected_; }
  void execute(const PassContext& context) const override { execute_(context); }

 private:
  const graph::PassType reflected_;
  const Execute execute_;
};

std::unique_ptr<PassType> makeFullscreen();
std::unique_ptr<PassType> makeCompute();
std::unique_ptr<PassType> makeDraw();
std::unique_ptr<PassType> makeBlit();
std::unique_ptr<PassType> makeMipmap();

}  // namespace weft::passes
