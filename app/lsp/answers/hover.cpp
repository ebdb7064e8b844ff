// What is shown of the thing under the cursor, and the outline of a file. Declared in features.h.
#include <fmt/format.h>

#include <algorithm>

#include "app/lsp/answers/features.h"
#include "app/lsp/answers/key_tables.h"
#include "engine/graph/language/format.h"
#include "engine/graph/print/print.h"

namespace weft::app::lsp {

namespace {

using Kind = Mention::Kind;
using Type = JsonValue::Type;

std::string fenced(const char* language, std::string_view text) {
  return fmt::format("```{}\n{}{}```\n", language, text, text.ends_with('\n') ? "" : "\n");
}

// What `weft explain` says of a name of a file, by the plan of the graph that it belongs to.
std::string explained(const Context& context, const std::string& path, const std::string& name) {
  const Analysis::Found found = context.analysis.graphWith(path);
  if (!found.graph) return "";
  for (const std::string& wanted : {found.prefix + name, "@" + name, name}) {
    base::Diagnostics ignored;
    if (auto text = graph::describe(*found.graph->plan, wanted, ignored))
      return *text + (found.graph->current ? "" : "(of the last plan without errors)\n");
  }
  return "";
}

// The lines of a pass's explanation about one of its slots or parameters.
std::string linesAbout(const std::string& text, const std::string& name) {
  std::string found;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string line = text.substr(at, end - at);
    at = end + 1;
    const bool pass = line.starts_with("pass ");
    const bool about = line.find(" " + name + ": ") != std::string::npos ||
                       line.find(" " + name + " = ") != std::string::npos ||
                       line.starts_with("  define " + name + " ");
    if (pass || about) found += line + "\n";
  }
  return found;
}

std::string ofShaderName(const Context& context, const FileIndex& file, const Mention& mention) {
  const auto graph = context.project.index(file.text->path());
  const Project::Program program = context.project.programOf(graph, *mention.pass);
  std::string text;
  if (const auto declared = context.project.findInShaders(program, mention.name)) {
    const auto shader = context.texts.of(declared->path);
    if (const GlslName* name = shader->glsl().find(mention.name))
      text += fenced("glsl", std::string_view(shader->bytes())
                                 .substr(name->statement.begin, name->statement.end - name->statement.begin));
  }
  if (const JsonValue* pass = nameOf(*mention.pass))
    if (const std::string lines = linesAbout(explained(context, file.text->path(), pass->text), mention.name);
        !lines.empty())
      text += fenced("text", lines);
  return text;
}

std::string ofMention(const Context& context, const FileIndex& file, const Mention& mention) {
  switch (mention.kind) {
    case Kind::slot:
    case Kind::parameter:
    case Kind::define:
      return mention.pass ? ofShaderName(context, file, mention) : "";
    case Kind::file:
    case Kind::shader: {
      const auto definition = context.project.resolve(file, mention);
      return definition ? fmt::format("`{}`\n", definition->path) : "";
    }
    default: {
      const std::string name = mention.kind == Kind::import ? "@" + mention.name : mention.name;
      if (const std::string text = explained(context, file.text->path(), name); !text.empty())
        return fenced("text", text);
      if (mention.kind == Kind::import) return docOfImport(context.analysis.registry(), mention.name);
      return "";
    }
  }
}

std::string ofValue(const Context& context, std::string_view key, const std::string& text) {
  const graph::Registry& registry = context.analysis.registry();
  if (key == "texture")
    if (const auto format = graph::findFormat(text)) {
      const graph::FormatInfo& info = graph::infoOf(*format);
      return fmt::format("`{}`: {} bytes per texel, {} channels{}{}\n", info.name, info.bytes, info.channels,
                         info.colorRenderable ? ", can be rendered to" : "",
                         info.imageStorable ? ", can be an image" : "");
    }
  if (key == "import") return docOfImport(registry, text);
  if (key == "type")
    for (const graph::PassType& type : registry.passTypes)
      if (type.name == text) return fmt::format("**{}**: {}\n", type.name, type.doc);
  return "";
}

Json inJson(const Context& context, const Text& text, std::size_t offset) {
  const auto file = context.project.index(text.path());
  if (!file) return nullptr;
  std::string shown;
  Range range;
  Spot spot = spotAt(text.json(), offset);
  if (const Mention* mention = file->at(offset)) {
    shown = ofMention(context, *file, *mention);
    range = mention->range;
  } else if (const JsonMember* member = spot.way.back().member; member && spot.inKey) {
    spot.way.pop_back();
    for (const KeyDoc& key : keysOf(context.analysis.registry(), spot.way))
      if (key.key == member->key) shown = fmt::format("**{}**: {}\n", key.key, key.doc);
    range = inside(*member);
  } else if (member) {
    shown = ofValue(context, member->key, member->value.text);
    range = rangeOf(member->value);
  }
  if (shown.empty()) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", shown}}}, {"range", toJson(text.map(), range)}};
}

Json inGlsl(const Context& context, const Text& text, std::size_t offset) {
  constexpr int kMostShown = 5;
  const GlslWord* const word = text.glsl().wordAt(offset);
  if (!word || word->member) return nullptr;
  std::string shown;
  int count = 0;
  for (const Project::Program& program : context.project.programsWith({text.path()})) {
    const JsonValue* const pass = nameOf(*program.stanza);
    if (!pass || count >= kMostShown) continue;
    const std::string about =
        linesAbout(explained(context, program.graph->text->path(), pass->text), std::string(word->text));
    if (about.find("\n  ") == std::string::npos) continue;
    shown += fenced("text", about);
    ++count;
  }
  if (shown.empty()) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", shown}}}, {"range", toJson(text.map(), word->range)}};
}

// Kinds of symbols of the protocol.
constexpr int kFile = 1, kNamespace = 3, kProperty = 7, kFunction = 12, kVariable = 13, kConstant = 14,
              kKey = 20;

Json symbol(const LineMap& map, std::string_view name, std::string_view detail, int kind, Range whole,
            Range own) {
  Json json{{"name", name.empty() ? "?" : std::string(name)}, {"kind", kind}};
  if (!detail.empty()) json["detail"] = std::string(detail);
  json["range"] = toJson(map, {std::min(whole.begin, own.begin), std::max(whole.end, own.end)});
  json["selectionRange"] = toJson(map, own);
  return json;
}

Json ofStanza(const LineMap& map, const JsonValue& stanza) {
  const JsonValue* const name = nameOf(stanza);
  if (!name) return nullptr;
  const std::string prefix = prefixOf(stanza);
  Json json =
      prefix.empty()
          ? symbol(map, name->text, textOf(stanza, "type"), kFunction, rangeOf(stanza), inside(*name))
          : symbol(map, prefix, textOf(stanza, "include"), kNamespace, rangeOf(stanza), inside(*name));
  Json slots = Json::array();
  for (const char* key : {"read", "write", "modify"})
    if (const JsonValue* group = stanza.find(key))
      for (const JsonMember& slot : group->members)
        slots.push_back(symbol(map, slot.key, fmt::format("{} {}", key, slot.value.text), kProperty,
                               rangeOf(slot.value), inside(slot)));
  if (!slots.empty()) json["children"] = std::move(slots);
  return json;
}

}  // namespace

Json hoverAt(const Context& context, const Text& text, std::size_t offset) {
  return text.isJson() ? inJson(context, text, offset) : inGlsl(context, text, offset);
}

Json symbolsOf(const Context& context, const Text& text) {
  const LineMap& map = text.map();
  Json all = Json::array();
  if (!text.isJson()) {
    for (const GlslName& name : text.glsl().names())
      all.push_back(symbol(map, name.name,
                           std::string_view(text.bytes())
                               .substr(name.statement.begin, name.statement.end - name.statement.begin),
                           name.kind == GlslName::Kind::define ? kConstant : kVariable, name.statement,
                           name.range));
    return all;
  }
  const auto file = context.project.index(text.path());
  if (!file || !text.json().root.is(Type::object)) return all;
  for (const JsonMember& member : text.json().root.members) {
    const bool named = member.key == "parameters" || member.key == "let" || member.key == "resources";
    if (!named && member.key != "passes") continue;
    Json group = symbol(map, member.key, "", named ? kKey : kFile, rangeOf(member.value), inside(member));
    Json children = Json::array();
    const auto detailOf = [&](const JsonValue& value) {
      return value.is(Type::object) || value.is(Type::array) ? std::string_view() : text.written(value);
    };
    for (const JsonMember& child : member.value.members) {
      if (!named) break;
      std::string_view detail = detailOf(child.value);
      for (const char* key : {"texture", "import", "input", "type", "buffer"})
        if (const JsonValue* kind = child.value.find(key)) detail = detailOf(*kind);
      children.push_back(symbol(map, child.key, detail, member.key == "resources" ? kVariable : kConstant,
                                rangeOf(child.value), inside(child)));
    }
    for (const JsonValue& item : member.value.items)
      if (Json stanza = ofStanza(map, item); !stanza.is_null()) children.push_back(std::move(stanza));
    group["children"] = std::move(children);
    all.push_back(std::move(group));
  }
  return all;
}

}  // namespace weft::app::lsp
