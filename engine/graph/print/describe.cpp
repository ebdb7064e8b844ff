// What a plan knows of one name, for `weft explain`. Declared in print.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "engine/graph/language/names.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"

namespace weft::graph {

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
    for (const UniformSpec& uniform : spec.uniforms)
      if (wanted(uniform.name))
        line(1, "parameter {} = {}{}{}", uniform.text(), toText(uniform.value),
             uniform.path.empty() ? "" : fmt::format(" ({})", uniform.path),
             follows(uniform)                                         ? ", follows an import"
             : uniform.dynamic.present() && uniform.dynamic.dynamic() ? ", changes with time"
                                                                      : "");
    for (const SlotSpec& slot : graph_.slotsOf(spec))
      if (wanted(slot.name)) addSlot(slot, pass);
  }

  bool follows(const UniformSpec& uniform) const {
    const std::vector<std::uint32_t> keys = uniform.dynamic.parameterKeys();
    return !keys.empty() && keys.back() >= graph_.parameters.size();
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
        const std::vector<std::uint32_t> keys =
            uniform.dynamic.present() ? uniform.dynamic.parameterKeys() : std::vector<std::uint32_t>{};
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
  const bool several = !matches.empty();
  text::Diagnostic& d = diagnostics.error(
      several ? text::Code::ambiguousName : text::Code::unknownPass, text::placeOfOption(""),
      several ? fmt::format("'{}' may mean several", name)
              : fmt::format("no pass, resource or parameter is called '{}'", name),
      {.hint = several ? fmt::format("write more of the name, such as '{}'", names[matches[0]])
                       : suffixHint(name, names)});
  for (std::size_t i = 0; i < std::min<std::size_t>(matches.size(), 8); ++i)
    d.found += (i ? ", " : "") + names[matches[i]];
  return std::nullopt;
}

std::string describeInPass(const Plan& plan, std::string_view pass, std::string_view name) {
  Describer describer(plan);
  return describer.addInPass(pass, name) ? describer.text() : "";
}

}  // namespace weft::graph
