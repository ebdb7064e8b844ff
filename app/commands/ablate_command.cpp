// weft ablate: what each pass costs and does.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/trials/ablation.h"

namespace weft::app {

namespace {

struct AblateOptions : Options {
  std::string format = "text";
  std::uint32_t repeats = 3;
};

int runAblate(AblateOptions& options) {
  const Options* const one = &options;
  const auto run = [&](gl::Context& context, const runtime::World& world, base::Diagnostics& diagnostics) {
    const auto table = ablatePasses(context, options, options.repeats, world, diagnostics);
    if (!table) return 1;
    print(options.format == "json"   ? ablationJson(*table)
          : options.format == "html" ? ablationPage(*table, options.graph)
                                     : ablationText(*table));
    return 0;
  };
  return runOnDevice({one, 1}, 1, run);
}

}  // namespace

void addAblate(CommandLine& line) {
  const auto [command, options] = line.add(
      "ablate", "what each pass costs and does: milliseconds, bytes and picture difference without it",
      runAblate);
  options.addGraph(command);
  options.addFrame(command);
  options.addPointer(command);
  options.addBackend(command);
  command.add_option("--repeats", options.repeats, "frames to measure; the fastest counts")
      ->check(CLI::Range(1u, 1000u));
  addChoice(command, "--format", options.format, "text, json or html", {"text", "json", "html"});
  command.footer("Example: weft ablate graphs/glow.json --size 320x180");
}

}  // namespace weft::app
