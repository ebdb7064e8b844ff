// `-o NAME=FILE` and `--present NAME`: textures of the graph into picture files, as the viewer's inspector shows them (.png) or with their
// values (.exr). Does not: choose frames, or write the presented picture (app/output/picture_writer.h does).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/output/output_files.h"
#include "app/session/options.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/inspection/capture.h"

namespace weft::app {

// What a copy of the inspector's is saved as under `path`, by the kind of its name. False after W180.
bool saveInspected(runtime::Inspector& inspector, const std::string& path, base::Diagnostics& diagnostics);

// A texture of the graph that is written to a file.
struct PickedOutput {
  graph::Pick pick;
  std::string file;  // or a pattern, as -o
};

class PickOutputs {
 public:
  // Of the frames of `options`. Both must outlive this.
  PickOutputs(const Options& options, const std::vector<PickedOutput>& picked)
      : options_(options), picked_(picked) {}

  bool empty() const { return picked_.empty(); }
  // Whether pictures can be written under all names. W180 if not.
  bool check(base::Diagnostics& diagnostics) const;
  bool makeAllFolders(base::Diagnostics& diagnostics) const;
  void append(std::vector<OutputFile>& files) const;
  // Once the graph is loaded. False after errors of runtime::captureItemOf().
  bool start(runtime::Renderer& renderer, base::Diagnostics& diagnostics);
  // Before a frame: whether it is to be saved, and under which number.
  void expect(std::optional<std::uint32_t> frame) { frame_ = frame; }
  // After it: false when something was not saved.
  bool finish(base::Diagnostics& diagnostics);
  // The execution goes.
  void stop(runtime::Renderer& renderer);

 private:
  const Options& options_;
  const std::vector<PickedOutput>& picked_;
  std::unique_ptr<runtime::Capture> capture_;
  std::optional<std::uint32_t> frame_;
  base::Diagnostics said_;
  std::vector<std::uint8_t> saved_;  // per picked output, of this frame
};

}  // namespace weft::app
