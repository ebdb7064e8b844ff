// The canonical text of a plan. Declared in print.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "engine/graph/print/explain.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"
#include "engine/text/printable.h"

namespace weft::graph {

namespace {

class TextWriter {
 public:
  TextWriter(const Plan& plan, bool explain) : plan_(plan), graph_(*plan.graph), slots_(slotNames(graph_)) {
    if (explain) explainer_.emplace(plan);
  }

  std::string write() {
    line(0, "plan {}", graph_.name.empty() ? "-" : graph_.name);
    line(0, "passes {} run {}", graph_.passes.size(), plan_.steps.size());
    line(0, "bytes declared {} allocated {} lower_bound {} arena {} bound {}", plan_.bytesDeclared,
         plan_.bytesAllocated, plan_.bytesLowerBound, plan_.arenaBytes, plan_.bytesBound);
    text_ += "\norder\n";
    for (std::uint32_t t = 0; t < plan_.steps.size(); ++t) addStep(t);
    addEnd();
    addTextures();
    addBuffers();
    addIdle();
    return std::move(text_);
  }

 private:
  template <class... Args>
  void line(std::size_t depth, fmt::format_string<Args...> format, Args&&... args) {
    text_ += std::string(2 * depth, ' ') + text::printable(fmt::format(format, std::forward<Args>(args)...)) +
             '\n';
  }
  void because(std::size_t depth, const std::string& why) {
    if (!why.empty()) line(depth, "why {}", why);
  }
  // The heading of a list, before its first line.
  void heading(bool& any, const char* text) {
    if (!std::exchange(any, true)) text_ += fmt::format("\n{}\n", text);
  }

  void addBarriers(const char* what, std::uint16_t mask, std::uint32_t step, bool after) {
    if (mask == 0) return;
    line(2, "{} {}", what, barrierText(mask));
    if (explainer_)
      for (const std::string& why : explainer_->whyBarriers(step, after)) because(3, why);
  }

  void addStep(std::uint32_t t) {
    const Step& step = plan_.steps[t];
    const FlatPass& pass = graph_.passes[step.pass];
    std::string head = fmt::format("{} {}", t, graph_.passNames[step.pass]);
    if (pass.cadence != Cadence::always) head += fmt::format(" update {}", nameOf(pass.cadence));
    if (pass.slices != 1) head += fmt::format(" slices {}", pass.slices);
    line(1, "{}{}", head, pass.sideEffect ? " side_effect" : "");
    if (explainer_) {
      because(2, explainer_->whyPass(step.pass));
      because(2, explainer_->whyHere(step.pass));
    }
    addBarriers("barrier", step.barriers, t, false);
    for (std::uint32_t c = step.firstClear; c < step.firstClear + step.clearCount; ++c)
      line(2, "clear {}", textOf(graph_, plan_.clears[c].use));
    addBarriers("barrier_after_clears", step.barriersAfterClears, t, true);
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) {
      const FlatUse& use = graph_.uses[u];
      line(2, "{}{}{} {} {}{}{}{}", nameOf(use.access), slots_[u].empty() ? "" : " ", slots_[u],
           nameOf(use.kind), textOf(graph_, use), use.feedback ? " feedback" : "", use.exact ? " exact" : "",
           plan_.attached[u] == 0 ? " (not attached: nobody reads it)" : "");
    }
    const FramebufferText framebuffer = framebufferOf(plan_, step.pass);
    if (framebuffer.empty()) return;
    std::string attachments;
    for (const std::string& color : framebuffer.color) attachments += " color " + color;
    if (!framebuffer.depth.empty()) attachments += " depth " + framebuffer.depth;
    line(2, "framebuffer {}x{}{}", framebuffer.width, framebuffer.height, attachments);
  }

  void addEnd() {
    text_ += "  end\n";
    addBarriers("barrier", plan_.finalBarriers, static_cast<std::uint32_t>(plan_.steps.size()), false);
    if (graph_.present.resource != kNone) line(2, "present {}", textOf(graph_, graph_.present));
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      line(2, "output {} {}{}", graph_.outputNames[i], textOf(graph_, graph_.outputs[i]),
           plan_.outputLive[i] != 0 ? "" : " (nothing makes it)");
  }

  void addTextures() {
    text_ += "\ntextures\n";
    std::vector<std::vector<std::uint32_t>> users(plan_.storages.size());
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r)
      if (plan_.storageOf[r] != kNone) users[plan_.storageOf[r]].push_back(r);
    for (std::size_t i = 0; i < users.size(); ++i) {
      const Storage& s = plan_.storages[i];
      std::string head = fmt::format("{} {} {}x{}", i, nameOf(s.target), s.width, s.height);
      if (s.target == Target::texture_3d) head += fmt::format("x{}", s.depth);
      head += fmt::format(" {}", infoOf(s.format).name);
      if (s.mips > 1) head += fmt::format(" mips {}", s.mips);
      if (s.layers > 1) head += fmt::format(" layers {}", s.layers);
      if (s.samples > 1) head += fmt::format(" samples {}", s.samples);
      if (s.copies > 1) head += fmt::format(" copies {}", s.copies);
      line(1, "{}{} bytes {}", head, s.persistent ? " persistent" : "", s.bytes);
      std::ranges::sort(users[i], {}, [&](std::uint32_t r) { return std::pair(plan_.firstStep[r], r); });
      for (const std::uint32_t r : users[i]) {
        const Format format = graph_.resources[r].format;
        line(2, "{} {}{}", lifetimeText(plan_, r), graph_.resourceNames[r],
             format == s.format ? "" : fmt::format(" as {}", infoOf(format).name));
        if (explainer_) because(3, explainer_->whyStorage(r));
      }
    }
  }

  void addBuffers() {
    bool any = false;
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r) {
      if (plan_.firstStep[r] == kNone || graph_.resources[r].kind != ResourceKind::buffer) continue;
      heading(any, "buffers");
      std::string where = " persistent";
      if (plan_.bufferOffsetOf[r] != Plan::kNoOffset)
        where = fmt::format(" offset {}", plan_.bufferOffsetOf[r]);
      else if (plan_.copiesOf(r) > 1)
        where += fmt::format(" copies {}", plan_.copiesOf(r));
      line(1, "{} {}{} bytes {}", graph_.resourceNames[r], lifetimeText(plan_, r), where,
           graph_.resources[r].bytes);
      if (explainer_) because(2, explainer_->whyStorage(r));
    }
  }

  void addIdle() {
    bool culled = false, disabled = false;
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) {
      if (plan_.stepOf[p] != kNone) continue;
      heading(culled, "culled");
      line(1, "{}", graph_.passNames[p]);
      if (explainer_) because(2, explainer_->whyPass(p));
    }
    for (const DisabledPass& each : graph_.disabled) {
      heading(disabled, "disabled");
      line(1, "{}{}", each.name, explainer_ ? ": " + each.why : "");
    }
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  const std::vector<std::string> slots_;
  std::optional<Explainer> explainer_;
  std::string text_;
};

}  // namespace

std::string dumpText(const Plan& plan, bool explain) {
  return TextWriter(plan, explain).write();
}

}  // namespace weft::graph
