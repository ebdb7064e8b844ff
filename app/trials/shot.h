// A picture of a graph, what each pass wrote and cost, by a renderer of its own; and how two pictures differ.
#pragma once

#include <map>

#include "app/session/session.h"
#include "engine/assets/images/flip.h"
#include "engine/assets/images/image.h"
#include "engine/graph/compile/compile.h"
#include "engine/runtime/inspection/step_watches.h"

namespace weft::app {

struct ShotWish {
  std::vector<std::uint32_t> frames = {0};  // ascending; the ones to look at
  bool records = false;                     // of those frames, and of the first that runs
  graph::CompileOptions compile{};
  std::optional<runtime::PoisonPattern> poison{};
};

struct FrameRecord {
  std::uint32_t frame = 0;
  std::vector<runtime::StepRecord> steps;
};

// What every pass wrote.
struct PassRecords {
  std::string driver;  // DeviceInfo::driverKey
  std::vector<FrameRecord> frames;
  std::vector<std::string> culled{};  // passes of the graph that do not run; not written to the file
};

struct Shot {
  std::map<std::uint32_t, assets::Image8> pictures;  // RGBA, by frame
  PassRecords records;
  std::shared_ptr<const graph::Plan> plan;
};

// The graph, scene, settings and size of `options`. Empty after errors.
std::optional<Shot> takeShot(gl::Context& context, const Options& options, const runtime::World& world,
                             const ShotWish& wish, text::Diagnostics& diagnostics);

// Milliseconds on the GPU of each step of the plan: the median over those of `repeats` frames from `frame` on in which it ran, or 0.
std::vector<double> measureSteps(runtime::Renderer& renderer, const runtime::World& world,
                                 const Options& options, std::uint32_t frame, std::uint32_t repeats,
                                 text::Diagnostics& diagnostics);

struct PictureDifference {
  assets::FlipMap map;
  assets::Comparison bytes;
  assets::FlipSummary flip;
  double share = 0;  // of the pixels that differ at all

  // "FLIP 0.0123, at most 0.200 (at 1,2); 96 pixels differ (1.5 %), by up to 12 of 255 (at 3,4)"
  std::string text() const;
};

// Nothing for pictures of different sizes. What has the weight 0 does not count for `flip`; an empty `weights` means that all do.
std::optional<PictureDifference> comparePictures(const assets::Image8& picture,
                                                 const assets::Image8& reference,
                                                 const std::vector<std::uint8_t>& weights = {});
// "96x54"
std::string sizeText(const assets::Image8& image);

}  // namespace weft::app
