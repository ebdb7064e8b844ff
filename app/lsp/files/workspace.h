// The graphs that the editor has open or that lie in its folders: what their files say, which names they use and where these are
// declared (engine/graph/expand/names/name_uses.h), and what Weft reports of the open ones. Opens no context, and compiles no
// shaders.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "app/lsp/text/texts.h"
#include "app/session/options.h"
#include "engine/glsl/source.h"
#include "engine/graph/expand/names/name_uses.h"
#include "engine/graph/plan.h"
#include "engine/graph/registry.h"

namespace weft::app::lsp {

struct Location {
  std::string path;
  Range range;
  friend auto operator<=>(const Location& a, const Location& b) {
    return std::tie(a.path, a.range.begin) <=> std::tie(b.path, b.range.begin);
  }
  friend bool operator==(const Location& a, const Location& b) {
    return a.path == b.path && a.range.begin == b.range.begin;
  }
};

using TextsByPath = std::map<std::string, std::shared_ptr<const Text>>;

// A graph with all files that belong to it.
struct Graph {
  // As all files of it could be read last, and the texts then; they may be older than the present ones.
  std::shared_ptr<const graph::GraphDesc> desc;
  std::vector<graph::NameUse> uses;
  TextsByPath texts;
  std::vector<std::string> shaderFolders;
  // Of a graph that is open and belongs to no other:
  bool checked = false;
  std::shared_ptr<const graph::Plan> plan;  // the last one that was made; it may be older than the texts
  bool current = false;                     // whether the plan is of the present texts
  text::Diagnostics said;
  std::set<std::string> files;  // a change of one of these changes what is said
  // Private to Workspace:
  std::shared_ptr<const graph::GraphDesc> read;  // of the present texts; null where they cannot be read
  text::Diagnostics readSaid;
  TextsByPath readTexts;
};

// A name of a pass that its shader has, too: a slot, parameter or define.
struct ShaderKey {
  enum class Kind : std::uint8_t { slot, parameter, define };
  Kind kind = Kind::slot;
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

class Workspace {
 public:
  Workspace(const Options& options, const Texts& texts);

  // The folders that the editor shows. When all uses of a name are wanted, the graphs in them count.
  void setFolders(std::vector<std::string> folders) { folders_ = std::move(folders); }
  bool isInFolders(const std::string& path) const;
  const Texts& texts() const { return texts_; }
  const graph::Registry& registry() const { return registry_; }

  // Checks the graphs again that have one of these files. Returns the files whose messages may have changed.
  std::set<std::string> refresh(const std::set<std::string>& changed);
  // The messages of a file, each once.
  std::vector<text::Diagnostic> diagnosticsOf(const std::string& path) const;

  // Reads what has changed of the graphs that are open or in the folders. To be called before each request.
  void readAll();
  // Those that no other includes, the open ones first.
  const std::vector<const Graph*>& graphs() const { return roots_; }
  // Where `name`, which stood at the place when the graph was read, stands now. Nothing when it stands there no more.
  std::optional<Location> locate(const Graph& graph, const text::Place& place, std::string_view name) const;
  // Where an offset of a text of the graph was when the graph was read; without a file when it was nowhere.
  text::Place placeIn(const Graph& graph, const Text& text, std::size_t offset) const;

  // The programs of all graphs; the passes of one graph, without their files.
  std::vector<Program> programs() const;
  std::vector<Program> passesOf(const Graph& graph) const;
  std::vector<std::string> filesOf(const Program& program) const;
  // Folders in which the shaders of a file are looked for.
  std::vector<std::string> shaderFolders(const Text& text) const;
  glsl::SourceLoader& sources(const std::vector<std::string>& folders) const;
  // The files of a shader with all that it includes; none when it cannot be read.
  std::vector<std::string> shaderFiles(const std::string& shader,
                                       const std::vector<std::string>& folders) const;
  // Where these files declare the name, else where they first say it.
  std::optional<Location> findInShaders(const std::vector<std::string>& files, std::string_view name) const;

 private:
  bool isGraph(const std::string& path) const;
  bool isPreset(const std::string& path) const;
  void read(const std::string& path, Graph& graph);
  void check(const std::string& path, Graph& graph);
  void checkShaders(Graph& graph, const graph::Plan& plan);
  void checkFiles(Graph& graph, const graph::GraphDesc& desc);

  const Options& options_;
  const Texts& texts_;
  graph::Registry registry_;
  std::vector<std::string> folders_;
  std::map<std::string, Graph> graphs_;
  std::vector<const Graph*> roots_;
  mutable std::map<std::vector<std::string>, std::unique_ptr<glsl::SourceLoader>> sources_;  // by folders
};

// The shaders that a pass names: one, or those of a draw.
std::vector<std::string> shadersOf(const std::string& shader, const std::string& vertexShader);

}  // namespace weft::app::lsp
