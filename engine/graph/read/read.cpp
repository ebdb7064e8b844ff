#include "engine/graph/read/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <utility>

#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"
#include "engine/text/nearest.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

using text::Code;
using text::Diagnostics;
using Type = JsonValue::Type;

class GraphReader {
 public:
  GraphReader(Diagnostics& diagnostics, const ReadOptions& options)
      : diagnostics_(diagnostics), loader_(diagnostics, options), shared_(options.shared) {}

  std::shared_ptr<const GraphDesc> readWith(const std::string& path, std::span<const std::string> presets) {
    if (presets.empty()) return readBelow(path, {}).graph;
    std::shared_ptr<const Source> source = loader_.file(path, {});
    for (const std::string& preset : presets)
      if (source)
        if (auto made = loader_.withPreset(*source, preset)) source = std::move(made);
    return source ? readSource(*source).graph : nullptr;
  }

 private:
  ReadFile readBelow(const std::string& path, const Place& from) {
    const std::string identity = identityOf(path);
    if (const auto known = finished_.find(identity); known != finished_.end()) return known->second;
    if (identity != path) shared_ = nullptr;  // a file of two names has one description in a graph
    if (shared_ && shared_->contains(path)) return finished_[identity] = shared_->at(path);
    const std::shared_ptr<const Source> source = loader_.file(path, from);
    const ReadFile made = source ? readSource(*source) : ReadFile{};
    // Nothing was said so far: all that is below is there, too.
    if (shared_ && made.graph && diagnostics_.empty()) shared_->emplace(path, made);
    return finished_[identity] = made;
  }

  ReadFile readSource(const Source& source) {
    open_.emplace_back(source.identity, source.path);
    ReadFile before = std::exchange(weight_, {.graph = nullptr, .values = source.values});
    std::shared_ptr<const GraphDesc> graph = readRoot(source);
    open_.pop_back();
    ReadFile made = std::exchange(weight_, std::move(before));
    made.graph = std::move(graph);
    return made;
  }

  std::shared_ptr<const GraphDesc> readRoot(const Source& source) {
    ReadContext context(diagnostics_);
    if (!context.expect(source.root, Type::object, "a graph") || isOtherFile(source.root, context))
      return nullptr;
    JsonValue root = source.root;
    checkShape(root, diagnostics_);
    auto graph = std::make_shared<GraphDesc>();
    static_cast<FileDesc&>(*graph) = source;
    graph->place = root.place;
    graph->name = textIn(root, "name");
    if (graph->name.empty()) graph->name = std::filesystem::path(source.path).stem().string();
    readVariables(context, root, *graph);
    for (const JsonMember& member : membersIn(root, "resources")) {
      if (!context.goesOn()) break;
      if (std::optional<ResourceDesc> resource = readResource(context, member))
        graph->resources.push_back(*std::move(resource));
      else
        graph->unread.push_back(member.key);
    }
    for (const auto& [member, origin] : source.sets) {
      if (std::optional<Value> value = valueOf(member.value))
        graph->sets.push_back({member.key, origin, member.place, member.value.place, *std::move(value)});
      else
        context
            .wrongType(member.value, fmt::format("the value of '{}'", member.key),
                       "a number, true or false, a word, a path, or a list of two to four numbers")
            .hint = member.value.is(Type::object) ? "what passes share is declared under \"sets\"" : "";
    }
    for (const JsonMember& member : membersIn(root, "sets"))
      if (context.checkName(member.key, member.place, {.noun = "a set", .ofFile = true}))
        graph->slotSets.emplace_back(member.key, member.place);
    readPasses(context, source, root, *graph);
    graph->present = context.ref(root, "present");
    for (const JsonMember& member : membersIn(root, "outputs")) {
      const bool named = context.checkName(member.key, member.place, {"an output"});
      std::optional<RefDesc> ref = context.refOf(member.value);
      if (named && ref) graph->outputs.push_back({member.key, *std::move(ref)});
    }
    takeOptional(*graph);
    graph->texts = loader_.texts();
    return graph;
  }

  // What reads an optional input may do without it.
  void takeOptional(GraphDesc& graph) {
    std::set<std::string_view> optional;
    for (const ResourceDesc& resource : graph.resources)
      if (resource.kind == ResourceDesc::Kind::input && resource.optional) optional.insert(resource.name);
    for (PassDesc& pass : graph.passes)
      for (SlotDesc& slot : pass.slots) {
        if (slot.access == Access::write || slot.ref.import || !optional.contains(slot.ref.name)) continue;
        if (std::exchange(slot.ref.optional, true))
          diagnostics_.warning(say::optionalAnyway, slot.ref.place, slot.ref.text);
      }
  }

  // A file without any key of a graph, such as a scene: one report says what it lacks and who may take it.
  static bool isOtherFile(const JsonValue& root, ReadContext& context) {
    const auto own = [](const JsonMember& member) {
      return member.key != "name" && member.key != "description" && member.key != "$schema" &&
             shapeOfFile(false).find(member.key);
    };
    if (std::ranges::any_of(root.members, own)) return false;
    context.error(say::notAGraph, root, root.place.file ? *root.place.file : "FILE");
    return true;
  }

  // Parameters and lets share the names behind '$'.
  static void readVariables(ReadContext& context, const JsonValue& root, GraphDesc& graph) {
    ReadContext::Seen seen;
    for (const JsonMember& member : membersIn(root, "parameters")) {
      seen.emplace(member.key, member.place);
      if (std::optional<ParameterDesc> parameter = readParameter(context, member))
        graph.parameters.push_back(*std::move(parameter));
      else
        graph.unread.push_back(member.key);
    }
    for (const JsonMember& member : membersIn(root, "let")) {
      bool good = context.checkName(member.key, member.place, {.noun = "a \"let\"", .ofFile = true});
      good = context.checkFresh(seen, member.key, member.place, "the variable") && good;
      Expr expr = context.exprOf(member.value);
      if (good && expr.present())
        graph.lets.push_back({member.key, member.place, std::move(expr)});
      else
        graph.unread.push_back(member.key);
    }
  }

  // The sets of a file. One that no pass uses, and that several passes call nearly so, is misspelt where it is declared: that is said
  // once, and the passes have it.
  static JsonValue setsOf(ReadContext& context, const JsonValue& root) {
    const JsonValue *passes = valueIn(root, "passes"), *declared = valueIn(root, "sets");
    if (!passes || !declared) return {};
    JsonValue sets = *declared;
    std::map<std::string, int> uses;
    for (const JsonValue& stanza : passes->items)
      if (const JsonValue* use = valueIn(stanza, "use"))
        for (const JsonValue& name : stringsOf(*use)) ++uses[name.text];
    for (JsonMember& set : sets.members) {
      if (uses.contains(set.key)) continue;
      std::vector<std::string> missing;
      for (const auto& [name, count] : uses)
        if (count > 1 && !sets.find(name)) missing.push_back(name);
      const std::string meant = text::nearestName(set.key, missing);
      if (meant.empty()) continue;
      context.error(say::setMisspelt, set.place, set.key, uses[meant], meant);
      set.key = meant;
    }
    return sets;
  }

  void readPasses(ReadContext& context, const Source& source, const JsonValue& root, GraphDesc& graph) {
    const JsonValue* const passes = valueIn(root, "passes");
    const JsonValue sets = setsOf(context, root);
    ReadContext::Seen seen;
    for (std::size_t i = 0; passes && i < passes->items.size() && context.goesOn(); ++i) {
      const JsonValue& stanza = passes->items[i];
      std::optional<PassDesc> pass = readPass(context, stanza, sets);
      const JsonValue* name = source.root.find("passes")->items[i].find("name");
      if (name && name->is(Type::string) && (!pass || (!pass->include && pass->name != name->text)))
        graph.unread.push_back(name->text);
      if (!pass) continue;
      for (const auto& use : pass->uses)
        if (!loader_.mayShare(*sets.find(use.name), stanza.place)) return;
      context.pass = pass->name;
      context.checkFresh(seen, pass->name, pass->namePlace, "pass");
      context.pass.clear();
      if (pass->include) follow(*stanza.find("include"), *pass->include, source, graph);
      graph.passes.push_back(*std::move(pass));
    }
  }

  void follow(const JsonValue& stanza, IncludeDesc& include, const Source& source, GraphDesc& graph) {
    if (tooMuch_) return;
    const std::string path = pathBeside(stanza);
    const std::string identity = identityOf(path);
    const auto again = std::ranges::find(open_, identity, &std::pair<std::string, std::string>::first);
    if (again != open_.end()) {
      auto& d = diagnostics_.error(say::includesItself, stanza.place, path);
      for (auto file = again; file != open_.end(); ++file) d.found += file->second + " -> ";
      d.found += path;
      return;
    }
    if (exceeds(kMaxInRow, "files in a row", open_.size() + 1, stanza)) return;
    const auto changed = source.changed.find(include.as);
    ReadFile below =
        changed != source.changed.end() ? readSource(*changed->second) : readBelow(path, stanza.place);
    if (tooMuch_) return;
    // A file that was read before may stand deeper here.
    if (exceeds(kMaxInRow, "files in a row", open_.size() + below.depth, stanza) ||
        exceeds(text::raised(kMaxIncludes), "files", weight_.files + below.files, stanza) ||
        exceeds(text::raised(text::kMaxValues), "values", weight_.values + below.values, stanza))
      return;
    weight_.files += below.files;
    weight_.values += below.values;
    weight_.depth = std::max(weight_.depth, below.depth + 1);
    include.graph = std::move(below.graph);
    addFiles(include, path, graph);
  }

  // True after a report; then no further include is followed, and the graph is not expanded.
  bool exceeds(std::uint64_t bound, const char* counts, std::uint64_t count, const JsonValue& stanza) {
    if (count <= bound) return false;
    tooMuch_ = true;
    auto& d = diagnostics_.error(say::includesTooMany, stanza.place, counts, bound, count, stanza.text);
    if (bound != kMaxInRow) d.hint = text::hintToRaise(bound / text::limitsRaised, count);
    return true;
  }

  static void addFiles(const IncludeDesc& include, const std::string& path, GraphDesc& graph) {
    std::vector<std::string> below = include.graph ? include.graph->files : std::vector<std::string>{path};
    for (std::string& file : below)
      if (std::ranges::find(graph.files, file) == graph.files.end()) graph.files.push_back(std::move(file));
  }

  Diagnostics& diagnostics_;
  SourceLoader loader_;
  std::vector<std::pair<std::string, std::string>> open_;  // identity and path of a chain of includes
  ReadFiles finished_;                                     // by identity
  ReadFiles* shared_;                                      // ReadOptions::shared
  ReadFile weight_;                                        // of the file that is being read, so far
  bool tooMuch_ = false;
};

}  // namespace

std::shared_ptr<const GraphDesc> readGraph(const std::string& path, Diagnostics& diagnostics,
                                           const ReadOptions& options) {
  Diagnostics said;
  GraphReader reader(said, options);
  std::shared_ptr<const GraphDesc> graph = reader.readWith(path, options.presets);
  said.sortByPlace();  // in the order of the text, whatever order the reader looked at things
  diagnostics.append(said);
  return graph;
}

std::shared_ptr<const GraphDesc> readGraphText(std::string_view text, const std::string& name,
                                               Diagnostics& diagnostics) {
  return readGraph(name, diagnostics, {.given = {{name, std::make_shared<const std::string>(text)}}});
}

}  // namespace weft::graph
