// A plan as JSON. Declared in print.h.
#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "engine/graph/print/explain.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"
#include "engine/text/printable.h"

namespace weft::graph {

namespace {

using nlohmann::ordered_json;

ordered_json useJson(const Plan& plan, std::uint32_t u, const std::string& slot) {
  const FlatUse& use = plan.graph->uses[u];
  ordered_json json;
  if (!slot.empty()) json["slot"] = slot;
  json["access"] = nameOf(use.access);
  json["kind"] = nameOf(use.kind);
  json["resource"] = plan.graph->resourceNames[use.resource];
  json["range"] = textOf(*plan.graph, use);
  json["attached"] = plan.attached[u] != 0;
  if (use.history > 0) json["history"] = use.history;
  return json;
}

}  // namespace

std::string dumpJson(const Plan& plan, bool explain) {
  const FlatGraph& graph = *plan.graph;
  const std::vector<std::string> slots = slotNames(graph);
  std::optional<Explainer> explainer;
  if (explain) explainer.emplace(plan);
  const auto whyBarriers = [&](std::uint32_t step) {
    std::vector<std::string> why = explainer->whyBarriers(step, false);
    std::ranges::move(explainer->whyBarriers(step, true), std::back_inserter(why));
    return why;
  };

  ordered_json json;
  json["name"] = graph.name;
  json["bytes"] = {{"declared", plan.bytesDeclared},
                   {"allocated", plan.bytesAllocated},
                   {"lower_bound", plan.bytesLowerBound},
                   {"arena", plan.arenaBytes},
                   {"bound", plan.bytesBound}};
  json["steps"] = ordered_json::array();
  for (std::uint32_t t = 0; t < plan.steps.size(); ++t) {
    const Step& step = plan.steps[t];
    const FlatPass& pass = graph.passes[step.pass];
    ordered_json s;
    s["pass"] = graph.passNames[step.pass];
    s["update"] = nameOf(pass.cadence);
    if (pass.slices != 1) s["slices"] = pass.slices;
    s["barriers"] = barrierNames(step.barriers);
    s["clears"] = ordered_json::array();
    for (std::uint32_t c = step.firstClear; c < step.firstClear + step.clearCount; ++c)
      s["clears"].push_back(textOf(graph, plan.clears[c].use));
    if (step.barriersAfterClears != 0) s["barriers_after_clears"] = barrierNames(step.barriersAfterClears);
    s["uses"] = ordered_json::array();
    for (std::uint32_t u = pass.firstUse; u < pass.firstUse + pass.useCount; ++u)
      s["uses"].push_back(useJson(plan, u, slots[u]));
    const FramebufferText framebuffer = framebufferOf(plan, step.pass);
    if (!framebuffer.empty())
      s["framebuffer"] = {{"size", {framebuffer.width, framebuffer.height}},
                          {"color", framebuffer.color},
                          {"depth", framebuffer.depth}};
    if (explain) {
      s["why"] = explainer->whyPass(step.pass);
      s["why_here"] = explainer->whyHere(step.pass);
      s["why_barriers"] = whyBarriers(t);
    }
    json["steps"].push_back(std::move(s));
  }
  json["final_barriers"] = barrierNames(plan.finalBarriers);
  if (explain) json["why_final_barriers"] = whyBarriers(static_cast<std::uint32_t>(plan.steps.size()));
  if (graph.present.resource != kNone) json["present"] = textOf(graph, graph.present);
  json["outputs"] = ordered_json::array();
  for (std::size_t i = 0; i < graph.outputs.size(); ++i)
    json["outputs"].push_back({{"name", graph.outputNames[i]},
                               {"resource", textOf(graph, graph.outputs[i])},
                               {"live", plan.outputLive[i] != 0}});
  json["culled"] = ordered_json::array();
  for (std::uint32_t p = 0; p < graph.passes.size(); ++p) {
    if (plan.stepOf[p] != kNone) continue;
    ordered_json c{{"pass", graph.passNames[p]}};
    if (explain) c["why"] = explainer->whyPass(p);
    json["culled"].push_back(std::move(c));
  }
  json["disabled"] = ordered_json::array();
  for (const DisabledPass& d : graph.disabled) json["disabled"].push_back({{"pass", d.name}, {"why", d.why}});
  json["storages"] = ordered_json::array();
  for (const Storage& s : plan.storages)
    json["storages"].push_back({{"target", nameOf(s.target)},
                                {"format", infoOf(s.format).name},
                                {"width", s.width},
                                {"height", s.height},
                                {"depth", s.depth},
                                {"layers", s.layers},
                                {"mips", s.mips},
                                {"samples", s.samples},
                                {"copies", s.copies},
                                {"shared", s.shared},
                                {"persistent", s.persistent},
                                {"bytes", s.bytes}});
  json["resources"] = ordered_json::array();
  for (std::uint32_t r = 0; r < graph.resources.size(); ++r) {
    const FlatResource& resource = graph.resources[r];
    ordered_json j{
        {"name", graph.resourceNames[r]}, {"bytes", resource.bytes}, {"imported", isImported(resource)}};
    if (!isBuffer(resource)) {
      j["format"] = infoOf(resource.format).name;
      j["size"] = {resource.width, resource.height};
    }
    if (resource.history > 0) j["history"] = resource.history;
    if (plan.copiesOf(r) > 1) j["copies"] = plan.copiesOf(r);
    if (plan.firstStep[r] != kNone) j["steps"] = ordered_json::array({plan.firstStep[r], plan.lastStep[r]});
    if (plan.storageOf[r] != kNone) j["storage"] = plan.storageOf[r];
    if (plan.bufferOffsetOf[r] != Plan::kNoOffset) j["offset"] = plan.bufferOffsetOf[r];
    if (explain) j["why"] = explainer->whyStorage(r);
    json["resources"].push_back(std::move(j));
  }
  return text::printableJson(json.dump(2, ' ', false, ordered_json::error_handler_t::replace)) + "\n";
}

}  // namespace weft::graph
