// The import `camera`: through one lens and one jitter, the view for a size of screen, kept for the frame.
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "engine/imports/import.h"
#include "engine/imports/row_table.h"
#include "engine/scene/camera.h"

namespace weft::imports {

Columns<scene::ViewData> cameraColumns();

class CameraProvider : public Provider {
 public:
  static graph::ImportType reflect();
  static graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world, Files&);

  CameraProvider() = default;  // the scene's as it is
  explicit CameraProvider(const graph::ImportRequest& request);
  const scene::ViewData& view(const Frame& frame, const ViewPart& part) override;
  bool value(const Frame& frame, const ViewPart& part, std::uint32_t column, Numbers& out) override {
    return table_.read({&view(frame, part), 1}, part.element, column, out);
  }
  // Moves when the camera stands elsewhere or has another lens. What else a view holds does not count: the moment, the
  // sub-pixel step of the jitter, and where the camera stood before.
  std::uint64_t generation(const Frame& frame) override;

 private:
  // In a frame, and in the one before.
  using Poses = std::pair<scene::CameraPose, scene::CameraPose>;
  Poses posesOf(const Frame& frame) const;
  static std::function<Poses(const Frame&)> placed(const graph::ImportRequest& request);

  std::uint32_t jitter_ = 0;  // length of the sub-pixel sequence
  double around_ = -1;        // where on its way to the target it has six faces; below 0: none
  std::function<Poses(const Frame&)> poses_;  // empty: those of the scene's camera
  scene::CameraPose seen_;                    // of generation_
  std::uint64_t generation_ = 0;
  scene::ViewData data_;  // of a size, in a frame
  glm::uvec2 size_{0};
  std::uint64_t made_ = 0;
  RowTable<scene::ViewData> table_{"camera", cameraColumns()};
};

}  // namespace weft::imports
