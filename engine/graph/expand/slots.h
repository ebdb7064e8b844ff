// Slots: from a reference as written to the texture, buffer or import it means and the sub-resources it
// selects, with alternatives chosen by condition and version, and every check of a single use (selectors,
// ranges, kinds, formats). Does not: make versions (passes.cpp does, in slot order) or compare slots with
// each other (checks.h).
#pragma once

#include "engine/graph/expand/names/names.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/scope.h"

namespace weft::graph::expansion {

// Selectors with numbers in place of expressions; ends left open are filled in by placeSelection.
struct Selection {
  struct Span {
    std::int64_t first = 0, last = 0;
    bool openFirst = false, openLast = false;
    Place place;
  };
  std::optional<Span> mip, layer, face, element;
  bool stencil = false;
};

// One concrete thing a reference may mean.
struct Leaf {
  std::uint32_t entity = kNone;
  Selection selection;
  std::optional<Kind> kind;
  Sampler sampler;
  BorderColor border{};
  int history = 0;           // n of @-n, of the reference and of the alternatives on the way
  bool conditional = false;  // it stands in a list, with a condition
};

// A slot of one pass instance.
struct SlotWork {
  enum class State : std::uint8_t {
    connected,
    absent,   // condition false, or optional without a version
    missing,  // required, but nothing is there: a MissingRead was recorded or will be
    empty,    // levels that the clamp to the size took away, or `1..` of one level: the pass is left out
    failed    // reported
  };
  const SlotDesc* slot = nullptr;
  State state = State::failed;
  std::uint32_t entity = kNone, firstElement = 0, elementCount = 1;
  bool array = false;  // the whole of an array
  bool whole = false;  // no selector: all sub-resources
  FlatUse use;         // everything but the resource
  Sampler sampler;
  BorderColor border{};
};

// Whether a slot needs what another slot of the pass writes: some pass must have written it before.
inline bool needs(const SlotWork& slot, const SlotWork& written) {
  return slot.slot->access != Access::write && slot.entity == written.entity &&
         slot.firstElement < written.firstElement + written.elementCount &&
         written.firstElement < slot.firstElement + slot.elementCount && slot.use.history == 0 &&
         overlap(slot.use, written.use);
}

struct SlotContext {
  Model& model;
  Names& names;             // of the pass instance
  const PassType* type;     // null: present, outputs, resets
  const std::string& user;  // "pass 'glow_down[3]'"
  const std::string& pass;  // "glow_down[3]"
  bool versions = true;     // false: a disabled pass; the first candidate is validated
  bool ranges = true;       // false: sub-resource ranges are not held against sizes
  std::vector<Leaf>* room =
      nullptr;  // for candidates, so that not every slot takes memory of its own for them
};

// Resolves one slot. Reads and modifies look for versions; a required slot without one is recorded in
// model.missing (with `pass` as its pass) and comes back as `missing`.
SlotWork resolveSlot(const SlotContext& context, const SlotDesc& slot, std::uint32_t pass);

}  // namespace weft::graph::expansion
