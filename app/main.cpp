// weft: the command line. Each command declares its own options; the one that is chosen runs, its exit code out.
#include <string_view>

#include "app/commands/commands.h"
#include "app/lsp/lsp.h"
#include "app/output/standard_streams.h"
#include "app/session/command_line.h"
#include "app/view/viewer.h"
#include "engine/gl/programs/program_cache.h"

int main(int argc, char** argv) {
  using namespace weft::app;
  if (argc > 1 && std::string_view(argv[1]) == weft::gl::kTrialWord) weft::gl::runTrial(argc - 1, argv + 1);
  prepareStreams();
  CommandLine line;
  for (const auto add : {addRender, addView,    addCheck, addPlan,   addExplain, addDiff, addReport,
                         addParams, addPresets, addTest,  addAblate, addFuzz,    addDump, addFormat,
                         addNew,    addImport,  addLsp,   addBench,  addSchema,  addTypes})
    add(line);
  return finishStreams(line.run(argc, argv));
}
