#include "engine/graph/print/describe.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "engine/base/printable.h"
#include "engine/graph/language/suffix.h"
#include "engine/graph/print/explain.h"
#include "engine/graph/print/shared.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

namespace {

// "hdr#2" and "maps[3]" are versions and elements of "hdr" and "maps".
std::string declaredName(const std::string& name) {
  return name.substr(0, name.find_first_of("#["));
}

class Describer {
 public:
  explicit Describer(const Plan& plan)
      : plan_(plan), graph_(*plan.graph), explainer_(plan), reasons_(explainer_.whyBarriers()) {}

  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const PassSpec& spec : graph_.specs) {
      all.push_back(spec.declared);
      if (spec.name != spec.declared) all.push_back(spec.name);
    }
    for (const DisabledPass& disabled : graph_.disabled) all.push_back(disabled.name);
    for (const std::string& name : graph_.resourceNames) {
      all.push_back(declaredName(name));
      all.push_back(name);
    }
    for (const ImportSpec& import : graph_.imports) all.push_back(import.name);
    for (const AliasSpec& alias : graph_.aliases) all.push_back(alias.name);
    for (const ParameterSpec& parameter : graph_.parameters) all.push_back(parameter.path);
    std::ranges::sort(all);
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  // "@sun" where the graph declares one under a name of its own: that name.
  std::optional<std::string> declaredImport(std::string_view name) const {
    if (!name.starts_with('@')) return std::nullopt;
    const auto is = [&](const ImportSpec& import) { return import.request.type == name.substr(1); };
    const auto found = std::ranges::find_if(graph_.imports, is);
    return found == graph_.imports.end() ? std::nullopt : std::optional(found->name);
  }

  std::string describe(const std::string& name) {
    add(name);
    return std::move(text_);
  }

 private:
  void add(const std::string& name) {
    for (std::uint32_t pass = 0; pass < graph_.passes.size(); ++pass)
      if (graph_.specs[pass].name == name || graph_.specs[pass].declared == name) addPass(pass);
    for (const DisabledPass& disabled : graph_.disabled)
      if (disabled.name == name || declaredName(disabled.name) == name)
        line(0, fmt::format("pass {}: disabled, {}", disabled.name, disabled.why));
    for (std::uint32_t r = 0; r < graph_.resources.size(); ++r)
      if (graph_.resourceNames[r] == name || declaredName(graph_.resourceNames[r]) == name) addResource(r);
    addImports(name);
    addAliases(name);
    for (const ParameterSpec& parameter : graph_.parameters)
      if (parameter.path == name) addParameter(parameter);
  }

  // Imports that no pass reads as a resource (views, events, lists that only expressions ask of), and those that the first
  // pass to read them calls otherwise.
  void addImports(const std::string& name) {
    for (std::uint32_t i = 0; i < graph_.imports.size(); ++i) {
      const ImportSpec& import = graph_.imports[i];
      if (import.name != name || elementOf(import.request) > 0) continue;
      const auto resource = std::ranges::find(graph_.resources, i, &FlatResource::import);
      if (resource != graph_.resources.end()) {
        const auto r = static_cast<std::uint32_t>(resource - graph_.resources.begin());
        if (declaredName(graph_.resourceNames[r]) != name) addResource(r);
        continue;
      }
      line(0, fmt::format("import {}: {}{}", import.name, whatIs(import), textOf(import.place)));
      addArguments(import);
      for (const PassSpec& spec : graph_.specs)
        if (spec.view == i) line(1, fmt::format("is the view of '{}'", spec.name));
    }
  }

  // What they stand for follows, each once.
  void addAliases(const std::string& name) {
    for (const AliasSpec& alias : graph_.aliases) {
      if (alias.name != name || !told_.insert(name).second) continue;
      std::string text;
      for (std::size_t i = 0; i < alias.targets.size(); ++i) {
        const bool written = i < alias.texts.size();
        text += fmt::format("{}'{}'", text.empty() ? "" : ", ", written ? alias.texts[i] : alias.targets[i]);
      }
      line(0, fmt::format("name {}: {}{}{}", alias.name,
                          alias.targets.size() > 1 ? "the first that is there of " : "stands for ", text,
                          textOf(alias.place)));
      for (const std::string& target : alias.targets)
        if (!told_.contains(target)) {
          add(target);
          told_.insert(target);
        }
    }
  }

  static std::string whatIs(const ImportSpec& import) {
    constexpr const char* kKinds[] = {"texture", "buffer", "view", "list", "event"};
    std::string what =
        fmt::format("{} @{}", kKinds[static_cast<std::size_t>(import.kind)], import.request.type);
    if (!import.columns.empty()) {
      what = fmt::format("table @{}, {} row{} of", import.request.type, import.count,
                         import.count == 1 ? "" : "s");
      for (const TableColumn& column : import.columns)
        what +=
            fmt::format("{} {} {}", &column == import.columns.data() ? "" : ",", column.type, column.name);
    } else if (import.kind == ImportKind::list) {
      what += fmt::format(", {} entries", import.count);
    }
    return what;
  }

  void addArguments(const ImportSpec& import) {
    for (const auto& [argument, value] : import.request.arguments)
      line(1, fmt::format("argument {} = {}", argument, toText(value)));
  }

  void line(int depth, const std::string& text) {
    text_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + base::printable(text) + "\n";
  }

  static std::string textOf(const Place& place) {
    return place.file ? fmt::format(" at {}:{}:{}", *place.file, place.line, place.column) : "";
  }

  // ---- passes ----

  void addPass(std::uint32_t pass) {
    const PassSpec& spec = graph_.specs[pass];
    const FlatPass& flat = graph_.passes[pass];
    line(0, fmt::format("pass {}: {}{}", spec.name, spec.type, textOf(spec.place)));
    if (plan_.stepOf[pass] != kNone)
      line(1, fmt::format("step {} of {}", plan_.stepOf[pass], plan_.steps.size()));
    line(1, explainer_.whyPass(pass));
    if (const std::string here = explainer_.whyHere(pass); !here.empty()) line(1, here);
    if (flat.cadence != Cadence::always) line(1, fmt::format("update {}", nameOf(flat.cadence)));
    if (flat.slices != 1) line(1, fmt::format("slices {}", flat.slices));
    if (!spec.vertexShader.empty()) line(1, "vertex shader " + spec.vertexShader);
    if (!spec.shader.empty()) line(1, "shader " + spec.shader);
    for (const DefineSpec& define : spec.defines)
      line(1, fmt::format("define {} {}", define.name, define.text));
    for (const UniformSpec& uniform : spec.uniforms) addUniform(uniform);
    for (std::uint32_t i = 0; i < spec.slotCount; ++i) addSlot(graph_.slots[spec.firstSlot + i], pass);
    if (plan_.stepOf[pass] != kNone) addBarriers(plan_.stepOf[pass]);
  }

  void addUniform(const UniformSpec& uniform) {
    const std::string from = uniform.path.empty() ? "" : fmt::format(" ({})", uniform.path);
    const bool timed = uniform.dynamic.present() && uniform.dynamic.dynamic();
    line(1, fmt::format("parameter {} = {}{}{}", uniform.name, toText(uniform.value), from,
                        timed ? ", changes with time" : ""));
  }

  void addSlot(const SlotSpec& slot, std::uint32_t pass) {
    if (slot.useCount == 0) {
      line(1, fmt::format("{} {}: nothing, the shader has no HAS_… of it", nameOf(slot.access), slot.name));
      return;
    }
    for (std::uint32_t u = slot.firstUse; u < slot.firstUse + slot.useCount; ++u) {
      const FlatUse& use = graph_.uses[u];
      std::string text = fmt::format("{} {}: {} as {}", nameOf(slot.access), slot.name,
                                     weft::graph::textOf(graph_, use), nameOf(use.kind));
      if (slot.access != Access::write) text += madeBy(u, pass);
      if (slot.access != Access::read && plan_.attached[u] == 0) text += ", not attached: nobody reads it";
      line(1, text);
    }
    if (slot.firstValue != kNone)
      line(2,
           fmt::format("until there is one: {}{}", weft::graph::textOf(graph_, graph_.uses[slot.firstValue]),
                       madeBy(slot.firstValue, pass)));
  }

  // ", made by 'sky', 'spheres'"
  std::string madeBy(std::uint32_t use, std::uint32_t pass) const {
    std::string text;
    std::vector<std::uint32_t> seen;
    graph_.links.forEachWriter(graph_.links.seen[use], [&](std::uint32_t writer) {
      const std::uint32_t by = graph_.links.passOf[writer];
      if (by == pass && graph_.uses[use].history == 0) return;
      if (std::ranges::find(seen, by) != seen.end()) return;
      seen.push_back(by);
      text += fmt::format("{}'{}'", text.empty() ? ", made by " : ", ", graph_.passNames[by]);
    });
    return text;
  }

  void addBarriers(std::uint32_t step) {
    for (const BarrierReason& reason : reasons_)
      if (reason.step == step) line(1, "barrier " + explainer_.textOf(reason));
  }

  // ---- resources ----

  void addResource(std::uint32_t r) {
    const FlatResource& resource = graph_.resources[r];
    const Place place = r < graph_.resourcePlaces.size() ? graph_.resourcePlaces[r] : Place{};
    std::string what;
    if (resource.import != kNone && isBuffer(resource)) {
      what = whatIs(graph_.imports[resource.import]);
      if (resource.bytes > 0) what += fmt::format(", {} bytes", resource.bytes);
    } else if (isBuffer(resource)) {
      what = fmt::format("buffer of {} bytes", resource.bytes);
    } else {
      what = fmt::format("texture {} {}x{}", infoOf(resource.format).name, resource.width, resource.height);
      if (resource.depth > 1) what += fmt::format("x{}", resource.depth);
      if (resource.target != Target::texture_2d) what += fmt::format(" {}", nameOf(resource.target));
      if (resource.layers > 1) what += fmt::format(", {} layers", resource.layers);
      if (resource.mips > 1) what += fmt::format(", {} levels", resource.mips);
      if (resource.samples > 1) what += fmt::format(", {} samples", resource.samples);
      if (!isImported(resource)) what += fmt::format(", {} bytes", resource.bytes);
    }
    line(0, fmt::format("resource {}: {}{}", graph_.resourceNames[r], what, textOf(place)));
    if (resource.import != kNone) addArguments(graph_.imports[resource.import]);
    if (resource.history > 0) line(1, fmt::format("history of {}", resource.history));
    if (resource.hasClear) line(1, "has a \"clear\": a version before the first write");
    line(1, "storage " + explainer_.whyStorage(r));
    for (std::uint32_t pass = 0; pass < graph_.passes.size(); ++pass) {
      const FlatPass& flat = graph_.passes[pass];
      for (std::uint32_t u = flat.firstUse; u < flat.firstUse + flat.useCount; ++u) {
        const FlatUse& use = graph_.uses[u];
        if (use.resource != r) continue;
        const char* const verb = use.access == Access::read    ? "read"
                                 : use.access == Access::write ? "written"
                                                               : "modified";
        line(1, fmt::format("{} by '{}' as {}: {}{}", verb, graph_.passNames[pass], nameOf(use.kind),
                            weft::graph::textOf(graph_, use), plan_.stepOf[pass] == kNone ? ", culled" : ""));
      }
    }
    if (graph_.present.resource == r) line(1, "is presented");
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      if (graph_.outputs[i].resource == r)
        line(1, fmt::format("is read back as output '{}'", graph_.outputNames[i]));
  }

  // ---- parameters ----

  void addParameter(const ParameterSpec& parameter) {
    line(0, fmt::format("parameter {} = {}, from the {}{}", parameter.path, toText(parameter.value),
                        wordFor(parameter.origin), textOf(parameter.desc.place)));
    line(1, parameter.structural ? "structural: a change makes another plan"
                                 : "live: a change writes bytes of uniforms");
    const auto index = static_cast<std::uint32_t>(&parameter - graph_.parameters.data());
    for (const PassSpec& spec : graph_.specs)
      for (const UniformSpec& uniform : spec.uniforms) {
        const std::vector<std::uint32_t> keys =
            uniform.dynamic.present() ? uniform.dynamic.parameterKeys() : std::vector<std::uint32_t>{};
        if (uniform.path == parameter.path || std::ranges::find(keys, index) != keys.end())
          line(1, fmt::format("is read by '{}' as '{}'", spec.name, uniform.name));
      }
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  Explainer explainer_;
  const std::vector<BarrierReason> reasons_;
  std::string text_;
  std::set<std::string> told_;  // aliases and what they stand for
};

}  // namespace

std::optional<std::string> describe(const Plan& plan, std::string_view name, base::Diagnostics& diagnostics) {
  Describer describer(plan);
  const std::vector<std::string> names = describer.names();
  const std::vector<std::size_t> matches = suffixMatches(names, name);
  if (matches.size() == 1) return describer.describe(names[matches[0]]);
  if (const auto declared = matches.empty() ? describer.declaredImport(name) : std::nullopt)
    return describer.describe(*declared);
  const base::Where place = base::placeOfOption("");
  if (matches.empty()) {
    base::Diagnostic& d = diagnostics.error(
        base::Code::unknownPass, place, fmt::format("no pass, resource or parameter is called '{}'", name));
    d.expected = "a name of the expanded graph, or the end of one behind a dot";
    d.hint = suffixHint(name, names);
    return std::nullopt;
  }
  base::Diagnostic& d =
      diagnostics.error(base::Code::ambiguousName, place, fmt::format("'{}' may mean several", name));
  for (std::size_t i = 0; i < std::min<std::size_t>(matches.size(), 8); ++i)
    d.found += (i ? ", " : "") + names[matches[i]];
  d.hint = fmt::format("write more of the name, such as '{}'", names[matches[0]]);
  return std::nullopt;
}

}  // namespace weft::graph
