#include "engine/graph/read/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <utility>

#include "engine/graph/read/misspelt_keys.h"
#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"
#include "engine/graph/read/read_like.h"

namespace weft::graph {

namespace {

using base::Code;
using base::Diagnostics;
using Type = JsonValue::Type;

// One file of a chain of includes, innermost last.
struct OpenFile {
  std::string identity;
  std::string path;
};

class GraphReader {
 public:
  GraphReader(Diagnostics& diagnostics, const FileTexts& given)
      : diagnostics_(diagnostics), loader_(diagnostics, given) {}

  const FileTexts& texts() const { return loader_.texts(); }

  std::shared_ptr<const GraphDesc> readText(std::string_view text, const std::string& path) {
    const std::shared_ptr<const Source> source = loader_.text(text, path);
    return source ? readSource(*source).graph : nullptr;
  }

  std::shared_ptr<const GraphDesc> readWith(const std::string& path, std::span<const std::string> presets) {
    std::shared_ptr<const Source> source = loader_.file(path, {});
    for (const std::string& preset : presets)
      if (source)
        if (auto made = loader_.withPreset(*source, preset)) source = std::move(made);
    return source ? readSource(*source).graph : nullptr;
  }

 private:
  // A file with everything below it: each use of a file counts, because each is expanded for itself.
  struct Weighed {
    std::shared_ptr<const GraphDesc> graph;  // null when it could not be read
    std::uint64_t files = 1, values = 0;
    std::uint64_t depth = 1;  // of files in a row
  };

  Weighed readBelow(const std::string& path, const Place& from) {
    const std::string identity = identityOf(path);
    if (const auto known = finished_.find(identity); known != finished_.end()) return known->second;
    const std::shared_ptr<const Source> source = loader_.file(path, from);
    return finished_[identity] = source ? readSource(*source) : Weighed{};
  }

  Weighed readSource(const Source& source) {
    open_.push_back({source.identity, source.path});
    Weighed before = std::exchange(weight_, {.graph = nullptr, .values = source.values});
    std::shared_ptr<const GraphDesc> graph = readRoot(source);
    open_.pop_back();
    Weighed made = std::exchange(weight_, std::move(before));
    made.graph = std::move(graph);
    return made;
  }

  std::shared_ptr<const GraphDesc> readRoot(const Source& source) {
    const JsonValue& root = source.root;
    ReadContext context(diagnostics_);
    if (!context.expect(root, Type::object, "a graph")) return nullptr;
    auto graph = std::make_shared<GraphDesc>();
    graph->path = source.path;
    graph->place = root.place;
    graph->files = source.files;
    graph->removed = source.removed;
    graph->named = source.named;
    graph->top = source.top;
    if (isOtherFile(root, context)) return nullptr;
    context.checkKeys(root, kGraphKeys, "a graph", base::Foreign::graph_key);
    context.text(root.find("$schema"), "\"$schema\"");
    graph->name = context.text(root.find("name"), "\"name\"");
    context.text(root.find("description"), "\"description\"");
    if (graph->name.empty()) graph->name = std::filesystem::path(source.path).stem().string();
    readVariables(context, root, *graph);
    for (const JsonMember& member : membersOf(context, root, "resources")) {
      if (!context.goesOn()) break;
      if (std::optional<ResourceDesc> resource = readResource(context, member))
        graph->resources.push_back(*std::move(resource));
      else
        graph->unread.push_back(member.key);
    }
    readSets(context, source, *graph);
    readPasses(context, source, *graph);
    graph->present = context.ref(root.find("present"), "\"present\"");
    for (const JsonMember& member : membersOf(context, root, "outputs")) {
      const bool named = context.checkName(member.key, member.place, "an output");
      std::optional<RefDesc> ref = context.ref(&member.value, fmt::format("the output '{}'", member.key));
      if (named && ref) graph->outputs.push_back({member.key, *std::move(ref)});
    }
    mendNames(*graph, diagnostics_);
    graph->texts = loader_.texts();
    return graph;
  }

  // A file of another kind that was given as a graph: one report says what it is and who takes it.
  static bool isOtherFile(const JsonValue& root, ReadContext& context) {
    for (const char* own :
         {"passes", "resources", "parameters", "let", "set", "extends", "present", "outputs"})
      if (root.find(own)) return false;
    for (const std::string_view key : kSceneKeys)
      if (root.find(key)) {
        const std::string file = root.place.file ? *root.place.file : "FILE";
        auto& d = context.error(
            Code::missingKey, root,
            fmt::format("this file has \"{}\" and no \"passes\": it is a scene, not a graph", key));
        d.expected = "a graph, with \"passes\"";
        d.hint = fmt::format("the option --scene takes it: weft check GRAPH --scene {}", file);
        return true;
      }
    return false;
  }

  static const std::vector<JsonMember>& membersOf(ReadContext& context, const JsonValue& root,
                                                  const char* key) {
    static const std::vector<JsonMember> none;
    const JsonValue* value = root.find(key);
    return value && context.expect(*value, Type::object, fmt::format("\"{}\"", key)) ? value->members : none;
  }

  // Parameters and lets share the names behind '$'.
  static void readVariables(ReadContext& context, const JsonValue& root, GraphDesc& graph) {
    ReadContext::Seen seen;
    for (const JsonMember& member : membersOf(context, root, "parameters")) {
      seen.emplace(member.key, member.place);
      if (std::optional<ParameterDesc> parameter = readParameter(context, member))
        graph.parameters.push_back(*std::move(parameter));
      else
        graph.unread.push_back(member.key);
    }
    for (const JsonMember& member : membersOf(context, root, "let")) {
      bool good = context.checkName(member.key, member.place, "a \"let\"");
      good = context.checkFresh(seen, member.key, member.place, "the variable") && good;
      Expr expr = context.expr(&member.value, fmt::format("the \"let\" '{}'", member.key));
      if (good && expr.present())
        graph.lets.push_back({member.key, member.place, std::move(expr)});
      else
        graph.unread.push_back(member.key);
    }
  }

  static void readSets(ReadContext& context, const Source& source, GraphDesc& graph) {
    if (const JsonValue* set = source.root.find("set")) context.expect(*set, Type::object, "\"set\"");
    for (const auto& [member, origin] : source.sets)
      if (std::optional<Value> value = readValue(context, member))
        graph.sets.push_back({member.key, origin, member.place, member.value.place, *std::move(value)});
  }

  void readPasses(ReadContext& context, const Source& source, GraphDesc& graph) {
    const JsonValue* passes = source.root.find("passes");
    if (!passes || !context.expect(*passes, Type::array, "\"passes\"",
                                   "write a list, each with its name: \"passes\": [ { \"name\": … }, … ]"))
      return;
    ReadContext::Seen seen;
    graph.passes.reserve(passes->items.size());
    LikePasses alike(context, passes->items);
    for (std::size_t i = 0; i < passes->items.size(); ++i) {
      if (!context.goesOn()) break;
      const JsonValue& item = passes->items[i];
      const JsonValue* whole = alike.at(i);
      std::optional<PassDesc> pass = whole ? readWhole(context, *whole, whole != &item) : std::nullopt;
      const JsonValue* name = item.find("name");
      if (name && name->is(Type::string) && (!pass || (!pass->include && pass->name != name->text)))
        graph.unread.push_back(name->text);
      if (!pass) continue;
      // A pass that is like another may have taken over even this from it.
      const char* const key = pass->include ? "include" : "name";
      const JsonValue* const named = item.find(key) ? item.find(key) : whole->find(key);
      context.pass = pass->name;
      context.checkFresh(seen, pass->name, pass->namePlace, "pass");
      context.pass.clear();
      if (pass->include && named) follow(*named, *pass->include, source, graph);
      graph.passes.push_back(*std::move(pass));
    }
  }

  // A pass that is like another: what is wrong with the other was said there.
  std::optional<PassDesc> readWhole(ReadContext& context, const JsonValue& stanza, bool alike) {
    if (!alike) return readPass(context, stanza);
    Diagnostics said;
    ReadContext own(said);
    std::optional<PassDesc> pass = readPass(own, stanza);
    const std::vector<base::Diagnostic>& before = diagnostics_.items();
    for (const base::Diagnostic& each : said.items())
      if (std::ranges::none_of(before, [&](const base::Diagnostic& d) {
            return d.code == each.code && base::isSamePlace(d.place.inFile(), each.place.inFile());
          }))
        diagnostics_.add(each);
    return pass;
  }

  void follow(const JsonValue& stanza, IncludeDesc& include, const Source& source, GraphDesc& graph) {
    if (tooMuch_) return;
    const std::string path = pathBeside(stanza);
    const std::string identity = identityOf(path);
    const auto again = std::find_if(open_.begin(), open_.end(),
                                    [&](const OpenFile& file) { return file.identity == identity; });
    if (again != open_.end()) {
      auto& d =
          diagnostics_.error(Code::includesItself, stanza.place, fmt::format("'{}' includes itself", path));
      for (auto file = again; file != open_.end(); ++file) d.found += file->path + " -> ";
      d.found += path;
      d.hint = "remove one of these includes";
      return;
    }
    if (isTooDeep(open_.size() + 1, stanza)) return;
    const auto changed = source.changed.find(include.as);
    Weighed below =
        changed != source.changed.end() ? readSource(*changed->second) : readBelow(path, stanza.place);
    if (tooMuch_) return;
    // A file that was read before may stand deeper here.
    if (isTooDeep(open_.size() + below.depth, stanza) ||
        exceeds(kMostIncludes, "files", weight_.files + below.files, stanza,
                "the graph includes too many files") ||
        exceeds(base::kMostValues, "values", weight_.values + below.values, stanza,
                "the included files hold too many values"))
      return;
    weight_.files += below.files;
    weight_.values += below.values;
    weight_.depth = std::max(weight_.depth, below.depth + 1);
    include.graph = std::move(below.graph);
    addFiles(include, path, graph);
  }

  // True after a report; then no further include is followed, and the graph is not expanded.
  bool isTooDeep(std::size_t count, const JsonValue& stanza) {
    if (count <= kMostInRow) return false;
    tooMuch_ = true;
    auto& d =
        diagnostics_.error(Code::limitExceeded, stanza.place, "files include each other in too long a row");
    d.expected = fmt::format("at most {}", kMostInRow);
    d.found = fmt::format("{} with '{}'", count, stanza.text);
    return true;
  }
  bool exceeds(std::uint64_t bound, const char* counts, std::uint64_t count, const JsonValue& stanza,
               const char* message) {
    if (count <= base::raised(bound)) return false;
    tooMuch_ = true;
    auto& d = base::reportLimit(diagnostics_, stanza.place, message, bound, counts, count);
    d.found = fmt::format("{} with '{}'", count, stanza.text);
    return true;
  }

  static void addFiles(const IncludeDesc& include, const std::string& path, GraphDesc& graph) {
    std::vector<std::string> below = include.graph ? include.graph->files : std::vector<std::string>{path};
    for (std::string& file : below)
      if (std::find(graph.files.begin(), graph.files.end(), file) == graph.files.end())
        graph.files.push_back(std::move(file));
  }

  Diagnostics& diagnostics_;
  SourceLoader loader_;
  std::vector<OpenFile> open_;
  std::map<std::string, Weighed> finished_;  // by identity
  Weighed weight_;                           // of the file that is being read, so far
  bool tooMuch_ = false;
};

// Diagnostics come in the order of the text, whatever order the reader looked at things.
template <class Read>
std::shared_ptr<const GraphDesc> readSorted(const FileTexts& given, Diagnostics& diagnostics, Read read) {
  Diagnostics said;
  GraphReader reader(said, given);
  std::shared_ptr<const GraphDesc> graph = read(reader);
  for (const auto& [path, text] : reader.texts()) base::PointerScope(path, *text, said);
  said.sortByPlace();
  diagnostics.append(said);
  return graph;
}

}  // namespace

std::shared_ptr<const GraphDesc> readGraph(const std::string& path, std::span<const std::string> presets,
                                           const FileTexts& given, Diagnostics& diagnostics) {
  return readSorted(given, diagnostics, [&](GraphReader& reader) { return reader.readWith(path, presets); });
}

std::shared_ptr<const GraphDesc> readGraphText(std::string_view text, const std::string& name,
                                               Diagnostics& diagnostics) {
  return readSorted({}, diagnostics, [&](GraphReader& reader) { return reader.readText(text, name); });
}

}  // namespace weft::graph
