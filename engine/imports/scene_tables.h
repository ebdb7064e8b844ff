// The rows of the draw lists, on the CPU and as tables on the device, one per list and layout: made on first use and
// renewed when the scene changed or moves. Shared by every provider of a device.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/gl/objects/objects.h"
#include "engine/imports/frame.h"
#include "engine/imports/instance_layout.h"
#include "engine/imports/world.h"
#include "engine/scene/scene.h"

namespace weft::imports {

class SceneTables {
 public:
  // Both must live until the next call.
  void beginFrame(const World& world, const FrameInput& input, std::uint64_t number);

  BufferRef table(scene::DrawList list, const InstanceLayout& layout, base::Diagnostics& diagnostics);
  const std::vector<scene::Instance>& rows(scene::DrawList list);
  std::uint32_t countOf(scene::DrawList list);
  // Moves when a row may be another.
  std::uint64_t generation(scene::DrawList list);

 private:
  // What is asked of a draw list several times a frame; looking at every sphere each time would cost with a million.
  struct ListFacts {
    std::uint64_t scene = 0;  // generation
    std::uint32_t count = 0;
    bool moving = false;
  };
  struct Rows {
    std::vector<scene::Instance> rows;
    std::uint64_t generation = 0;
  };
  struct Table {
    scene::DrawList list{};
    InstanceLayout layout;
    gl::Buffer buffer;
    std::uint64_t generation = 0;
  };
  const ListFacts& factsOf(scene::DrawList list);

  const World* world_ = nullptr;
  const FrameInput* input_ = nullptr;
  std::uint64_t number_ = 0;
  ListFacts facts_[scene::kDrawListCount];
  Rows rows_[scene::kDrawListCount];
  std::vector<std::unique_ptr<Table>> tables_;
  std::vector<std::byte> bytes_;
};

}  // namespace weft::imports
