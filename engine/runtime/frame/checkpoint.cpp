// The state of an execution between two frames. Declared in execution.h.
#include <fmt/format.h>

#include "engine/runtime/frame/execution.h"
#include "runtime_sentences.h"

namespace weft::runtime {

bool Execution::canSave(const World& world, text::Diagnostics& diagnostics) const {
  const std::size_t before = diagnostics.errorCount();
  const graph::FlatGraph& graph = *plan().graph;
  for (const graph::ImportSpec& import : graph.imports)
    if (device_.imports.of(import).remembers(world))
      diagnostics.error(say::importRemembers, import.place, import.name);
  for (std::size_t r = 0; r < graph.resources.size(); ++r)
    if (plan().persistent[r] && graph.resources[r].samples > 1)
      diagnostics.error(say::samplesAreKept,
                        r < graph.resourcePlaces.size() ? graph.resourcePlaces[r] : text::Place{},
                        graph.resourceNames[r]);
  return diagnostics.errorCount() == before;
}

void Execution::carry(StateStream& state, text::Diagnostics& diagnostics) {
  std::vector<std::uint64_t> own;
  for (std::size_t step = 0; step < prepared_.passes.size(); ++step)
    own.push_back(steps_.isAlways(step) ? 0
                                        : ownHashOf(prepared_.passes[step], plan().passOf(step).cadence,
                                                    *prepared_.pool, device_.imports));
  steps_.carry(state, own, [&](std::uint32_t resource) { return publications_.importGeneration(resource); });
  if (state.good()) publications_.carry(state, diagnostics);
}

std::optional<std::string> Execution::save(text::Diagnostics& diagnostics) {
  StateStream state;
  carry(state, diagnostics);
  if (!state.good()) return std::nullopt;
  return std::move(state).bytes();
}

bool Execution::restore(std::string_view bytes, const World& world, const FrameInput& last,
                        text::Diagnostics& diagnostics) {
  input_ = last;
  device_.imports.beginFrame(world, last);
  publications_.beginFrame(last);
  publications_.refreshImports(diagnostics);
  StateStream state(bytes);
  carry(state, diagnostics);
  state.require(state.atEnd());
  return state.good() && !diagnostics.hasErrors();
}

}  // namespace weft::runtime
