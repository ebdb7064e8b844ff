// Reads that find nothing because what they read is written below them.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "engine/graph/expand/judge/reach.h"

namespace weft::graph::expansion {

// An element of a slot that found no version but zero, in an enabled pass.
struct Missed {
  const WouldUse* would = nullptr;
  Line line;  // who: the pass
};
std::vector<Missed> missedReads(const Model& model, const Ground& ground);

// W059, a warning, for each slot of a live pass that stays empty, takes another alternative or reads what "clear" says
// although an enabled pass below writes what it reads. Not where that pass is lost (it is told with its reader), is
// another repeat of the same stanza, where a pass above that would write it is switched off, or where it needs what the reader makes and the reader only begins with what "clear" says.
void warnMisplaced(Model& model, const Ground& ground, const Liveness& live,
                   const std::function<bool(std::uint32_t)>& isLost);

// The entries of the file in which both stand, "post.bloom" and "post.display" of "post.bloom.up" and
// "post.display.composite": what a person moves.
std::pair<std::string, std::string> entriesOf(const std::string& a, const std::string& b);

}  // namespace weft::graph::expansion
