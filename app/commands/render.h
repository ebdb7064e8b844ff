// The options of weft render, which weft farm takes, too.
#pragma once

#include "app/commands/commands.h"
#include "app/session/checkpoints.h"

namespace weft::app {

struct RenderOptions : Options {
  std::vector<std::string> outputs;  // -o, as they were written
  std::string present;
  std::vector<std::uint32_t> frames = {0};
  std::string manifest;
  bool skipDone = false;
  CheckpointOptions checkpoints;
  // Called in place of drawing, when all is checked; the exit code. `inOrder`: the graph remembers. `outputs`: what would be written.
  std::function<int(bool inOrder, std::vector<OutputFile>& outputs, text::Diagnostics& diagnostics)> instead;
};

void addRenderOptions(CLI::App& command, RenderOptions& options);
int runRender(RenderOptions& options);

}  // namespace weft::app
