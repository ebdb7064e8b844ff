// weft bench: what frames and edits cost, as JSON.
#include <fmt/format.h>

#include "app/bench/edit_bench.h"
#include "app/bench/frame_bench.h"
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"

namespace weft::app {

namespace {

struct BenchOptions : Options {
  std::string frameGraph, editGraph;
};

int runBench(BenchOptions& options) {
  base::Diagnostics diagnostics;
  Options frame = options, edit = options;
  frame.graph = options.frameGraph;
  edit.graph = options.editGraph;
  std::optional<std::string> text;
  if (!frame.graph.empty()) {
    text = benchFrame(frame, diagnostics);
  } else if (!edit.graph.empty()) {
    text = benchEdits(edit, diagnostics);
  } else {
    frame.graph = edit.graph = dataFolder() + "/graphs/studio.json";
    const auto edits = benchEdits(edit, diagnostics);
    const auto frames = edits ? benchFrame(frame, diagnostics) : std::nullopt;
    if (frames) text = fmt::format("{{\"edit\": {},\n\"frame\": {}}}", *edits, *frames);
  }
  if (text) print(*text + "\n");
  return report(diagnostics);
}

}  // namespace

void addBench(CommandLine& line) {
  const auto [command, options] = line.add("bench", "measure; prints JSON", runBench);
  addPath(command, "--frame", options.frameGraph,
          "a graph file: the cost of its frame in full-screen copies");
  addPath(command, "--edit", options.editGraph,
          "a graph file: what a changed parameter and a saved file cost before the next frame")
      ->excludes("--frame");
  addPath(command, "--environment", options.environment, "environment map, .hdr or .exr");
  addPath(command, "--scene", options.scene, "scene file");
  command.add_option("--camera", options.camera, "camera of the scene");
  addPath(command, "--materials", options.materials, "material library");
  options.addSize(command);
  options.addBackend(command);
}

}  // namespace weft::app
