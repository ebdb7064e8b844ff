#include "app/lsp/files/file_index.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "engine/graph/language/names.h"
#include "engine/graph/read/ref_parse.h"

namespace weft::app::lsp {

namespace {

using Kind = Mention::Kind;
using Type = JsonValue::Type;

constexpr int kMostParts = 128;  // of a dotted name; fewer files may include each other in a row

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

class Indexer {
 public:
  explicit Indexer(FileIndex& out) : out_(out) {}

  void run() {
    const JsonValue& root = out_.text->json().root;
    if (!root.is(Type::object)) return;
    if (const JsonValue* below = root.find("extends")) extends(*below);  // first: stanzas depend on it
    for (const JsonMember& member : root.members) {
      out_.isGraph |= isOneOf(member.key, {"passes", "resources", "parameters", "let", "extends", "present",
                                           "outputs"}) ||
                      (member.key == "set" && member.value.is(Type::object)) ||
                      (member.key == "$schema" && member.value.text.ends_with("graph.schema.json"));
      top(member);
    }
    out_.isPreset = out_.extends.empty() && root.find("set") && !root.find("present");
    std::ranges::stable_sort(out_.mentions, {}, [](const Mention& m) { return m.range.begin; });
  }

 private:
  void extends(const JsonValue& below) {
    if (below.is(Type::string)) {
      out_.extends.push_back(beside(below.text));
      add(Kind::file, inside(below), below.text);
    }
    for (const JsonValue& each : below.items) extends(each);
  }

  void top(const JsonMember& member) {
    const JsonValue& value = member.value;
    if (isOneOf(member.key, {"parameters", "let"})) {
      for (const JsonMember& child : value.members) {
        declare(out_.variables, Kind::variable, child);
        expressions(child.value, "");
      }
    } else if (member.key == "resources") {
      for (const JsonMember& child : value.members) resource(child);
    } else if (member.key == "set") {
      for (const JsonMember& child : value.members)
        add(Kind::variable, lastPart(inside(child), child.key), child.key);
    } else if (member.key == "passes") {
      for (const JsonValue& child : value.items)
        if (child.is(Type::object)) stanza(child);
    } else if (member.key == "present") {
      reference(value);
    } else if (member.key == "outputs") {
      for (const JsonMember& child : value.members) reference(child.value);
    }
  }

  std::string beside(std::string_view path) const {
    return pathKey((std::filesystem::path(out_.text->path()).parent_path() / path).string());
  }

  static Range lastPart(const Range& range, std::string_view name) {
    const std::size_t dot = name.rfind('.');
    return dot == std::string_view::npos ? range : Range{range.begin + dot + 1, range.end};
  }

  Mention& add(Kind kind, Range range, std::string name, bool declares = false) {
    out_.mentions.push_back(
        {.kind = kind, .range = range, .name = std::move(name), .pass = pass_, .declares = declares});
    return out_.mentions.back();
  }

  void declare(std::map<std::string, Range, std::less<>>& names, Kind kind, const JsonMember& member) {
    names.try_emplace(member.key, inside(member));
    add(kind, lastPart(inside(member), member.key), member.key, true);
  }

  void resource(const JsonMember& member) {
    declare(out_.resources, Kind::resource, member);
    references(member.value);
    for (const JsonMember& child : member.value.members) {
      if (child.key == "reset")
        references(child.value);
      else if (child.key == "first" && graph::looksLikeRef(child.value.text))
        reference(child.value);
      else if (!isOneOf(child.key, {"texture", "import", "input", "view"}))
        expressions(child.value, child.key);
    }
  }

  void stanza(const JsonValue& node) {
    pass_ = &node;
    out_.stanzas.push_back(&node);
    const std::string prefix = prefixOf(node);
    if (const JsonValue* name = nameOf(node)) {
      const std::string own = prefix.empty() ? name->text : prefix;
      // A stanza of an overlay that has no type is about a pass of the file below.
      const bool typed = !prefix.empty() || node.find("type") || node.find("like");
      const bool declares = typed || out_.extends.empty();
      if (declares) (typed ? out_.passes : out_.untyped).try_emplace(own, inside(*name));
      if (name != node.find("include")) add(Kind::pass, lastPart(inside(*name), name->text), own, declares);
    }
    for (const JsonMember& member : node.members) stanzaMember(node, member, prefix);
    pass_ = nullptr;
  }

  void stanzaMember(const JsonValue& node, const JsonMember& member, const std::string& prefix) {
    const std::string& key = member.key;
    const JsonValue& value = member.value;
    if (key == "include" && value.is(Type::string)) {
      out_.includes.try_emplace(prefix, beside(value.text));
      add(Kind::file, inside(value), value.text);
    } else if (key == "shader") {
      if (value.is(Type::string)) add(Kind::shader, inside(value), value.text);
      for (const JsonMember& child : value.members)
        if (child.value.is(Type::string)) add(Kind::shader, inside(child.value), child.value.text);
    } else if (isOneOf(key, {"read", "write", "modify"})) {
      for (const JsonMember& slot : value.members) {
        add(Kind::slot, inside(slot), slot.key, true);
        reference(slot.value);
      }
    } else if (key == "bind") {
      for (const JsonMember& bound : value.members) {
        add(Kind::resource, inside(bound), prefix + "." + bound.key);
        reference(bound.value);
      }
    } else if (isOneOf(key, {"parameters", "defines"})) {
      for (const JsonMember& each : value.members) parameter(node, each, key == "defines");
    } else if (key == "view") {
      reference(value);
    } else if (isOneOf(key, {"like", "before", "after"}) && value.is(Type::string)) {
      add(Kind::pass, lastPart(inside(value), value.text), value.text);
    } else if (key == "state") {
      if (const JsonValue* blend = value.find("blend"))
        for (const JsonMember& slot : blend->members) add(Kind::slot, inside(slot), slot.key);
      expressions(value, "");
    } else if (!isOneOf(key, {"name", "as", "type", "update", "group", "list"})) {
      expressions(value, key);
    }
  }

  void parameter(const JsonValue& node, const JsonMember& member, bool define) {
    add(define ? Kind::define : Kind::parameter, inside(member), member.key, true);
    const JsonValue* const name = nameOf(node);
    if (name && member.value.is(Type::object))
      out_.variables.try_emplace(name->text + "." + member.key, inside(member));
    expressions(member.value, member.key);
  }

  // ---- inside strings ----

  void references(const JsonValue& value) {
    reference(value);
    for (const JsonValue& item : value.items) references(item);
  }

  // Adds a mention for each part of the dotted name that begins at `at`, of the name up to that part, for kMostParts parts at
  // most. Returns where they end.
  std::size_t dotted(std::string_view text, std::size_t base, std::size_t at, Kind kind) {
    const std::size_t start = at;
    for (int parts = 1;; ++parts) {
      const std::size_t begin = at;
      while (at < text.size() && graph::isIdentChar(text[at])) ++at;
      const std::string_view part = text.substr(begin, at - begin);
      if (part.empty() || (begin > start && graph::isReservedWord(part))) return at;
      std::size_t next = at + 1;
      while (next < text.size() && graph::isIdentChar(text[next])) ++next;
      const bool goesOn = at < text.size() && text[at] == '.' && next > at + 1 &&
                          !graph::isReservedWord(text.substr(at + 1, next - at - 1));
      const bool inner = goesOn && kind != Kind::import;
      add(inner ? Kind::pass : kind, {base + begin, base + at}, std::string(text.substr(start, at - start)));
      if (!goesOn || parts == kMostParts) return at;
      ++at;
    }
  }

  void reference(const JsonValue& value) {
    if (!value.is(Type::string)) return;
    const std::string_view text = out_.text->written(value);
    const std::size_t base = inside(value).begin;
    std::size_t at = 0;
    while (at < text.size() && graph::isSpace(text[at])) ++at;
    const bool import = at < text.size() && text[at] == '@';
    if (import) ++at;
    std::size_t end = at;
    while (end < text.size() && graph::isIdentChar(text[end])) ++end;
    const bool call = end < text.size() && text[end] == '(';
    if (!call && at < text.size() && graph::isIdentStart(text[at]))
      at = dotted(text, base, at, import ? Kind::import : Kind::resource);
    expression(text, base, at);
  }

  void expressions(const JsonValue& value, std::string_view key) {
    if (isOneOf(key, {"label", "doc", "description", "choices", "type"})) return;
    if (value.is(Type::string)) expression(out_.text->written(value), inside(value).begin, 0);
    for (const JsonValue& item : value.items) expressions(item, "");
    for (const JsonMember& member : value.members) expressions(member.value, member.key);
  }

  void expression(std::string_view text, std::size_t base, std::size_t at) {
    while (at < text.size()) {
      const char c = text[at];
      if (c == '$') {
        at = std::max(dotted(text, base, at + 1, Kind::variable), at + 1);
      } else if (graph::isIdentStart(c)) {
        const std::size_t begin = at;
        while (at < text.size() && graph::isIdentChar(text[at])) ++at;
        const std::string_view word = text.substr(begin, at - begin);
        if (at < text.size() && text[at] == '(' && isOneOf(word, {"size", "mips", "count", "has", "age"})) {
          ++at;
          while (at < text.size() && graph::isSpace(text[at])) ++at;
          const bool import = at < text.size() && text[at] == '@';
          if (import) ++at;
          const std::size_t before = out_.mentions.size();
          at = dotted(text, base, at, import ? Kind::import : Kind::resource);
          if (out_.mentions.size() > before && !import) out_.mentions.back().mayBePass = word == "has";
        }
      } else {
        ++at;
      }
    }
  }

  FileIndex& out_;
  const JsonValue* pass_ = nullptr;
};

}  // namespace

bool FileIndex::doesExtend(const std::string& path) const {
  return std::ranges::find(extends, path) != extends.end();
}

const Mention* FileIndex::at(std::size_t offset) const {
  const Mention* found = nullptr;
  for (const Mention& mention : mentions)
    if (mention.range.holds(offset)) found = &mention;
  return found;
}

const JsonValue* FileIndex::stanza(std::string_view name) const {
  for (const JsonValue* each : stanzas) {
    const std::string prefix = prefixOf(*each);
    if (prefix.empty() ? textOf(*each, "name") == name : prefix == name) return each;
  }
  return nullptr;
}

std::shared_ptr<const FileIndex> indexOf(std::shared_ptr<const Text> text) {
  auto index = std::make_shared<FileIndex>();
  index->text = std::move(text);
  Indexer(*index).run();
  return index;
}

std::string prefixOf(const JsonValue& stanza) {
  const JsonValue* const include = stanza.find("include");
  if (!include || !include->is(Type::string)) return "";
  const std::string_view as = textOf(stanza, "as");
  return as.empty() ? std::filesystem::path(include->text).stem().string() : std::string(as);
}

const JsonValue* nameOf(const JsonValue& stanza) {
  for (const char* key : {"name", "as", "include"})
    if (const JsonValue* value = stanza.find(key); value && value->is(Type::string)) return value;
  return nullptr;
}

std::vector<std::string> shadersOf(const FileIndex& index, const JsonValue& stanza) {
  const JsonValue* node = &stanza;
  for (int depth = 0; node && depth < 32; ++depth) {
    if (const JsonValue* shader = node->find("shader")) {
      if (shader->is(Type::object))
        return {std::string(textOf(*shader, "vertex")), std::string(textOf(*shader, "fragment"))};
      const std::string& path = shader->text;
      if (path.ends_with(".glsl")) return {path};
      return {path + ".vert.glsl", path + ".frag.glsl"};
    }
    const std::string_view like = textOf(*node, "like");
    node = like.empty() ? nullptr : index.stanza(like);
    if (node == &stanza) break;
  }
  return {};
}

}  // namespace weft::app::lsp
