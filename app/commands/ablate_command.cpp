// weft ablate: what each pass of a graph costs and does, found by leaving it out: time, bytes and the picture without it.
#include <fmt/format.h>

#include <algorithm>

#include "app/commands/commands.h"
#include "app/output/page.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/shot.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

struct AblateOptions : Options {
  std::string format = "text";
  std::uint32_t repeats = 3;
};

// Declared names of the passes that run, each once, in order of the plan.
std::vector<std::string> passesOf(const graph::Plan& plan) {
  std::vector<std::string> names;
  for (const graph::Step& step : plan.steps)
    if (const std::string& name = plan.graph->specs[step.pass].declared;
        std::ranges::find(names, name) == names.end())
      names.push_back(name);
  return names;
}

// Of all steps, or of one pass with its repeats.
double millisecondsOf(const Shot& shot, std::string_view pass = {}) {
  double sum = 0;
  for (std::size_t step = 0; step < shot.milliseconds.size(); ++step)
    if (pass.empty() || shot.plan->graph->specs[shot.plan->steps[step].pass].declared == pass)
      sum += shot.milliseconds[step];
  return sum;
}

// What is known of a pass, as --format json prints it: what it takes in the whole frame, and what the frame is without it and what only
// fed it; or why the graph does not do without it. With --format html pictures, too.
Json leaveOut(gl::Context& context, const AblateOptions& options, const runtime::World& world,
              const ShotWish& wish, const Shot& whole, const std::string& pass) {
  Json row{{"pass", pass}, {"own_ms", millisecondsOf(whole, pass)}};
  Options without = options;
  without.disables.emplace_back(pass);
  text::Diagnostics said;
  const bool possible = makePlan(without, world.facts(), context.device().software, said) != nullptr;
  const auto shot = possible ? takeShot(context, without, world, wish, said) : std::nullopt;
  if (!shot) {
    const auto error = std::ranges::find(said.items(), text::Severity::error, &text::Diagnostic::severity);
    row["needed"] = error == said.items().end() ? "it fails without" : error->message;
    return row;
  }
  const auto signedOf = [](std::size_t number) { return static_cast<std::int64_t>(number); };
  const assets::Image8& picture = shot->pictures.begin()->second;
  row["saved_ms"] = millisecondsOf(whole) - millisecondsOf(*shot);
  row["saved_bytes"] = signedOf(whole.plan->bytesAllocated) - signedOf(shot->plan->bytesAllocated);
  row["steps_gone"] = whole.plan->steps.size() - std::min(whole.plan->steps.size(), shot->plan->steps.size());
  const auto difference = comparePictures(picture, whole.pictures.begin()->second);
  if (difference) row.update({{"flip", difference->flip.mean}, {"flip_peak", difference->flip.peak}});
  if (options.format != "html") return row;
  row["picture"] = pictureAddress(picture);
  row["map"] = difference ? pictureAddress(assets::colorFlip(difference->map)) : "";
  return row;
}

std::vector<std::string> cellsOf(const Json& row) {
  std::vector<std::string> cells{row["pass"], fmt::format("{:.2f}", row["own_ms"].get<double>())};
  if (row.contains("needed")) cells.emplace_back("needed");
  constexpr std::pair<const char*, int> kNumbers[] = {
      {"saved_ms", 2}, {"saved_bytes", 0}, {"steps_gone", 0}, {"flip", 4}, {"flip_peak", 3}};
  for (const auto& [key, digits] : kNumbers)
    if (!row.contains("needed")) cells.push_back(fmt::format("{:.{}f}", row.value(key, 0.0), digits));
  return cells;
}

int ablate(gl::Context& context, const AblateOptions& options, const runtime::World& world,
           text::Diagnostics& diagnostics) {
  const ShotWish wish{.frames = {options.lastFrame}, .repeats = options.repeats};
  const auto whole = takeShot(context, options, world, wish, diagnostics);
  if (!whole) return 1;
  const std::vector<std::string> passes = passesOf(*whole->plan);
  ProgressLines lines({.total = passes.size(), .unit = "passes"});
  Json rows = Json::array();
  for (const std::string& pass : passes) {
    rows.push_back(leaveOut(context, options, world, wish, *whole, pass));
    lines.countOne();
  }
  const double ms = millisecondsOf(*whole);
  const std::size_t steps = whole->plan->steps.size(), bytes = whole->plan->bytesAllocated;
  if (options.format == "json") {
    print(dumpJson({{"steps", steps}, {"ms", ms}, {"bytes", bytes}, {"passes", rows}}) + "\n");
    return 0;
  }
  const std::string sum = fmt::format("{} run, {:.2f} ms, {} bytes", text::counted(steps, "pass"), ms, bytes);
  std::vector<std::vector<std::string>> table{
      {"pass", "own ms", "saved ms", "saved bytes", "steps", "FLIP", "at most"}};
  for (const Json& row : rows) table.push_back(cellsOf(row));
  if (options.format == "html") {
    const auto page = pageOf({{"ablation",
                               {{"graph", options.graph},
                                {"sum", sum},
                                {"table", table},
                                {"picture", pictureAddress(whole->pictures.begin()->second)},
                                {"rows", rows}}}},
                             "weft ablate", diagnostics);
    return page ? print(*page), 0 : 1;
  }
  print(sum + "\n\n");
  printTable(table);
  return 0;
}

int runAblate(AblateOptions& options) {
  return runOnDevice({&options}, 1, [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
    return ablate(*session->context, options, world, diagnostics);
  });
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
  command.add_option("--repeats", options.repeats, "frames to measure; the median counts")
      ->check(CLI::Range(1u, 1000u));
  addChoice(command, "--format", options.format, "text, json or html", {"text", "json", "html"});
  command.footer("Example: weft ablate graphs/glow.json --size 320x180");
}

}  // namespace weft::app
