// Lays overlays over graph files, as JSON, before they are read as graphs: a file over the one that it `extends`, and presets
// over the result. Every value keeps the file, line and column at which it was written. An overlay may change an included file, whose names it gives whole; the changed copy is kept beside the include.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/read/read.h"
#include "engine/text/json/dom.h"

namespace weft::graph {

constexpr std::uint64_t kMaxIncludes = 1000;  // files of one graph, each use counted
constexpr std::size_t kMaxInRow = 64;  // files that include each other, and overlays that extend each other

// A file, extended and overlaid.
struct Source : FileDesc {
  std::string identity;  // canonical path, so that two spellings of one file are recognized
  text::JsonValue root;  // what stands in the file, without "extends", "set" and stanzas of overlays
  struct Set {
    text::JsonMember member;
    Origin origin = Origin::file;
  };
  std::vector<Set> sets;                                   // of "set", in the order they apply: the last wins
  std::map<std::string, std::shared_ptr<Source>> changed;  // by prefix: includes reached into
  std::size_t values = 0;                                  // of root: what a copy costs
};

// The path behind "include" or "extends": relative to the folder of the file it is written in.
std::string pathBeside(const text::JsonValue& written);
std::string identityOf(const std::string& path);

// Opens files, each once.
class SourceLoader {
 public:
  SourceLoader(text::Diagnostics& diagnostics, const ReadOptions& options)
      : diagnostics_(diagnostics), options_(options) {}

  // Null after a report (the same file again: null without another).
  std::shared_ptr<const Source> file(const std::string& path, const text::Place& from);
  // `source` with the overlay in `path` on top. Null after an error that leaves nothing to lay over it.
  std::shared_ptr<const Source> withPreset(const Source& source, const std::string& path);
  // True while the overlay of this identity is being laid over its base: it includes or extends itself.
  bool isOpen(const std::string& identity) const;
  // The texts of all files that were opened so far.
  const FileTexts& texts() const { return texts_; }
  // False after Code::limitExceeded: overlays make copies of what they are laid over, so values are counted again for each.
  bool mayCopy(const Source& source, const text::Place& place);
  // As mayCopy(), for a set that a pass gets.
  bool mayShare(const text::JsonValue& set, const text::Place& place);
  bool tooMany() const { return tooMany_; }

 private:
  std::optional<text::JsonValue> parse(const std::string& path, const text::Place& from, bool preset);
  std::shared_ptr<const Source> complete(text::JsonValue root, const std::string& path);
  bool mayAdd(std::uint64_t count, std::uint64_t& sum, std::uint64_t bound, const text::Place& place,
              const char* message);
  // False after a report. `written`: an entry of "extends".
  bool mayExtend(const text::JsonValue& written);
  // Lays an overlay over `made`, a file after those that it extends. `written`: what names it; null: the command line.
  bool layFile(Source& made, const std::string& path, const text::JsonValue* written, bool preset);
  bool lay(Source& made, const text::JsonValue& root, const std::string& path, bool preset);

  text::Diagnostics& diagnostics_;
  const ReadOptions& options_;
  FileTexts texts_;
  std::set<std::string> broken_;  // identities of overlays that failed: they are not looked at again
  std::map<std::string, std::shared_ptr<const Source>> known_;  // by identity; null for files that failed
  std::vector<std::pair<std::string, std::string>> open_;       // identity and path of such overlays
  std::uint64_t values_ = 0;                                    // of all files and copies so far
  std::uint64_t shared_ = 0;                                    // of sets, in passes
  bool tooMany_ = false;  // reported; nothing more is laid over anything
};

// The member of that key, or null.
text::JsonMember* memberOf(text::JsonValue& object, std::string_view key);
// "texture", "buffer", "import" or "inputs"; "alternatives" for what is no object; "" for an object without a kind.
std::string_view kindOf(const text::JsonValue& resource);
// What an include stanza is called: "as", else the file's name without its ending. "" when it says neither.
std::string includePrefix(const text::JsonValue& stanza);
// Name of a pass stanza, else the prefix of an include (which an overlay may also call by "name"). "" when it has none.
std::string stanzaName(const text::JsonValue& stanza);

// The short spellings of a file, written out as what everything behind the parser knows: lists of names as objects, "inputs" as
// resources, and groups of passes as passes.

// Makes objects of the lists under "read", "write", "modify", "bind" and "parameters" of passes and sets: ["ibl.brdf", { "sky":
// "clouds" }] is { "brdf": "ibl.brdf", "sky": "clouds" }. Each name stands where its string does. What is neither a string nor
// an object stays a list, which does not fit the schema.
// An input, "specular as linear ?", becomes the resource "specular": { "inputs": "specular as linear ?" }.
// Each pass of a group gets what the group says; "enabled" and "repeat", which it may have itself, stand together under its key
// "passes", at the place of the group, as often as `loader` lets passes share.
void writeOutLists(text::JsonValue& root, SourceLoader& loader, text::Diagnostics& diagnostics);

}  // namespace weft::graph
