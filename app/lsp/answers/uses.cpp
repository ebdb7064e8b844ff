// Definitions, uses and renaming. Declared in features.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/lsp/answers/features.h"
#include "engine/graph/language/names.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app::lsp {

namespace fs = std::filesystem;

namespace {

using Kind = graph::NameUse::Kind;

bool isAt(const text::Place& place, const text::Place& begin, const std::string& name) {
  return place.line == begin.line && place.column >= begin.column &&
         place.column <= begin.column + name.size() && *place.file == *begin.file;
}

// The keys of a pass by which it knows `name` of its shader.
std::vector<Location> keysNamed(const Workspace& workspace, const Program& program, std::string_view name) {
  std::vector<Location> keys;
  for (const ShaderKey& key : program.keys)
    if (key.name == name)
      if (const auto location = workspace.locate(*program.graph, key.place, name)) keys.push_back(*location);
  return keys;
}

// Adds every use of what is declared at `declared`.
void usesInGraphs(const Workspace& workspace, Uses& uses, const Location& declared) {
  for (const Graph* graph : workspace.graphs())
    for (const graph::NameUse& use : graph->uses)
      if (use.name == uses.name && workspace.locate(*graph, use.declared, "") == declared)
        if (const auto location = workspace.locate(*graph, use.place, uses.name))
          uses.locations.insert(*location);
}

// Adds every word `name` in the files of a slot's programs. A renamed program is consistent only with all of them, and so is
// every other program that has one of these files; so the set of files grows until it has the files of all such programs.
void usesInShaders(const Workspace& workspace, Uses& uses, std::set<std::string> files) {
  const std::string presence = runtime::presenceDefineOf(uses.name);
  std::vector<Program> others = workspace.programs();
  const auto isOne = [&](const Program& program) {
    return std::ranges::any_of(program.files, [&](const std::string& file) { return files.contains(file); });
  };
  for (bool grows = true; grows;) {
    const auto found = std::ranges::partition(others, [&](const Program& each) { return !isOne(each); });
    grows = !found.empty();
    for (Program& program : found) {
      for (const std::string& path : program.files)
        if (const auto text = workspace.texts().of(path))
          for (const GlslWord& word : text->glsl().words)
            if (word.text == uses.name || word.text == presence) files.insert(path);
      uses.files.insert(program.files.begin(), program.files.end());
      for (const Location& key : keysNamed(workspace, program, uses.name)) uses.locations.insert(key);
      uses.programs.push_back(std::move(program));
    }
    others.erase(found.begin(), found.end());
  }
  for (const std::string& path : files)
    if (const auto text = workspace.texts().of(path))
      for (const GlslWord& word : text->glsl().words) {
        if (word.text == uses.name) uses.locations.insert({path, word.range});
        if (word.text == presence) uses.presence.insert({path, word.range});
      }
}

Uses usesOfWord(const Workspace& workspace, const Text& text, std::size_t offset) {
  Uses uses;
  const GlslWord* const word = text.glsl().wordAt(offset);
  if (!word || word->member) return uses;
  uses.ofShader = true;
  uses.name = std::string(word->text);
  uses.here = word->range;
  usesInShaders(workspace, uses, {text.path()});
  uses.found = std::ranges::any_of(
      uses.programs, [&](const Program& each) { return !keysNamed(workspace, each, uses.name).empty(); });
  return uses;
}

// Of a name that a pass shares with its shader; $pass.name is a use of it, too.
void usesOfKey(const Workspace& workspace, Uses& uses, Program program) {
  uses.found = uses.ofShader = true;
  if (const auto declared = workspace.findInShaders(workspace.filesOf(program), uses.name))
    usesInShaders(workspace, uses, {declared->path});
  else
    uses.programs = {std::move(program)};
  for (const Program& each : uses.programs)
    for (const Location& key : keysNamed(workspace, each, uses.name)) {
      uses.locations.insert(key);
      usesInGraphs(workspace, uses, key);
    }
}

std::string problemOfName(const Uses& uses, const std::string& name) {
  if (!graph::isIdent(name) || graph::isReservedWord(name))
    return fmt::format(
        "'{}' is no name: letters, digits and '_', and not mip, layer, face, stencil, x, y, z, w", name);
  if (uses.ofShader && name.starts_with("gl_"))
    return fmt::format("'{}': names of GLSL begin with gl_", name);
  return "";
}

// An input that an include does not bind takes the resource of its own name. Another name for one of the two parts them.
std::string problemOfInputs(const Workspace& workspace, const Uses& uses, const Graph& graph,
                            const graph::GraphDesc& desc) {
  // What a file declares under the name, when that is renamed.
  const auto renamed = [&](const graph::GraphDesc& file) -> const graph::ResourceDesc* {
    const auto found = std::ranges::find(file.resources, uses.name, &graph::ResourceDesc::name);
    return found == file.resources.end() ? nullptr : &*found;
  };
  const auto isRenamed = [&](const graph::ResourceDesc& resource) {
    text::Place place = resource.place;
    ++place.column;
    const auto location = workspace.locate(graph, place, uses.name);
    return location && uses.locations.contains(*location);
  };
  for (const graph::PassDesc& pass : desc.passes) {
    if (!pass.include || !pass.include->graph) continue;
    const graph::ResourceDesc* const own = renamed(desc);
    const graph::ResourceDesc* const input = renamed(*pass.include->graph);
    const bool bound =
        std::ranges::any_of(pass.include->binds, [&](const auto& bind) { return bind.first == uses.name; });
    if (input && input->kind == graph::ResourceDesc::Kind::input && !bound &&
        (isRenamed(*input) || (own && isRenamed(*own))))
      return fmt::format(
          "the include '{0}' in {1} gives '{2}' to the input of the same name: write \"bind\": {{ \"{2}\": "
          "\"{2}\" }} there first",
          pass.name, desc.path, uses.name);
    if (std::string below = problemOfInputs(workspace, uses, graph, *pass.include->graph); !below.empty())
      return below;
  }
  return "";
}

std::string problemOfPlace(const Workspace& workspace, const Uses& uses, const std::string& name) {
  for (const Location& each : uses.locations)
    if (!workspace.texts().isOpen(each.path) && !workspace.isInFolders(each.path))
      return fmt::format("'{}' uses it, too, and lies outside the folders of the editor", each.path);
  if (!uses.ofShader) {
    for (const Graph* graph : workspace.graphs()) {
      for (const graph::NameUse& use : graph->uses)
        if (use.name == name && use.kind == uses.kind && text::isSamePlace(use.place, use.declared) &&
            std::ranges::any_of(uses.locations,
                                [&](const Location& each) { return each.path == *use.place.file; }))
          return fmt::format("'{}' is declared already in {}", name, *use.place.file);
      if (uses.kind == Kind::resource)
        if (std::string problem = problemOfInputs(workspace, uses, *graph, *graph->desc); !problem.empty())
          return problem;
    }
    return "";
  }
  for (const std::string& path : uses.files)
    if (const auto text = workspace.texts().of(path))
      for (const GlslWord& word : text->glsl().words) {
        if (word.text == name) return fmt::format("'{}' is there already in {}", name, path);
        if (word.text == uses.name && word.member)
          return fmt::format("'{}' is also the name of a member, behind a dot, in {}", uses.name, path);
      }
  for (const Program& program : uses.programs)
    for (const Location& key : keysNamed(workspace, program, name))
      return fmt::format("a pass in {} has '{}' already", key.path, name);
  return "";
}

}  // namespace

Named namedAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  Named named;
  const auto take = [&](const Graph& graph, const text::Place& begin, const std::string& name) {
    const auto here = workspace.locate(graph, begin, name);
    if (here) named.here = here->range;
    if (here) named.graph = &graph;
    return here.has_value();
  };
  for (const Graph* graph : workspace.graphs()) {
    const text::Place place = workspace.placeIn(*graph, text, offset);
    if (!place.file) continue;
    for (Program& program : workspace.passesOf(*graph))
      for (const ShaderKey& key : program.keys)
        if (isAt(place, key.place, key.name) && take(*graph, key.place, key.name)) {
          named.key = key;
          named.program = std::move(program);
          return named;
        }
    for (const graph::NameUse& use : graph->uses)
      if (isAt(place, use.place, use.name) && take(*graph, use.place, use.name)) named.use = &use;
    if (named.use) return named;
  }
  return named;
}

std::optional<Location> fileAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  const Spot spot = spotAt(text.json(), offset);
  const std::vector<std::string_view> way = keysOn(spot.way);
  if (spot.inKey || !spot.value().is(JsonValue::Type::string) || way.empty()) return std::nullopt;
  const std::string& named = spot.value().text;
  if (way[0] == "extends" || (way[0] == "passes" && way.back() == "include")) {
    std::string path = pathKey((fs::path(text.path()).parent_path() / named).string());
    return workspace.texts().of(path) ? std::optional(Location{std::move(path), {}}) : std::nullopt;
  }
  if (way[0] == "passes" && way.size() > 2 && way[2] == "shader")
    for (const std::string& shader : {named, named + ".frag.glsl"})
      if (const auto path = workspace.sources(workspace.shaderFolders(text)).locate(shader))
        return Location{pathKey(*path), {}};
  return std::nullopt;
}

std::vector<Location> definitionsAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  std::vector<Location> found;
  const auto add = [&](const std::optional<Location>& location) {
    if (location) found.push_back(*location);
    return std::move(found);
  };
  if (text.isJson()) {
    const Named named = namedAt(workspace, text, offset);
    if (named.key) return add(workspace.findInShaders(workspace.filesOf(*named.program), named.key->name));
    if (named.use) {
      std::optional<Location> declared = workspace.locate(*named.graph, named.use->declared, "");
      if (declared) declared->range.end += named.use->name.size();
      return add(declared);
    }
    return add(fileAt(workspace, text, offset));
  }
  const std::vector<std::string> folders = workspace.shaderFolders(text);
  for (const GlslInclude& include : text.glsl().includes) {
    if (!include.range.holds(offset)) continue;
    const std::string beside = pathKey((fs::path(text.path()).parent_path() / include.path).string());
    if (workspace.texts().of(beside)) return {{beside, {}}};
    if (const auto path = workspace.sources(folders).locate(std::string(include.path)))
      return {{pathKey(*path), {}}};
  }
  const Uses uses = usesOfWord(workspace, text, offset);
  for (const Program& program : uses.programs)
    if (uses.found && program.has(text.path()))
      for (const Location& key : keysNamed(workspace, program, uses.name))
        if (std::ranges::find(found, key) == found.end()) found.push_back(key);
  const GlslWord* const word = text.glsl().wordAt(offset);
  if (!found.empty() || !word) return found;
  for (const std::string& path : workspace.shaderFiles(text.path(), folders))
    if (const auto other = workspace.texts().of(path))
      if (const GlslName* name = other->glsl().find(word->text)) return {{path, name->range}};
  return found;
}

Uses usesAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  if (!text.isJson()) return usesOfWord(workspace, text, offset);
  Uses uses;
  Named named = namedAt(workspace, text, offset);
  if (!named.graph) return uses;
  uses.here = named.here;
  uses.name = named.key ? named.key->name : named.use->name;
  if (named.key) {
    usesOfKey(workspace, uses, *std::move(named.program));
    return uses;
  }
  std::optional<Location> declared = workspace.locate(*named.graph, named.use->declared, "");
  if (!declared) return uses;
  if (named.use->kind == Kind::variable)
    if (const auto other = workspace.texts().of(declared->path)) {
      Named key = namedAt(workspace, *other, declared->range.begin);
      if (key.key && key.key->name == uses.name) {
        usesOfKey(workspace, uses, *std::move(key.program));
        return uses;
      }
    }
  uses.found = true;
  uses.kind = named.use->kind;
  usesInGraphs(workspace, uses, *declared);
  declared->range.end += uses.name.size();
  uses.locations.insert(*declared);
  return uses;
}

Renamed renameAt(const Workspace& workspace, const Text& text, std::size_t offset, const std::string& name) {
  const Uses uses = usesAt(workspace, text, offset);
  if (!uses.found) return {nullptr, "nothing here can be renamed"};
  std::string problem = problemOfName(uses, name);
  if (problem.empty() && name == uses.name) return {{{"changes", Json::object()}}, ""};
  if (problem.empty()) problem = problemOfPlace(workspace, uses, name);
  for (const Location& each : uses.locations)
    if (const auto file = workspace.texts().of(each.path);
        problem.empty() &&
        (!file || file->bytes().compare(each.range.begin, uses.name.size(), uses.name) != 0))
      problem = fmt::format("'{}' stands in the path of an include in {}: give the include an \"as\"",
                            uses.name, each.path);
  if (!problem.empty()) return {nullptr, problem};
  Json changes = Json::object();
  const auto edit = [&](const std::set<Location>& locations, const std::string& with) {
    for (const Location& each : locations)
      changes[uriOfPath(each.path)].push_back(
          {{"range", toJson(workspace.texts().of(each.path)->map(), each.range)}, {"newText", with}});
  };
  edit(uses.locations, name);
  edit(uses.presence, runtime::presenceDefineOf(name));
  return {{{"changes", std::move(changes)}}, ""};
}

}  // namespace weft::app::lsp
