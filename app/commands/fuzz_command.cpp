// weft fuzz: whatever a plan leaves open, the picture is the same.
#include <fmt/format.h>

#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/device_session.h"
#include "app/trials/divergence.h"
#include "app/trials/fuzz.h"
#include "app/trials/work_lines.h"
#include "engine/assets/images/flip.h"
#include "engine/base/counted.h"
#include "engine/base/printable.h"

namespace weft::app {

namespace {

struct FuzzOptions : Options {
  std::uint32_t runs = 12;            // random orders
  std::optional<std::uint32_t> seed;  // this order alone; 0 is the declared one
  std::string order, share = "both", poison = "both";
  const CLI::App* line = nullptr;  // what was given
};

std::string checkWindow(const std::string& text) {
  std::uint32_t first = 0, last = 0;
  return parsePair(text, ':', first, last) && first <= last
             ? ""
             : "expected FIRST:LAST with FIRST <= LAST, places of passes in the plan counted from 0, found "
               "'" +
                   text + "'";
}

class Fuzzer {
 public:
  Fuzzer(gl::Context& context, const FuzzOptions& options, const runtime::World& world)
      : context_(context), options_(options), world_(world) {}

  // Returns the exit code.
  int run(base::Diagnostics& diagnostics) {
    base_ = shoot({}, diagnostics);
    if (!base_ || !checkOrder(diagnostics)) return 2;
    const std::vector<FuzzTrial> trials = trialsOf(options_);
    WorkLines lines(trials.size(), "runs");
    for (const FuzzTrial& trial : trials) {
      const bool same = !differs(trial);
      lines.countOne();
      if (same) {
        if (!problems_.hasErrors()) continue;
        diagnostics.append(problems_);
        return 2;
      }
      tell(trial);
      return 1;
    }
    print(fmt::format("{} of {} in {}: every picture is the same\n", base::counted(trials.size(), "run"),
                      base::counted(base_->plan->steps.size(), "pass"),
                      base::counted(options_.seed ? 1 : options_.runs + 1, "order")));
    return 0;
  }

 private:
  static std::vector<FuzzTrial> trialsOf(const FuzzOptions& wanted) {
    std::vector<std::uint32_t> seeds;
    if (wanted.seed)
      seeds = {*wanted.seed};
    else
      for (std::uint32_t seed = 0; seed <= wanted.runs; ++seed) seeds.push_back(seed);
    std::vector<bool> shares;
    if (wanted.share != "off") shares.push_back(true);
    if (wanted.share != "on") shares.push_back(false);
    std::vector<std::optional<runtime::PoisonPattern>> poisons;
    if (wanted.poison == "both")
      poisons = {runtime::PoisonPattern::nan, runtime::PoisonPattern::large};
    else
      poisons = {runtime::findPoison(wanted.poison)};
    std::uint32_t first = 0, last = ~0u;
    if (!wanted.order.empty()) parsePair(wanted.order, ':', first, last);
    return listTrials(seeds, first, last, shares, poisons);
  }

  // Checks that the places of --order are places of the plan.
  bool checkOrder(base::Diagnostics& diagnostics) const {
    std::uint32_t first = 0, last = 0;
    const std::size_t places = base_->plan->steps.size();
    if (!parsePair(options_.order, ':', first, last) || last < places) return true;
    base::Diagnostic& d =
        diagnostics.error(base::Code::numberOutOfRange, base::placeOfOption("--order " + options_.order),
                          fmt::format("the plan has {}", base::counted(places, "pass")));
    d.expected = fmt::format("places from 0 to {}", places - 1);
    d.found = fmt::format("{}", last);
    d.hint = "weft plan lists them in their order";
    return false;
  }

  std::optional<Shot> shoot(const FuzzTrial& trial, base::Diagnostics& diagnostics) {
    return takeShot(context_, options_, world_,
                    {.frames = {options_.lastFrame},
                     .records = true,
                     .compile = trial.compileOptions(),
                     .poison = trial.poison},
                    diagnostics);
  }

  const assets::Image8& pictureOf(const Shot& shot) const { return shot.pictures.at(options_.lastFrame); }

  bool differs(const FuzzTrial& trial) {
    problems_.clear();
    auto shot = shoot(trial, problems_);
    if (!shot || pictureOf(*shot).texels == pictureOf(*base_).texels) return false;
    last_ = std::move(shot);
    return true;
  }

  void tell(const FuzzTrial& found) {
    const FuzzTrial trial = shrinkTrial(found, static_cast<std::uint32_t>(base_->plan->steps.size()),
                                        [&](const FuzzTrial& smaller) { return differs(smaller); });
    differs(trial);
    const assets::Image8 &picture = pictureOf(*last_), &expected = pictureOf(*base_);
    const assets::Comparison bytes = assets::compareImages(picture, expected);
    const assets::FlipSummary flip = assets::summarizeFlip(assets::computeFlip(expected, picture));
    print(fmt::format("a picture differs: {}, by up to {:.0f} of 255 (at {},{}); FLIP {:.4f}\n",
                      base::counted(bytes.differingPixels, "pixel"), bytes.maxDifference, bytes.worstX,
                      bytes.worstY, flip.mean));
    const std::string& driver = context_.device().driverKey;
    if (const auto first = findDivergence(recordsOf(*base_, driver), recordsOf(*last_, driver)))
      print(fmt::format("    first that differs: {}\n", first->text()));
    print(fmt::format("    found with {}\n", found.arguments()));
    if (trial.seed != 0) print("    in this order: " + reordered() + "\n");
    print(base::printable(fmt::format("    repeat: weft fuzz {} {}{}", quote(options_.graph),
                                      trial.arguments(), givenText())) +
          "\n");
  }

  // The passes that do not stand where they are declared.
  std::string reordered() const {
    std::string text;
    const graph::Plan &declared = *base_->plan, &plan = *last_->plan;
    for (std::size_t step = 0; step < plan.steps.size(); ++step)
      if (plan.steps[step].pass != declared.steps[step].pass)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", step,
                            plan.graph->passNames[plan.steps[step].pass]);
    return text;
  }

  static std::string quote(const std::string& word) {
    if (!word.empty() &&
        word.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                               "_-./=:,+@%") == std::string::npos)
      return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
  }

  // The options as they were given, but for those that say which trials to make.
  std::string givenText() const {
    std::string text;
    for (const CLI::Option* option : options_.line->get_options()) {
      const std::string name = option->get_name();
      const bool ofTrials = name == "--runs" || name == "--seed" || name == "--order" || name == "--share" ||
                            name == "--poison";
      if (option->get_positional() || ofTrials) continue;
      for (const std::string& value : option->results()) text += fmt::format(" {} {}", name, quote(value));
    }
    return text;
  }

  gl::Context& context_;
  const FuzzOptions& options_;
  const runtime::World& world_;
  std::optional<Shot> base_, last_;  // the declared plan; the last picture that differed
  base::Diagnostics problems_;
};

int runFuzz(FuzzOptions& options) {
  const Options* const one = &options;
  return runOnDevice({one, 1}, 2,
                     [&](gl::Context& context, const runtime::World& world, base::Diagnostics& diagnostics) {
                       return Fuzzer(context, options, world).run(diagnostics);
                     });
}

}  // namespace

void addFuzz(CommandLine& line) {
  const auto [command, options] = line.add("fuzz",
                                           "render in random legal orders, with shared storage and without, "
                                           "with poisoned transients; exit 1 when a "
                                           "picture differs",
                                           runFuzz);
  options.line = &command;
  options.addGraph(command);
  options.addFrame(command);
  options.addPointer(command);
  options.addBackend(command);
  command.add_option("--runs", options.runs, "how many random orders to try")->check(CLI::Range(1u, 100000u));
  command.add_option("--seed", options.seed,
                     "try this order alone; 0 is the declared one (default: 0 to --runs)");
  command
      .add_option("--order", options.order,
                  "reorder only the passes at these places of the plan, counted from 0")
      ->check(CLI::Validator(checkWindow, "FIRST:LAST"));
  addChoice(command, "--share", options.share, "whether transient textures share storage: on, off or both",
            {"on", "off", "both"});
  addChoice(command, "--poison", options.poison,
            "what transients hold before they are written: nan, large, none, or both (nan and large)",
            {"nan", "large", "none", "both"});
  command.footer("Example: weft fuzz graphs/glow.json --size 64x36");
}

}  // namespace weft::app
