// weft ablate: what each pass of a graph costs and does. weft fuzz: whatever a plan leaves open, the picture is the same.
#include "app/commands/commands.h"
#include "app/output/pictures.h"
#include "app/trials/divergence.h"

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

// ---- fuzz ----

struct FuzzOptions : Options {
  std::uint32_t runs = 12;            // random orders
  std::optional<std::uint32_t> seed;  // this order alone; 0 is the declared one
  std::string share = "both", poison = "both";
};

// The graph in another legal order, with shared storage or without, with poisoned transients or not.
struct Trial {
  std::uint32_t seed = 0;  // of the order; 0: the declared one
  bool share = true;
  std::optional<runtime::PoisonPattern> poison{};

  // "--seed 7 --share off --poison nan": repeats this one.
  std::string arguments() const {
    return fmt::format("--seed {} --share {} --poison {}", seed, share ? "on" : "off",
                       !poison                                  ? "none"
                       : *poison == runtime::PoisonPattern::nan ? "nan"
                                                                : "large");
  }
};

std::vector<Trial> trialsOf(const FuzzOptions& wanted) {
  std::vector<bool> shares;
  if (wanted.share != "off") shares.push_back(true);
  if (wanted.share != "on") shares.push_back(false);
  std::vector<std::optional<runtime::PoisonPattern>> poisons;
  if (wanted.poison == "none") poisons.emplace_back();
  if (wanted.poison != "none" && wanted.poison != "large") poisons.emplace_back(runtime::PoisonPattern::nan);
  if (wanted.poison != "none" && wanted.poison != "nan") poisons.emplace_back(runtime::PoisonPattern::large);
  std::vector<Trial> trials;
  for (std::uint32_t run = 0; run <= (wanted.seed ? 0 : wanted.runs); ++run)
    for (const bool share : shares)
      for (const auto& poison : poisons) trials.push_back({wanted.seed.value_or(run), share, poison});
  return trials;
}

// The smallest trial that still differs, found by leaving out one thing after another: the poison, the storage, the order.
template <class Differs>
Trial shrink(Trial trial, const Differs& differs) {
  for (const auto leaveOut : {+[](Trial& each) { each.poison.reset(); },
                              +[](Trial& each) { each.share = true; }, +[](Trial& each) { each.seed = 0; }}) {
    Trial smaller = trial;
    leaveOut(smaller);
    if (smaller.arguments() != trial.arguments() && differs(smaller)) trial = smaller;
  }
  return trial;
}

// The passes that run elsewhere than they are declared.
std::string reordered(const graph::Plan& declared, const graph::Plan& plan) {
  std::string text;
  for (std::size_t step = 0; step < plan.steps.size(); ++step)
    if (plan.steps[step].pass != declared.steps[step].pass)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", step,
                          plan.graph->passNames[plan.steps[step].pass]);
  return text;
}

// Returns the exit code.
int fuzz(gl::Context& context, const FuzzOptions& options, const runtime::World& world,
         text::Diagnostics& diagnostics) {
  const auto shoot = [&](const Trial& trial, text::Diagnostics& said) {
    const ShotWish wish{.frames = {options.lastFrame},
                        .records = true,
                        .compile = {.share = trial.share, .orderSeed = trial.seed},
                        .poison = trial.poison};
    return takeShot(context, options, world, wish, said);
  };
  const auto pictureOf = [&](const Shot& shot) -> const assets::Image8& {
    return shot.pictures.at(options.lastFrame);
  };
  const std::optional<Shot> declared = shoot({}, diagnostics);
  if (!declared) return 2;
  std::optional<Shot> other;  // the last picture that differed
  text::Diagnostics problems;
  const auto differs = [&](const Trial& trial) {
    problems.clear();
    auto shot = shoot(trial, problems);
    if (!shot || pictureOf(*shot).texels == pictureOf(*declared).texels) return false;
    other = std::move(shot);
    return true;
  };
  const std::vector<Trial> trials = trialsOf(options);
  ProgressLines lines({.total = trials.size(), .unit = "runs"});
  for (const Trial& found : trials) {
    const bool same = !differs(found);
    lines.countOne();
    if (problems.hasErrors()) {
      diagnostics.append(problems);
      return 2;
    }
    if (same) continue;
    const Trial trial = shrink(found, differs);
    differs(trial);
    if (const auto difference = comparePictures(pictureOf(*other), pictureOf(*declared)))
      print("a picture differs: " + difference->text() + "\n");
    if (const auto first = findDivergence(declared->records, other->records))
      print("    first that differs: " + text::printable(first->text()) + "\n");
    print(fmt::format("    found with {}\n", found.arguments()));
    if (trial.seed != 0)
      print("    in this order: " + text::printable(reordered(*declared->plan, *other->plan)) + "\n");
    print(fmt::format("    repeat: the same command with {}\n", trial.arguments()));
    return 1;
  }
  print(fmt::format("{} of {} in {}: every picture is the same\n", text::counted(trials.size(), "run"),
                    text::counted(declared->plan->steps.size(), "pass"),
                    text::counted(options.seed ? 1 : options.runs + 1, "order")));
  return 0;
}

int runFuzz(FuzzOptions& options) {
  return runOnDevice({&options}, 2, [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
    return fuzz(*session->context, options, world, diagnostics);
  });
}

}  // namespace

void addAblate(CommandLine& line) {
  const auto [command, options] =
      line.add("ablate", "what each pass costs and does: time, bytes and picture without it", runAblate);
  options.addGraph(command);
  options.addFrame(command);
  options.addDrawing(command);
  command.add_option("--repeats", options.repeats, "frames to measure; the median counts")
      ->check(CLI::Range(1u, 1000u));
  addChoice(command, "--format", options.format, "text, json or html", {"text", "json", "html"});
  command.footer("Example: weft ablate graphs/glow.json --size 320x180");
}

void addFuzz(CommandLine& line) {
  const auto [command, options] =
      line.add("fuzz", "render in other legal orders and storage; exit 1 when a picture differs", runFuzz);
  options.addGraph(command);
  options.addFrame(command);
  options.addDrawing(command);
  command.add_option("--runs", options.runs, "how many random orders to try")->check(CLI::Range(1u, 100000u));
  command.add_option("--seed", options.seed,
                     "this order alone; 0 is the declared one (default: 0 to --runs)");
  addChoice(command, "--share", options.share, "whether transient textures share storage",
            {"on", "off", "both"});
  addChoice(command, "--poison", options.poison,
            "what transients hold before they are written; both: nan and large",
            {"nan", "large", "none", "both"});
  command.footer("Example: weft fuzz graphs/glow.json --size 64x36");
}

}  // namespace weft::app
