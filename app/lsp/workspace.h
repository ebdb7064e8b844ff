// The graphs that the editor has open or that lie in its folders: which names they use and where these are declared, and what Weft
// reports of the open ones. Opens no context, and compiles no shaders.
#pragma once

#include <algorithm>
#include <set>
#include <tuple>

#include "app/lsp/texts.h"
#include "app/session/options.h"
#include "engine/glsl/source.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/plan.h"
#include "engine/graph/read/read.h"
#include "engine/graph/registry.h"

namespace weft::app::lsp {

struct Location {
  std::string path;
  Range range;
  friend bool operator<(const Location& a, const Location& b) {
    return std::tie(a.path, a.range.begin) < std::tie(b.path, b.range.begin);
  }
  friend bool operator==(const Location& a, const Location& b) {
    return a.path == b.path && a.range.begin == b.range.begin;
  }
};

// A graph with all files that belong to it.
struct Graph {
  std::map<std::string, std::shared_ptr<const Text>> texts;  // as they were read last
  std::shared_ptr<const graph::GraphDesc> read;              // of these texts; null where they cannot be read
  text::Diagnostics readSaid;
  // As all of them could be read last; places may be those of older texts.
  std::shared_ptr<const graph::GraphDesc> desc;
  mutable std::optional<std::vector<graph::NameUse>> uses;  // of `desc`, once asked for: Workspace::usesOf()
  std::vector<std::string> shaderFolders;
  // Of a graph that is open and belongs to no other:
  bool checked = false;
  std::shared_ptr<const graph::Plan> plan;  // the last one that was made; it may be older than the texts
  bool current = false;                     // whether the plan is of the present texts
  text::Diagnostics said;
};

// A name of a pass that its shader has, too: a slot, parameter or define.
struct ShaderKey {
  const char* kind = "slot";
  std::string name;
  text::Place place;  // of its first character
};

// A pass and the GLSL files of its program.
struct Program {
  const Graph* graph = nullptr;
  const graph::PassDesc* pass = nullptr;
  std::string name;  // of the pass in the plan
  std::vector<ShaderKey> keys;
  std::vector<std::string> files{};
  bool has(const std::string& file) const { return std::ranges::find(files, file) != files.end(); }
};

// At most 20,000 files are looked at.
std::set<std::string> jsonFilesBelow(const std::string& folder);

class Workspace {
 public:
  Workspace(const Options& options, const Texts& texts);

  // The folders that the editor shows. When all uses of a name are wanted, the graphs in them count.
  void setFolders(std::vector<std::string> folders) { folders_ = std::move(folders); }
  bool isInFolders(const std::string& path) const;
  const Texts& texts() const { return texts_; }
  const graph::Registry& registry() const { return registry_; }

  // To be called first: files may have changed since the last call.
  void look();
  // Checks the open graphs that no other open graph includes or extends, and all that include each other in a circle.
  void check();
  // What the last check() said of each file, each message once.
  std::map<std::string, text::Diagnostics> diagnostics() const;

  // Reads what has changed of the graphs that are open or in the folders. To be called before each request.
  void readAll();
  // Those that no other includes, the open ones first.
  const std::vector<const Graph*>& graphs() const { return roots_; }
  // All that have this file.
  std::vector<const Graph*> graphsOf(const std::string& path) const;
  // The uses of names in a graph that could be read.
  const std::vector<graph::NameUse>& usesOf(const Graph& graph) const;
  // A place of a graph, unless the text has another name there now.
  std::optional<Location> locate(const text::Place& place, std::string_view name) const;

  // The programs of all graphs; of one, without their files; and the files of one.
  std::vector<Program> programs() const;
  std::vector<Program> programsOf(const Graph& graph) const;
  std::vector<std::string> filesOf(const Program& program) const;
  // Folders in which the shaders of a file are looked for.
  std::vector<std::string> shaderFolders(const Text& text) const;
  glsl::SourceLoader& sources(const std::vector<std::string>& folders) const;
  // The files of the shaders that a pass names, one or those of a draw, with all that they include; none when they cannot be read.
  std::vector<std::string> shaderFiles(const std::string& shader, const std::string& vertexShader,
                                       const std::vector<std::string>& folders) const;
  // Where these files declare a slot or parameter, else where they first say the name.
  std::optional<Location> findInShaders(const std::vector<std::string>& files, std::string_view name) const;

 private:
  bool isGraph(const std::string& path) const;
  bool isPreset(const std::string& path, int depth = 0) const;
  void read(const std::string& path, Graph& graph);
  void check(const std::string& path, Graph& graph);

  const Options& options_;
  const Texts& texts_;
  graph::Registry registry_;
  std::vector<std::string> folders_;
  std::map<std::string, Graph> graphs_;
  // Texts as look() found them or as they were read since, and what was read of them.
  std::map<std::string, std::shared_ptr<const Text>> seen_;
  graph::ReadFiles shared_;
  std::vector<const Graph*> roots_;
  mutable std::map<std::vector<std::string>, glsl::SourceLoader> sources_;  // by folders
};

// ---- the answers to what an editor asks about a place in a file, as JSON of the protocol; null where nothing is known ----

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

// A workspace edit; or null, and `problem` says why the name cannot be changed.
Json renameAt(const Workspace& workspace, const Text& text, std::size_t offset, const std::string& name,
              std::string& problem);

}  // namespace weft::app::lsp
