// What each pass of a graph costs and does, found by leaving it out: time, bytes and the picture without it. Does not: print.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/trials/shot.h"
#include "engine/assets/images/flip.h"

namespace weft::app {

struct Ablation {
  std::string pass;             // as declared; all its repeats
  double ownMs = 0;             // of the pass in the whole frame
  double savedMs = 0;           // of the frame, without the pass and what only fed it
  std::int64_t savedBytes = 0;  // of the textures and buffers
  std::size_t stepsGone = 0;
  assets::FlipSummary flip;
  assets::Image8 picture;
  assets::FlipMap map;
  std::string needed;  // why the graph does not do without it; then only ownMs is known
};

struct AblationTable {
  double ms = 0;
  std::uint64_t bytes = 0;
  std::size_t steps = 0;
  assets::Image8 picture;
  std::vector<Ablation> rows;  // in order of the plan
};

// Measures `repeats` frames, of which the fastest counts. Empty after errors.
std::optional<AblationTable> ablatePasses(gl::Context& context, const Options& options, std::uint32_t repeats,
                                          const runtime::World& world, base::Diagnostics& diagnostics);

std::string ablationText(const AblationTable& table);
std::string ablationJson(const AblationTable& table);
std::string ablationPage(const AblationTable& table, const std::string& graph);

}  // namespace weft::app
