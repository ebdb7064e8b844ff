// Why a plan is as it is, words that all printed forms share, what a plan knows of a name (`weft explain`). Declared in print.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>
#include <vector>

#include "engine/graph/language/keys.h"
#include "engine/graph/language/names.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"
#include "graph_sentences.h"

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

// ".mip[2]" or ".mip[2..4]"
std::string spanText(const char* part, std::uint32_t first, std::uint32_t count) {
  return count == 1 ? fmt::format(".{}[{}]", part, first)
                    : fmt::format(".{}[{}..{}]", part, first, first + count - 1);
}

}  // namespace

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
    const std::string text = fmt::format("{} '{}'", why, graph_.resourceNames[edge.resource]);
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

// ---- what is known of one name ----

namespace {

// "hdr#2" and "maps[3]" are versions and elements of "hdr" and "maps".
std::string declaredName(const std::string& name) {
  return name.substr(0, name.find_first_of("#["));
}

std::string placeText(const Place& place) {
  return place.file ? fmt::format(" at {}:{}:{}", *place.file, place.line, place.column) : "";
}

std::string importText(const ImportSpec& import) {
  constexpr const char* kKinds[] = {"texture", "buffer", "view", "list", "event"};
  if (import.columns.empty())
    return fmt::format("{} @{}{}", kKinds[static_cast<std::size_t>(import.kind)], import.request.type,
                       import.kind == ImportKind::list ? fmt::format(", {} entries", import.count) : "");
  std::vector<std::string> columns;
  for (const TableColumn& column : import.columns)
    columns.push_back(fmt::format("{} {}", column.type, column.name));
  return fmt::format("table @{}, {} row{} of {}", import.request.type, import.count,
                     import.count == 1 ? "" : "s", fmt::join(columns, ", "));
}

class Describer {
 public:
  explicit Describer(const Plan& plan) : plan_(plan), graph_(*plan.graph), explainer_(plan) {
    const auto know = [&](const std::set<std::string>& names, const std::function<void()>& tell) {
      for (const std::string& name : names) things_.emplace(name, tell);
    };
    for (std::uint32_t p = 0; p < graph_.passes.size(); ++p)
      know({graph_.specs[p].declared, graph_.specs[p].name}, [this, p] { addPass(p); });
    for (const DisabledPass& disabled : graph_.disabled)
      know({disabled.name, declaredName(disabled.name)},
           [this, &disabled] { line(0, "pass {}: disabled, {}", disabled.name, disabled.why); });
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r)
      know({graph_.resourceNames[r], declaredName(graph_.resourceNames[r])}, [this, r] { addResource(r); });
    for (std::uint32_t i = 0; i < graph_.imports.size(); ++i)
      if (elementOf(graph_.imports[i].request) == 0)
        know({graph_.imports[i].name}, [this, i] { addImport(i); });
    for (const AliasSpec& alias : graph_.aliases) know({alias.name}, [this, &alias] { addAlias(alias); });
    for (std::uint32_t i = 0; i < graph_.parameters.size(); ++i)
      know({graph_.parameters[i].path}, [this, i] { addParameter(i); });
  }

  std::vector<std::string> names() const {
    std::set<std::string> all;
    for (const auto& [name, tell] : things_) all.insert(name);
    return {all.begin(), all.end()};
  }

  // Adds everything that has this name, each name once.
  void add(const std::string& name) {
    if (!told_.insert(name).second) return;
    const auto [first, last] = things_.equal_range(name);
    std::for_each(first, last, [](const auto& thing) { thing.second(); });
  }

  // Whether the pass, called so without an index, has a slot, parameter or define of the name. Adds what it does with it.
  bool addInPass(std::string_view pass, std::string_view name) {
    bool found = false;
    for (std::uint32_t i = 0; i < graph_.passes.size(); ++i) {
      if (graph_.specs[i].declared != pass) continue;
      addTitle(graph_.specs[i]);
      const std::size_t before = text_.size();
      addNames(i, name);
      found = found || text_.size() > before;
    }
    return found;
  }

  const std::string& text() const { return text_; }

 private:
  template <class... Args>
  void line(std::size_t depth, fmt::format_string<Args...> format, Args&&... args) {
    addLine(text_, depth, format, std::forward<Args>(args)...);
  }

  // Imports that no pass reads as a resource (views, events, lists that only expressions ask of), and those that the first
  // pass to read them calls otherwise.
  void addImport(std::uint32_t index) {
    const ImportSpec& import = graph_.imports[index];
    const auto resource = std::ranges::find(graph_.resources, index, &FlatResource::import);
    if (resource != graph_.resources.end()) {
      const auto r = static_cast<std::uint32_t>(resource - graph_.resources.begin());
      if (declaredName(graph_.resourceNames[r]) != import.name) addResource(r);
      return;
    }
    line(0, "import {}: {}{}", import.name, importText(import), placeText(import.place));
    addArguments(import);
    for (const PassSpec& spec : graph_.specs)
      if (spec.view == index) line(1, "is the view of '{}'", spec.name);
  }

  void addArguments(const ImportSpec& import) {
    for (const auto& [argument, value] : import.request.arguments)
      line(1, "argument {} = {}", argument, toText(value));
  }

  // What it stands for follows.
  void addAlias(const AliasSpec& alias) {
    std::vector<std::string> texts = alias.targets;
    std::ranges::copy(alias.texts, texts.begin());
    line(0, "name {}: {} '{}'{}", alias.name, texts.size() > 1 ? "the first that is there of" : "stands for",
         fmt::join(texts, "', '"), placeText(alias.place));
    for (const std::string& target : alias.targets) add(target);
  }

  void addPass(std::uint32_t pass) {
    const PassSpec& spec = graph_.specs[pass];
    const FlatPass& flat = graph_.passes[pass];
    const std::uint32_t step = plan_.stepOf[pass];
    addTitle(spec);
    if (step != kNone) line(1, "step {} of {}", step, plan_.steps.size());
    line(1, "{}", explainer_.whyPass(pass));
    if (const std::string here = explainer_.whyHere(pass); !here.empty()) line(1, "{}", here);
    if (flat.cadence != Cadence::always) line(1, "update {}", updateOf(flat));
    if (flat.slices != 1) line(1, "slices {}", flat.slices);
    if (!spec.vertexShader.empty()) line(1, "vertex shader {}", spec.vertexShader);
    if (!spec.shader.empty()) line(1, "shader {}", spec.shader);
    addNames(pass, "");
    if (step == kNone) return;
    for (const bool afterClears : {false, true})
      for (const std::string& why : explainer_.whyBarriers(step, afterClears)) line(1, "barrier {}", why);
  }

  void addTitle(const PassSpec& spec) {
    line(0, "pass {}: {}{}", spec.name, spec.type, placeText(spec.place));
  }

  // Defines, parameters and slots; all of them, or those of one name.
  void addNames(std::uint32_t pass, std::string_view only) {
    const PassSpec& spec = graph_.specs[pass];
    const auto wanted = [&](const std::string& name) { return only.empty() || name == only; };
    for (const DefineSpec& define : spec.defines)
      if (wanted(define.name)) line(1, "define {} {}", define.name, define.text);
    for (const UniformSpec& uniform : spec.uniforms) {
      if (!wanted(uniform.name)) continue;
      const std::vector<std::uint32_t> keys = uniform.dynamic.parameterKeys();
      const bool follows = !keys.empty() && keys.back() >= graph_.parameters.size();
      line(1, "parameter {} = {}{}{}", uniform.text(), toText(uniform.value),
           uniform.path.empty() ? "" : fmt::format(" ({})", uniform.path),
           follows                     ? ", follows an import"
           : uniform.dynamic.dynamic() ? ", changes with time"
                                       : "");
    }
    for (const SlotSpec& slot : graph_.slotsOf(spec))
      if (wanted(slot.name)) addSlot(slot, pass);
  }

  void addSlot(const SlotSpec& slot, std::uint32_t pass) {
    if (slot.useCount == 0)
      line(1, "{} {}: nothing, the shader has no HAS_… of it", nameOf(slot.access), slot.name);
    for (std::uint32_t u = slot.firstUse; u < slot.firstUse + slot.useCount; ++u) {
      const FlatUse& use = graph_.uses[u];
      line(1, "{} {}: {} as {}{}{}", nameOf(slot.access), slot.name, textOf(graph_, use), nameOf(use.kind),
           slot.access != Access::write ? madeBy(u, pass) : "",
           slot.access != Access::read && plan_.attached[u] == 0 ? ", not attached: nobody reads it" : "");
    }
    if (slot.firstValue != kNone)
      line(2, "until there is one: {}{}", textOf(graph_, graph_.uses[slot.firstValue]),
           madeBy(slot.firstValue, pass));
  }

  // ", made by 'sky', 'spheres'"
  std::string madeBy(std::uint32_t use, std::uint32_t pass) const {
    std::vector<std::string> makers;
    graph_.links.forEachWriter(graph_.links.seen[use], [&](std::uint32_t writer) {
      const std::uint32_t by = graph_.links.passOf[writer];
      const std::string& name = graph_.passNames[by];
      if ((by != pass || graph_.uses[use].history > 0) && std::ranges::find(makers, name) == makers.end())
        makers.push_back(name);
    });
    return makers.empty() ? "" : fmt::format(", made by '{}'", fmt::join(makers, "', '"));
  }

  void addResource(std::uint32_t r) {
    const FlatResource& resource = graph_.resources[r];
    std::string shape = shapeText(resource);
    if (resource.import != kNone && isBuffer(resource)) {
      shape = importText(graph_.imports[resource.import]);
      if (resource.bytes > 0) shape += fmt::format(", {} bytes", resource.bytes);
    }
    line(0, "resource {}: {}{}", graph_.resourceNames[r], shape,
         r < graph_.resourcePlaces.size() ? placeText(graph_.resourcePlaces[r]) : "");
    if (resource.import != kNone) addArguments(graph_.imports[resource.import]);
    if (resource.history > 0) line(1, "history of {}", resource.history);
    if (resource.hasClear) line(1, "has a \"clear\": a version before the first write");
    line(1, "storage {}", explainer_.whyStorage(r));
    for (std::uint32_t u = 0; u < graph_.uses.size(); ++u) {
      const FlatUse& use = graph_.uses[u];
      const std::uint32_t pass = graph_.links.passOf[u];
      if (use.resource != r || pass == kNone) continue;
      const char* const verb = use.access == Access::read    ? "read"
                               : use.access == Access::write ? "written"
                                                             : "modified";
      line(1, "{} by '{}' as {}: {}{}", verb, graph_.passNames[pass], nameOf(use.kind), textOf(graph_, use),
           plan_.stepOf[pass] == kNone ? ", culled" : "");
    }
    if (graph_.present.resource == r) line(1, "is presented");
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      if (graph_.outputs[i].resource == r) line(1, "is read back as output '{}'", graph_.outputNames[i]);
  }

  void addParameter(std::uint32_t index) {
    const ParameterSpec& parameter = graph_.parameters[index];
    line(0, "parameter {} = {}, from the {}{}", parameter.path, toText(parameter.value),
         wordFor(parameter.origin), placeText(parameter.desc.place));
    line(1, "{}",
         parameter.structural ? "structural: a change makes another plan"
                              : "live: a change writes bytes of uniforms");
    for (const PassSpec& spec : graph_.specs)
      for (const UniformSpec& uniform : spec.uniforms) {
        const std::vector<std::uint32_t> keys = uniform.dynamic.parameterKeys();
        const bool live = std::ranges::find(keys, index) != keys.end();
        if (live || uniform.path == parameter.path)
          line(1, "is read by '{}' as '{}'", spec.name, uniform.text());
      }
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  Explainer explainer_;
  std::multimap<std::string, std::function<void()>> things_;  // what adds them, by name
  std::string text_;
  std::set<std::string> told_;
};

}  // namespace

std::optional<std::string> describe(const Plan& plan, std::string_view name, text::Diagnostics& diagnostics) {
  Describer describer(plan);
  const std::vector<std::string> names = describer.names();
  const std::vector<std::size_t> matches = suffixMatches(names, name);
  // "@sun" where the graph declares one under a name of its own.
  const auto declared = std::ranges::find_if(plan.graph->imports, [&](const ImportSpec& import) {
    return matches.empty() && "@" + import.request.type == name;
  });
  if (matches.size() == 1 || declared != plan.graph->imports.end()) {
    describer.add(matches.empty() ? declared->name : names[matches[0]]);
    return describer.text();
  }
  std::vector<std::string> meant;
  for (const std::size_t match : std::span(matches).first(std::min<std::size_t>(matches.size(), 8)))
    meant.push_back(names[match]);
  if (meant.empty())
    diagnostics.error(say::nothingIsCalled, text::placeOfOption(""), name, suffixHint(name, names));
  else
    diagnostics.error(say::mayMeanSeveral, text::placeOfOption(""), name, fmt::join(meant, ", "), meant[0]);
  return std::nullopt;
}

std::string describeInPass(const Plan& plan, std::string_view pass, std::string_view name) {
  Describer describer(plan);
  return describer.addInPass(pass, name) ? describer.text() : "";
}

}  // namespace weft::graph
