// The answers to what an editor asks about a place in a file, as JSON of the Language Server Protocol 3.17. `offset`: a byte of the
// text. Null where nothing is known.
#pragma once

#include "app/lsp/workspace.h"

namespace weft::app::lsp {

Json completionAt(const Workspace& workspace, const Text& text, std::size_t offset);
Json hoverAt(const Workspace& workspace, const Text& text, std::size_t offset);
Json symbolsOf(const Text& text);

struct KeyDoc {
  std::string key, doc;
};
// The keys that the innermost object around the spot may have; empty where the author names them.
std::vector<KeyDoc> keysAt(const graph::Registry& registry, const Spot& spot);

// What is named at an offset of a JSON text: a name of graphs, a name that a pass and its shader share, or nothing.
struct Named {
  const Graph* graph = nullptr;
  const graph::NameUse* use = nullptr;
  std::optional<Program> program;  // `key` is the name of one of its keys
  std::string key;
  Range here;
};
Named namedAt(const Workspace& workspace, const Text& text, std::size_t offset);
// The file that a JSON text names at the offset, by "include", "extends" or "shader".
std::optional<Location> fileAt(const Workspace& workspace, const Text& text, std::size_t offset);

// Where the thing at the offset is declared; for a slot in GLSL, its keys in the graphs.
std::set<Location> definitionsAt(const Workspace& workspace, const Text& text, std::size_t offset);

// All uses of what is named at a place, with its declaration.
struct Uses {
  bool found = false;
  bool ofShader = false;                                       // a slot, parameter or define
  graph::NameUse::Kind kind = graph::NameUse::Kind::resource;  // of the others
  std::string name;                                            // the last part of a dotted name
  std::set<Location> locations;                                // of `name`
  std::set<Location> keys;                                     // of these, NameUse::key
  std::set<Location> presence;                                 // in GLSL, of HAS_NAME
  std::vector<Program> programs;                               // of a slot: those that have it
};
Uses usesAt(const Workspace& workspace, const Text& text, std::size_t offset);

// A workspace edit; or why the name cannot be changed, then `edit` is null.
struct Renamed {
  Json edit;
  std::string problem;
};
Renamed renameAt(const Workspace& workspace, const Text& text, std::size_t offset, const std::string& name);

}  // namespace weft::app::lsp
