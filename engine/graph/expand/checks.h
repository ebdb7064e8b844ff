// Checks whether uses fit what they use: for one slot kind, access, format and pass type; for the slots of one pass sizes,
// layers, samples, overlaps, cadences and names. Reports mistakes and never changes anything.
#pragma once

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

bool isInteger(Format format);
// Not an attachment of a draw: of that only what its geometry covers is drawn.
bool coversAll(const PassType* type, const SlotWork& work);

// What `outer`, of a slot, says of sampling, and where it says nothing, `inner` of the alternative that it means.
Sampler layOver(const Sampler& outer, const Sampler& inner);

// The kind of a use whose reference names none.
Kind defaultKind(const PassType* type, Access access, const FlatResource& shape);

// Checks one use: its kind must fit the resource, the access, the pass type and the format; sampler words must fit.
bool checkUse(const SlotContext& context, const RefDesc& ref, Access access, const SlotWork& work);

// Checks that the resource remembers as much as `ref` asks for, x@-`history`.
bool checkHistory(const SlotContext& context, const RefDesc& ref, int history, const Entity& entity);

// Checks all uses of one pass: attachments must have one size, layer count and sample count; nothing may be written
// twice; nothing may be both read and written, except by feedback.
bool checkPassUses(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots);

// An `always` pass must not modify what a slower one made: it would add to it again in every frame. `firstUse` is the
// first of the slot's uses in the graph.
void checkAccumulation(const SlotContext& context, const SlotWork& work, std::uint32_t firstUse);

const PassType* findPassType(const Registry& registry, std::string_view name);

}  // namespace weft::graph::expansion
