#include "engine/graph/print/text.h"

#include <algorithm>

#include "engine/base/printable.h"
#include "engine/graph/print/explain.h"
#include "engine/graph/print/shared.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

namespace {

class Writer {
 public:
  Writer(const Plan& plan, bool explain) : plan_(plan), graph_(*plan.graph), slots_(slotNames(graph_)) {
    if (!explain) return;
    explainer_ = std::make_unique<Explainer>(plan);
    reasons_ = explainer_->whyBarriers();
  }

  std::string write() {
    line(0, "plan " + (graph_.name.empty() ? "-" : graph_.name));
    line(0, "passes " + std::to_string(graph_.passes.size()) + " run " + std::to_string(plan_.steps.size()));
    line(0, "bytes declared " + std::to_string(plan_.bytesDeclared) + " allocated " +
                std::to_string(plan_.bytesAllocated) + " lower_bound " +
                std::to_string(plan_.bytesLowerBound) + " arena " + std::to_string(plan_.arenaBytes) +
                " bound " + std::to_string(plan_.bytesBound));
    line(0, "");
    line(0, "order");
    for (std::uint32_t t = 0; t < plan_.steps.size(); ++t) writeStep(t);
    writeEnd();
    writeStorages();
    writeBuffers();
    writeCulled();
    return std::move(text_);
  }

 private:
  void line(int depth, const std::string& content) {
    // Two headings begin with an empty line.
    const std::size_t blank = content.starts_with('\n') ? 1 : 0;
    text_.append(blank, '\n');
    if (!content.empty())
      text_.append(static_cast<std::size_t>(2 * depth), ' ').append(base::printable(content.substr(blank)));
    text_ += '\n';
  }

  void writeBarriers(const char* what, std::uint16_t mask, std::uint32_t step, bool after) {
    if (mask == 0) return;
    line(2, std::string(what) + " " + barrierText(mask));
    for (const BarrierReason& reason : reasons_)
      if (reason.step == step && reason.afterClears == after) line(3, "why " + explainer_->textOf(reason));
  }

  void writeStep(std::uint32_t t) {
    const Step& step = plan_.steps[t];
    const FlatPass& pass = graph_.passes[step.pass];
    std::string head = std::to_string(t) + " " + graph_.passNames[step.pass];
    if (pass.cadence != Cadence::always) head += std::string(" update ") + nameOf(pass.cadence);
    if (pass.group != kNone && pass.group < graph_.groupNames.size())
      head += " group " + graph_.groupNames[pass.group];
    if (pass.slices != 1) head += " slices " + std::to_string(pass.slices);
    if (pass.sideEffect) head += " side_effect";
    line(1, head);
    if (explainer_) {
      line(2, "why " + explainer_->whyPass(step.pass));
      const std::string here = explainer_->whyHere(step.pass);
      if (!here.empty()) line(2, "why " + here);
    }
    writeBarriers("barrier", step.barriers, t, false);
    for (std::uint32_t c = step.firstClear; c < step.firstClear + step.clearCount; ++c)
      line(2, "clear " + textOf(graph_, plan_.clears[c].use));
    writeBarriers("barrier_after_clears", step.barriersAfterClears, t, true);
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u) writeUse(u);
    const FramebufferText framebuffer = framebufferOf(plan_, step.pass);
    if (framebuffer.empty()) return;
    std::string text =
        "framebuffer " + std::to_string(framebuffer.width) + "x" + std::to_string(framebuffer.height);
    for (const std::string& color : framebuffer.color) text += " color " + color;
    if (!framebuffer.depth.empty()) text += " depth " + framebuffer.depth;
    line(2, text);
  }

  void writeUse(std::uint32_t u) {
    const FlatUse& use = graph_.uses[u];
    std::string text = nameOf(use.access);
    if (!slots_[u].empty()) text += " " + slots_[u];
    text += std::string(" ") + nameOf(use.kind) + " " + textOf(graph_, use);
    if (use.feedback) text += " feedback";
    if (use.exact) text += " exact";
    if (plan_.attached[u] == 0) text += " (not attached: nobody reads it)";
    line(2, text);
  }

  void writeEnd() {
    line(1, "end");
    writeBarriers("barrier", plan_.finalBarriers, static_cast<std::uint32_t>(plan_.steps.size()), false);
    if (graph_.present.resource != kNone) line(2, "present " + textOf(graph_, graph_.present));
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      line(2, "output " + (i < graph_.outputNames.size() ? graph_.outputNames[i] : std::to_string(i)) + " " +
                  textOf(graph_, graph_.outputs[i]) +
                  (plan_.outputLive[i] != 0 ? "" : " (nothing makes it)"));
  }

  std::string lifetime(std::uint32_t r) const {
    const std::uint32_t first = plan_.firstStep[r], last = plan_.lastStep[r];
    return std::to_string(first) + ".." + (last == plan_.steps.size() ? "end" : std::to_string(last));
  }

  void writeStorages() {
    line(0, "");
    line(0, "textures");
    std::vector<std::vector<std::uint32_t>> users(plan_.storages.size());
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r)
      if (plan_.storageOf[r] != kNone) users[plan_.storageOf[r]].push_back(r);
    for (std::size_t i = 0; i < users.size(); ++i) {
      const Storage& s = plan_.storages[i];
      std::string head = std::to_string(i) + " " + nameOf(s.target) + " " + std::to_string(s.width) + "x" +
                         std::to_string(s.height);
      if (s.target == Target::texture_3d) head += "x" + std::to_string(s.depth);
      head += std::string(" ") + infoOf(s.format).name;
      if (s.mips > 1) head += " mips " + std::to_string(s.mips);
      if (s.layers > 1) head += " layers " + std::to_string(s.layers);
      if (s.samples > 1) head += " samples " + std::to_string(s.samples);
      if (s.copies > 1) head += " copies " + std::to_string(s.copies);
      if (s.persistent) head += " persistent";
      line(1, head + " bytes " + std::to_string(s.bytes));
      std::sort(users[i].begin(), users[i].end(), [&](std::uint32_t a, std::uint32_t b) {
        return plan_.firstStep[a] != plan_.firstStep[b] ? plan_.firstStep[a] < plan_.firstStep[b] : a < b;
      });
      for (const std::uint32_t r : users[i]) {
        std::string text = lifetime(r) + " " + graph_.resourceNames[r];
        if (graph_.resources[r].format != s.format)
          text += std::string(" as ") + infoOf(graph_.resources[r].format).name;
        line(2, text);
        if (explainer_) line(3, "why " + explainer_->whyStorage(r));
      }
    }
  }

  void writeBuffers() {
    bool any = false;
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r) {
      if (plan_.firstStep[r] == kNone || graph_.resources[r].kind != ResourceKind::buffer) continue;
      if (!any) line(0, "\nbuffers");
      any = true;
      std::string text = graph_.resourceNames[r] + " " + lifetime(r);
      if (plan_.bufferOffsetOf[r] != Plan::kNoOffset)
        text += " offset " + std::to_string(plan_.bufferOffsetOf[r]);
      else
        text += " persistent" +
                (plan_.copiesOf(r) > 1 ? " copies " + std::to_string(plan_.copiesOf(r)) : std::string());
      line(1, text + " bytes " + std::to_string(graph_.resources[r].bytes));
      if (explainer_) line(2, "why " + explainer_->whyStorage(r));
    }
  }

  void writeCulled() {
    bool any = false;
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p) {
      if (plan_.stepOf[p] != kNone) continue;
      if (!any) line(0, "\nculled");
      any = true;
      line(1, graph_.passNames[p]);
      if (explainer_) line(2, "why " + explainer_->whyPass(p));
    }
    for (std::size_t i = 0; i < graph_.disabled.size(); ++i) {
      if (i == 0) line(0, "\ndisabled");
      line(1, graph_.disabled[i].name + (explainer_ ? ": " + graph_.disabled[i].why : ""));
    }
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  const std::vector<std::string> slots_;
  std::unique_ptr<Explainer> explainer_;
  std::vector<BarrierReason> reasons_;
  std::string text_;
};

}  // namespace

std::string dumpText(const Plan& plan, bool explain) {
  return Writer(plan, explain).write();
}

}  // namespace weft::graph
