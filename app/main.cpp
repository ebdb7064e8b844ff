// weft: the command line. Each command declares its own options; the one that is chosen runs, its exit code out.
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>

#include "app/commands/commands.h"
#include "app/lsp/lsp.h"
#include "app/output/standard_streams.h"
#include "app/session/command_line.h"
#include "app/view/viewer.h"
#include "engine/gl/programs/program_cache.h"

namespace {

// What nobody caught, on whichever thread: as a rule memory that there is none of, or threads.
[[noreturn]] void endAtOnce() {
  try {
    if (std::current_exception()) throw;
    std::fputs("weft: an exception that nobody caught\n", stderr);
  } catch (const std::bad_alloc&) {
    std::fputs("weft: out of memory\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "weft: %s\n", error.what());
  }
  std::_Exit(2);
}

// Before anything is constructed that may fail.
[[gnu::constructor(101)]] void catchAll() {
  std::set_terminate(endAtOnce);
}

}  // namespace

int main(int argc, char** argv) try {
  using namespace weft::app;
  const std::string_view first = argc > 1 ? argv[1] : "";
  if (first == weft::gl::kTrialWord) weft::gl::runTrial(argc - 1, argv + 1);
  prepareStreams();
  CommandLine line;
  for (const auto add :
       {addRender, addFarm, addView, addCheck, addPlan, addExplain, addDiff, addReport, addParams, addPresets,
        addTest, addFuzz, addDump, addFormat, addNew, addImport, addLsp, addSchema, addTypes})
    add(line);
  return finishStreams(line.run(argc, argv));
} catch (...) {  // half-written files are gone by now
  endAtOnce();
}
