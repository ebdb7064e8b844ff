// The graph core alone, without OpenGL. Reads a graph from text and prints every mistake with its place, or the plan.
#include <cstdio>

#include "engine/graph/compile/compile.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/print/print.h"
#include "engine/graph/read/read.h"

int main() {
  using namespace weft;
  const char* text = R"({
    "resources": { "ldr": { "texture": "rgba8", "size": "screen" } },
    "passes": [ { "name": "sky", "type": "fullscreen", "shader": "sky.frag.glsl", "write": { "result": "ldr" } } ],
    "present": "ldr" })";
  graph::Registry registry;  // what a graph may name: pass types, imports, draw lists, geometries
  registry.passTypes.push_back({.name = "fullscreen", .doc = "", .shader = graph::ShaderShape::fragment});
  registry.factsOf = [](const graph::ImportRequest&) { return graph::ImportFacts{}; };

  text::Diagnostics diagnostics;
  const auto desc = graph::readGraphText(text, "sky.json", diagnostics);
  const auto flat = desc ? graph::expandGraph(*desc, registry, {}, diagnostics) : nullptr;
  std::fputs(diagnostics.text().c_str(), stderr);
  if (!flat) return 1;
  std::fputs(graph::dumpText(graph::compile(flat)).c_str(), stdout);
}
