// What may stand at the cursor: keys by the object they are in, words and names by their key. Declared in features.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "app/lsp/answers/features.h"
#include "app/lsp/answers/items.h"
#include "app/lsp/answers/key_tables.h"
#include "engine/glsl/source.h"
#include "engine/graph/language/format.h"
#include "engine/graph/language/keys.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/ref_parse.h"
#include "engine/graph/subresource.h"

namespace weft::app::lsp {

namespace {

using Type = JsonValue::Type;
namespace fs = std::filesystem;

struct Item {
  std::string label;
  ItemKind kind = ItemKind::value;
  std::string detail{};
};

bool isSlotGroup(std::string_view key) {
  return key == "read" || key == "write" || key == "modify";
}

class Completer {
 public:
  Completer(const Context& context, const Text& text, std::size_t offset)
      : context_(context),
        text_(text),
        offset_(offset),
        registry_(context.analysis.registry()),
        file_(context.project.index(text.path())) {}

  Json run() {
    Spot spot = spotAt(text_.json(), offset_);
    if (!file_ || spot.inComment) return nullptr;
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
    if (stanza && way.size() == 3 && way[2] == "parameters") shaderNames(*stanza, {GlslName::Kind::member});
    if (stanza && way.size() == 3 && way[2] == "bind") inputs(*stanza);
    if (stanza && way.size() == 4 && way[3] == "blend")
      for (const char* group : {"write", "modify"})
        if (const JsonValue* slots = stanza->find(group))
          for (const JsonMember& slot : slots->members) add(slot.key, ItemKind::field);
    if (way.size() == 1 && way[0] == "set")
      for (const std::string& path : context_.project.closure(text_.path()))
        if (const auto file = context_.project.index(path))
          for (const auto& [name, range] : file->variables) add(name, ItemKind::variable);
    for (const JsonMember& child : object.members)
      if (&child != typed) std::erase_if(items_, [&](const Item& item) { return item.label == child.key; });
  }

  void slotKeys(const JsonValue& stanza, std::string_view group) {
    for (const graph::PassType& type : registry_.passTypes)
      if (type.name == textOf(stanza, "type"))
        for (const graph::FixedSlot& slot : type.fixedSlots)
          if ((slot.access == graph::Access::read) == (group == "read"))
            add(slot.name, ItemKind::field, slot.doc);
    using enum GlslName::Kind;
    if (group == "read")
      shaderNames(stanza, {sampler, image, uniform_block, storage_block});
    else
      shaderNames(stanza, {output, image, storage_block});
    for (const char* other : {"read", "write", "modify"})
      if (const JsonValue* slots = stanza.find(other); slots && other != group)
        for (const JsonMember& slot : slots->members)
          std::erase_if(items_, [&](const Item& item) { return item.label == slot.key; });
  }

  // Offers the names of these kinds that the program of a pass declares.
  void shaderNames(const JsonValue& stanza, std::initializer_list<GlslName::Kind> kinds) {
    // Blocks that the engine itself gives to shaders.
    constexpr std::string_view kOwn[] = {"View", "Parameters", "Slice", "instances"};
    const Project::Program program = context_.project.programOf(file_, stanza);
    for (const std::string& path : program.files) {
      const auto text = context_.texts.of(path);
      if (!text) continue;
      for (const GlslName& name : text->glsl().names()) {
        const bool wanted = std::ranges::find(kinds, name.kind) != kinds.end();
        if (!wanted || std::ranges::find(kOwn, name.name) != std::end(kOwn)) continue;
        if (name.kind == GlslName::Kind::member && name.block != "Parameters") continue;
        const auto statement = std::string_view(text->bytes())
                                   .substr(name.statement.begin, name.statement.end - name.statement.begin);
        add(std::string(name.name), ItemKind::field, std::string(statement));
      }
    }
  }

  void inputs(const JsonValue& stanza) {
    const auto include = file_->includes.find(prefixOf(stanza));
    const auto below = include == file_->includes.end() ? nullptr : context_.project.index(include->second);
    if (!below) return;
    if (const JsonValue* resources = below->text->json().root.find("resources"))
      for (const JsonMember& resource : resources->members)
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
      for (const std::string& path : context_.project.closure(text_.path()))
        if (const auto file = context_.project.index(path); file && (group != "like" || path == text_.path()))
          for (const auto& [name, range] : file->passes)
            add(context_.project.prefixIn(text_.path(), path).value_or("") + name, ItemKind::function);
    } else if (group == "group") {
      for (const JsonValue* other : file_->stanzas)
        if (const std::string_view name = textOf(*other, "group"); !name.empty() && other != &around())
          add(std::string(name), ItemKind::value);
    } else if (group == "state" && way.size() > 3 && way[3] == "blend") {
      addWords(graph::kBlendWords);
    } else if (group != "name" && group != "as") {
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
    const JsonValue* const repeat = stanza() ? stanza()->find("repeat") : nullptr;
    if (!repeat) return;
    const auto indices = [&](const JsonValue& ranges) {
      for (const JsonMember& index : ranges.members)
        add(index.key, ItemKind::variable, "index of the repeat");
    };
    indices(*repeat);
    for (const JsonValue& item : repeat->items) indices(item);
  }

  void resources() {
    const auto addOf = [&](const FileIndex& file, const std::string& prefix) {
      for (const auto& [name, range] : file.resources)
        add(prefix + name, ItemKind::variable, fs::path(file.text->path()).filename().string());
    };
    addOf(*file_, "");
    for (const std::string& path : context_.project.closure(text_.path()))
      if (const auto prefix =
              path == text_.path() ? std::nullopt : context_.project.prefixIn(text_.path(), path))
        if (const auto file = context_.project.index(path)) addOf(*file, *prefix);
    for (const graph::ImportType& type : registry_.imports) add("@" + type.name, ItemKind::module, type.doc);
  }

  void variables() {
    for (const std::string& path : context_.project.closure(text_.path()))
      if (const auto prefix = context_.project.prefixIn(text_.path(), path))
        if (const auto file = context_.project.index(path))
          for (const auto& [name, range] : file->variables)
            add(*prefix + name, ItemKind::variable,
                path == text_.path() ? "" : fs::path(path).filename().string());
    for (const std::string& includer : context_.project.includersOf(text_.path()))
      if (const auto file = context_.project.index(includer))
        for (const auto& [name, range] : file->variables)
          add(name, ItemKind::variable, fs::path(includer).filename().string());
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
    const std::vector<std::string> all = glsl::shadersBelow(context_.project.shaderFolders(text_.path()));
    for (const std::string& path : all) {
      if (!stem && path.ends_with(ending)) add(path, ItemKind::file);
      if (stem && path.ends_with(".vert.glsl")) {
        const std::string both = path.substr(0, path.size() - 10);
        if (std::ranges::binary_search(all, both + ".frag.glsl")) add(both, ItemKind::file);
      }
    }
  }

  const Context& context_;
  const Text& text_;
  const std::size_t offset_;
  const graph::Registry& registry_;
  const std::shared_ptr<const FileIndex> file_;
  Way way_;  // to the value, or to the object around the key
  std::vector<Item> items_;
  std::optional<Range> fragment_;  // of a string: what the choice replaces
  char sign_ = '\0';
};

}  // namespace

Json completionAt(const Context& context, const Text& text, std::size_t offset) {
  return text.isJson() ? Completer(context, text, offset).run() : completionInGlsl(context, text, offset);
}

}  // namespace weft::app::lsp
