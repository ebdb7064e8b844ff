// Definitions, uses and renaming. Declared in workspace.h.
#include <fmt/format.h>

#include "app/lsp/workspace.h"
#include "engine/graph/language/names.h"
#include "engine/text/json/report.h"

namespace weft::app::lsp {

namespace {

using Kind = graph::NameUse::Kind;

bool isAt(const text::Place& place, const text::Place& begin, const std::string& name) {
  return begin.file && place.line == begin.line && place.column >= begin.column &&
         place.column <= begin.column + name.size() && *place.file == text::absolutePath(*begin.file);
}

// The keys of a pass by which it knows `name` of its shader.
std::vector<Location> keysNamed(const Workspace& workspace, const Program& program, std::string_view name) {
  std::vector<Location> keys;
  for (const ShaderKey& key : program.keys)
    if (key.name == name)
      if (const auto location = workspace.locate(key.place, name)) keys.push_back(*location);
  return keys;
}

// Adds what is declared at `declared` and every use of it; where graphs share the file of a use, also what each of them declares.
void usesInGraphs(const Workspace& workspace, Uses& uses, const Location& declared) {
  const auto add = [&](const Location& it) {
    return uses.locations.insert({it.path, {it.range.begin, it.range.begin + uses.name.size()}}).second;
  };
  const auto has = [&](const Location& it) { return uses.locations.contains(it) && !uses.keys.contains(it); };
  add(declared);
  for (bool grows = true; std::exchange(grows, false);)
    for (const Graph* graph : workspace.graphs())
      for (const graph::NameUse& use : workspace.usesOf(*graph)) {
        if (use.name != uses.name) continue;
        const auto at = workspace.locate(use.place, use.name), by = workspace.locate(use.declared, "");
        if (!at || !by || !(has(*by) || (!use.key && has(*at)))) continue;
        grows |= add(*by) | add(*at);
        if (use.key) uses.keys.insert(*at);
      }
}

// Adds every word `name` in the files of a slot's programs, and of all that share one of these: they are consistent only together.
void usesInShaders(const Workspace& workspace, Uses& uses, std::set<std::string> files) {
  const std::string presence = glsl::presenceDefineOf(uses.name);
  const auto eachMention = [&](const std::string& path, auto&& f) {
    if (const auto text = workspace.texts().of(path))
      for (const GlslWord& word : text->words())
        if (word.text == uses.name || word.text == presence) f(word);
  };
  std::vector<Program> others = workspace.programs();
  for (bool grows = true; grows;) {
    const auto found = std::ranges::partition(others, [&](const Program& program) {
      return std::ranges::none_of(program.files,
                                  [&](const std::string& file) { return files.contains(file); });
    });
    grows = !found.empty();
    for (Program& program : found) {
      for (const std::string& path : program.files)
        eachMention(path, [&](const GlslWord&) { files.insert(path); });
      for (const Location& key : keysNamed(workspace, program, uses.name)) uses.locations.insert(key);
      uses.programs.push_back(std::move(program));
    }
    others.erase(found.begin(), found.end());
  }
  for (const std::string& path : files)
    eachMention(path, [&](const GlslWord& word) {
      (word.text == presence ? uses.presence : uses.locations).insert({path, word.range});
    });
}

// Of a name that a pass shares with its shader; $pass.name is a use of it, too.
void usesOfKey(const Workspace& workspace, Uses& uses, Program program) {
  uses.found = uses.ofShader = true;
  if (const auto declared = workspace.findInShaders(program.files, uses.name))
    usesInShaders(workspace, uses, {declared->path});
  else
    uses.programs = {std::move(program)};
  for (const Program& each : uses.programs)
    for (const Location& key : keysNamed(workspace, each, uses.name)) usesInGraphs(workspace, uses, key);
}

// Why what is used cannot have this name, or "".
std::string problemOf(const Workspace& workspace, const Uses& uses, const std::string& name) {
  if (!graph::isIdent(name) || graph::isReservedWord(name) || (uses.ofShader && name.starts_with("gl_")))
    return fmt::format("'{}' is no name that both graphs and GLSL can have", name);
  for (const Location& each : uses.locations) {
    const auto file = workspace.texts().of(each.path);
    if (!file || (!workspace.texts().isOpen(each.path) && !workspace.isInFolders(each.path)))
      return fmt::format("'{}' uses it, too, and lies outside the folders of the editor", each.path);
    if (file->bytes().compare(each.range.begin, uses.name.size(), uses.name) != 0)
      return fmt::format("'{}' stands in the path of an include in {}: give the include an \"as\"", uses.name,
                         each.path);
  }
  for (const Graph* graph : workspace.graphs()) {
    if (uses.ofShader) break;
    for (const graph::NameUse& use : workspace.usesOf(*graph))
      if (use.name == name && use.kind == uses.kind && use.place == use.declared &&
          std::ranges::any_of(uses.locations,
                              [&](const Location& each) { return each.path == *use.place.file; }))
        return fmt::format("'{}' is declared already in {}", name, *use.place.file);
  }
  for (const Program& program : uses.programs) {
    for (const Location& key : keysNamed(workspace, program, name))
      return fmt::format("a pass in {} has '{}' already", key.path, name);
    for (const std::string& path : program.files)
      if (const auto text = workspace.texts().of(path))
        for (const GlslWord& word : text->words())
          if (word.text == name || (word.member && word.text == uses.name))
            return fmt::format("'{}' is there already in {}, or '{}' is a member, behind a dot", name, path,
                               uses.name);
  }
  return "";
}

// The string in a list of names that is called by what stands at `name`; null when none is.
const JsonValue* itemCalled(const Text& text, const Range& name) {
  if (!text.isJson()) return nullptr;
  const Spot spot = spotAt(text.json(), name.begin);
  constexpr std::string_view kLists[] = {"read", "write", "modify", "bind", "parameters"};
  const bool listed = spot.keys.size() == 4 && spot.keys[3] == "[]" &&
                      spot.value().is(JsonValue::Type::string) &&
                      std::ranges::find(kLists, spot.keys[2]) != std::end(kLists);
  std::string_view behind = text.bytes();
  behind.remove_prefix(name.end);
  const bool last = !behind.starts_with('.') ||
                    graph::isReservedWord(behind.substr(1, behind.find_first_of("[\". ", 1) - 1));
  return listed && last ? &spot.value() : nullptr;
}

}  // namespace

Named namedAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  Named named;
  const text::Place place = text.placeOf(offset);
  const auto take = [&](const Graph& graph, const text::Place& begin, const std::string& name) {
    const auto here = isAt(place, begin, name) ? workspace.locate(begin, name) : std::nullopt;
    if (here) named.here = here->range, named.graph = &graph;
    return here.has_value();
  };
  for (const Graph* graph : workspace.graphs()) {
    if (!graph->texts.contains(text.path())) continue;
    for (Program& program : workspace.programsOf(*graph))
      for (const ShaderKey& key : program.keys)
        if (take(*graph, key.place, key.name)) {
          named.key = key.name;
          named.program = std::move(program);
          named.program->files = workspace.filesOf(*named.program);
          break;
        }
    // In a list a name is both.
    for (const graph::NameUse& use : workspace.usesOf(*graph))
      if (!use.key && take(*graph, use.place, use.name)) named.use = &use;
    if (named.graph) return named;
  }
  return named;
}

std::optional<Location> fileAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  const Spot spot = spotAt(text.json(), offset);
  const std::vector<std::string_view>& way = spot.keys;
  if (spot.key || !spot.value().is(JsonValue::Type::string) || way.empty()) return std::nullopt;
  const std::string& named = spot.value().text;
  if (way[0] == "extends" || (way[0] == "passes" && way.back() == "include")) {
    std::string path = pathBeside(text.path(), named);
    return workspace.texts().of(path) ? std::optional(Location{std::move(path), {}}) : std::nullopt;
  }
  if ((spot.stanza() || way[0] == "sets") && way.size() > 2 && way[2] == "shader")
    for (const std::string& shader : {named, named + ".frag.glsl"})
      if (const auto path = workspace.sources(workspace.shaderFolders(text)).locate(shader))
        return Location{text::absolutePath(*path), {}};
  return std::nullopt;
}

std::set<Location> definitionsAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  std::set<Location> found;
  const auto add = [&](const std::optional<Location>& location, std::size_t bytes = 0) {
    if (location) found.insert({location->path, {location->range.begin, location->range.end + bytes}});
  };
  if (text.isJson()) {
    const Named named = namedAt(workspace, text, offset);
    if (named.program) add(workspace.findInShaders(named.program->files, named.key));
    if (named.use) add(workspace.locate(named.use->declared, ""), named.use->name.size());
    if (!named.graph) add(fileAt(workspace, text, offset));
    return found;
  }
  const std::vector<std::string> files =
      workspace.shaderFiles(text.path(), "", workspace.shaderFolders(text));
  const GlslWord* const word = text.wordAt(offset);
  if (!word) {  // perhaps the path of an include
    const std::string_view all = text.bytes();
    const std::size_t begin = all.rfind('"', offset) + 1, end = all.find('"', offset);
    for (const std::string& path : files)
      if (begin > 0 && end != all.npos && begin < end && path.ends_with(all.substr(begin, end - begin)))
        add(Location{path, {}});
    return found;
  }
  const Uses uses = usesAt(workspace, text, offset);
  for (const Program& program : uses.programs)
    if (uses.found && program.has(text.path()))
      for (const Location& key : keysNamed(workspace, program, uses.name)) add(key);
  if (found.empty()) add(workspace.findInShaders(files, word->text));
  return found;
}

Uses usesAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  Uses uses;
  if (!text.isJson()) {
    const GlslWord* const word = text.wordAt(offset);
    if (!word || word->member) return uses;
    uses.ofShader = true;
    uses.name = std::string(word->text);
    usesInShaders(workspace, uses, {text.path()});
    uses.found = std::ranges::any_of(
        uses.programs, [&](const Program& each) { return !keysNamed(workspace, each, uses.name).empty(); });
    return uses;
  }
  Named named = namedAt(workspace, text, offset);
  if (!named.graph) return uses;
  uses.name = named.program ? named.key : named.use->name;
  std::optional<Location> declared;
  if (named.use && !named.program) {
    declared = workspace.locate(named.use->declared, "");
    if (!declared) return uses;
    // A parameter that a pass declares is a name of its shader, too.
    if (const auto file = workspace.texts().of(declared->path); file && named.use->kind == Kind::variable)
      if (Named key = namedAt(workspace, *file, declared->range.begin); key.key == uses.name)
        named.program = std::move(key.program);
  }
  if (named.program) {
    usesOfKey(workspace, uses, *std::move(named.program));
    return uses;
  }
  uses.found = true;
  uses.kind = named.use->kind;
  usesInGraphs(workspace, uses, *declared);
  return uses;
}

Json renameAt(const Workspace& workspace, const Text& text, std::size_t offset, const std::string& name,
              std::string& problem) {
  const Uses uses = usesAt(workspace, text, offset);
  problem = !uses.found         ? "nothing here can be renamed"
            : name == uses.name ? ""
                                : problemOf(workspace, uses, name);
  if (!problem.empty()) return nullptr;
  Json changes = Json::object();
  const auto edit = [&](const std::set<Location>& locations, const std::string& with) {
    for (const Location& each : locations) {
      const auto file = workspace.texts().of(each.path);
      Json& edits = changes[text::uriOf(each.path)];
      const auto put = [&](Range range, const std::string& by) {
        edits.push_back({{"range", file->toJson(range)}, {"newText", by}});
      };
      // An item of a list is a key and its value, of which one keeps its name.
      const JsonValue* const item = itemCalled(*file, each.range);
      const bool key = uses.ofShader || uses.keys.contains(each);
      if (item) put({item->begin, item->begin}, fmt::format("{{ \"{}\": ", key ? with : uses.name));
      if (!item || !key) put(each.range, with);
      if (item) put({item->end, item->end}, " }");
    }
  };
  if (name != uses.name) {
    edit(uses.locations, name);
    edit(uses.presence, glsl::presenceDefineOf(name));
  }
  return {{"changes", std::move(changes)}};
}

}  // namespace weft::app::lsp
