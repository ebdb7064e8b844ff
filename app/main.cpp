// weft: the command line. Options in, one command, its exit code out.
#include <string_view>
#include <utility>

#include "app/commands/commands.h"
#include "app/lsp/lsp.h"
#include "app/output/standard_streams.h"
#include "app/session/options.h"
#include "app/view/view.h"
#include "engine/gl/programs/shader_trial.h"

int main(int argc, char** argv) {
  using namespace weft::app;
  if (argc > 1 && std::string_view(argv[1]) == weft::gl::kTrialWord) weft::gl::runTrial(argc - 1, argv + 1);
  prepareStreams();
  int exitCode = 0;
  const auto options = parseOptions(argc, argv, exitCode);
  if (!options) return finishStreams(exitCode);

  static constexpr std::pair<const char*, int (*)(const Options&)> kCommands[] = {
      {"render", runRender}, {"view", runView},     {"check", runCheck},   {"explain", runExplain},
      {"expand", runExpand}, {"diff", runDiff},     {"params", runParams}, {"presets", runPresets},
      {"dot", runDot},       {"plan", runPlan},     {"bench", runBench},   {"schema", runSchema},
      {"types", runTypes},   {"format", runFormat}, {"lsp", runLsp},       {"dump", runDump},
      {"test", runTest},     {"bisect", runBisect}, {"ablate", runAblate}, {"fuzz", runFuzz},
      {"new", runNew},       {"import", runImport},
  };
  for (const auto& [name, run] : kCommands)
    if (options->command == name) return finishStreams(run(*options));
  return 2;
}
