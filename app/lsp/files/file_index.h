// What one graph file declares and which names it mentions, each with its byte range. It is made from the outline, so it works
// while the file is being typed. Does not: look into other files (project.h does).
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "app/lsp/text/texts.h"

namespace weft::app::lsp {

struct Mention {
  enum class Kind : std::uint8_t {
    resource,   // also of an include: "post.glow"
    import,     // @name
    variable,   // $name: a parameter, a let, a parameter of a pass
    pass,       // also the prefix of an include
    slot,       // a key of read, write, modify, or of blend
    parameter,  // a key of a pass's parameters
    define,     // a key of a pass's defines
    file,       // of include or extends
    shader
  };
  Kind kind = Kind::resource;
  bool mayBePass = false;  // of has(x): the name of a resource, or of a pass when there is no such resource
  Range range;             // of the last part of the name
  std::string name;        // all parts up to that one, without @ and $
  const JsonValue* pass = nullptr;  // the stanza it stands in
  bool declares = false;
};

struct FileIndex {
  std::shared_ptr<const Text> text;
  bool isGraph = false;   // has a key that only graphs, overlays and presets have, or names their schema
  bool isPreset = false;  // sets values, shows no picture and extends nothing
  std::vector<std::string> extends;  // absolute paths: the lowest file first, then what is laid over it
  std::map<std::string, std::string, std::less<>> includes;  // absolute paths by prefix
  std::map<std::string, Range, std::less<>> resources, variables, passes;
  std::map<std::string, Range, std::less<>> untyped;  // stanzas without a type, where nothing is extended
  std::vector<const JsonValue*> stanzas;              // passes and includes
  std::vector<Mention> mentions;                      // in the order of the text

  bool doesExtend(const std::string& path) const;
  const Mention* at(std::size_t offset) const;
  const JsonValue* stanza(std::string_view name) const;
};

std::shared_ptr<const FileIndex> indexOf(std::shared_ptr<const Text> text);

// The prefix of an include: its "as", else the file's name. "" for a pass.
std::string prefixOf(const JsonValue& stanza);
// What names a stanza: the string of "name", "as" or "include". Null when there is none.
const JsonValue* nameOf(const JsonValue& stanza);
// The shaders that a stanza names, with what "like" takes over: paths as written, of a draw both.
std::vector<std::string> shadersOf(const FileIndex& index, const JsonValue& stanza);

}  // namespace weft::app::lsp
