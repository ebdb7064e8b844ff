#include "engine/runtime/prepare/missing_slot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/nearest.h"
#include "engine/graph/subresource.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/runtime/prepare/shader_advice.h"

namespace weft::runtime {

namespace {

const char* neededFor(graph::Kind kind) {
  switch (kind) {
    case graph::Kind::sampled:
      return "a sampler";
    case graph::Kind::image:
      return "an image";
    case graph::Kind::uniform:
      return "a uniform block";
    case graph::Kind::storage:
      return "a storage block";
    default:
      return "an output";
  }
}

}  // namespace

bool isSlotOf(const graph::FlatGraph& graph, const graph::PassSpec& spec, const std::string& name) {
  for (std::uint32_t i = 0; i < spec.slotCount; ++i)
    if (graph.slots[spec.firstSlot + i].name == name) return true;
  return false;
}

void sayMissingSlot(const graph::FlatGraph& graph, const graph::PassSpec& spec, const graph::SlotSpec& slot,
                    const ShaderWords& words, const std::string& shaders,
                    const std::vector<std::string>& declared, base::Diagnostic& d) {
  const graph::FlatUse& use = graph.uses[slot.firstUse];
  const std::string declaration = declarationFor(slot, slot.kind, use, graph.resources[use.resource]);
  d.expected = fmt::format("{} named '{}'", neededFor(slot.kind), slot.name);
  const std::string what = words.whatIs(slot.name);
  if (what.empty()) {
    d.message = fmt::format("slot '{}' is not in the shader '{}'", slot.name, shaders);
    d.hint = base::nearestHint(slot.name, declared);
    if (slot.inherited)
      d.hint = fmt::format("take it away: \"{}\": {{ \"{}\": null }}", graph::nameOf(slot.access), slot.name);
    else if (!d.hint.starts_with("did you mean"))
      d.hint = fmt::format("declare `{}`{}{}", declaration, d.hint.empty() ? "" : "; ", d.hint);
    return;
  }
  d.message = fmt::format("slot '{}' is {} in the shader '{}', not {}", slot.name, what, shaders,
                          neededFor(slot.kind));
  std::vector<std::string> fitting = words.namesFor(slot.kind);
  std::erase_if(fitting, [&](const std::string& name) { return isSlotOf(graph, spec, name); });
  if (fitting.size() == 1)
    d.hint = fmt::format("did you mean '{}'?", fitting[0]);
  else if (!fitting.empty())
    d.hint = fmt::format("the shader has {}", fmt::join(fitting, ", "));
  else
    d.hint = fmt::format("rename the slot and declare it: `{}`", declaration);
}

void sayMissingParameter(const graph::UniformSpec& uniform, const ShaderWords& words,
                         const std::string& shaders, const std::vector<std::string>& declared,
                         base::Diagnostic& d) {
  const std::string what = words.whatIs(uniform.name);
  const std::string nearest = what.empty() ? base::nearestName(uniform.name, declared) : "";
  d.message =
      what.empty()
          ? fmt::format("parameter '{}' is not in the shader '{}'", uniform.name, shaders)
          : fmt::format("parameter '{}' is {} in the shader '{}', not a member of the block Parameters",
                        uniform.name, what, shaders);
  const bool own = what == "a variable" || what == "a constant";
  if (what.empty() || own)
    d.hint = fmt::format("declare it: `layout(std140) uniform Parameters {{ {} {}; }};`{}",
                         memberTypeFor(uniform.value), uniform.name,
                         own ? fmt::format(", and take {} away", fmt::format("the {}", what.substr(2)))
                         : nearest.empty() ? ""
                                           : fmt::format(", or did you mean '{}'?", nearest));
  else
    d.hint =
        "give the parameter another name, and declare that in `layout(std140) uniform Parameters { … };`";
}

void sayBlockName(const std::string& block, const std::string& shaders, base::Diagnostic& d) {
  d.message = fmt::format("the shader '{}' has its parameters in a uniform block '{}'", shaders, block);
  d.expected = "a uniform block 'Parameters'";
  d.found = fmt::format("uniform {} {{ … }}", block);
  d.hint = "call it 'Parameters'";
}

void sayUnset(const std::string& member, const std::string& type, const graph::PassSpec& spec,
              const std::string& shaders, base::Diagnostic& d) {
  d.message = fmt::format("the shader '{}' reads the parameter '{}', which pass '{}' does not set", shaders,
                          member, spec.declared);
  if (type.ends_with(']')) {
    d.message = fmt::format("the shader '{}' reads the parameter '{}', an array, which no graph can set",
                            shaders, member);
    d.expected = "a number or a vector";
    d.found = fmt::format("{} {}", type, member);
    d.hint =
        "make it a constant of the shader, one member for each element, or rows of a storage buffer that a "
        "pass writes";
    return;
  }
  d.expected = fmt::format("\"parameters\": {{ \"{}\": … }}, of type {}", member, type);
  d.hint = fmt::format("set it, or guard the member and its use with `#ifdef {}`", presenceDefineOf(member));
}

void sayOutputToDepth(const graph::FlatGraph& graph, const graph::SlotSpec& slot, base::Diagnostic& d) {
  const graph::FlatUse& use = graph.uses[slot.firstUse];
  const char* const format = graph::infoOf(graph.resources[use.resource].format).name;
  d.resource = graph.resourceNames[use.resource];
  d.message = fmt::format("slot '{}' is an output of the shader, and its texture is one of depth", slot.name);
  d.expected = "a texture with a color format, such as r32f or rgba16f";
  d.found = format;
  d.hint = fmt::format("give '{}' a color format, or write gl_FragDepth and take the output '{}' away",
                       d.resource, slot.name);
}

std::string otherFormat(const std::vector<std::string>& words, graph::Format format) {
  std::string other;
  for (const std::string& word : words)
    if (const auto named = graph::findFormat(word)) {
      if (*named == format) return {};
      other = word;
    }
  return other;
}

void sayImageFormat(const graph::FlatGraph& graph, const graph::SlotSpec& slot, const std::string& other,
                    const std::string& shaders, base::Diagnostic& d) {
  const graph::FlatUse& use = graph.uses[slot.firstUse];
  const graph::FlatResource& resource = graph.resources[use.resource];
  const char* const own = graph::infoOf(resource.format).name;
  d.message =
      fmt::format("slot '{}' is a texture of {}, and the shader's image of {}", slot.name, own, other);
  d.resource = graph.resourceNames[use.resource];
  d.expected = fmt::format("layout({})", own);
  d.found = fmt::format("layout({}) in '{}'", other, shaders);
  d.hint = fmt::format("declare `{}`, or make the texture {}",
                       declarationFor(slot, graph::Kind::image, use, resource), other);
}

}  // namespace weft::runtime
