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

struct AblateOptions : Options {
  std::string format = "text";
  std::uint32_t repeats = 3;
};

struct Ablation {
  std::string pass;             // as declared; all its repeats
  double ownMs = 0;             // of the pass in the whole frame
  double savedMs = 0;           // of the frame, without the pass and what only fed it
  std::int64_t savedBytes = 0;  // of the textures and buffers
  std::size_t stepsGone = 0;
  assets::Image8 picture;
  std::optional<PictureDifference> difference;  // nothing for a picture of another size
  std::string needed;  // why the graph does not do without it; then only ownMs is known
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

Ablation leaveOut(gl::Context& context, const Options& options, const runtime::World& world,
                  const ShotWish& wish, const Shot& whole, const std::string& pass) {
  Ablation row{.pass = pass};
  if (const auto own = whole.passMilliseconds.find(pass); own != whole.passMilliseconds.end())
    row.ownMs = own->second;
  Options without = options;
  without.disables.emplace_back(pass);
  text::Diagnostics said;
  const bool possible = makePlan(without, world.facts(), context.device().software, said) != nullptr;
  const auto shot = possible ? takeShot(context, without, world, wish, said) : std::nullopt;
  if (!shot) {
    const auto error = std::ranges::find(said.items(), text::Severity::error, &text::Diagnostic::severity);
    row.needed = error == said.items().end() ? "it fails without" : error->message;
    return row;
  }
  row.savedMs = whole.milliseconds - shot->milliseconds;
  row.savedBytes = static_cast<std::int64_t>(whole.plan->bytesAllocated) -
                   static_cast<std::int64_t>(shot->plan->bytesAllocated);
  row.stepsGone = whole.plan->steps.size() - std::min(whole.plan->steps.size(), shot->plan->steps.size());
  row.picture = shot->pictures.begin()->second;
  row.difference = comparePictures(row.picture, whole.pictures.begin()->second);
  return row;
}

std::vector<std::string> cellsOf(const Ablation& row) {
  std::vector<std::string> cells{row.pass, fmt::format("{:.2f}", row.ownMs)};
  if (!row.needed.empty()) {
    cells.emplace_back("needed");
    return cells;
  }
  const assets::FlipSummary flip = row.difference ? row.difference->flip : assets::FlipSummary{};
  cells.insert(cells.end(), {fmt::format("{:.2f}", row.savedMs), fmt::format("{}", row.savedBytes),
                             fmt::format("{}", row.stepsGone), fmt::format("{:.4f}", flip.mean),
                             fmt::format("{:.3f}", flip.peak)});
  return cells;
}

// For the page: the table with pictures.
nlohmann::ordered_json ablationOf(const std::vector<Ablation>& rows, const std::vector<std::string>& titles,
                                  const std::string& graph, const std::string& sum,
                                  const assets::Image8& picture) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Ablation& row : rows)
    list.push_back({{"cells", cellsOf(row)},
                    {"needed", row.needed},
                    {"picture", row.needed.empty() ? pictureAddress(row.picture) : ""},
                    {"flip", row.difference ? pictureAddress(assets::colorFlip(row.difference->map)) : ""}});
  return {{"graph", graph},
          {"sum", sum},
          {"titles", titles},
          {"picture", pictureAddress(picture)},
          {"rows", list}};
}

std::string jsonOf(const std::vector<Ablation>& rows, const Shot& whole) {
  nlohmann::ordered_json passes = nlohmann::ordered_json::array();
  for (const Ablation& row : rows) {
    nlohmann::ordered_json& entry = passes.emplace_back();
    entry = {{"pass", row.pass}, {"own_ms", row.ownMs}};
    if (!row.needed.empty()) entry["needed"] = row.needed;
    if (!row.needed.empty()) continue;
    entry.update({{"saved_ms", row.savedMs}, {"saved_bytes", row.savedBytes}, {"steps_gone", row.stepsGone}});
    if (row.difference)
      entry.update({{"flip", row.difference->flip.mean}, {"flip_peak", row.difference->flip.peak}});
  }
  return dumpJson({{"steps", whole.plan->steps.size()},
                   {"ms", whole.milliseconds},
                   {"bytes", whole.plan->bytesAllocated},
                   {"passes", std::move(passes)}}) +
         "\n";
}

int ablate(gl::Context& context, const AblateOptions& options, const runtime::World& world,
           text::Diagnostics& diagnostics) {
  const ShotWish wish{.frames = {options.lastFrame}, .repeats = options.repeats};
  const auto whole = takeShot(context, options, world, wish, diagnostics);
  if (!whole) return 1;
  const std::vector<std::string> passes = passesOf(*whole->plan);
  ProgressLines lines({.total = passes.size(), .unit = "passes"});
  std::vector<Ablation> rows;
  for (const std::string& pass : passes) {
    rows.push_back(leaveOut(context, options, world, wish, *whole, pass));
    lines.countOne();
  }
  if (options.format == "json") return print(jsonOf(rows, *whole)), 0;
  const std::string sum =
      fmt::format("{} run, {:.2f} ms, {} bytes", text::counted(whole->plan->steps.size(), "pass"),
                  whole->milliseconds, whole->plan->bytesAllocated);
  const std::vector<std::string> titles{"pass",  "own ms", "saved ms", "saved bytes",
                                        "steps", "FLIP",   "at most"};
  if (options.format == "html")
    if (const auto page = pageOf(
            {{"ablation", ablationOf(rows, titles, options.graph, sum, whole->pictures.begin()->second)}},
            "weft ablate", diagnostics))
      return print(*page), 0;
  std::vector<std::vector<std::string>> table{titles};
  for (const Ablation& row : rows) table.push_back(cellsOf(row));
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
  command.add_option("--repeats", options.repeats, "frames to measure; the fastest counts")
      ->check(CLI::Range(1u, 1000u));
  addChoice(command, "--format", options.format, "text, json or html", {"text", "json", "html"});
  command.footer("Example: weft ablate graphs/glow.json --size 320x180");
}

}  // namespace weft::app
