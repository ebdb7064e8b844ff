#include "engine/runtime/prepare/word_check.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/chars.h"
#include "engine/base/nearest.h"
#include "engine/glsl/tokens.h"
#include "engine/runtime/prepare/missing_slot.h"
#include "engine/runtime/prepare/pass_errors.h"

namespace weft::runtime {

using base::Code;
using graph::Access;
using graph::Kind;

namespace {

class WordChecker : PassErrors {
 public:
  WordChecker(const graph::Plan& plan, std::uint32_t pass, std::span<const gl::StageSource> stages,
              std::span<const glsl::Define> defines, RoleCache& cache, base::Diagnostics& diagnostics)
      : PassErrors(plan.graph->specs[pass].name, diagnostics),
        plan_(plan),
        graph_(*plan.graph),
        spec_(graph_.specs[pass]),
        pass_(pass),
        diagnostics_(diagnostics),
        stages_(stages),
        words_(stages, defines, cache) {}

  void run() {
    for (std::uint32_t i = 0; i < spec_.slotCount; ++i) checkSlot(graph_.slots[spec_.firstSlot + i]);
    std::string misnamed;  // block
    for (const graph::UniformSpec& uniform : spec_.uniforms) {
      if (words_.declaresParameter(uniform.name)) continue;
      const std::string block = words_.blockOf(uniform.name);
      if (!block.empty() && !isSlotOf(graph_, spec_, block)) {
        if (misnamed.empty())
          sayBlockName(block, shaders_, fail(Code::undeclaredShaderInput, spec_.shaderPlace, ""));
        misnamed = block;
        continue;
      }
      sayMissingParameter(uniform, words_, shaders_, declared(),
                          fail(Code::parameterNotInShader, uniform.place, ""));
    }
    warnTimeless(graph_, pass_, words_, diagnostics_);
    warnUnwritten(plan_, pass_, words_, diagnostics_);
    // One misspelling is one mistake.
    if (any()) return;
    for (const auto& [type, name] : words_.parameters())
      if (std::ranges::find(spec_.uniforms, name, &graph::UniformSpec::name) == spec_.uniforms.end())
        sayUnset(name, type, spec_, shaders_, fail(Code::undeclaredShaderInput, spec_.shaderPlace, ""));
  }

 private:
  void checkSlot(const graph::SlotSpec& slot) {
    if (slot.useCount == 0) return;
    if (slot.access != Access::read && !plan_.attached[slot.firstUse]) return;
    switch (slot.kind) {
      case Kind::sampled:
      case Kind::image:
      case Kind::uniform:
      case Kind::storage:
      case Kind::color:
        if (slot.kind == Kind::color && givesRasterAlone(plan_, pass_, slot.firstUse)) return;
        if (!words_.declares(slot.name, slot.kind))
          sayMissingSlot(graph_, spec_, slot, words_, shaders_, declared(),
                         fail(Code::slotNotInShader, slot.place, ""));
        else if (slot.kind == Kind::image)
          checkImageFormat(slot);
        return;
      case Kind::depth:
        if (words_.hasOutput(slot.name))
          sayOutputToDepth(graph_, slot, fail(Code::slotTypeMismatch, slot.place, ""));
        return;
      default:
        return;
    }
  }

  void checkImageFormat(const graph::SlotSpec& slot) {
    if (!words_.uses(slot.name)) return;
    const std::string other = otherFormat(words_.imageFormatsOf(slot.name),
                                          graph_.resources[graph_.uses[slot.firstUse].resource].format);
    if (!other.empty())
      sayImageFormat(graph_, slot, other, shaders_, fail(Code::slotTypeMismatch, slot.place, ""));
  }

  const std::vector<std::string>& declared() {
    if (declared_.empty())
      for (const gl::StageSource& stage : stages_)
        declared_.insert(declared_.end(), stage.source->declared.begin(), stage.source->declared.end());
    std::ranges::sort(declared_);
    declared_.erase(std::ranges::unique(declared_).begin(), declared_.end());
    return declared_;
  }

  const graph::Plan& plan_;
  const graph::FlatGraph& graph_;
  const graph::PassSpec& spec_;
  const std::uint32_t pass_;
  base::Diagnostics& diagnostics_;
  const std::span<const gl::StageSource> stages_;
  const ShaderWords words_;
  std::vector<std::string> declared_;
  // For messages, between quotes.
  const std::string shaders_ =
      spec_.vertexShader.empty() ? spec_.shader : spec_.vertexShader + "' and '" + spec_.shader;
};

}  // namespace

void checkWords(const graph::Plan& plan, std::uint32_t pass, std::span<const gl::StageSource> stages,
                std::span<const glsl::Define> defines, RoleCache& cache, base::Diagnostics& diagnostics) {
  WordChecker(plan, pass, stages, defines, cache, diagnostics).run();
}

void warnTimeless(const graph::FlatGraph& graph, std::uint32_t pass, const ShaderWords& words,
                  base::Diagnostics& diagnostics) {
  if (graph.passes[pass].cadence == graph::Cadence::always) return;
  const graph::PassSpec& spec = graph.specs[pass];
  for (const char* const member : {"time", "delta_time", "frame"}) {
    if (!words.usesOfView(member)) continue;
    const std::string message =
        fmt::format("pass '{}' does not run in every frame, and its shader reads '{}', which is 0 there",
                    spec.declared, member);
    const auto isSaid = [&](const base::Diagnostic& d) {
      return d.code == Code::cadenceMisfit && d.message == message;
    };
    if (std::ranges::any_of(diagnostics.items(), isSaid)) return;  // of another repeat
    base::Diagnostic& d = diagnostics.warning(Code::cadenceMisfit, spec.place, message);
    d.pass = spec.name;
    d.hint = fmt::format("leave \"update\" out of '{}' if its picture is to move", spec.declared);
    return;
  }
}

void warnUnwritten(const graph::Plan& plan, std::uint32_t pass, const ShaderWords& words,
                   base::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan.graph;
  const graph::PassSpec& spec = graph.specs[pass];
  for (std::uint32_t i = 0; i < spec.slotCount; ++i) {
    const graph::SlotSpec& slot = graph.slots[spec.firstSlot + i];
    if (slot.useCount == 0 || slot.kind != Kind::color || !plan.attached[slot.firstUse]) continue;
    if (!words.hasOutput(slot.name) || words.mayWrite(slot.name)) continue;
    const std::string message =
        fmt::format("pass '{}': the shader '{}' declares its output '{}' and never writes it", spec.declared,
                    spec.shader, slot.name);
    const auto isSaid = [&](const base::Diagnostic& d) {
      return d.code == Code::slotNotInShader && d.message == message;
    };
    if (std::ranges::any_of(diagnostics.items(), isSaid)) continue;  // of another repeat
    base::Diagnostic& d = diagnostics.warning(Code::slotNotInShader, slot.place, message);
    d.pass = spec.name;
    d.resource = graph.resourceNames[graph.uses[slot.firstUse].resource];
    d.hint = fmt::format("assign '{}' in main(), or take the slot out: what is in '{}' is undefined",
                         slot.name, d.resource);
  }
}

namespace {

// A define that is 0, and "#ifdef" of it: it is defined, whatever it is.
void warnOfTests(const std::string& pass, const gl::StageSource& stage, std::span<const glsl::Define> defines,
                 base::Diagnostics& diagnostics) {
  const auto isOff = [](const glsl::Define& define) { return define.value == "0"; };
  if (std::ranges::none_of(defines, isOff)) return;
  for (const glsl::Token& word : glsl::onlyTested(stage.source->text)) {
    const auto off = std::ranges::find_if(
        defines, [&](const glsl::Define& define) { return isOff(define) && define.name == word.text; });
    if (off == defines.end()) continue;
    const base::Place place = stage.source->placeOf(word.line, word.column);
    const auto isSaid = [&](const base::Diagnostic& d) {
      return d.code == Code::undeclaredShaderInput && base::isSamePlace(d.place.inFile(), place);
    };
    if (std::ranges::any_of(diagnostics.items(), isSaid)) continue;
    base::Diagnostic& d = diagnostics.warning(
        Code::undeclaredShaderInput, place,
        fmt::format("'{}' is 0 here, and the shader asks only whether it is defined, which it always is",
                    off->name));
    d.pass = pass;
    d.hint = fmt::format("write '#if {}' for '#ifdef', '#if !{}' for '#ifndef'", off->name, off->name);
  }
}

}  // namespace

void warnOfConditions(const std::string& pass, std::span<const gl::StageSource> stages,
                      std::span<const glsl::Define> defines, base::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const glsl::Define& define : defines) names.push_back(define.name);
  for (const gl::StageSource& stage : stages) warnOfTests(pass, stage, defines, diagnostics);
  for (const gl::StageSource& stage : stages)
    for (const glsl::UnknownCondition& unknown : glsl::unknownInConditions(stage.source->text, defines)) {
      const auto likeIt = [&](const std::string& name) {
        return base::lowered(name) == base::lowered(unknown.word.text);
      };
      const auto other = std::ranges::find_if(names, likeIt);
      // A word that is only asked for may well be a slot that this pass does not have.
      const std::string meant = other != names.end() ? *other
                                : unknown.value      ? base::nearestName(unknown.word.text, names)
                                                     : "";
      const base::Place place = stage.source->placeOf(unknown.word.line, unknown.word.column);
      if (meant.empty() || std::ranges::any_of(diagnostics.items(), [&](const base::Diagnostic& d) {
            return d.code == Code::undeclaredShaderInput && base::isSamePlace(d.place.inFile(), place);
          }))
        continue;
      base::Diagnostic& d =
          diagnostics.warning(Code::undeclaredShaderInput, place,
                              fmt::format("nothing defines '{}': {}", unknown.word.text,
                                          unknown.value ? "to the compiler it is 0" : "it never is"));
      d.pass = pass;
      d.hint = fmt::format("did you mean '{}'?", meant);
    }
}

}  // namespace weft::runtime
