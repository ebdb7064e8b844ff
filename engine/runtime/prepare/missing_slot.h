// Messages for slots and parameters that a shader does not declare as what they must be: what carries the name instead, and
// which names would fit. Shared by the check of a linked program (program_check.h) and that of its words (word_check.h).
// Does not: find out whether something is missing.
#pragma once

#include <string>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/graph/flat_graph.h"
#include "engine/runtime/prepare/shader_words.h"

namespace weft::runtime {

bool isSlotOf(const graph::FlatGraph& graph, const graph::PassSpec& spec, const std::string& name);
// Fills in a W181 whose slot no introspection has. `declared`: all names that the texts declare.
void sayMissingSlot(const graph::FlatGraph& graph, const graph::PassSpec& spec, const graph::SlotSpec& slot,
                    const ShaderWords& words, const std::string& shaders,
                    const std::vector<std::string>& declared, base::Diagnostic& d);
// Fills in a W182.
void sayMissingParameter(const graph::UniformSpec& uniform, const ShaderWords& words,
                         const std::string& shaders, const std::vector<std::string>& declared,
                         base::Diagnostic& d);
// Fills in a W187 for a block that has the parameters of the pass, under another name.
void sayBlockName(const std::string& block, const std::string& shaders, base::Diagnostic& d);
// Fills in a W187 for a member of the block Parameters that the pass does not set.
void sayUnset(const std::string& member, const std::string& type, const graph::PassSpec& spec,
              const std::string& shaders, base::Diagnostic& d);
// Fills in a W183: the fragment shader has an output of the slot's name, and the texture is a depth texture.
void sayOutputToDepth(const graph::FlatGraph& graph, const graph::SlotSpec& slot, base::Diagnostic& d);
// The first format among the words of an image's layout, when none of them is the texture's; "" when they agree.
std::string otherFormat(const std::vector<std::string>& words, graph::Format format);
// Fills in a W183: the image is declared with another format than its texture has.
void sayImageFormat(const graph::FlatGraph& graph, const graph::SlotSpec& slot, const std::string& other,
                    const std::string& shaders, base::Diagnostic& d);

}  // namespace weft::runtime
