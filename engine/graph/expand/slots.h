// Slots: from a reference as written to the texture, buffer or import it means and the sub-resources it
// selects, with alternatives chosen by condition and version, and every check of a single use (selectors,
// ranges, kinds, formats). passes.cpp makes versions, in slot order; checks.h compares slots with each other.
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <vector>

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
  enum Part : std::uint8_t { level, layer, face, element };
  std::array<std::optional<Span>, 4> parts;  // by Part
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
  std::size_t firstOf =
      ~std::size_t{0};  // the index of the slot in whose place it is read; see resolveFirsts()
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

  // Reports a mistake of the pass: "pass 'glow_down[3]' MESSAGE". Returns false.
  bool report(Code code, const Place& place, std::string_view message, Says says = {}) const;
};

// Resolves one slot. Reads and modifies look for versions; a required slot without one is recorded in
// model.missing (with `pass` as its pass) and comes back as `missing`.
SlotWork resolveSlot(const SlotContext& context, const SlotDesc& slot, std::uint32_t pass);

// A pass reads something else in the place of a history's publication that is not there yet, where "first" names a texture or
// buffer; the executor chooses between the two in every frame. Adds to `slots`, for each of them that reads @-n, the same
// part of what is named, read in the same way (SlotWork::firstOf). Reports what does not fit. `descs` holds what they point to.
void resolveFirsts(const SlotContext& context, std::vector<SlotWork>& slots, std::deque<SlotDesc>& descs,
                   std::uint32_t pass);

}  // namespace weft::graph::expansion
