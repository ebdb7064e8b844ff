// weft completion, weft man: what shells and man(1) read.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"

namespace weft::app {

int runCompletion(const Options& options) {
  print(completionScript(options.commandLine, options.shell));
  return 0;
}

int runMan(const Options& options) {
  print(manPage(options.commandLine));
  return 0;
}

}  // namespace weft::app
