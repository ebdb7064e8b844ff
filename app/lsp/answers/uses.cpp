// Definitions, uses and renaming.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/lsp/answers/features.h"
#include "engine/graph/language/names.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app::lsp {

namespace {

using Kind = Mention::Kind;

bool isOfShader(Kind kind) {
  return kind == Kind::slot || kind == Kind::parameter || kind == Kind::define;
}

std::string leafOf(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
}

// The keys of a pass by which it knows `name` of its shader.
std::vector<Range> keysOf(const Project::Program& program, std::string_view name) {
  std::vector<Range> keys;
  for (const Mention& mention : program.graph->mentions)
    if (mention.pass == program.stanza && isOfShader(mention.kind) && mention.name == name)
      keys.push_back(mention.range);
  return keys;
}

// Adds every word `name` in the files of a slot's programs. A renamed program is consistent only with all of them, and so is
// every other program that has one of these files; so the set of files grows until it has the files of all such programs.
void usesInShaders(const Context& context, Uses& uses, std::set<std::string> files) {
  const std::string presence = runtime::presenceDefineOf(uses.name);
  for (std::size_t before = files.size() + 1; before != files.size();) {
    before = files.size();
    uses.programs = context.project.programsWith(files);
    for (const Project::Program& program : uses.programs)
      for (const std::string& path : program.files)
        if (const auto text = context.texts.of(path))
          for (const GlslWord& word : text->glsl().words())
            if (word.text == uses.name || word.text == presence) files.insert(path);
  }
  for (const Project::Program& program : uses.programs) {
    const std::string& graph = program.graph->text->path();
    uses.files.insert(program.files.begin(), program.files.end());
    for (const Range& key : keysOf(program, uses.name)) uses.locations.insert({graph, key});
    if (const JsonValue* name = nameOf(*program.stanza))  // $pass.parameter
      for (const Mention& mention : program.graph->mentions)
        if (mention.kind == Kind::variable && mention.name == fmt::format("{}.{}", name->text, uses.name))
          uses.locations.insert({graph, mention.range});
  }
  for (const std::string& path : files)
    if (const auto text = context.texts.of(path))
      for (const GlslWord& word : text->glsl().words()) {
        if (word.text == uses.name) uses.locations.insert({path, word.range});
        if (word.text == presence) uses.presence.insert({path, word.range});
      }
}

void usesInGraphs(const Context& context, Uses& uses, const Definition& definition) {
  for (const std::string& path : context.project.graphFiles()) {
    const auto file = context.project.index(path);
    for (const Mention& mention : file->mentions) {
      if (isOfShader(mention.kind) || mention.kind == Kind::file || mention.kind == Kind::shader ||
          leafOf(mention.name) != uses.name)
        continue;
      if (context.project.resolve(*file, mention) == definition) {
        uses.locations.insert({path, mention.range});
        uses.files.insert(path);
      }
    }
  }
  uses.locations.insert({definition.path, {definition.range.end - uses.name.size(), definition.range.end}});
  uses.files.insert(definition.path);
}

Uses usesOfWord(const Context& context, const Text& text, std::size_t offset) {
  Uses uses;
  const GlslWord* const word = text.glsl().wordAt(offset);
  if (!word || word->member) return uses;
  uses.kind = Kind::slot;
  uses.name = std::string(word->text);
  uses.here = word->range;
  usesInShaders(context, uses, {text.path()});
  const bool named = std::ranges::any_of(
      uses.programs, [&](const Project::Program& p) { return !keysOf(p, uses.name).empty(); });
  uses.found = named;
  return uses;
}

std::string problemOfName(const Uses& uses, const std::string& name) {
  if (!graph::isIdent(name) || graph::isReservedWord(name))
    return fmt::format(
        "'{}' is no name: letters, digits and '_', and not mip, layer, face, stencil, x, y, z, w", name);
  if (isOfShader(uses.kind) && name.starts_with("gl_"))
    return fmt::format("'{}': names of GLSL begin with gl_", name);
  return "";
}

// An input that an include does not bind takes the resource of its own name. Another name for one of the two parts them.
std::string problemOfInputs(const Context& context, const Uses& uses) {
  const auto isUnbound = [&](const JsonValue& stanza) {
    const JsonValue* const bind = stanza.find("bind");
    return stanza.find("include") && !(bind && bind->find(uses.name));
  };
  const auto isInput = [&](const FileIndex& file) {
    const JsonValue* const resources = file.text->json().root.find("resources");
    const JsonValue* const resource = resources ? resources->find(uses.name) : nullptr;
    return resource && resource->find("input");
  };
  const auto problem = [&](const std::string& include, const std::string& path) {
    return fmt::format(
        "the include '{0}' in {1} gives '{2}' to the input of the same name: write \"bind\": {{ \"{2}\": "
        "\"{2}\" }} there first",
        include, path, uses.name);
  };
  for (const std::string& path : uses.files) {
    const auto file = context.project.index(path);
    if (!file || !file->resources.contains(uses.name)) continue;
    for (const JsonValue* const stanza : file->stanzas) {
      const auto below = isUnbound(*stanza) ? file->includes.find(prefixOf(*stanza)) : file->includes.end();
      const auto included = below == file->includes.end() ? nullptr : context.project.index(below->second);
      if (included && isInput(*included)) return problem(below->first, path);
    }
    if (!isInput(*file)) continue;
    for (const std::string& above : context.project.includersOf(path))
      if (const auto including = context.project.index(above))
        for (const JsonValue* const stanza : including->stanzas)
          if (const auto below = including->includes.find(prefixOf(*stanza));
              isUnbound(*stanza) && below != including->includes.end() && below->second == path)
            return problem(below->first, above);
  }
  return "";
}

std::string problemOfPlace(const Context& context, const Uses& uses, const std::string& name) {
  for (const Location& each : uses.locations)
    if (!context.texts.isOpen(each.path) && !context.project.isInFolders(each.path))
      return fmt::format("'{}' uses it, too, and lies outside the folders of the editor", each.path);
  if (!isOfShader(uses.kind)) {
    for (const std::string& path : uses.files) {
      const auto file = context.project.index(path);
      const auto& names = uses.kind == Kind::pass       ? file->passes
                          : uses.kind == Kind::variable ? file->variables
                                                        : file->resources;
      if (names.contains(name)) return fmt::format("'{}' is declared already in {}", name, path);
    }
    return uses.kind == Kind::resource ? problemOfInputs(context, uses) : "";
  }
  for (const std::string& path : uses.files)
    if (const auto text = context.texts.of(path))
      for (const GlslWord& word : text->glsl().words()) {
        if (word.text == name) return fmt::format("'{}' is there already in {}", name, path);
        if (word.text == uses.name && word.member)
          return fmt::format("'{}' is also the name of a member, behind a dot, in {}", uses.name, path);
      }
  for (const Project::Program& program : uses.programs)
    if (!keysOf(program, name).empty())
      return fmt::format("a pass in {} has '{}' already", program.graph->text->path(), name);
  return "";
}

}  // namespace

std::vector<Location> definitionsAt(const Context& context, const Text& text, std::size_t offset) {
  std::vector<Location> found;
  if (text.isJson()) {
    const auto file = context.project.index(text.path());
    const Mention* const mention = file ? file->at(offset) : nullptr;
    if (!mention) return found;
    if (const auto definition = context.project.resolve(*file, *mention))
      found.push_back({definition->path, definition->range});
    return found;
  }
  const std::vector<std::string> folders = context.project.shaderFolders(text.path());
  for (const GlslInclude& include : text.glsl().includes())
    if (include.range.holds(offset))
      if (const auto path = context.project.locateInclude(text.path(), include.path, folders))
        return {{*path, {}}};
  const Uses uses = usesOfWord(context, text, offset);
  if (uses.found)
    for (const Project::Program& program : uses.programs)
      if (std::ranges::find(program.files, text.path()) != program.files.end())
        for (const Range& key : keysOf(program, uses.name))
          found.push_back({program.graph->text->path(), key});
  if (!found.empty()) return found;
  if (const GlslWord* word = text.glsl().wordAt(offset))
    for (const std::string& path : context.project.shaderClosure(text.path(), folders))
      if (const auto other = context.texts.of(path))
        if (const GlslName* name = other->glsl().find(word->text)) return {{path, name->range}};
  return found;
}

Uses usesAt(const Context& context, const Text& text, std::size_t offset) {
  if (!text.isJson()) return usesOfWord(context, text, offset);
  Uses uses;
  const auto file = context.project.index(text.path());
  const Mention* const mention = file ? file->at(offset) : nullptr;
  if (!mention || mention->kind == Kind::file || mention->kind == Kind::shader) return uses;
  uses.kind = mention->kind == Kind::import ? Kind::resource : mention->kind;
  uses.name = leafOf(mention->name);
  uses.here = mention->range;
  if (isOfShader(mention->kind)) {
    const Project::Program program = context.project.programOf(file, *mention->pass);
    const auto declared = context.project.findInShaders(program, uses.name);
    if (declared) {
      usesInShaders(context, uses, {declared->path});
    } else {
      uses.programs = {program};
      for (const Range& key : keysOf(program, uses.name)) uses.locations.insert({text.path(), key});
    }
    uses.found = true;
    return uses;
  }
  const auto definition = context.project.resolve(*file, *mention);
  if (!definition) return uses;
  uses.found = true;
  if (definition->name.find('.') != std::string::npos && definition->kind == Kind::variable &&
      !mention->pass) {
    // $pass.parameter is a parameter of that pass, and so of its shader.
    const auto other = context.project.index(definition->path);
    const Mention* const key = other ? other->at(definition->range.begin) : nullptr;
    if (key && isOfShader(key->kind)) return usesAt(context, *other->text, definition->range.begin);
  }
  usesInGraphs(context, uses, *definition);
  return uses;
}

Renamed renameAt(const Context& context, const Text& text, std::size_t offset, const std::string& name) {
  const Uses uses = usesAt(context, text, offset);
  if (!uses.found) return {nullptr, "nothing here can be renamed"};
  std::string problem = problemOfName(uses, name);
  if (problem.empty() && name == uses.name) return {{{"changes", Json::object()}}, ""};
  if (problem.empty()) problem = problemOfPlace(context, uses, name);
  for (const Location& each : uses.locations)
    if (problem.empty())
      if (const auto file = context.texts.of(each.path);
          !file || file->bytes().compare(each.range.begin, each.range.end - each.range.begin, uses.name) != 0)
        problem = fmt::format("'{}' stands in the path of an include in {}: give the include an \"as\"",
                              uses.name, each.path);
  if (!problem.empty()) return {nullptr, problem};
  Json changes = Json::object();
  const auto edit = [&](const std::set<Location>& locations, const std::string& with) {
    for (const Location& each : locations)
      changes[uriOfPath(each.path)].push_back(
          {{"range", toJson(context.texts.of(each.path)->map(), each.range)}, {"newText", with}});
  };
  edit(uses.locations, name);
  edit(uses.presence, runtime::presenceDefineOf(name));
  return {{{"changes", std::move(changes)}}, ""};
}

}  // namespace weft::app::lsp
