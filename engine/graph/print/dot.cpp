// A plan for Graphviz. Declared in print.h.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/graph/pick/pick.h"
#include "engine/graph/print/print.h"
#include "engine/graph/subresource.h"
#include "engine/text/printable.h"

namespace weft::graph {

namespace {

// A line feed begins another line of a label.
std::string quotedDot(const std::string& text) {
  std::string out = "\"";
  for (std::size_t from = 0, end; from <= text.size(); from = end + 1) {
    end = std::min(text.find('\n', from), text.size());
    if (from > 0) out += "\\n";
    for (const char c : text::printable(text.substr(from, end - from))) {
      if (c == '"' || c == '\\') out.push_back('\\');
      out.push_back(c);
    }
  }
  return out + "\"";
}

std::size_t prefixLength(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string::npos ? 0 : dot + 1;
}

// What stands in an include, and the includes in it by their names.
struct Cluster {
  std::vector<std::string> nodes;
  std::map<std::string, Cluster> inside;

  void print(std::string& text, const std::string& name, const std::string& indent) const {
    for (const std::string& node : nodes) text += indent + node;
    for (const auto& [word, cluster] : inside) {
      const std::string whole = name.empty() ? word : name + "." + word;
      text += fmt::format("{0}subgraph {1} {{\n{0}  label={2};\n", indent, quotedDot("cluster_" + whole),
                          quotedDot(word));
      cluster.print(text, whole, indent + "  ");
      text += indent + "}\n";
    }
  }
};

class DotWriter {
 public:
  DotWriter(const Plan& plan, bool effects) : plan_(plan), graph_(*plan.graph), effects_(effects) {}

  std::string write() {
    for (const Step& step : plan_.steps) ++folds_[folded(graph_.passNames[step.pass])];
    std::set<std::string> seen;
    for (const Step& step : plan_.steps) {
      const std::string name = folded(graph_.passNames[step.pass]);
      if (seen.insert(name).second) addPass(name);
      for (const std::uint32_t u : graph_.usesOf(step.pass)) addUse(name, u);
    }
    for (std::size_t pass = 0; pass < graph_.passNames.size() && !effects_; ++pass)
      if (const std::string name = folded(graph_.passNames[pass]);
          plan_.stepOf[pass] == kNone && seen.insert(name).second)
        addNode(name, name, name.substr(prefixLength(name)), "shape=box, style=filled, fillcolor=gray93");
    addEnd("present", "present", graph_.present, graph_.links.present);
    for (std::size_t i = 0; i < graph_.outputs.size(); ++i)
      addEnd(graph_.outputNames[i], "output " + graph_.outputNames[i], graph_.outputs[i],
             graph_.links.outputs[i]);
    std::string text = fmt::format(
        "digraph {} {{\n  rankdir=LR;\n  ranksep=0.25;\n  nodesep=0.12;\n  color=gray60;\n  node "
        "[fontname=\"sans-serif\", fontsize=10];\n  "
        "graph [fontname=\"sans-serif\", fontsize=10];\n",
        quotedDot(graph_.name.empty() ? "plan" : graph_.name));
    root_.print(text, "", "  ");
    for (const std::string& edge : edges_) text += edge;
    return text + "}\n";
  }

 private:
  // "post.bloom.glow_down" of "post.bloom.glow_down[3]": repeats are one node. "post" where an effect is one.
  std::string folded(const std::string& pass) const {
    return pass.substr(0, pass.find_first_of(effects_ ? ".[" : "["));
  }

  // In the cluster of `owner`, the name of a pass.
  void addNode(const std::string& owner, const std::string& id, const std::string& label,
               const std::string& look) {
    Cluster* cluster = &root_;
    for (std::size_t from = 0, dot; (dot = owner.find('.', from)) != std::string::npos; from = dot + 1)
      cluster = &cluster->inside[owner.substr(from, dot - from)];
    cluster->nodes.push_back(
        fmt::format("{} [id={}, label={}, {}];\n", quotedDot(id), quotedDot(id), quotedDot(label), look));
  }

  void addPass(const std::string& name) {
    const std::size_t times = folds_[name];
    addNode(name, name, name.substr(prefixLength(name)) + (times > 1 ? fmt::format(" x{}", times) : ""),
            "shape=box, style=filled, fillcolor=moccasin");
  }

  // The version of a resource that a pass, or its repeats together, made. kNone: what is there before the frame.
  std::string version(std::uint32_t writer, std::uint32_t resource) {
    const std::string owner =
        writer == kNone ? std::string() : folded(graph_.passNames[graph_.links.passOf[writer]]);
    const std::string name(sharedName(graph_.resourceNames[resource]));
    const std::string id = owner.empty() ? name : owner + " " + name;
    if (!versions_.insert(id).second) return id;
    const std::size_t number = owner.empty() ? 0 : ++made_[name];
    std::string label = name.substr(prefixLength(name));
    const FlatResource& desc = graph_.resources[resource];
    if (number > 1)
      label += fmt::format(" {}", number);
    else if (!isBuffer(desc))
      label += fmt::format("\n{} {}x{}", infoOf(desc.format).name, desc.width, desc.height);
    addNode(owner, id, label,
            owner.empty() ? "shape=ellipse, style=filled, fillcolor=palegreen"
                          : "shape=ellipse, style=filled, fillcolor=lightblue");
    if (!owner.empty()) addEdge(owner, id, "");
    return id;
  }

  void addEdge(const std::string& from, const std::string& to, const char* look) {
    const std::string edge = fmt::format("  {} -> {}{};\n", quotedDot(from), quotedDot(to), look);
    if (known_.insert(edge).second) edges_.push_back(edge);
  }

  void addUse(const std::string& pass, std::uint32_t u) {
    const FlatUse& use = graph_.uses[u];
    const char* const look = use.history > 0 ? " [style=dashed, constraint=false]" : "";
    if (use.access != Access::write) {
      bool found = false;
      graph_.links.forEachWriter(graph_.links.seen[u], [&](std::uint32_t writer) {
        found = true;
        if (folded(graph_.passNames[graph_.links.passOf[writer]]) != pass || use.history > 0)
          addEdge(version(writer, use.resource), pass, look);
      });
      // What a step clears and modifies was not there before.
      if (!found && (use.access == Access::read || isImported(graph_.resources[use.resource])))
        addEdge(version(kNone, use.resource), pass, look);
    }
    if (use.access != Access::read && !effects_) version(u, use.resource);
  }

  void addEnd(const std::string& id, const std::string& label, const FlatUse& use, std::uint32_t link) {
    if (use.resource == kNone) return;
    addNode("", ":" + id, label, "shape=doublecircle");
    graph_.links.forEachWriter(
        link, [&](std::uint32_t writer) { addEdge(version(writer, use.resource), ":" + id, ""); });
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  const bool effects_;
  Cluster root_;
  std::map<std::string, std::size_t> folds_, made_;  // steps of a pass; versions of a resource so far
  std::set<std::string> versions_, known_;
  std::vector<std::string> edges_;
};

}  // namespace

std::string dumpDot(const Plan& plan, bool effects) {
  return DotWriter(plan, effects).write();
}

}  // namespace weft::graph
