// Declared in print.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "engine/graph/language/keys.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

namespace {

// "step 3", "steps 2..end"
std::string stepsText(const Plan& plan, std::uint32_t r) {
  const std::uint32_t first = plan.firstStep[r], last = plan.lastStep[r];
  const std::string end = last == plan.steps.size() ? "end" : fmt::to_string(last);
  return first == last ? "step " + end : fmt::format("steps {}..{}", first, end);
}

// Whether two transient resources are in the same memory.
bool shareStorage(const Plan& plan, std::uint32_t a, std::uint32_t b) {
  if (plan.storageOf[a] != kNone && plan.storageOf[a] == plan.storageOf[b]) return true;
  const std::uint64_t from = plan.bufferOffsetOf[a], other = plan.bufferOffsetOf[b];
  return from != Plan::kNoOffset && other != Plan::kNoOffset &&
         other < from + plan.graph->resources[a].bytes && from < other + plan.graph->resources[b].bytes;
}

std::string textOf(const FlatGraph& graph, const BarrierAccess& access) {
  const std::string what = textOf(graph, access.use);
  if (access.pass == kNone) return fmt::format("the end of the frame reads '{}'", what);
  const std::string& pass = graph.passNames[access.pass];
  if (access.clear) return fmt::format("the clear before '{}' writes '{}'", pass, what);
  return fmt::format("'{}' {} '{}' as {}", pass, verbOf(access.use.access), what, nameOf(access.use.kind));
}

}  // namespace

std::string spanText(const char* part, std::uint32_t first, std::uint32_t count) {
  return count == 1 ? fmt::format(".{}[{}]", part, first)
                    : fmt::format(".{}[{}..{}]", part, first, first + count - 1);
}

std::string textOf(const FlatGraph& graph, const FlatUse& use) {
  const FlatResource& r = graph.resources[use.resource];
  std::string text = graph.resourceNames[use.resource];
  if (!isBuffer(r)) {
    if (use.mips < r.mips) text += spanText("mip", use.mip, use.mips);
    if (use.layers < r.layers) text += spanText("layer", use.layer, use.layers);
    if (planesOf(r) == 2 && (use.planes & 3) == 1) text += ".depth";
    if (planesOf(r) == 2 && (use.planes & 3) == 2) text += ".stencil";
  }
  return use.history > 0 ? fmt::format("{}@-{}", text, use.history) : text;
}

std::string textOf(const ImportType& type) {
  std::string text = fmt::format("@{}\n  {}\n", type.name, type.doc);
  for (const ImportArgument& argument : type.arguments)
    text += fmt::format("  {} (default {}): {}\n", argument.name, toText(argument.initial), argument.doc);
  for (const TableColumn& column : type.columns)
    text +=
        fmt::format("  .{} {}{}{}\n", column.name, column.type, column.doc.empty() ? "" : ": ", column.doc);
  return text;
}

nlohmann::ordered_json jsonOf(const Value& value) {
  switch (value.type) {
    case Value::Type::boolean:
      return value.truth();
    case Value::Type::number:
      return value.v[0];
    case Value::Type::list:
      return std::vector<double>(value.v.begin(), value.v.begin() + value.count);
    default:
      return value.symbol;
  }
}

std::string shapeText(const FlatResource& r) {
  if (isBuffer(r)) return fmt::format("buffer of {} bytes", r.bytes);
  std::string text = fmt::format("texture {} {}x{}", infoOf(r.format).name, r.width, r.height);
  if (r.depth > 1) text += fmt::format("x{}", r.depth);
  if (r.target != Target::texture_2d) text += fmt::format(" {}", nameOf(r.target));
  if (r.layers > 1) text += fmt::format(", {} layers", r.layers);
  if (r.mips > 1) text += fmt::format(", {} levels", r.mips);
  if (r.samples > 1) text += fmt::format(", {} samples", r.samples);
  return isImported(r) ? text : fmt::format("{}, {} bytes", text, r.bytes);
}

const char* nameOf(Target target) {
  constexpr const char* kNames[] = {"2d", "2d_array", "cube", "cube_array", "3d", "2d_multisample"};
  return kNames[static_cast<std::size_t>(target)];
}

std::string updateOf(const FlatPass& pass) {
  if (pass.cadence == Cadence::every) return fmt::format("every({})", pass.period);
  return std::string(kUpdateWords[static_cast<std::size_t>(pass.cadence)]);
}

Explainer::Explainer(const Plan& plan)
    : plan_(plan), graph_(*plan.graph), edges_(dependencies(*plan.graph)), reasons_(explainBarriers(plan)) {}

std::string Explainer::whyPass(std::uint32_t pass) const {
  using Type = Dependency::Type;
  const bool live = plan_.stepOf[pass] != kNone;
  const auto resourceName = [&](std::uint32_t r) { return graph_.resourceNames[r]; };
  const auto findEdge = [&](Type type, bool toLive) {
    const auto found = std::ranges::find_if(edges_, [&](const Dependency& edge) {
      return edge.from == pass && edge.type == type && (plan_.stepOf[edge.to] != kNone) == toLive &&
             (!live || plan_.writes(plan_.stepOf[pass], edge.resource));
    });
    return found == edges_.end() ? nullptr : &*found;
  };
  if (live) {
    const std::uint32_t step = plan_.stepOf[pass], shown = graph_.present.resource;
    if (graph_.passes[pass].sideEffect) return "runs: it has a side effect";
    if (shown != kNone && plan_.writes(step, shown))
      return fmt::format("runs: '{}' is presented", resourceName(shown));
    if (const Dependency* edge = findEdge(Type::read_after_write, true))
      return fmt::format("runs: '{}' reads '{}'", graph_.passNames[edge->to], resourceName(edge->resource));
    for (const std::uint32_t u : graph_.usesOf(pass))
      if (const std::uint32_t r = graph_.uses[u].resource;
          graph_.resources[r].history > 0 && plan_.writes(step, r))
        return fmt::format("runs: a later frame reads '{}'", resourceName(r));
    return "runs";
  }
  if (const Dependency* edge = findEdge(Type::read_after_write, false))
    return fmt::format("culled: '{}' is read only by culled passes, '{}' first", resourceName(edge->resource),
                       graph_.passNames[edge->to]);
  for (const bool toLive : {true, false})
    if (const Dependency* edge = findEdge(Type::write_after_write, toLive))
      return fmt::format("culled: '{}' overwrites '{}' before anything reads it", graph_.passNames[edge->to],
                         resourceName(edge->resource));
  for (const std::uint32_t u : graph_.usesOf(pass))
    if (graph_.uses[u].access != Access::read)
      return fmt::format("culled: nothing reads '{}'", resourceName(graph_.uses[u].resource));
  return "culled: it writes nothing and has no side effect";
}

std::string Explainer::whyHere(std::uint32_t pass) const {
  using Type = Dependency::Type;
  std::vector<std::pair<std::string, std::vector<std::string>>> reasons;  // with the stanzas of the passes
  for (const Dependency& edge : edges_) {
    if (edge.to != pass || plan_.stepOf[edge.from] == kNone) continue;
    Dependency read = edge;
    read.type = Type::read_after_write;
    if (edge.type == Type::write_after_write && std::ranges::find(edges_, read) != edges_.end())
      continue;  // it modifies
    const char* const why = edge.type == Type::read_after_write   ? "reads its"
                            : edge.type == Type::write_after_read ? "overwrites what it reads,"
                                                                  : "overwrites its";
    const std::string text = edge.type == Type::stated
                                 ? "as the file says"
                                 : fmt::format("{} '{}'", why, graph_.resourceNames[edge.resource]);
    auto known = std::ranges::find(reasons, text, [](const auto& each) { return each.first; });
    if (known == reasons.end()) known = reasons.insert(known, {text, {}});
    const std::string& name = graph_.passNames[edge.from];
    if (const std::string stanza = name.substr(0, name.find('['));
        std::ranges::find(known->second, stanza) == known->second.end())
      known->second.push_back(stanza);
  }
  std::string text;
  for (const auto& [why, stanzas] : reasons)
    text += fmt::format("{}'{}' ({})", text.empty() ? "after " : "; ", fmt::join(stanzas, "', '"), why);
  return text;
}

std::string Explainer::whyStorage(std::uint32_t resource) const {
  const FlatResource& r = graph_.resources[resource];
  if (isImported(r)) return "imported";
  if (plan_.firstStep[resource] == kNone) return "none: no live pass touches it";
  if (plan_.persistent[resource] != 0) {
    if (plan_.groups.slicedWriterOf(resource) != kNone)
      return fmt::format("its own: written over several frames beside what was published, it needs {} copies",
                         plan_.copiesOf(resource));
    if (r.history > 0) return fmt::format("its own: history of {} needs {} copies", r.history, r.history + 1);
    for (std::uint32_t step = 0; step < plan_.steps.size(); ++step)
      if (plan_.passOf(step).cadence != Cadence::always && plan_.writes(step, resource))
        return fmt::format("its own: '{}' does not write it in every frame",
                           graph_.passNames[plan_.steps[step].pass]);
  }
  constexpr std::size_t kNamed = 8;
  std::vector<std::string> others;
  std::size_t more = 0;
  for (std::uint32_t q = 0; q < graph_.resources.size(); ++q)
    if (q != resource && plan_.firstStep[q] != kNone && shareStorage(plan_, resource, q)) {
      if (others.size() < kNamed)
        others.push_back(fmt::format("'{}' ({})", graph_.resourceNames[q], stepsText(plan_, q)));
      else
        ++more;
    }
  if (more > 0) others.push_back(fmt::format("{} more", more));
  return others.empty()
             ? "its own: nothing else of its class fits before or after"
             : fmt::format("shared with {}, none of which lives while it does", fmt::join(others, ", "));
}

std::vector<std::string> Explainer::whyBarriers(std::uint32_t step, bool afterClears) const {
  std::vector<std::string> texts;
  for (const BarrierReason& reason : reasons_) {
    if (reason.step != step || reason.afterClears != afterClears) continue;
    const std::string ago = reason.framesAgo == 0   ? ""
                            : reason.framesAgo == 1 ? " in the frame before"
                                                    : fmt::format(" {} frames before", reason.framesAgo);
    texts.push_back(fmt::format("{}: {}{}, then {}", barrierName(reason.bit), textOf(graph_, reason.before),
                                ago, textOf(graph_, reason.after)));
  }
  return texts;
}

}  // namespace weft::graph
