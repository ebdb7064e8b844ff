// The answers to what an editor asks about a place in a file, as JSON of the Language Server Protocol 3.17. `offset`: a byte of the
// text. Null where nothing is known.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "app/lsp/files/workspace.h"

namespace weft::app::lsp {

Json completionAt(const Workspace& workspace, const Text& text, std::size_t offset);
Json hoverAt(const Workspace& workspace, const Text& text, std::size_t offset);
Json symbolsOf(const Text& text);

struct KeyDoc {
  std::string key, doc;
  std::span<const std::string_view> words{};  // that it may be, where these are few
};
// The keys of the object at the end of the way; empty where the author names them.
std::vector<KeyDoc> keysOf(const graph::Registry& registry, const Way& object);

// What is named at an offset of a JSON text: a name of graphs, a name that a pass and its shader share, or nothing.
struct Named {
  const Graph* graph = nullptr;
  const graph::NameUse* use = nullptr;
  std::optional<Program> program;  // without its files; `key` is one of its keys
  std::optional<ShaderKey> key;
  Range here;
};
Named namedAt(const Workspace& workspace, const Text& text, std::size_t offset);

// Where the thing at the offset is declared; for a slot in GLSL, its keys in the graphs.
std::vector<Location> definitionsAt(const Workspace& workspace, const Text& text, std::size_t offset);

// All uses of what is named at a place, with its declaration.
struct Uses {
  bool found = false;
  bool ofShader = false;                                       // a slot, parameter or define
  graph::NameUse::Kind kind = graph::NameUse::Kind::resource;  // of the others
  std::string name;                                            // the last part of a dotted name
  Range here;                                                  // where it was asked
  std::set<Location> locations;                                // of `name`
  std::set<Location> presence;                                 // in GLSL, of HAS_NAME
  std::set<std::string> files;                                 // files in which a new name must be free
  std::vector<Program> programs;                               // of a slot: those that have it
};
Uses usesAt(const Workspace& workspace, const Text& text, std::size_t offset);

// A workspace edit; or why the name cannot be changed, then `edit` is null.
struct Renamed {
  Json edit;
  std::string problem;
};
Renamed renameAt(const Workspace& workspace, const Text& text, std::size_t offset, const std::string& name);

// The file that a JSON text names at the offset, by "include", "extends" or "shader".
std::optional<Location> fileAt(const Workspace& workspace, const Text& text, std::size_t offset);

}  // namespace weft::app::lsp
