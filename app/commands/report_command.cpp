// weft report: one HTML page of a frame, or of what differs between two: app/report/page.html with the data that its script draws.
#include "app/commands/commands.h"
#include "app/output/frame_look.h"
#include "app/output/pictures.h"
#include "app/trials/shot.h"
#include "engine/graph/print/print.h"
#include "engine/text/chars.h"
#include "engine/text/json/report.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

struct Drawn {
  Json json;
  graph::Plan plan;
  assets::Image8 picture;
};

// Runs the frame, and looks at what each step leaves.
std::optional<Drawn> stateOf(gl::Context& context, const Options& options, std::uint32_t repeats,
                             runtime::World& world, text::Diagnostics& diagnostics) {
  runtime::Renderer renderer(context, options.graph, rendererOptionsOf(options));
  text::Diagnostics said;
  const bool loaded = renderer.load(settingsOf(options, context.device().software), world, said);
  diagnostics.append(said);
  if (!loaded || !checkPresents(options, renderer, diagnostics)) return std::nullopt;
  FrameLook look(renderer);
  const bool remembers = renderer.execution()->remembers(world);
  for (std::uint64_t number = remembers ? 0 : options.lastFrame; number <= options.lastFrame; ++number) {
    if (number == options.lastFrame) look.begin(diagnostics);
    drawFrame(renderer, world, options, static_cast<std::uint32_t>(number), diagnostics);
    if (diagnostics.hasErrors()) return std::nullopt;
  }
  std::vector<std::string> facts{fmt::format("{}x{}", options.width, options.height),
                                 fmt::format("frame {}", options.lastFrame),
                                 withoutFolder(scenePathOf(options)), context.device().renderer};
  for (const std::string& preset : options.presets) facts.push_back(withoutFolder(preset));
  Drawn state{look.end(options.graph, facts, said), look.plan(), look.picture()};
  if (repeats > 0)
    state.json["times"] = measureSteps(renderer, world, options, options.lastFrame + 1, repeats, diagnostics);
  return state;
}

struct ReportOptions : OtherOptions {
  std::string output;
  std::uint32_t repeats = 0;  // frames to measure; 0: no times
};

int runReport(ReportOptions& options) {
  const Options sides[] = {options, options.otherSide()};
  const auto draw = [&](auto& session, runtime::World& world, text::Diagnostics& diagnostics) {
    const std::span<const Options> drawn(sides, options.hasOther() ? 2 : 1);
    const bool good = writeFramePage(*session->context, options.typed, drawn, options.repeats, options.output,
                                     world, diagnostics);
    if (good) print(text::printable(options.output) + "\n");
    return good ? 0 : 1;
  };
  return options.hasOther() ? runOnDevice({&sides[0], &sides[1]}, 1, draw)
                            : runOnDevice({&sides[0]}, 1, draw);
}

}  // namespace

bool writeFramePage(gl::Context& context, const std::string& command, std::span<const Options> sides,
                    std::uint32_t repeats, const std::string& path, runtime::World& world,
                    text::Diagnostics& diagnostics) {
  Json report{{"command", command}, {"states", Json::array()}};
  std::vector<Drawn> states;
  for (const Options& side : sides) {
    auto state = stateOf(context, side, repeats, world, diagnostics);
    if (!state) return false;
    report["states"].push_back(std::move(state->json));
    states.push_back(*std::move(state));
  }
  if (states.size() > 1) {
    report["difference"] = text::linesOf(graph::diffText(states[0].plan, states[1].plan));
    if (const auto found = comparePictures(states[1].picture, states[0].picture))
      report["pictures"] = found->bytes.equal() ? "pictures: the same" : "pictures: " + found->text();
  }
  const OutputFile output{"-o", path, OutputFile::Over::file};
  const auto page = pageOf(report, sides[0].graph, diagnostics);
  return page && checkDistinct({&output, 1}, diagnostics) && makeFolderOf(path, diagnostics) &&
         text::writeFile(path, *page, diagnostics);
}

void addReport(CommandLine& line) {
  const auto [command, options] = line.add(
      "report", "write an HTML page of a frame: its steps and resources, what each wrote and why", runReport);
  options.addGraph(command);
  options.addOther(command);
  addPath(command, "-o,--output", options.output, "the page to write, .html")->required();
  options.addFrame(command);
  options.addDrawing(command);
  command.add_option("--times", options.repeats, "also show times: medians over so many frames")
      ->check(CLI::Range(1, 1000));
  command.footer("Example: weft report graphs/studio.json --size 320x180 -o out/report.html");
}

}  // namespace weft::app
