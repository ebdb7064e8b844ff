// What is said of a graph when all of its passes are known: reads that nothing feeds, passes that reach nothing, declarations
// that nothing uses, and "update" and "slices" that do not fit. What is alive is found by findLive (versions/versions.h), by
// which the compiler culls.
#pragma once

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// The passes whose results go into what `last` makes, directly or through others: per pass the one that it feeds on a shortest way
// there; of `last` itself; kNone for all others. each(pass, follow) calls follow(source) for its sources.
template <class Each>
std::vector<std::uint32_t> findWays(const FlatGraph& graph, std::uint32_t last, const Each& each) {
  std::vector<std::uint32_t> next(graph.passes.size(), kNone), queue{last};
  next[last] = last;
  for (std::size_t at = 0; at < queue.size(); ++at)
    each(queue[at], [&, pass = queue[at]](std::uint32_t source) {
      if (source >= next.size() || next[source] != kNone) return;
      next[source] = pass;
      queue.push_back(source);
    });
  return next;
}

// Reports every MissingRead: an error in a live pass, a warning in a culled one, with the reason (a pass that is disabled,
// removed or never repeated, a later writer, a cycle, no writer) and the fixes.
void reportMissingReads(Model& model);

// Finds what `as compare` means where the reference names no comparison: that of the depth test which made the map. Fills
// Sampler::function; W056 where nothing says how. The versions must be linked.
void inferComparisons(Model& model);

// W077 for what cannot be time-sliced.
void checkSlices(Model& model);

// The others are warnings, of a graph without errors.

// Warns of each enabled pass that reaches neither the picture nor an output, and of what a pass draws that another throws
// away, with the reason: overwritten, its reader stands above it, nobody reads it. Passes that only feed such a pass are
// named in its message. What would be read if all that is switched off now (a disabled pass, a condition that is false, a
// level that is not there at this size) were there is no mistake.
// Also warns (W059) of each slot of a live pass that stays empty, takes another alternative or reads what "clear" says
// although an enabled pass below writes what it reads; and of a graph that shows nothing.
void warnUnread(Model& model);

// W089 for what the files declare and nothing uses: parameters, lets of the opened file, resources, inputs, a history that nobody
// reads, alternatives that cannot be reached; lists of the scene that no pass draws. What a disabled pass or a condition that is
// false now would use counts as used. What lies under an overlay or a preset is not judged: its user may have been removed.
void warnUnused(Model& model);

// W083 for a live `once` pass that reads a history, what a pass writes in every frame, or an import that changes while the
// graph runs; and for an `on_change` pass that runs in every frame, because what it reads changes in each. One warning a
// stanza. A `once` pass that runs again with others of its group is not judged.
void warnCadence(Model& model);

}  // namespace weft::graph::expansion
