// weft: the command line. Each command declares its own options; the one that is chosen runs, its exit code out.
#include <string_view>

#include "app/commands/commands.h"
#include "app/lsp/lsp.h"
#include "app/output/standard_streams.h"
#include "app/session/command_line.h"
#include "app/view/viewer.h"
#include "engine/gl/programs/program_cache.h"

namespace {

using namespace weft::app;

int runServer(Options& options) {
  return runLsp(options);
}

void addLsp(CommandLine& line) {
  const auto [command, options] = line.add<Options>(
      "lsp", "language server for editors, on standard input and output (docs/editors.md); needs no OpenGL",
      runServer);
  addPath(command, "--scene", options.scene, "scene that graphs are checked with (default: the bundled one)");
  options.addSize(command);
  command.add_flag("--stdio")->description("accepted for editors that say so; there is no other transport");
  command.footer("Example, for Neovim: vim.lsp.start({ name = 'weft', cmd = { 'weft', 'lsp' } })");
}

}  // namespace

int main(int argc, char** argv) {
  if (argc > 1 && std::string_view(argv[1]) == weft::gl::kTrialWord) weft::gl::runTrial(argc - 1, argv + 1);
  prepareStreams();
  CommandLine line;
  for (const auto add :
       {addRender, addView, addCheck, addPlan, addExplain, addDiff, addParams, addPresets, addTest, addAblate,
        addFuzz, addDump, addFormat, addNew, addImport, addLsp, addBench, addSchema, addTypes})
    add(line);
  return finishStreams(line.run(argc, argv));
}
