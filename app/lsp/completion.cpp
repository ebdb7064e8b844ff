// What may be written at the cursor. Declared in workspace.h.
#include <fmt/format.h>

#include <filesystem>

#include "app/lsp/workspace.h"
#include "engine/graph/language/keys.h"
#include "engine/graph/read/overlay.h"
#include "engine/graph/read/read_context.h"
#include "engine/graph/read/ref_parse.h"
#include "engine/graph/subresource.h"
#include "engine/text/chars.h"

namespace weft::app::lsp {

namespace {

using Type = JsonValue::Type;
using Kind = graph::NameUse::Kind;
namespace fs = std::filesystem;

// ---- the schema ----

// What a value may be.
using Shapes = std::vector<const graph::Shape*>;

void addShape(const graph::Shape& shape, Shapes& out) {
  out.push_back(&shape);
  for (const graph::Shape* each : shape.anyOf) addShape(*each, out);
}

bool areShapes(const Shapes& shapes, std::string_view kind) {
  return std::ranges::find(shapes, kind, &graph::Shape::kind) != shapes.end();
}

// Of the innermost value around a spot.
Shapes shapesAt(const Spot& spot) {
  Shapes shapes{&graph::shapeOfFile(spot.values[0]->find("extends") || spot.values[0]->find("set"))};
  for (const std::string_view step : spot.keys) {
    Shapes inner;
    for (const graph::Shape* shape : shapes)
      if (const graph::KeySpec* key = inner.empty() ? shape->find(step) : nullptr)
        addShape(*key->shape, inner);
    for (const graph::Shape* shape : inner.empty() ? shapes : Shapes())
      if (const graph::Shape* each = step == "[]" ? shape->items : shape->others) addShape(*each, inner);
    shapes = std::move(inner);
  }
  return shapes;
}

// The import that an object declares; null of other objects.
const graph::ImportType* importOf(const graph::Registry& registry, const JsonValue& object) {
  return graph::findNamed(registry.imports, textOf(object, "import"));
}

// Whether an object may become of this shape.
bool fits(const graph::Shape& shape, const JsonValue& object, const JsonMember* typed) {
  const auto needed = std::ranges::find_if(shape.keys, &graph::KeySpec::required);
  const bool others = shape.others && needed != shape.keys.end() && object.find(needed->key);
  return std::ranges::all_of(object.members, [&](const JsonMember& member) {
    return &member == typed || shape.find(member.key) || others;
  });
}

// ---- completion ----

// Kinds of items of the protocol.
enum class ItemKind { field = 5, variable, module = 9, property, value = 12, keyword = 14, file = 17 };

class Completer {
 public:
  Completer(const Workspace& workspace, const Text& text, std::size_t offset)
      : workspace_(workspace), text_(text), offset_(offset), registry_(workspace.registry()) {}

  Json inJson() {
    spot_ = spotAt(text_.json(), offset_);
    if (spot_.inComment) return nullptr;
    const JsonValue& node = spot_.value();
    Range range{offset_, offset_};
    if (spot_.key || node.is(Type::object)) {
      keys();
      if (spot_.key) range = inside(*spot_.key);
      return finish(range, spot_.key ? "" : "\"");
    }
    const bool string = node.is(Type::string);
    fragment_ = string ? inside(node) : node.is(Type::array) || node.is(Type::absent) ? range : rangeOf(node);
    if (!spot_.keys.empty()) value();
    return finish(fragment_, string ? "" : "\"");
  }

  // Offers the slots, parameters and defines of the shader's passes, and HAS_… of slots and parameters.
  Json inGlsl() {
    const GlslWord* const word = text_.wordAt(offset_);
    for (const Program& program : workspace_.programs())
      for (const ShaderKey& key : program.keys) {
        if (!program.has(text_.path())) break;
        add(key.name, ItemKind::field, fmt::format("{} of pass '{}'", key.kind, program.name));
        if (key.kind != std::string_view("define"))
          add(glsl::presenceDefineOf(key.name), ItemKind::keyword, "1 where the pass has it");
      }
    return finish(word ? word->range : Range{offset_, offset_}, "");
  }

 private:
  struct Item {
    std::string label;
    ItemKind kind;
    std::string detail;
  };
  void add(std::string label, ItemKind kind, std::string detail = {}) {
    if (std::ranges::find(items_, label, &Item::label) == items_.end())
      items_.push_back({std::move(label), kind, std::move(detail)});
  }
  template <class Words>
  void addWords(const Words& words) {
    for (const auto& word : words) add(std::string(word), ItemKind::keyword);
  }
  template <class Types>
  void addTypes(const Types& types, const char* before = "") {
    for (const auto& type : types) add(before + type.name, ItemKind::module, type.doc);
  }
  void drop(const JsonValue& object) {
    for (const JsonMember& member : object.members)
      if (&member != spot_.key)
        std::erase_if(items_, [&](const Item& item) { return item.label == member.key; });
  }

  Json finish(const Range& range, const char* quote) const {
    const Json place = text_.toJson(range);
    Json list = Json::array();
    for (const Item& item : items_)
      list.push_back({{"label", item.label},
                      {"kind", static_cast<int>(item.kind)},
                      {"detail", item.detail},
                      {"textEdit", {{"range", place}, {"newText", quote + item.label + quote}}}});
    return {{"isIncomplete", false}, {"items", std::move(list)}};
  }

  void keys() {
    for (KeyDoc& key : keysAt(registry_, spot_))
      add(std::move(key.key), ItemKind::property, std::move(key.doc));
    const JsonValue* const stanza = spot_.stanza();
    const bool inList = spot_.keys.size() == 4 && spot_.keys.back() == "[]";
    const std::string_view group = spot_.keys.empty() ? "" : inList ? spot_.keys[2] : spot_.keys.back();
    if (spot_.keys.size() == 1 && group == "set") names(Kind::variable);
    if (stanza && (spot_.keys.size() == 3 || inList)) {
      slotsIn(*stanza, group);
      if (group == "bind") inputs(*stanza);
    }
    if ((spot_.keys.size() == 3 || inList) && spot_.keys[0] == "sets") keysOfSet();
    drop(spot_.value());
  }

  // Of a set: what the shaders of passes that use it have.
  void keysOfSet() {
    const auto look = [&](const auto& self, const JsonValue& around) -> void {
      const JsonValue* passes = around.find("passes");
      for (const JsonValue& stanza : passes ? passes->items : std::vector<JsonValue>()) {
        self(self, stanza);
        if (const JsonValue* use = stanza.find("use");
            use && std::ranges::count(graph::stringsOf(*use), spot_.keys[1], &JsonValue::text) > 0)
          slotsIn(stanza, spot_.keys[2]);
      }
    };
    look(look, text_.json().root);
  }

  void slotsIn(const JsonValue& stanza, std::string_view group) {
    using enum glsl::Role;
    if (group == "read") slots(stanza, {sampler, image, uniform_block, storage_block});
    if (group == "write" || group == "modify") slots(stanza, {output, image, storage_block});
    if (group == "parameters") shaderNames(stanza, {member});
  }

  void slots(const JsonValue& stanza, std::initializer_list<glsl::Role> roles) {
    if (const graph::PassType* type = graph::findNamed(registry_.passTypes, textOf(stanza, "type")))
      for (const graph::FixedSlot& slot : type->fixedSlots) add(slot.name, ItemKind::field, slot.doc);
    shaderNames(stanza, roles);
    for (const char* group : {"read", "write", "modify"})
      if (const JsonValue* slots = stanza.find(group)) drop(*slots);
  }

  // The files of the program of a stanza; of an overlay, of the pass that it changes.
  std::vector<std::string> shaderFilesOf(const JsonValue& stanza) const {
    if (const JsonValue* const shader = stanza.find("shader")) {
      const bool pair = shader->is(Type::object);
      return workspace_.shaderFiles(pair ? std::string(textOf(*shader, "fragment")) : shader->text,
                                    pair ? std::string(textOf(*shader, "vertex")) : "",
                                    workspace_.shaderFolders(text_));
    }
    for (const Graph* graph : workspace_.graphsOf(text_.path()))
      for (const Program& program : workspace_.programsOf(*graph))
        if (program.name == textOf(stanza, "name")) return workspace_.filesOf(program);
    return {};
  }

  // Offers the names of these kinds that the program of a pass declares.
  void shaderNames(const JsonValue& stanza, std::initializer_list<glsl::Role> roles) {
    // Blocks that the engine itself gives to shaders.
    constexpr std::string_view kOwn[] = {"View", "Parameters", "Slice", "instances"};
    for (const std::string& path : shaderFilesOf(stanza))
      if (const auto text = workspace_.texts().of(path))
        for (const glsl::Declaration& each : text->glsl().declarations)
          if (std::ranges::find(roles, each.role) != roles.end() &&
              std::ranges::find(kOwn, each.name) == std::end(kOwn) &&
              (each.role != glsl::Role::member || each.owner == "Parameters"))
            add(std::string(each.name), ItemKind::field, std::string(text->statementOf(each)));
  }

  void inputs(const JsonValue& stanza) {
    const auto text = workspace_.texts().of(pathBeside(text_.path(), textOf(stanza, "include")));
    if (text) inputsOf(text->json().root);
  }

  void inputsOf(const JsonValue& root) {
    const JsonValue* const inputs = root.find("inputs");
    const auto take = [&](const std::string& text) {
      add(text.substr(0, text.find_first_of(" ?")), ItemKind::variable);
    };
    for (const JsonValue& item : inputs ? inputs->items : std::vector<JsonValue>()) {
      if (item.is(Type::string)) take(item.text);
      for (const JsonMember& member : item.members) take(member.key);
    }
  }

  // Names of the graphs that have this file, as it calls them, and what it declares now.
  void names(Kind kind) {
    const JsonValue& root = text_.json().root;
    constexpr std::pair<const char*, Kind> kSections[] = {{"resources", Kind::resource},
                                                          {"sets", Kind::set},
                                                          {"parameters", Kind::variable},
                                                          {"let", Kind::variable}};
    for (const auto& [section, holds] : kSections)
      if (const JsonValue* found = root.find(section); found && holds == kind)
        for (const JsonMember& each : found->members) add(each.key, ItemKind::variable);
    if (kind == Kind::resource) inputsOf(root);
    for (const Graph* graph : workspace_.graphsOf(text_.path()))
      for (const graph::NameUse& use : workspace_.usesOf(*graph)) {
        // Of a graph that includes this file, what it declares itself: an expression here may use its parameters.
        const bool own = graph->desc->path == text_.path();
        if (use.kind != kind || use.full.starts_with('@')) continue;
        if (own || (kind == Kind::variable && *use.place.file == graph->desc->path))
          add(use.full, ItemKind::variable);
      }
  }

  // ---- values ----

  void value() {
    const auto& way = spot_.keys;
    const bool item = way.back() == "[]", pass = (spot_.stanza() || way[0] == "sets") && way.size() > 2;
    const std::string_view key = item && way.size() > 1 ? way[way.size() - 2] : way.back();
    const Shapes shapes = shapesAt(spot_);
    for (const graph::Shape* shape : shapes) addWords(shape->words);
    if (way[0] == "extends" || (pass && key == "include")) files();
    if (pass && key == "type") addTypes(registry_.passTypes);
    if (pass && way[2] == "shader") shaders(key);
    if (pass && key == "geometry")
      for (const graph::GeometryType& type : registry_.geometries) add(type.name, ItemKind::value);
    if (pass && (key == "before" || key == "after")) names(Kind::pass);
    if (pass && key == "use") names(Kind::set);
    if (key == "list") {
      addWords(registry_.drawLists);
      names(Kind::resource);
    }
    if (key == "import") addTypes(registry_.imports);
    if (const auto* type = importOf(registry_, *spot_.values[spot_.values.size() - 2]))
      if (const auto* argument = graph::findNamed(type->arguments, key)) addWords(argument->choices);
    const bool refers = areShapes(shapes, "reference") || areShapes(shapes, "resets") || key == "first";
    if (pass && way[2] == "bind")
      for (const JsonValue& stanza : spot_.values[1]->items)
        if (stanza.find("include")) add(graph::stanzaName(stanza), ItemKind::module);
    if (refers || areShapes(shapes, "value") || areShapes(shapes, "variable") || areShapes(shapes, "format"))
      mention(refers);
  }

  // A reference or an expression, of which a part is typed at the cursor.
  void mention(bool refers) {
    const std::string_view all = text_.bytes();
    const Range whole = fragment_;
    std::size_t& begin = fragment_.begin;
    const auto isPart = [&](std::size_t at) { return text::isIdentChar(all[at]) || all[at] == '.'; };
    for (begin = offset_; begin > whole.begin && isPart(begin - 1); --begin) {
    }
    for (fragment_.end = offset_; fragment_.end < whole.end && text::isIdentChar(all[fragment_.end]);)
      ++fragment_.end;
    const std::string_view before = all.substr(whole.begin, begin - whole.begin);
    if (before.ends_with('$')) return names(Kind::variable);
    if (before.ends_with('@')) --begin;
    const bool condition = before.find(" if ") != before.npos;
    if (refers && !condition && before.find(" as ") != before.npos) {
      addWords(graph::kKindNames);
      addWords(graph::kSamplerWords);
      return addWords(graph::kCompareNames);
    }
    if (const std::size_t sigil = all.substr(0, offset_).rfind('@');
        !refers && sigil >= whole.begin && sigil < offset_)
      importValues(all.substr(sigil + 1, offset_ - sigil - 1));
    names(Kind::resource);
    addTypes(registry_.imports, "@");
    if (!refers || condition)
      addWords(std::initializer_list<const char*>{
          "size",          "mips", "count",    "has",      "age",    "format",
          "min",           "max",  "floor",    "ceil",     "round",  "abs",
          "pow2",          "log2", "pow2ceil", "log2ceil", "screen", "device.software",
          "device.window", "true", "false"});
  }

  // The values of an import of which "lamps[0].col" is typed: by its type, or by a name that this file gives it.
  void importValues(std::string_view typed) {
    const std::string name(typed.substr(0, typed.find_first_of("[.")));
    const std::size_t dot = typed.rfind('.');
    if (dot == typed.npos) return;
    const JsonValue* declared = text_.json().root.find("resources");
    declared = declared ? declared->find(name) : nullptr;
    const std::string_view type = declared ? textOf(*declared, "import") : std::string_view(name);
    if (const graph::ImportType* import = graph::findNamed(registry_.imports, type))
      for (const graph::TableColumn& column : import->columns)
        add(fragment_.begin < offset_ - typed.size()
                ? fmt::format("@{}.{}", typed.substr(0, dot), column.name)
                : "." + column.name,
            ItemKind::field, fmt::format("{} {}", column.type, column.doc));
  }

  void files() {
    const fs::path folder = fs::path(text_.path()).parent_path();
    for (const std::string& path : jsonFilesBelow(folder.string()))
      if (path != text_.path()) add(fs::path(path).lexically_relative(folder).string(), ItemKind::file);
  }

  // Those with the ending that the type of the pass asks for; of a draw the stems of two.
  void shaders(std::string_view key) {
    // Of the stanza, or of the set: in a pass without a type, that of its shader.
    const graph::PassType* type = graph::findNamed(registry_.passTypes, textOf(*spot_.values[2], "type"));
    const bool compute = type && type->shader == graph::ShaderShape::compute;
    const bool stem = type && type->shader == graph::ShaderShape::draw && key == "shader";
    const std::string ending = key == "vertex" ? ".vert.glsl" : compute ? ".comp.glsl" : ".frag.glsl";
    const std::vector<std::string> all = glsl::shadersBelow(workspace_.shaderFolders(text_));
    for (const std::string& path : all) {
      const std::string both = path.substr(0, path.size() - std::min(path.size(), ending.size()));
      if ((path.ends_with(ending) || (!type && key == "shader" && path.ends_with(".comp.glsl"))) &&
          (!stem || std::ranges::binary_search(all, both + ".vert.glsl")))
        add(stem ? both : path, ItemKind::file);
    }
  }

  const Workspace& workspace_;
  const Text& text_;
  const std::size_t offset_;
  const graph::Registry& registry_;
  Spot spot_;
  std::vector<Item> items_;
  Range fragment_;  // what the choice replaces
};

}  // namespace

std::vector<KeyDoc> keysAt(const graph::Registry& registry, const Spot& spot) {
  const JsonValue& object = spot.value();
  std::vector<KeyDoc> keys;
  for (const graph::Shape* shape : shapesAt(spot))
    if (spot.keys.empty() || fits(*shape, object, spot.key))
      for (const graph::KeySpec& key : shape->keys)
        keys.push_back({std::string(key.key), std::string(key.doc)});
  if (const graph::ImportType* import = importOf(registry, object))
    for (const graph::ImportArgument& argument : import->arguments)
      keys.push_back({argument.name, argument.doc});
  // What only other types of passes take.
  const graph::PassType* const type = graph::findNamed(registry.passTypes, textOf(object, "type"));
  if (spot.stanza() == &object && type)
    std::erase_if(keys, [&](const KeyDoc& key) {
      const auto takes = [&](const graph::PassType& each) {
        return std::ranges::find(each.keys, key.key) != each.keys.end();
      };
      return key.key == "shader" ? type->shader == graph::ShaderShape::none
                                 : !takes(*type) && std::ranges::any_of(registry.passTypes, takes);
    });
  return keys;
}

Json completionAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  Completer completer(workspace, text, offset);
  return text.isJson() ? completer.inJson() : completer.inGlsl();
}

}  // namespace weft::app::lsp
