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

// Null where nothing is known. `path` is a file that can be read.
Json completionAt(const Context& context, const Text& text, std::size_t offset);
Json hoverAt(const Context& context, const Text& text, std::size_t offset);
Json symbolsOf(const Context& context, const Text& text);

// What stands here is declared there. Of a slot in GLSL: the keys in the graphs.
std::vector<Location> definitionsAt(const Context& context, const Text& text, std::size_t offset);

// All uses of what is named at a place, with its declaration.
struct Uses {
  bool found = false;
  Mention::Kind kind = Mention::Kind::resource;
  std::string name;                        // the last part
  Range here;                              // where it was asked
  std::set<Location> locations;            // of `name`
  std::set<Location> presence;             // in GLSL, of HAS_NAME
  std::set<std::string> files;             // in which the new name must be free
  std::vector<Project::Program> programs;  // of a slot
};
Uses usesAt(const Context& context, const Text& text, std::size_t offset);

// A workspace edit, or why not.
struct Renamed {
  Json edit;
  std::string problem;
};
Renamed renameAt(const Context& context, const Text& text, std::size_t offset, const std::string& name);

}  // namespace weft::app::lsp
