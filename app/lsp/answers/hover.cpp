// What is shown of the thing under the cursor, and the outline of a file. Declared in features.h.
#include <fmt/format.h>

#include <algorithm>

#include "app/lsp/answers/features.h"
#include "engine/graph/language/format.h"
#include "engine/graph/print/print.h"
#include "engine/graph/read/overlay.h"

namespace weft::app::lsp {

namespace {

using Type = JsonValue::Type;

std::string fenced(const char* language, std::string_view text) {
  return fmt::format("```{}\n{}{}```\n", language, text, text.ends_with('\n') ? "" : "\n");
}

const char* ageOf(const Graph& graph) {
  return graph.current ? "" : "(of the last plan without errors)\n";
}

// As Markdown; "" when the type is no import.
std::string docOfImport(const graph::Registry& registry, std::string_view name) {
  for (const graph::ImportType& type : registry.imports) {
    if (type.name != name) continue;
    std::string text = fmt::format("**@{}**: {}\n", type.name, type.doc);
    for (const graph::ImportArgument& argument : type.arguments)
      text += fmt::format("- `{}` (default {}): {}\n", argument.name, graph::toText(argument.initial),
                          argument.doc);
    for (const graph::TableColumn& column : type.columns)
      text += fmt::format("- `.{}` {}: {}\n", column.name, column.type, column.doc);
    return text;
  }
  return "";
}

// What the plan does with a name that a pass shares with its shader.
std::string ofKey(const Program& program, const std::string& name) {
  const auto& plan = program.graph->plan;
  const std::string text = plan ? graph::describeInPass(*plan, program.name, name) : "";
  return text.empty() ? "" : fenced("text", text + ageOf(*program.graph));
}

std::string ofNamed(const Workspace& workspace, const Named& named) {
  if (named.key) {
    std::string text;
    if (const auto declared = workspace.findInShaders(workspace.filesOf(*named.program), named.key->name)) {
      const auto shader = workspace.texts().of(declared->path);
      if (const GlslName* name = shader->glsl().find(named.key->name)) text = fenced("glsl", name->statement);
    }
    return text + ofKey(*named.program, named.key->name);
  }
  text::Diagnostics ignored;
  const std::string& full = named.use->full;
  const auto& plan = named.graph->plan;
  if (const auto text = plan ? graph::describe(*plan, full, ignored) : std::nullopt)
    return fenced("text", *text + ageOf(*named.graph));
  return full.starts_with('@') ? docOfImport(workspace.registry(), full.substr(1)) : "";
}

std::string ofValue(const graph::Registry& registry, std::string_view key, const std::string& text) {
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

Json hover(const Text& text, const std::string& shown, const Range& range) {
  if (shown.empty()) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", shown}}}, {"range", toJson(text.map(), range)}};
}

Json inJson(const Workspace& workspace, const Text& text, std::size_t offset) {
  if (const Named named = namedAt(workspace, text, offset); named.graph)
    return hover(text, ofNamed(workspace, named), named.here);
  Spot spot = spotAt(text.json(), offset);
  const JsonMember* const member = spot.way.back().member;
  if (const auto file = fileAt(workspace, text, offset))
    return hover(text, fmt::format("`{}`\n", file->path), rangeOf(spot.value()));
  if (!member) return nullptr;
  if (!spot.inKey)
    return hover(text, ofValue(workspace.registry(), member->key, member->value.text),
                 rangeOf(member->value));
  spot.way.pop_back();
  for (const KeyDoc& key : keysOf(workspace.registry(), spot.way))
    if (key.key == member->key)
      return hover(text, fmt::format("**{}**: {}\n", key.key, key.doc), inside(*member));
  return nullptr;
}

Json inGlsl(const Workspace& workspace, const Text& text, std::size_t offset) {
  constexpr int kMaxShown = 5;
  const GlslWord* const word = text.glsl().wordAt(offset);
  if (!word || word->member) return nullptr;
  std::string shown;
  int count = 0;
  for (const Program& program : workspace.programs())
    if (count < kMaxShown && program.has(text.path()))
      if (const std::string about = ofKey(program, std::string(word->text)); !about.empty()) {
        shown += about;
        ++count;
      }
  return hover(text, shown, word->range);
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
  const JsonValue* name = nullptr;
  for (const char* key : {"include", "as", "name"})
    if (const JsonValue* value = stanza.find(key); value && value->is(Type::string)) name = value;
  if (!name) return nullptr;
  const std::string prefix = stanza.find("include") ? graph::includePrefix(stanza) : "";
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

Json hoverAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  return text.isJson() ? inJson(workspace, text, offset) : inGlsl(workspace, text, offset);
}

Json symbolsOf(const Text& text) {
  const LineMap& map = text.map();
  Json all = Json::array();
  if (!text.isJson()) {
    for (const GlslName& name : text.glsl().names) {
      const auto begin = static_cast<std::size_t>(name.statement.data() - text.bytes().data());
      all.push_back(symbol(map, name.name, name.statement, name.role ? kVariable : kConstant,
                           {begin, begin + name.statement.size()}, name.range));
    }
    return all;
  }
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
