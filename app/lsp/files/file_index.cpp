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
using Type = Node::Type;

constexpr int kMostParts = 128;  // of a dotted name; fewer files may include each other in a row

bool isOneOf(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

class Indexer {
 public:
  explicit Indexer(FileIndex& out) : out_(out) {}

  void run() {
    const Node& root = out_.text->json().root();
    if (root.type != Type::object) return;
    if (const Node* below = root.find("extends")) extends(*below);  // first: stanzas depend on it
    for (const auto& member : root.children) {
      out_.isGraph |= isOneOf(member->key, {"passes", "resources", "parameters", "let", "extends", "present",
                                            "outputs"}) ||
                      (member->key == "set" && member->type == Type::object) ||
                      (member->key == "$schema" && member->text.ends_with("graph.schema.json"));
      top(*member);
    }
    out_.isPreset = out_.extends.empty() && root.find("set") && !root.find("present");
    std::ranges::stable_sort(out_.mentions, {}, [](const Mention& m) { return m.range.begin; });
  }

 private:
  void extends(const Node& below) {
    const auto name = [&](const Node& written) {
      if (written.type != Type::string) return;
      out_.extends.push_back(beside(written.text));
      add(Kind::file, written.inside(), std::string(written.text));
    };
    name(below);
    for (const auto& each : below.children) name(*each);
  }

  void top(const Node& member) {
    if (isOneOf(member.key, {"parameters", "let"})) {
      for (const auto& child : member.children) {
        declare(out_.variables, Kind::variable, *child);
        if (child->type == Type::object)
          for (const auto& key : child->children) expressions(*key, key->key);
        else
          expressions(*child, "");
      }
    } else if (member.key == "resources") {
      for (const auto& child : member.children) resource(*child);
    } else if (member.key == "set") {
      for (const auto& child : member.children)
        add(Kind::variable, lastPart(child->keyRange, child->key), std::string(child->key));
    } else if (member.key == "passes") {
      for (const auto& child : member.children)
        if (child->type == Type::object) stanza(*child);
    } else if (member.key == "present") {
      reference(member);
    } else if (member.key == "outputs") {
      for (const auto& child : member.children) reference(*child);
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

  void declare(std::map<std::string, Range, std::less<>>& names, Kind kind, const Node& member) {
    names.try_emplace(std::string(member.key), member.keyRange);
    add(kind, lastPart(member.keyRange, member.key), std::string(member.key), true);
  }

  void resource(const Node& member) {
    declare(out_.resources, Kind::resource, member);
    if (member.type == Type::string || member.type == Type::array) return references(member);
    for (const auto& child : member.children) {
      if (child->key == "reset")
        references(*child);
      else if (child->key == "first" && child->type == Type::string && graph::looksLikeRef(child->text))
        reference(*child);
      else if (!isOneOf(child->key, {"texture", "import", "input", "view"}))
        expressions(*child, child->key);
    }
  }

  void stanza(const Node& node) {
    pass_ = &node;
    out_.stanzas.push_back(&node);
    const std::string prefix = prefixOf(node);
    if (const Node* name = nameNode(node)) {
      const std::string own = prefix.empty() ? std::string(name->text) : prefix;
      // A stanza of an overlay that has no type is about a pass of the file below.
      const bool typed = !prefix.empty() || node.find("type") || node.find("like");
      const bool declares = typed || out_.extends.empty();
      if (declares) (typed ? out_.passes : out_.untyped).try_emplace(own, name->inside());
      if (name->key != "include") add(Kind::pass, lastPart(name->inside(), name->text), own, declares);
    }
    for (const auto& member : node.children) stanzaMember(node, *member, prefix);
    pass_ = nullptr;
  }

  void stanzaMember(const Node& node, const Node& member, const std::string& prefix) {
    const std::string_view key = member.key;
    if (key == "include" && member.type == Type::string) {
      out_.includes.try_emplace(prefix, beside(member.text));
      add(Kind::file, member.inside(), std::string(member.text));
    } else if (key == "shader") {
      if (member.type == Type::string) add(Kind::shader, member.inside(), std::string(member.text));
      for (const auto& child : member.children)
        if (child->type == Type::string) add(Kind::shader, child->inside(), std::string(child->text));
    } else if (isOneOf(key, {"read", "write", "modify"})) {
      for (const auto& slot : member.children) {
        add(Kind::slot, slot->keyRange, std::string(slot->key), true);
        reference(*slot);
      }
    } else if (key == "bind") {
      for (const auto& bound : member.children) {
        add(Kind::resource, bound->keyRange, prefix + "." + std::string(bound->key));
        reference(*bound);
      }
    } else if (isOneOf(key, {"parameters", "defines"})) {
      for (const auto& value : member.children) parameter(node, *value, key == "defines");
    } else if (key == "view") {
      reference(member);
    } else if (isOneOf(key, {"like", "before", "after"}) && member.type == Type::string) {
      add(Kind::pass, lastPart(member.inside(), member.text), std::string(member.text));
    } else if (key == "state") {
      const Node* const blend = member.find("blend");
      if (blend && blend->type == Type::object)
        for (const auto& slot : blend->children) add(Kind::slot, slot->keyRange, std::string(slot->key));
      for (const auto& value : member.children) expressions(*value, value->key);
    } else if (!isOneOf(key, {"name", "as", "type", "update", "group", "list"})) {
      expressions(member, key);
    }
  }

  void parameter(const Node& node, const Node& value, bool define) {
    add(define ? Kind::define : Kind::parameter, value.keyRange, std::string(value.key), true);
    if (value.type == Type::object) {
      const Node* const name = nameNode(node);
      if (name)
        out_.variables.try_emplace(std::string(name->text) + "." + std::string(value.key), value.keyRange);
    }
    expressions(value, value.key);
  }

  // ---- inside strings ----

  void references(const Node& node) {
    if (node.type == Type::string) reference(node);
    for (const auto& child : node.children) references(*child);
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

  void reference(const Node& node) {
    if (node.type != Type::string) return;
    const std::size_t base = node.inside().begin;
    std::size_t at = 0;
    while (at < node.text.size() && graph::isSpace(node.text[at])) ++at;
    const bool import = at < node.text.size() && node.text[at] == '@';
    if (import) ++at;
    std::size_t end = at;
    while (end < node.text.size() && graph::isIdentChar(node.text[end])) ++end;
    const bool call = end < node.text.size() && node.text[end] == '(';
    if (!call && at < node.text.size() && graph::isIdentStart(node.text[at]))
      at = dotted(node.text, base, at, import ? Kind::import : Kind::resource);
    expression(node.text, base, at);
  }

  void expressions(const Node& node, std::string_view key) {
    if (isOneOf(key, {"label", "doc", "description", "choices", "type"})) return;
    if (node.type == Type::string) expression(node.text, node.inside().begin, 0);
    for (const auto& child : node.children) expressions(*child, child->key);
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
  const Node* pass_ = nullptr;
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

const Node* FileIndex::stanza(std::string_view name) const {
  for (const Node* each : stanzas) {
    const std::string prefix = prefixOf(*each);
    if (prefix.empty() ? each->textOf("name") == name : prefix == name) return each;
  }
  return nullptr;
}

std::shared_ptr<const FileIndex> indexOf(std::shared_ptr<const Text> text) {
  auto index = std::make_shared<FileIndex>();
  index->text = std::move(text);
  Indexer(*index).run();
  return index;
}

std::string prefixOf(const Node& stanza) {
  const Node* const include = stanza.find("include");
  if (!include || include->type != Type::string) return "";
  const std::string_view as = stanza.textOf("as");
  return as.empty() ? std::filesystem::path(include->text).stem().string() : std::string(as);
}

const Node* nameNode(const Node& stanza) {
  for (const char* key : {"name", "as", "include"})
    if (const Node* node = stanza.find(key); node && node->type == Type::string) return node;
  return nullptr;
}

std::vector<std::string> shadersOf(const FileIndex& index, const Node& stanza) {
  const Node* node = &stanza;
  for (int depth = 0; node && depth < 32; ++depth) {
    if (const Node* shader = node->find("shader")) {
      if (shader->type == Type::object)
        return {std::string(shader->textOf("vertex")), std::string(shader->textOf("fragment"))};
      const std::string path(shader->text);
      if (path.ends_with(".glsl")) return {path};
      return {path + ".vert.glsl", path + ".frag.glsl"};
    }
    const std::string_view like = node->textOf("like");
    node = like.empty() ? nullptr : index.stanza(like);
    if (node == &stanza) break;
  }
  return {};
}

}  // namespace weft::app::lsp
