// What Weft reports of the graphs that are open: it reads, expands and compiles them, and checks their shaders by their words.
// Keeps the last plan of each graph. Does not: open a context, or compile shaders.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/lsp/files/project.h"
#include "app/session/options.h"
#include "engine/glsl/source.h"
#include "engine/graph/plan.h"
#include "engine/graph/registry.h"

namespace weft::app::lsp {

class Analysis {
 public:
  Analysis(const Options& options, const Texts& texts, const Project& project);

  // Checks the graphs again that have one of these files. Returns the files whose messages may have changed.
  std::set<std::string> refresh(const std::set<std::string>& changed);
  // The messages of a file, each once.
  std::vector<base::Diagnostic> diagnosticsOf(const std::string& path) const;

  struct Graph {
    std::shared_ptr<const graph::Plan> plan;  // the last one that was made; it may be older than the text
    bool current = false;                     // whether the plan is of the present text
    base::Diagnostics said;
    std::set<std::string> files;
    std::vector<std::string> read;  // GraphDesc::files
    std::unique_ptr<glsl::SourceLoader> sources;
  };
  const std::map<std::string, Graph>& graphs() const { return graphs_; }
  // The graph whose plan has the file: the file itself when it is a graph with a plan, else a graph that includes it, with the
  // prefix there.
  struct Found {
    const Graph* graph = nullptr;
    std::string prefix;
  };
  Found graphWith(const std::string& path) const;
  const graph::Registry& registry() const { return registry_; }

 private:
  std::set<std::string> roots() const;
  bool isBrokenGraph(const std::string& path, const FileIndex& file) const;
  void look(const std::string& path, Graph& graph);
  void checkShaders(Graph& graph, const graph::Plan& plan);
  void checkFiles(Graph& graph, const graph::GraphDesc& desc);
  std::shared_ptr<const glsl::ShaderSource> source(Graph& graph, const std::string& shader,
                                                   const base::Place& place);

  const Options& options_;
  const Texts& texts_;
  const Project& project_;
  graph::Registry registry_;
  std::map<std::string, Graph> graphs_;
  std::map<std::string, std::shared_ptr<const glsl::ShaderSource>> loaded_;  // of one check
};

}  // namespace weft::app::lsp
