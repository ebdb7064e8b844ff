// What may stand at the cursor: keys by the object they are in, words and names by their key, from the trees of the texts as they
// are. Declared in features.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>

#include "app/lsp/answers/features.h"
#include "engine/glsl/source.h"
#include "engine/graph/language/format.h"
#include "engine/graph/language/keys.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/overlay.h"
#include "engine/graph/read/ref_parse.h"
#include "engine/graph/subresource.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app::lsp {

namespace {

using Type = JsonValue::Type;
namespace fs = std::filesystem;

// Kinds of items of the protocol.
enum class ItemKind {
  text = 1,
  function = 3,
  field = 5,
  variable = 6,
  module = 9,
  property = 10,
  value = 12,
  keyword = 14,
  file = 17
};

struct Item {
  std::string label;
  ItemKind kind = ItemKind::value;
  std::string detail{};
};

bool isSlotGroup(std::string_view key) {
  return key == "read" || key == "write" || key == "modify";
}

// The members of an object of the document, or none.
const std::vector<JsonMember>& membersOf(const JsonValue& root, std::string_view key) {
  static const std::vector<JsonMember> none;
  const JsonValue* const section = root.find(key);
  return section ? section->members : none;
}

const std::vector<JsonValue>& stanzasOf(const JsonValue& root) {
  static const std::vector<JsonValue> none;
  const JsonValue* const passes = root.find("passes");
  return passes ? passes->items : none;
}

class Completer {
 public:
  Completer(const Workspace& workspace, const Text& text, std::size_t offset)
      : workspace_(workspace), text_(text), offset_(offset), registry_(workspace.registry()) {}

  Json run() {
    Spot spot = spotAt(text_.json(), offset_);
    if (spot.inComment) return nullptr;
    const JsonMember* const typed = spot.inKey ? spot.way.back().member : nullptr;
    if (spot.inKey) spot.way.pop_back();
    way_ = std::move(spot.way);
    const JsonValue& node = *way_.back().value;
    if (spot.inKey || spot.atKey) {
      keys(node, typed);
      return typed ? finish(inside(*typed), "") : finish({offset_, offset_}, "\"");
    }
    value(node, keysOn(way_));
    if (node.is(Type::string)) return finish(fragment_.value_or(inside(node)), "");
    // In an array an item may be begun.
    return finish(node.is(Type::array) || node.is(Type::absent) ? Range{offset_, offset_} : rangeOf(node),
                  "\"");
  }

 private:
  void add(std::string label, ItemKind kind, std::string detail = {}) {
    if (std::ranges::find(items_, label, &Item::label) == items_.end())
      items_.push_back({std::move(label), kind, std::move(detail)});
  }
  template <class Words>
  void addWords(const Words& words, ItemKind kind = ItemKind::value) {
    for (const auto& word : words) add(std::string(word), kind);
  }

  // Calls f(root, prefix of its names, file name) for the text and what it includes or extends, each file once.
  using SeeFile = std::function<void(const JsonValue&, const std::string&, const std::string&)>;
  void eachFile(const SeeFile& f) const {
    std::set<std::string> seen;
    eachFile(text_.path(), "", seen, f);
  }
  void eachFile(const std::string& path, const std::string& prefix, std::set<std::string>& seen,
                const SeeFile& f) const {
    const auto text = seen.size() < graph::kMaxInRow * 4 && seen.insert(path).second
                          ? workspace_.texts().of(path)
                          : nullptr;
    if (!text || !text->isJson()) return;
    const JsonValue& root = text->json().root;
    f(root, prefix, fs::path(path).filename().string());
    const auto follow = [&](const JsonValue& file, const std::string& below) {
      if (file.is(Type::string))
        eachFile(pathKey((fs::path(path).parent_path() / file.text).string()), below, seen, f);
    };
    if (const JsonValue* extends = root.find("extends")) {
      follow(*extends, prefix);
      for (const JsonValue& each : extends->items) follow(each, prefix);
    }
    for (const JsonValue& stanza : stanzasOf(root))
      if (const JsonValue* include = stanza.find("include"))
        follow(*include, prefix + graph::includePrefix(stanza) + ".");
  }

  Json finish(const Range& range, const char* quote) const {
    Json list = Json::array();
    for (const Item& item : items_) {
      Json json{{"label", item.label}, {"kind", static_cast<int>(item.kind)}};
      if (!item.detail.empty()) json["detail"] = item.detail;
      json["textEdit"] = {{"range", toJson(text_.map(), range)}, {"newText", quote + item.label + quote}};
      list.push_back(std::move(json));
    }
    return {{"isIncomplete", false}, {"items", std::move(list)}};
  }

  // ---- keys ----

  const JsonValue* stanza() const {
    const std::vector<std::string_view> way = keysOn(way_);
    return way.size() > 1 && way[0] == "passes" && way_[2].value->is(Type::object) ? way_[2].value : nullptr;
  }

  void keys(const JsonValue& object, const JsonMember* typed) {
    const std::vector<std::string_view> way = keysOn(way_);
    const JsonValue* const stanza = this->stanza();
    for (KeyDoc& key : keysOf(registry_, way_))
      add(std::move(key.key), ItemKind::property, std::move(key.doc));
    if (stanza && way.size() == 3 && isSlotGroup(way[2])) slotKeys(*stanza, way[2]);
    if (stanza && way.size() == 3 && way[2] == "parameters") shaderNames(*stanza, {glsl::Role::member});
    if (stanza && way.size() == 3 && way[2] == "bind") inputs(*stanza);
    if (stanza && way.size() == 4 && way[3] == "blend")
      for (const char* group : {"write", "modify"})
        if (const JsonValue* slots = stanza->find(group))
          for (const JsonMember& slot : slots->members) add(slot.key, ItemKind::field);
    if (way.size() == 1 && way[0] == "set")
      eachFile(
          [&](const JsonValue& root, const std::string&, const std::string&) { variablesOf(root, "", ""); });
    for (const JsonMember& child : object.members)
      if (&child != typed) std::erase_if(items_, [&](const Item& item) { return item.label == child.key; });
  }

  void slotKeys(const JsonValue& stanza, std::string_view group) {
    for (const graph::PassType& type : registry_.passTypes)
      if (type.name == textOf(stanza, "type"))
        for (const graph::FixedSlot& slot : type.fixedSlots)
          if ((slot.access == graph::Access::read) == (group == "read"))
            add(slot.name, ItemKind::field, slot.doc);
    using enum glsl::Role;
    if (group == "read")
      shaderNames(stanza, {sampler, image, uniform_block, storage_block});
    else
      shaderNames(stanza, {output, image, storage_block});
    for (const char* other : {"read", "write", "modify"})
      if (const JsonValue* slots = stanza.find(other); slots && other != group)
        for (const JsonMember& slot : slots->members)
          std::erase_if(items_, [&](const Item& item) { return item.label == slot.key; });
  }

  // The files of the program of a stanza, which may be like another.
  std::vector<std::string> shaderFilesOf(const JsonValue& stanza) const {
    const JsonValue* at = &stanza;
    for (int depth = 0; at && !at->find("shader") && depth < 32; ++depth) {
      const std::string_view like = textOf(*at, "like");
      const auto& all = stanzasOf(text_.json().root);
      const auto other =
          std::ranges::find_if(all, [&](const JsonValue& each) { return textOf(each, "name") == like; });
      at = other == all.end() ? nullptr : &*other;
    }
    const JsonValue* const shader = at ? at->find("shader") : nullptr;
    std::vector<std::string> files;
    if (!shader) return files;
    const bool pair = shader->is(Type::object);
    const std::vector<std::string> folders = workspace_.shaderFolders(text_);
    for (const std::string& each : shadersOf(pair ? std::string(textOf(*shader, "fragment")) : shader->text,
                                             pair ? std::string(textOf(*shader, "vertex")) : ""))
      for (std::string& file : workspace_.shaderFiles(each, folders)) files.push_back(std::move(file));
    return files;
  }

  // Offers the names of these kinds that the program of a pass declares.
  void shaderNames(const JsonValue& stanza, std::initializer_list<glsl::Role> roles) {
    // Blocks that the engine itself gives to shaders.
    constexpr std::string_view kOwn[] = {"View", "Parameters", "Slice", "instances"};
    for (const std::string& path : shaderFilesOf(stanza))
      if (const auto text = workspace_.texts().of(path))
        for (const GlslName& name : text->glsl().names)
          if (name.role && std::ranges::find(roles, *name.role) != roles.end() &&
              std::ranges::find(kOwn, name.name) == std::end(kOwn) &&
              (name.role != glsl::Role::member || name.block == "Parameters"))
            add(std::string(name.name), ItemKind::field, std::string(name.statement));
  }

  void inputs(const JsonValue& stanza) {
    const auto text = workspace_.texts().of(
        pathKey((fs::path(text_.path()).parent_path() / textOf(stanza, "include")).string()));
    if (!text || !text->isJson()) return;
    for (const JsonMember& resource : membersOf(text->json().root, "resources"))
      if (resource.value.find("input")) add(resource.key, ItemKind::variable);
  }

  // ---- values ----

  void value(const JsonValue& node, const std::vector<std::string_view>& way) {
    if (way.empty()) return;
    const std::string_view last = way.back();
    const bool item = last == "[]";
    const std::string_view key = item && way.size() > 1 ? way[way.size() - 2] : last;
    for (const KeyDoc& each : keysOf(registry_, Way(way_.begin(), way_.end() - 1)))
      if (each.key == last && !each.words.empty()) return addWords(each.words);
    if (way[0] == "extends") return files();
    if (way[0] == "present" || way[0] == "outputs") return reference(node);
    if (way[0] == "let") return expression(node);
    if (way[0] == "resources") return resourceValue(node, way, key);
    if (way[0] == "passes" && way.size() > 2) return stanzaValue(node, way, key);
  }

  void resourceValue(const JsonValue& node, const std::vector<std::string_view>& way, std::string_view key) {
    if (way.size() == 2 || (way.size() == 3 && way[2] == "[]")) return reference(node);
    if (key == "texture") {
      for (const std::string& name : graph::formatNames()) {
        const graph::FormatInfo& info = graph::infoOf(*graph::findFormat(name));
        add(name, ItemKind::value, fmt::format("{} bytes per texel, {} channels", info.bytes, info.channels));
      }
    } else if (key == "import") {
      for (const graph::ImportType& type : registry_.imports) add(type.name, ItemKind::module, type.doc);
    } else if (key == "reset" || key == "first") {
      reference(node);
    } else if (key == "list") {
      addWords(registry_.drawLists);
    } else {
      if (key == "mips") add("full", ItemKind::keyword, "down to one texel");
      importChoices(key);
      expression(node);
    }
  }

  // The object around the value.
  const JsonValue& around() const { return *way_[way_.size() - 2].value; }

  void importChoices(std::string_view key) {
    const std::string_view import = textOf(around(), "import");
    for (const graph::ImportType& type : registry_.imports)
      if (type.name == import)
        for (const graph::ImportArgument& argument : type.arguments)
          if (argument.name == key) addWords(argument.choices);
  }

  void stanzaValue(const JsonValue& node, const std::vector<std::string_view>& way, std::string_view key) {
    const std::string_view group = way[2];
    if (isSlotGroup(group) || group == "bind" || (group == "view" && way.size() == 3)) return reference(node);
    if (group == "type") {
      for (const graph::PassType& type : registry_.passTypes) add(type.name, ItemKind::module, type.doc);
    } else if (group == "include") {
      files();
    } else if (group == "shader") {
      shaders(key);
    } else if (group == "list") {
      addWords(registry_.drawLists);
    } else if (group == "geometry") {
      for (const graph::GeometryType& type : registry_.geometries) add(type.name, ItemKind::value);
    } else if (group == "like" || group == "before" || group == "after") {
      eachFile([&](const JsonValue& root, const std::string& prefix, const std::string&) {
        for (const JsonValue& stanza : stanzasOf(root))
          if (group != "like" || &root == &text_.json().root)
            add(prefix + std::string(stanza.find("include") ? graph::includePrefix(stanza)
                                                            : textOf(stanza, "name")),
                ItemKind::function);
      });
    } else if (group == "state" && way.size() > 3 && way[3] == "blend") {
      addWords(graph::kBlendWords);
    } else if (group != "name" && group != "as" && group != "group") {
      expression(node);
    }
  }

  // ---- names inside strings ----

  // The text of the string before the name at the cursor. The range of that name goes to fragment_, the character before it to
  // sign_.
  std::string_view typed(const JsonValue& node) {
    const std::string_view all = text_.bytes();
    std::size_t begin = offset_;
    const Range whole = inside(node);
    while (begin > whole.begin && (graph::isIdentChar(all[begin - 1]) || all[begin - 1] == '.')) --begin;
    sign_ = begin > whole.begin ? all[begin - 1] : '\0';
    std::size_t end = offset_;
    while (end < whole.end && graph::isIdentChar(all[end])) ++end;
    if (sign_ == '@') --begin;
    fragment_ = Range{begin, end};
    return all.substr(whole.begin, begin - whole.begin);
  }

  void reference(const JsonValue& node) {
    const std::string_view before = node.is(Type::string) ? typed(node) : std::string_view();
    if (sign_ == '$') return variables();
    const std::size_t as = before.rfind(" as "), condition = before.rfind(" if ");
    if (condition != std::string_view::npos && (as == std::string_view::npos || as < condition))
      return expression(node);
    if (as != std::string_view::npos) {
      if (const std::size_t open = before.rfind('('); open != std::string_view::npos && open > as) {
        if (before.substr(0, open).ends_with("compare")) addWords(graph::kCompareNames, ItemKind::keyword);
        return;
      }
      for (std::size_t kind = 0; kind < graph::kKindNames.size(); ++kind)
        if (!isCommandInput(static_cast<graph::Kind>(kind))) add(graph::kKindNames[kind], ItemKind::keyword);
      addWords(graph::kSamplerWords, ItemKind::keyword);
      return;
    }
    resources();
  }

  void expression(const JsonValue& node) {
    if (!node.is(Type::string)) return;
    const std::string_view before = typed(node);
    if (sign_ == '$') return variables();
    const std::size_t open = before.rfind('(');
    if (open != std::string_view::npos && open + 1 >= before.size())
      for (const char* fact : {"size", "mips", "count", "has", "age"})
        if (before.substr(0, open).ends_with(fact)) return resources();
    for (const char* function : {"size", "mips", "count", "has", "age", "min", "max", "floor", "ceil", "abs",
                                 "pow2ceil", "log2ceil"})
      add(function, ItemKind::function);
    addWords(std::initializer_list<const char*>{"screen", "device.software", "true", "false"},
             ItemKind::keyword);
  }

  void resources() {
    eachFile([&](const JsonValue& root, const std::string& prefix, const std::string& file) {
      for (const JsonMember& each : membersOf(root, "resources"))
        add(prefix + each.key, ItemKind::variable, file);
    });
    for (const graph::ImportType& type : registry_.imports) add("@" + type.name, ItemKind::module, type.doc);
  }

  void variablesOf(const JsonValue& root, const std::string& prefix, const std::string& file) {
    for (const char* section : {"parameters", "let"})
      for (const JsonMember& each : membersOf(root, section))
        add(prefix + each.key, ItemKind::variable, file);
    for (const JsonValue& stanza : stanzasOf(root))
      for (const JsonMember& each : membersOf(stanza, "parameters"))
        if (each.value.is(Type::object))
          add(fmt::format("{}{}.{}", prefix, textOf(stanza, "name"), each.key), ItemKind::variable, file);
  }

  void variables() {
    eachFile([&](const JsonValue& root, const std::string& prefix, const std::string& file) {
      variablesOf(root, prefix, file);
    });
    // Of the files that include this one.
    for (const Graph* graph : workspace_.graphs())
      if (graph->texts.contains(text_.path()) && graph->desc->path != text_.path())
        if (const auto text = workspace_.texts().of(graph->desc->path))
          variablesOf(text->json().root, "", fs::path(text->path()).filename().string());
  }

  // ---- files ----

  void files() {
    constexpr int kMost = 1000;
    const fs::path folder = fs::path(text_.path()).parent_path();
    std::error_code ec;
    int looked = 0;
    for (auto entry =
             fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ec);
         !ec && entry != fs::recursive_directory_iterator() && ++looked < kMost; entry.increment(ec)) {
      const std::string path = entry->path().string();
      if (entry.depth() > 2) entry.disable_recursion_pending();
      if (path.ends_with(".json") && path != text_.path() && entry->is_regular_file(ec))
        add(fs::path(path).lexically_relative(folder).string(), ItemKind::file);
    }
  }

  void shaders(std::string_view key) {
    const JsonValue* const stanza = this->stanza();
    const auto type =
        std::ranges::find(registry_.passTypes, stanza ? textOf(*stanza, "type") : "", &graph::PassType::name);
    const graph::ShaderShape shape =
        type == registry_.passTypes.end() ? graph::ShaderShape::none : type->shader;
    std::string ending = shape == graph::ShaderShape::compute    ? ".comp.glsl"
                         : shape == graph::ShaderShape::fragment ? ".frag.glsl"
                                                                 : ".glsl";
    bool stem = shape == graph::ShaderShape::draw;
    if (key == "vertex" || key == "fragment") {
      ending = key == "vertex" ? ".vert.glsl" : ".frag.glsl";
      stem = false;
    }
    const std::vector<std::string> all = glsl::shadersBelow(workspace_.shaderFolders(text_));
    for (const std::string& path : all) {
      if (!stem && path.ends_with(ending)) add(path, ItemKind::file);
      if (stem && path.ends_with(".vert.glsl")) {
        const std::string both = path.substr(0, path.size() - 10);
        if (std::ranges::binary_search(all, both + ".frag.glsl")) add(both, ItemKind::file);
      }
    }
  }

  const Workspace& workspace_;
  const Text& text_;
  const std::size_t offset_;
  const graph::Registry& registry_;
  Way way_;  // to the value, or to the object around the key
  std::vector<Item> items_;
  std::optional<Range> fragment_;  // of a string: what the choice replaces
  char sign_ = '\0';
};

// Offers the slots, parameters and defines of the shader's passes, and HAS_… of slots and parameters.
Json completionInGlsl(const Workspace& workspace, const Text& text, std::size_t offset) {
  Range range{offset, offset};
  const std::string_view all = text.bytes();
  while (range.begin > 0 && graph::isIdentChar(all[range.begin - 1])) --range.begin;
  while (range.end < all.size() && graph::isIdentChar(all[range.end])) ++range.end;
  Json items = Json::array();
  std::set<std::string> seen;
  const auto add = [&](const std::string& label, ItemKind kind, const std::string& detail) {
    if (seen.insert(label).second)
      items.push_back({{"label", label},
                       {"kind", static_cast<int>(kind)},
                       {"detail", detail},
                       {"textEdit", {{"range", toJson(text.map(), range)}, {"newText", label}}}});
  };
  constexpr const char* kKinds[] = {"slot", "parameter", "define"};
  for (const Program& program : workspace.programs())
    for (const ShaderKey& key : program.keys) {
      if (!program.has(text.path())) break;
      add(key.name, key.kind == ShaderKey::Kind::slot ? ItemKind::field : ItemKind::property,
          fmt::format("{} of pass '{}'", kKinds[static_cast<std::size_t>(key.kind)], program.name));
      if (key.kind != ShaderKey::Kind::define)
        add(runtime::presenceDefineOf(key.name), ItemKind::keyword, "1 where the pass has it");
    }
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

}  // namespace

Json completionAt(const Workspace& workspace, const Text& text, std::size_t offset) {
  return text.isJson() ? Completer(workspace, text, offset).run() : completionInGlsl(workspace, text, offset);
}

}  // namespace weft::app::lsp
