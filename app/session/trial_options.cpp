#include "app/session/trial_options.h"

#include <algorithm>

#include "app/session/option_checks.h"

namespace weft::app {

namespace {

std::string checkWindow(const std::string& text) {
  std::uint32_t first = 0, last = 0;
  return parsePair(text, ':', first, last) && first <= last
             ? ""
             : "expected FIRST:LAST with FIRST <= LAST, places of passes in the plan counted from 0, found "
               "'" +
                   text + "'";
}

CLI::Option* addFrame(CLI::App& command, RawOptions& raw) {
  return command.add_option("--frame", raw.frames, "number of the frame to look at (default: 0)")
      ->check(CLI::Validator(checkFrame, "FRAME"));
}

// A command that renders a graph again and again.
CLI::App* addTrial(CLI::App& app, const char* name, const char* doc, Options& options, RawOptions& raw) {
  CLI::App* trial = app.add_subcommand(name, doc);
  addGraphOptions(*trial, options, raw);
  addFrame(*trial, raw);
  addPointerOption(*trial, options);
  addBackendOptions(*trial, options);
  return trial;
}

void addTest(CLI::App& app, Options& options) {
  CLI::App* test = app.add_subcommand(
      "test",
      "render the cases of *.cases.json and compare them with their goldens; exit 1 when one differs");
  test->add_option("folder", options.trial.folder, "a folder with *.cases.json, or one such file")
      ->required()
      ->type_name("FILE");
  test->add_option("--only", options.trial.only, "run the cases whose name contains this; repeatable");
  test->add_flag("--accept", options.trial.accept,
                 "write what is rendered as the goldens, and say what changed");
  test->add_option("--report", options.trial.report,
                   "write a page of the failures: picture, golden, difference, first pass that differs")
      ->type_name("FILE");
  test->add_option("-o,--output", options.output,
                   "folder for the picture and the difference of each case that fails")
      ->type_name("FOLDER");
  addBackendOptions(*test, options);
  test->footer("Example: weft test tests/golden --report out/report.html");
}

void addBisect(CLI::App& app, Options& options, RawOptions& raw) {
  CLI::App* bisect = addTrial(
      app, "bisect", "find the first pass whose output differs between two graphs, or two settings of one",
      options, raw);
  bisect->add_option("other", options.otherGraph, "the other graph file (default: the same)")
      ->type_name("FILE");
  bisect->add_option("--other-set", raw.otherSets, "set a parameter in the other graph alone; repeatable")
      ->check(CLI::Validator(checkSet, "NAME=VALUE"));
  bisect->add_option("--other-disable", options.trial.otherDisables,
                     "disable a pass in the other graph alone; repeatable");
  bisect
      ->add_option("--other-preset", options.trial.otherPresets,
                   "lay an overlay over the other graph alone; repeatable")
      ->type_name("FILE");
  bisect->footer("Example: weft bisect graphs/studio.json --size 320x180 --other-set threshold=2");
}

void addAblate(CLI::App& app, Options& options, RawOptions& raw) {
  CLI::App* ablate = addTrial(
      app, "ablate", "what each pass costs and does: milliseconds, bytes and picture difference without it",
      options, raw);
  ablate->add_option("--repeats", options.trial.repeats, "frames to measure; the fastest counts")
      ->check(CLI::Range(1u, 1000u));
  ablate->add_option("--format", options.format, "text, json or html")
      ->check(CLI::IsMember({"text", "json", "html"}));
  ablate->footer("Example: weft ablate graphs/glow.json --size 320x180");
}

void addFuzz(CLI::App& app, Options& options, RawOptions& raw) {
  CLI::App* fuzz =
      addTrial(app, "fuzz",
               "render in random legal orders, with shared storage and without, with poisoned transients; "
               "exit 1 when a picture differs",
               options, raw);
  fuzz->add_option("--runs", options.trial.runs, "how many random orders to try")
      ->check(CLI::Range(1u, 100000u));
  fuzz->add_option("--seed", options.trial.seed,
                   "try this order alone; 0 is the declared one (default: 0 to --runs)");
  fuzz->add_option("--order", options.trial.order,
                   "reorder only the passes at these places of the plan, counted from 0")
      ->check(CLI::Validator(checkWindow, "FIRST:LAST"));
  fuzz->add_option("--share", options.trial.share,
                   "whether transient textures share storage: on, off or both")
      ->check(CLI::IsMember({"on", "off", "both"}));
  fuzz->add_option("--poison", options.trial.poison,
                   "what transients hold before they are written: nan, large, none, or both (nan and large)")
      ->check(CLI::IsMember({"nan", "large", "none", "both"}));
  fuzz->footer("Example: weft fuzz graphs/glow.json --size 64x36");
}

void addNew(CLI::App& app, Options& options) {
  CLI::App* made = app.add_subcommand("new", "write the files of something new");
  made->require_subcommand(1);
  CLI::App* pass = made->add_subcommand(
      "pass", "write a graph with a pass of that name behind an existing graph, and its shader, commented");
  pass->add_option("name", options.name, "name of the pass: letters, digits and _")->required();
  pass->add_option("--graph", options.graph, "the graph to extend (default: the bundled graphs/glow.json)")
      ->type_name("FILE");
  pass->add_option("-o,--output", options.trial.folder, "folder to write into (default: here)")
      ->type_name("FOLDER");
  pass->footer("Example: weft new pass tint -o out/tint");
}

}  // namespace

void addDiffOptions(CLI::App& diff, Options& options, RawOptions& raw) {
  CLI::Option* render = diff.add_flag("--render", options.trial.render,
                                      "render both: how the pictures differ, and the first pass that does");
  diff.add_option("-o,--output", options.output,
                  "folder for before.png, after.png and their difference (with --render)")
      ->type_name("FOLDER")
      ->needs(render);
  addFrame(diff, raw)->needs(render);
  addPointerOption(diff, options);
  diff.add_option("--format", options.format, "text or json")->check(CLI::IsMember({"text", "json"}));
  addBackendOptions(diff, options);
  diff.footer(
      "Example: weft diff graphs/glow.json tests/golden/vignette.json --render --size 320x180 -o out");
}

void addTrialCommands(CLI::App& app, Options& options, RawOptions& raw) {
  addTest(app, options);
  addBisect(app, options, raw);
  addAblate(app, options, raw);
  addFuzz(app, options, raw);
  addNew(app, options);
}

}  // namespace weft::app
