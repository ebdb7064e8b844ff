// The texts that the server works on: those that the editor has open, as the editor has them, and files on disk. Open texts are
// overlays (engine/text/files/file.h), so that all of Weft reads them. Outlines are made when they are first asked for.
// Paths are absolute.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/lsp/text/positions.h"
#include "engine/glsl/interface.h"
#include "engine/text/json/dom.h"

namespace weft::app::lsp {

// ---- a place in the tree of a JSON text, also of one that is being typed ----

using text::JsonMember;
using text::JsonValue;

// The bytes of a value; of a string or a key without its quotes.
Range rangeOf(const JsonValue& value);
Range inside(const JsonValue& string);
Range inside(const JsonMember& key);
// The text of a member that is a string, or "".
std::string_view textOf(const JsonValue& object, std::string_view key);

// A value on the way from the root to another.
struct Step {
  const JsonValue* value = nullptr;
  const JsonMember* member = nullptr;  // null of the root and in arrays
};
using Way = std::vector<Step>;  // never empty
// The keys on the way; "[]" for items of arrays.
std::vector<std::string_view> keysOn(const Way& way);

struct Spot {
  Way way;             // to the innermost value here, or to the container around an empty place
  bool inKey = false;  // in the key of the last
  bool atKey = false;  // in an object, where a key may begin
  bool inComment = false;
  const JsonValue& value() const { return *way.back().value; }
};
Spot spotAt(const text::JsonTree& tree, std::size_t offset);

// ---- GLSL as it stands, without macros, and with all branches of every #if ----

struct GlslWord {
  std::string_view text;
  Range range;
  bool member = false;  // behind a dot
};

struct GlslName {
  std::optional<glsl::Role> role;  // nothing: a define
  std::string_view name;
  Range range;                 // of the name
  std::string_view block{};    // of a member
  std::string_view statement;  // the declaration; of a block up to its '{'
};

struct GlslInclude {
  std::string_view path;
  Range range;
};

// The text must outlive it.
struct GlslOutline {
  explicit GlslOutline(std::string_view text);
  const GlslName* find(std::string_view name) const;
  const GlslWord* wordAt(std::size_t offset) const;

  std::vector<GlslWord> words;
  std::vector<GlslName> names;
  std::vector<GlslInclude> includes;
};

// ---- texts ----

class Text {
 public:
  Text(std::string path, std::string bytes)
      : path_(std::move(path)), bytes_(std::move(bytes)), map_(bytes_) {}
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  const std::string& path() const { return path_; }
  const std::string& bytes() const { return bytes_; }
  const LineMap& map() const { return map_; }
  const text::JsonTree& json() const;
  const GlslOutline& glsl() const;
  // A string as it is written, without its quotes.
  std::string_view written(const JsonValue& string) const;
  bool isJson() const { return path_.ends_with(".json"); }

 private:
  const std::string path_, bytes_;
  const LineMap map_;
  mutable std::optional<text::JsonTree> json_;
  mutable std::optional<GlslOutline> glsl_;
};

class Texts {
 public:
  ~Texts();
  void open(const std::string& path, std::string text, std::int64_t version);
  // Replaces the whole text, or a range of it. Nothing happens when it is not open, or the range ends before it begins.
  void replace(const std::string& path, std::string text);
  void change(const std::string& path, const Position& start, const Position& end, const std::string& text);
  void setVersion(const std::string& path, std::int64_t version);
  void close(const std::string& path);

  // Versions by path.
  const std::map<std::string, std::int64_t>& opened() const { return opened_; }
  bool isOpen(const std::string& path) const { return opened_.contains(path); }

  // Null when there is no such file. A text that was returned does not change when the file does.
  std::shared_ptr<const Text> of(const std::string& path) const;

 private:
  struct Known {
    std::shared_ptr<const Text> text;
    std::int64_t time = 0;
    std::uint64_t bytes = 0;
  };
  std::map<std::string, std::int64_t> opened_;
  std::map<std::string, std::shared_ptr<const Text>> texts_;  // of opened_
  mutable std::map<std::string, Known> onDisk_;
};

}  // namespace weft::app::lsp
