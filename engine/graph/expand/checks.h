// Checks of uses against what they use: kind, access, format and pass type for one slot; sizes, layers,
// samples, overlaps and cadences for the slots of one pass; names of one pass. They report and never change
// anything.
#pragma once

#include "engine/graph/expand/slots.h"

namespace weft::graph::expansion {

// The kind of a use when nothing else is said (design: Kinds).
Kind defaultKind(const PassType* type, Access access, const FlatResource& shape);

// One use: the kind fits the resource, the access, the pass type and the format; sampler words fit.
bool checkUse(const SlotContext& context, const RefDesc& ref, Access access, const SlotWork& work);

// All uses of one pass: attachments of one size, layer count and sample count, nothing written twice, nothing
// read and written at once unless by feedback.
bool checkPassUses(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots);

const PassType* findPassType(const Registry& registry, std::string_view name);

}  // namespace weft::graph::expansion
