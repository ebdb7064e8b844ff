// The texts that the server works on: as the editor has them open (overlays, engine/text/files/file.h), and files on disk. Paths are
// absolute; positions are lines from 0 and UTF-16 code units, as the protocol has them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/glsl/interface.h"
#include "engine/imports/world.h"
#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"

namespace weft::app::lsp {

using Json = nlohmann::ordered_json;
using Range = text::ByteRange;
using text::JsonMember;
using text::JsonValue;

// The path of a file: URI; "" for another URI.
std::string pathOfUri(std::string_view uri);
// An absolute path without "." and "..", of one that is written in a file.
std::string pathBeside(const std::string& file, std::string_view path);

// ---- a place in the tree of a JSON text, also of one that is being typed ----

// The bytes of a value; of a string or a key without its quotes.
Range rangeOf(const JsonValue& value);
Range inside(const JsonValue& string);
Range inside(const JsonMember& key);
// The text of a member that is a string, or "".
std::string_view textOf(const JsonValue& object, std::string_view key);

struct Spot {
  std::vector<const JsonValue*> values;  // from the root to the innermost value here
  std::vector<std::string_view> keys;    // that lead from each to the next; "[]" in arrays
  const JsonMember* key = nullptr;       // a key of the innermost value, in which the spot is
  bool inComment = false;
  const JsonValue& value() const { return *values.back(); }
  // The stanza of a pass or an include that holds the spot, or null.
  const JsonValue* stanza() const;
};
Spot spotAt(const text::JsonTree& tree, std::size_t offset);

// ---- texts ----

struct GlslWord {
  std::string_view text;
  Range range;
  bool member = false;  // behind a dot
};

class Text {
 public:
  Text(std::string path, std::string bytes);
  Text(const Text&) = delete;
  Text& operator=(const Text&) = delete;
  const std::string& path() const { return path_; }
  const std::string& bytes() const { return bytes_; }
  bool isJson() const { return path_.ends_with(".json"); }

  // Of {"line", "character"}, or a Json::exception. A position outside is taken for the nearest one inside.
  std::size_t offsetOf(const Json& position) const;
  Json toJson(const Range& range) const;
  // Where Weft counts lines and bytes, both from 1.
  text::Place placeOf(std::size_t offset) const;

  // Editors ask at each keystroke, so of a large text only the beginning is looked at.
  bool isLarge() const { return bytes_.size() > kMaxBytes; }
  static constexpr std::size_t kMaxBytes = 1 << 20, kBeginning = 4096;

  const text::JsonTree& json() const;
  // GLSL as it stands: the words outside comments and the paths of includes, and what all branches of every #if declare.
  const std::vector<GlslWord>& words() const;
  const GlslWord* wordAt(std::size_t offset) const;
  const glsl::Interface& glsl() const;
  // The name of a declaration, and its whole statement. Nothing where a macro makes the name.
  std::optional<Range> rangeOf(const glsl::Declaration& declaration) const;
  std::string_view statementOf(const glsl::Declaration& declaration) const;

 private:
  std::size_t offsetOf(const glsl::Token& token) const;
  std::size_t lineOf(std::size_t offset) const;  // from 1

  const std::string path_, bytes_;
  std::vector<std::size_t> lines_{0};  // where they begin
  mutable std::optional<text::JsonTree> json_;
  mutable std::optional<std::vector<GlslWord>> words_;
  mutable std::optional<glsl::Interface> glsl_;
};

class Texts {
 public:
  void open(const std::string& path, std::string text, std::int64_t version);
  void close(const std::string& path);
  struct Open {
    std::int64_t version = 0;
    std::shared_ptr<const Text> text;
  };
  const std::map<std::string, Open>& opened() const { return opened_; }  // by path
  bool isOpen(const std::string& path) const { return opened_.contains(path); }

  // Null when there is no such file. A text that was returned does not change when the file does.
  std::shared_ptr<const Text> of(const std::string& path) const;

 private:
  std::map<std::string, Open> opened_;
  mutable imports::Files onDisk_;
};

}  // namespace weft::app::lsp
