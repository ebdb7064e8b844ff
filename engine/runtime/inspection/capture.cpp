#include "engine/runtime/inspection/capture.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/graph/subresource.h"

namespace weft::runtime {

namespace {

bool isWanted(std::string_view resource, std::span<const std::string> patterns) {
  const auto fits = [](std::string_view pattern, std::string_view name) {
    for (;;) {  // the name and each suffix of it
      if (graph::matchesPattern(pattern, name)) return true;
      const std::size_t dot = name.find('.');
      if (dot == std::string_view::npos) return false;
      name.remove_prefix(dot + 1);
    }
  };
  return std::ranges::any_of(patterns, [&](const std::string& pattern) {
    return fits(pattern, pattern.find('#') == std::string::npos ? graph::sharedName(resource) : resource);
  });
}

// Whether the item has its content: its pass has results; or, where it names none, any pass that writes the resource.
bool isThere(const Execution& execution, const CaptureItem& item) {
  if (!item.target.pass.empty()) return execution.steps().hasResults(item.step);
  const graph::Plan& plan = execution.plan();
  bool written = false;
  for (std::uint32_t step = 0; step <= item.step; ++step) {
    bool writes = false;
    plan.forEachWrite(step, [&](const graph::FlatUse& use) {
      writes |= plan.graph->resourceNames[use.resource] == item.target.resource;
    });
    if (writes && execution.steps().hasResults(step)) return true;
    written |= writes;
  }
  return !written;
}

}  // namespace

std::vector<CaptureItem> captureItems(const graph::Plan& plan, std::span<const std::string> patterns) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<CaptureItem> items;
  for (std::uint32_t step = 0; step < plan.steps.size(); ++step) {
    const std::uint32_t p = plan.steps[step].pass;
    const auto begin = static_cast<std::ptrdiff_t>(items.size());
    plan.forEachWrite(step, [&](const graph::FlatUse& use) {
      if (!isWanted(graph.resourceNames[use.resource], patterns)) return;
      const graph::FlatResource& resource = graph.resources[use.resource];
      const bool buffer = resource.kind == graph::ResourceKind::buffer;
      const auto add = [&](std::uint32_t mip, std::uint32_t layer, bool stencil) {
        const CaptureItem item{step,
                               {.resource = graph.resourceNames[use.resource],
                                .pass = graph.passNames[p],
                                .mip = mip,
                                .layer = layer,
                                .stencil = stencil}};
        if (std::find(items.begin() + begin, items.end(), item) == items.end()) items.push_back(item);
      };
      if (buffer) return add(0, 0, false);
      const bool volume = resource.target == graph::Target::texture_3d;
      for (std::uint32_t mip = use.mip; mip < std::uint32_t{use.mip} + use.mips; ++mip) {
        const std::uint32_t first = volume ? 0 : use.layer,
                            count = volume ? graph::slicesOf(resource, mip) : use.layers;
        for (std::uint32_t layer = first; layer < first + count; ++layer) {
          if (!graph::hasStencil(resource.format) || (use.planes & 1)) add(mip, layer, false);
          if (graph::hasStencil(resource.format) && (use.planes & 2)) add(mip, layer, true);
        }
      }
    });
  }
  return items;
}

std::optional<CaptureItem> captureItemOf(const graph::Plan& plan, const graph::Pick& pick,
                                         text::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan.graph;
  const auto found = graph::findPick(graph, pick, diagnostics);
  if (!found) return std::nullopt;
  std::uint32_t last = graph::kNone;
  for (std::uint32_t step = 0; step < plan.steps.size(); ++step)
    if (plan.writes(step, found->resource) &&
        (found->pass == graph::kNone || found->pass == plan.steps[step].pass))
      last = step;
  // No pass writes it: it is an import, or has version zero only.
  if (last == graph::kNone && found->pass == graph::kNone && plan.firstStep[found->resource] != graph::kNone)
    last = std::min(plan.firstStep[found->resource], static_cast<std::uint32_t>(plan.steps.size() - 1));
  const bool table = graph.resources[found->resource].kind == graph::ResourceKind::imported_buffer;
  if (last == graph::kNone || table) {
    text::Diagnostic& d =
        diagnostics.error(text::Code::presentsUnwritten, text::placeOfOption(pick.option + " " + pick.text),
                          table ? fmt::format("'{}' is a table of the scene and no texture", pick.name)
                                : fmt::format("no pass that runs touches '{}'", pick.name));
    d.resource = graph.resourceNames[found->resource];
    return std::nullopt;
  }
  return CaptureItem{last,
                     {.resource = graph.resourceNames[found->resource],
                      .pass = found->pass == graph::kNone ? "" : graph.passNames[found->pass],
                      .mip = pick.mip,
                      .layer = pick.layer,
                      .history = pick.history,
                      .stencil = pick.stencil}};
}

void Capture::start(Execution& execution, std::vector<CaptureItem> items, Visit visit) {
  items_ = std::move(items);
  visit_ = std::move(visit);
  execution.watch({.after = [this, &execution](std::uint32_t step) {
    for (std::size_t i = 0; i < items_.size(); ++i)
      if (items_[i].step == step && isThere(execution, items_[i]) &&
          inspector_.look(execution, items_[i].target))
        visit_(i, inspector_);
  }});
}

void Capture::stop(Execution& execution) {
  execution.watch({});
  visit_ = {};
}

}  // namespace weft::runtime
