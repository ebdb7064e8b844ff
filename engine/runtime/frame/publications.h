// Publications: decides when all passes see the new contents of a resource. Each resource has a generation, which rises
// with every change, and an age, the time since it was published. A pass that runs publishes what it writes and rotates its
// history by one. A time-sliced group publishes all it wrote at once, in the frame after its last slice. An import that
// Provider::hold() keeps appears together with what a group makes of it. Histories are reset when what they depend on
// changes. A frame allocates nothing.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/cadence/cadence.h"
#include "engine/runtime/imports/imports.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

class Publications {
 public:
  // All but `before` must outlive this. What the execution before, if there is one, has published stays published where the
  // storage is shared; the texture that an import takes the place of is shown until the import is.
  Publications(const graph::Plan& plan, ResourcePool& pool, Imports& imports, FrameCadence& cadence,
               const std::vector<PreparedPass>& passes, const Publications* before = nullptr);
  Publications(const Publications&) = delete;
  Publications& operator=(const Publications&) = delete;

  void beginFrame(const FrameInput& input);
  void endFrame() { ++framesRun_; }

  // Publishes what time-sliced groups finished in the frame before.
  void publishFinished();
  // Asks each import for its newest texture or buffer and its generation.
  void refreshImports(text::Diagnostics& diagnostics);
  // Sets histories back to their first value when what resets them has changed.
  void resetHistories(text::Diagnostics& diagnostics);
  // Sets the age of what the passes of this frame will publish to 0. True when there is something. To be called when the cadence has decided.
  bool announce();
  // Before the steps of a round run: keeps the generations that the cadence saw.
  void beginRound();
  // `pass` runs in this round: rotates the history of what it writes and publishes it, once in a round.
  void publishWritten(const PreparedPass& pass);
  // The generations before the round, and the present ones.
  const std::vector<std::uint64_t>& generationsBefore() const { return generationsBefore_; }
  const std::vector<std::uint64_t>& generations() const { return generations_; }

  // Saves or restores, between two frames, what was published, with its contents. Imports are not in it: to be restored when those
  // of the last frame were refreshed.
  void carry(StateStream& state, text::Diagnostics& diagnostics);
  std::optional<std::uint64_t> importGeneration(std::uint32_t resource) const {
    if (plan_.graph->resources[resource].import == graph::kNone) return std::nullopt;
    return generations_[resource];
  }

  // Seconds since a resource was published; infinite when no pass ever writes it.
  double ageOf(std::uint32_t resource) const;
  const std::function<double(std::uint32_t)>& ages() const { return ages_; }
  bool firstHeadlessFrame() const { return input_.headless && framesRun_ == 0; }

 private:
  void findPublishers();
  void publish(std::uint32_t resource);
  void publishImports(std::uint32_t group);
  void show(std::size_t resource);
  std::uint64_t hashOfImports(const graph::HistorySpec& history);
  void continueGenerations(const Publications& before);
  void continueGroups();
  void continueHistories(const Publications& before);
  void continueImports(const Publications& before);
  const graph::ImportSpec& importOf(std::size_t resource) const {
    return plan_.graph->imports[plan_.graph->resources[resource].import];
  }

  const graph::Plan& plan_;
  ResourcePool& pool_;
  Imports& imports_;
  FrameCadence& cadence_;
  const std::vector<PreparedPass>& passes_;
  std::function<double(std::uint32_t)> ages_;
  FrameInput input_;
  std::uint64_t framesRun_ = 0, nextGeneration_ = 1;
  std::vector<std::uint64_t> generations_, generationsBefore_;  // per resource
  std::vector<std::uint8_t> publishing_;   // per resource: a pass that is not `always` publishes it now
  std::vector<std::uint8_t> turned_;       // per resource: rotated in this round
  std::vector<std::uint8_t> made_;         // per resource: the world's, or some pass writes it
  std::vector<std::uint64_t> resetState_;  // per history: hash of what resets it
};

// The last version of the texture or buffer `name` ("hdr", "ibl.brdf") that is alive in the plan, or kNone.
std::uint32_t lastVersionOf(const graph::Plan& plan, std::string_view name);

}  // namespace weft::runtime
