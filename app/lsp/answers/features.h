// The answers to what an editor asks about a place in a file, as JSON of the Language Server Protocol 3.17.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "app/lsp/files/analysis.h"
#include "app/lsp/files/project.h"

namespace weft::app::lsp {

struct Context {
  const Texts& texts;
  const Project& project;
  const Analysis& analysis;
};

// Completion items, what hovering shows, and the outline of a file. `offset`: a byte of the text. Null where nothing is known.
Json completionAt(const Context& context, const Text& text, std::size_t offset);
Json hoverAt(const Context& context, const Text& text, std::size_t offset);
Json symbolsOf(const Context& context, const Text& text);

// Where the thing at the offset is declared; for a slot in GLSL, its keys in the graphs.
std::vector<Location> definitionsAt(const Context& context, const Text& text, std::size_t offset);

// All uses of what is named at a place, with its declaration.
struct Uses {
  bool found = false;
  Mention::Kind kind = Mention::Kind::resource;
  std::string name;                        // the last part of a dotted name
  Range here;                              // where it was asked
  std::set<Location> locations;            // of `name`
  std::set<Location> presence;             // in GLSL, of HAS_NAME
  std::set<std::string> files;             // files in which a new name must be free
  std::vector<Project::Program> programs;  // of a slot: those that have it
};
Uses usesAt(const Context& context, const Text& text, std::size_t offset);

// A workspace edit; or why the name cannot be changed, then `edit` is null.
struct Renamed {
  Json edit;
  std::string problem;
};
Renamed renameAt(const Context& context, const Text& text, std::size_t offset, const std::string& name);

}  // namespace weft::app::lsp
