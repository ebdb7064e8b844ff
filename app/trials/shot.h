// A picture of a graph with what belongs to it: what each pass wrote, what it cost. Every shot is made by a renderer of its own, so
// that nothing of the shot before is in it. Does not: write files, or decide what is compared.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/session/device_session.h"
#include "app/session/options.h"
#include "engine/assets/images/image.h"
#include "engine/graph/compile/compile.h"
#include "engine/runtime/inspection/poison.h"
#include "engine/runtime/inspection/step_record.h"

namespace weft::app {

struct ShotWish {
  std::vector<std::uint32_t> frames = {0};  // ascending; the ones to look at
  bool records = false;                     // of those frames, and of the first that runs
  std::uint32_t repeats = 0;                // frames to measure behind the last one
  graph::CompileOptions compile{};
  std::optional<runtime::PoisonPattern> poison{};
  std::pair<std::string, std::string> keep{};  // a pass and a resource whose texels are kept
  std::uint32_t keepFrame = 0;
};

struct FrameRecord {
  std::uint32_t frame = 0;
  std::vector<runtime::StepRecord> steps;
};

struct Shot {
  std::map<std::uint32_t, assets::Image8> pictures;  // RGBA, by frame
  std::vector<FrameRecord> records;
  std::optional<runtime::WrittenTexels> kept;
  std::shared_ptr<const graph::Plan> plan;
  std::vector<std::string> files;                  // that were read
  double milliseconds = 0;                         // of the fastest frame that was measured
  std::map<std::string, double> passMilliseconds;  // by declared name, of that frame
};

// The graph, scene, settings and size of `options`. Empty after errors.
std::optional<Shot> takeShot(gl::Context& context, const Options& options, const runtime::World& world,
                             const ShotWish& wish, base::Diagnostics& diagnostics);

}  // namespace weft::app
