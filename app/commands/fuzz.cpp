// weft fuzz: whatever a plan leaves open, the picture is the same.
#include "app/commands/commands.h"
#include "app/trials/divergence.h"

namespace weft::app {

namespace {

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
