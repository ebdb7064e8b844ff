// What is shown of the thing under the cursor, and the outline of a file. Declared in workspace.h.
#include <fmt/format.h>

#include "app/lsp/workspace.h"
#include "engine/graph/print/print.h"
#include "engine/graph/read/overlay.h"

namespace weft::app::lsp {

namespace {

using Type = JsonValue::Type;

std::string fenced(const char* language, std::string_view text) {
  return fmt::format("```{}\n{}{}```\n", language, text, text.ends_with('\n') ? "" : "\n");
}

std::string ofPlan(const Graph& graph, const std::string& text) {
  return text.empty() ? ""
                      : fenced("text", text + (graph.current ? "" : "(of the last plan without errors)\n"));
}

// "" when the type is no import.
std::string docOfImport(const graph::Registry& registry, std::string_view name) {
  const graph::ImportType* const type = graph::findNamed(registry.imports, name);
  return type ? fenced("text", graph::textOf(*type)) : "";
}

// What the plan does with a name that a pass shares with its shader.
std::string ofKey(const Program& program, const std::string& name) {
  const auto& plan = program.graph->plan;
  return plan ? ofPlan(*program.graph, graph::describeInPass(*plan, program.name, name)) : "";
}

std::string ofNamed(const Workspace& workspace, const Named& named) {
  if (named.program) {
    std::string text;
    for (const std::string& path : named.program->files)
      if (const auto shader = text.empty() ? workspace.texts().of(path) : nullptr)
        if (const glsl::Declaration* found = shader->glsl().find(named.key))
          text = fenced("glsl", shader->statementOf(*found));
    return text + ofKey(*named.program, named.key);
  }
  if (named.use->kind == graph::NameUse::Kind::set) {
    const auto declared = workspace.locate(named.use->declared, "");
    const auto file = declared ? workspace.texts().of(declared->path) : nullptr;
    if (!file) return "";
    const JsonValue& set = text::valueAt(file->json().root, declared->range.begin);
    return fenced("json", std::string_view(file->bytes()).substr(set.begin, set.end - set.begin));
  }
  text::Diagnostics ignored;
  const std::string& full = named.use->full;
  const auto& plan = named.graph->plan;
  if (const auto text = plan ? graph::describe(*plan, full, ignored) : std::nullopt)
    return ofPlan(*named.graph, *text);
  return full.starts_with('@') ? docOfImport(workspace.registry(), full.substr(1)) : "";
}

Json hover(const Text& text, const std::string& shown, const Range& range) {
  if (shown.empty()) return nullptr;
  return {{"contents", {{"kind", "markdown"}, {"value", shown}}}, {"range", text.toJson(range)}};
}

Json inJson(const Workspace& workspace, const Text& text, std::size_t offset) {
  const Spot spot = spotAt(text.json(), offset);
  const graph::Registry& registry = workspace.registry();
  if (spot.key)
    for (const KeyDoc& each : keysAt(registry, spot))
      if (each.key == spot.key->key)
        return hover(text, fmt::format("**{}**: {}\n", each.key, each.doc), inside(*spot.key));
  if (const Named named = namedAt(workspace, text, offset); named.graph)
    return hover(text, ofNamed(workspace, named), named.here);
  if (const auto file = fileAt(workspace, text, offset))
    return hover(text, fmt::format("`{}`\n", file->path), rangeOf(spot.value()));
  std::string shown;
  if (!spot.keys.empty() && spot.keys.back() == "import") shown = docOfImport(registry, spot.value().text);
  if (!spot.keys.empty() && spot.keys.back() == "type")
    if (const graph::PassType* type = graph::findNamed(registry.passTypes, spot.value().text))
      shown = fmt::format("**{}**: {}\n", type->name, type->doc);
  return hover(text, shown, rangeOf(spot.value()));
}

Json inGlsl(const Workspace& workspace, const Text& text, std::size_t offset) {
  constexpr int kMaxShown = 5;
  const GlslWord* const word = text.wordAt(offset);
  if (!word || word->member) return nullptr;
  std::string shown;
  int left = kMaxShown;
  for (const Program& program : workspace.programs())
    if (left > 0 && program.has(text.path())) {
      const std::string about = ofKey(program, std::string(word->text));
      shown += about;
      left -= !about.empty();
    }
  return hover(text, shown, word->range);
}

// Kinds of symbols of the protocol.
constexpr int kNamespace = 3, kFunction = 12, kVariable = 13, kKey = 20;

Json symbol(const Text& text, std::string_view name, std::string_view detail, int kind, Range whole,
            Range own) {
  return {{"name", name.empty() ? "?" : std::string(name)},
          {"detail", std::string(detail)},
          {"kind", kind},
          {"range", text.toJson({std::min(whole.begin, own.begin), std::max(whole.end, own.end)})},
          {"selectionRange", text.toJson(own)}};
}

}  // namespace

Json hoverAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  return text.isJson() ? inJson(workspace, text, offset) : inGlsl(workspace, text, offset);
}

Json symbolsOf(const Text& text) {
  Json all = Json::array();
  if (!text.isJson())
    for (const glsl::Declaration& each : text.glsl().declarations)
      if (const auto range = text.rangeOf(each); range && each.role <= glsl::Role::member)
        all.push_back(symbol(text, each.name, text.statementOf(each), kVariable, *range, *range));
  if (!text.isJson()) return all;
  for (const JsonMember& section : text.json().root.members) {
    const bool passes = section.key == "passes";
    if (!passes && section.key != "parameters" && section.key != "let" && section.key != "resources" &&
        section.key != "sets" && section.key != "inputs")
      continue;
    Json children = Json::array();
    for (const JsonMember& child : section.value.members) {
      std::string_view detail = child.value.text;
      for (const char* key : {"texture", "import", "type"})
        if (const JsonValue* kind = child.value.find(key)) detail = kind->text;
      children.push_back(symbol(text, child.key, detail, kVariable, rangeOf(child.value), inside(child)));
    }
    const auto addItem = [&](const auto& self, const JsonValue& stanza) -> void {
      if (!passes && stanza.is(Type::string))
        children.push_back(symbol(text, stanza.text, "", kVariable, rangeOf(stanza), inside(stanza)));
      if (const JsonValue* members = passes ? stanza.find("passes") : nullptr)
        for (const JsonValue& member : members->items) self(self, member);
      const bool include = stanza.find("include");
      const JsonValue* name = nullptr;
      for (const char* key : {"include", "as", "name"})
        if (const JsonValue* value = stanza.find(key); value && value->is(Type::string)) name = value;
      if (passes && name)
        children.push_back(symbol(text, graph::stanzaName(stanza),
                                  textOf(stanza, include ? "include" : "type"),
                                  include ? kNamespace : kFunction, rangeOf(stanza), inside(*name)));
    };
    for (const JsonValue& item : section.value.items) addItem(addItem, item);
    Json group = symbol(text, section.key, "", kKey, rangeOf(section.value), inside(section));
    group["children"] = std::move(children);
    all.push_back(std::move(group));
  }
  return all;
}

}  // namespace weft::app::lsp
