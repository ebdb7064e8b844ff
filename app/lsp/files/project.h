// Finds which files include, extend or use which, and what a name in one file means in another. It reads outlines, so it works
// while a file is broken. Does not: check anything (analysis.h does).
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "app/lsp/files/file_index.h"

namespace weft::app::lsp {

struct Definition {
  Mention::Kind kind = Mention::Kind::resource;
  std::string path;
  Range range;
  std::string name;  // as it is declared there
  friend bool operator==(const Definition& a, const Definition& b) {
    return a.path == b.path && a.range.begin == b.range.begin;
  }
};

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

class Project {
 public:
  explicit Project(const Texts& texts) : texts_(texts) {}

  // The folders that the editor shows. When all uses of a name are wanted, the graphs in them count.
  void setFolders(std::vector<std::string> folders) { folders_ = std::move(folders); }
  bool isInFolders(const std::string& path) const;
  // Forgets what was gathered from many files, because they may have changed. To be called before each request.
  void forget();

  // Null when the file is not JSON, or not there.
  std::shared_ptr<const FileIndex> index(const std::string& path) const;
  // Whether the file is a preset, or extends one, so that the graph below it is missing.
  bool isPreset(const std::string& path) const;
  // `path` with all that it includes and extends; at most as many as a graph may include.
  std::vector<std::string> closure(const std::string& path) const;
  // All graph files: those that are open, those of the folders, with their closures.
  const std::vector<std::string>& graphFiles() const;
  // The graph files that include or extend `path`.
  const std::vector<std::string>& includersOf(const std::string& path) const;
  // The prefix of the names of `path` in `root`: "post." for graphs/post.json in graphs/studio.json. Nothing when `root` does
  // not include it.
  std::optional<std::string> prefixIn(const std::string& root, const std::string& path) const;

  std::optional<Definition> resolve(const FileIndex& from, const Mention& mention) const;

  // ---- shaders ----
  // The folders in which shaders of the passes of the graph `path` are looked for, as by the graphs that include it.
  const std::vector<std::string>& shaderFolders(const std::string& path) const;
  std::optional<std::string> locateShader(const std::string& graph, const std::string& shader) const;
  // A GLSL file with all that it includes.
  std::vector<std::string> shaderClosure(const std::string& path,
                                         const std::vector<std::string>& folders) const;
  std::optional<std::string> locateInclude(const std::string& from, std::string_view path,
                                           const std::vector<std::string>& folders) const;

  // A pass and the GLSL files of its program.
  struct Program {
    std::shared_ptr<const FileIndex> graph;
    const JsonValue* stanza = nullptr;
    std::vector<std::string> files;
  };
  Program programOf(const std::shared_ptr<const FileIndex>& graph, const JsonValue& stanza) const;
  // All programs that have one of these files.
  std::vector<Program> programsWith(const std::set<std::string>& files) const;
  std::optional<Definition> findInShaders(const Program& program, std::string_view name) const;

 private:
  using File = std::shared_ptr<const FileIndex>;
  // What a look-up has tried: in which file, for which name, and whether upwards too. Files may include each other in a circle,
  // or one file many times.
  using Seen = std::set<std::tuple<std::string, std::string, bool>>;
  static bool isNew(Seen& seen, const FileIndex& from, const std::string& name, bool up, int depth);
  std::optional<Definition> findResource(const FileIndex& from, const std::string& name, bool import,
                                         Seen& seen, int depth = 0) const;
  std::optional<Definition> findVariable(const FileIndex& from, const std::string& name, bool up, Seen& seen,
                                         int depth = 0) const;
  std::optional<Definition> findPass(const FileIndex& from, const std::string& name, Seen& seen,
                                     int depth = 0) const;
  // The files that `from` is laid over in other files: all that stand before it in a list of "extends".
  std::vector<std::string> listedBefore(const FileIndex& from) const;
  // What `from` extends; at the beginning of a look-up also what stands before it in lists.
  std::vector<File> layersBelow(const FileIndex& from, int depth) const;
  // The only declaration whose dotted name ends in `name`, in all files that `from` includes or is laid over.
  std::optional<Definition> findInside(const FileIndex& from, const std::string& name,
                                       Mention::Kind kind) const;

  const Texts& texts_;
  std::vector<std::string> folders_;
  mutable std::map<std::string, std::shared_ptr<const FileIndex>> indices_;
  // Until forget().
  mutable std::optional<std::vector<std::string>> graphFiles_;
  mutable std::optional<std::map<std::string, std::vector<std::string>>> includers_;
  mutable std::map<std::string, std::vector<std::string>> shaderFolders_;
};

}  // namespace weft::app::lsp
