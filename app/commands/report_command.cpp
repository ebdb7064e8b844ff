// weft report: one HTML page of a frame, or of what differs between two.
#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/frame_page.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

struct ReportOptions : OtherOptions {
  std::string output;
  std::uint32_t repeats = 0;  // frames to measure; 0: no times
};

int runReport(ReportOptions& options) {
  const Options sides[] = {options, options.otherSide()};
  const auto draw = [&](auto& session, runtime::World& world, text::Diagnostics& diagnostics) {
    const std::span<const Options> drawn(sides, options.hasOther() ? 2 : 1);
    if (!writeFramePage(*session->context, options.typed, drawn, options.repeats, options.output, world,
                        diagnostics))
      return 1;
    print(text::printable(options.output) + "\n");
    return 0;
  };
  return options.hasOther() ? runOnDevice({&sides[0], &sides[1]}, 1, draw)
                            : runOnDevice({&sides[0]}, 1, draw);
}

}  // namespace

void addReport(CommandLine& line) {
  const auto [command, options] = line.add("report",
                                           "write one HTML page of a frame: the matrix of steps and "
                                           "resources, what each pass wrote and why it runs",
                                           runReport);
  options.addGraph(command);
  options.addOther(command);
  addPath(command, "-o,--output", options.output, "the page to write, .html")->required();
  options.addFrame(command);
  options.addFps(command);
  options.addPointer(command);
  options.addBackend(command);
  command.add_option("--times", options.repeats, "also show times: medians over so many frames")
      ->check(CLI::Range(1, 1000));
  command.footer("Example: weft report graphs/studio.json --size 320x180 -o out/report.html");
}

}  // namespace weft::app
