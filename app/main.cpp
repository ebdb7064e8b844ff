// weft: the command line. Options in, one command, its exit code out.
#include <utility>

#include "app/commands.h"
#include "app/options.h"

int main(int argc, char** argv) {
  using namespace weft::app;
  int exitCode = 0;
  const auto options = parseOptions(argc, argv, exitCode);
  if (!options) return exitCode;

  static constexpr std::pair<const char*, int (*)(const Options&)> kCommands[] = {
      {"render", runRender}, {"view", runView},       {"check", runCheck}, {"params", runParams}, {"presets", runPresets},
      {"dot", runDot},       {"plan", runPlan},       {"bench", runBench}, {"schema", runSchema}, {"types", runTypes},
  };
  for (const auto& [name, run] : kCommands)
    if (options->command == name) return run(*options);
  return 2;
}
