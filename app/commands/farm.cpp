// weft farm: hands `weft render` of a set of frames to the scheduler of a cluster, as a script for Slurm or a template of Open Job
// Description. All work is done by `weft render --skip-done`; here are chunks, tries and dependencies.
#include <fmt/ranges.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "app/commands/render.h"
#include "app/output/frame_set.h"
#include "app/output/manifest.h"
#include "app_sentences.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostTasks = 1000;  // MaxArraySize of Slurm, unless a site says more
constexpr const char* kOwn[] = {"kind", "--frames", "--per-task", "--script", "--submit", "--skip-done"};

struct FarmOptions : RenderOptions {
  const CLI::App* command = nullptr;
  std::string kind, script;
  std::uint32_t perTask = 20;
  bool submit = false;
};

// As bash takes a word. Control characters and what is no UTF-8 as \xNN: the script is one of lines, and can be part of JSON. No two braces
// meet, which in a template would begin or end an expression.
std::string wordOf(const std::string& word) {
  if (text::printable(word) != word) {
    std::string out = "$'";
    for (const unsigned char c : word)
      out += std::isalnum(c) ? std::string(1, c) : fmt::format("\\x{:02x}", c);
    return out + "'";
  }
  std::string out;
  for (const char c : quoted(word)) {
    if ((c == '{' || c == '}') && out.ends_with(c)) out += "''";
    out += c;
  }
  return out;
}

// `weft render` with the words that were given to this command and are none of its own.
std::string renderOf(const FarmOptions& options, bool inOrder) {
  std::error_code ec;
  std::string line = fmt::format("cd -- {} && {} render", wordOf(fs::current_path(ec).string()),
                                 wordOf(fs::read_symlink("/proc/self/exe", ec).string()));
  for (const CLI::Option* option : options.command->get_options()) {
    if (std::ranges::count(kOwn, option->get_name()) > 0) continue;
    for (const std::string& value : option->results())
      line += " " + wordOf(option->get_positional() ? fs::absolute(value).string()
                                                    : option->get_name() + "=" + value);
  }
  // A task that is begun again, or begins, goes on where the one before ended.
  if (inOrder && options.command->get_option("--checkpoint")->empty())
    line += fmt::format(" --checkpoint={}", options.perTask);
  return line + " --skip-done";
}

int runFarm(FarmOptions& options) {
  const bool slurm = options.kind == "slurm";
  if (options.submit && (!slurm || options.script == "-")) {
    printError(fmt::format("weft farm: --submit is for slurm, and needs a file as --script, found {}\n",
                           slurm ? "-" : options.kind));
    return 2;
  }
  options.skipDone = true;  // what render would refuse is refused now
  options.instead = [&](bool inOrder, std::vector<OutputFile>& outputs, text::Diagnostics& diagnostics) {
    const std::string folder = fs::absolute(manifestNameOf(outputs[0].pattern)).parent_path().string();
    // A template has no order of tasks.
    const std::size_t most = inOrder && !slurm ? options.frames.size() : options.perTask;
    std::vector<std::string> chunks;
    for (std::span<const std::uint32_t> left = options.frames; !left.empty();
         left = left.subspan(std::min(most, left.size())))
      chunks.push_back(framesText(left.first(std::min(most, left.size()))));
    if (options.script.empty())
      options.script = (fs::path(folder) / (slurm ? "farm.sbatch.sh" : "farm.openjd.json")).string();
    if (chunks.size() > kMostTasks) {
      refuseOutput(diagnostics, say::tooManyTasks, options.script, kMostTasks, chunks.size(),
                   (options.frames.size() - 1) / kMostTasks + 1);
      return 1;
    }
    const auto tasks = filledIn("commands/farm_tasks.sh",
                                {{"%FRAMES%", fmt::format("{}", fmt::join(chunks, " "))},
                                 {"%ALL%", framesText(options.frames)},
                                 {"%RENDER%", renderOf(options, inOrder)}},
                                diagnostics);
    if (!tasks) return 1;
    // The template is one of https://github.com/OpenJobDescription/openjd-specifications, without extensions.
    const auto script = filledIn(slurm ? "commands/farm_slurm.sh" : "commands/farm_openjd.json",
                                 {{"%COUNT%", text::counted(chunks.size(), "task")},
                                  {"%LAST%", fmt::format("{}", chunks.size() - 1)},
                                  {"%TASKS%", *tasks},
                                  {"%SCRIPT%", text::dumpJson("#!/bin/bash\n" + *tasks, -1)},
                                  {"%FOLDER%", wordOf(folder)},
                                  {"%IN_ORDER%", inOrder ? "true" : "false"}},
                                 diagnostics);
    if (!script) return 1;
    if (options.script == "-") {
      print(*script);
      return 0;
    }
    outputs.push_back({"--script", options.script});
    return checkDistinct(outputs, diagnostics) && makeFolderOf(options.script, diagnostics) &&
                   text::writeFile(options.script, *script, diagnostics)
               ? 0
               : 1;
  };
  if (const int code = runRender(options); code != 0 || options.script == "-") return code;
  if (!options.submit) {
    print(slurm ? fmt::format("read it, and submit it with: bash {}\n", wordOf(options.script))
                : text::printable(options.script) + "\n");
    return 0;
  }
  const int status = std::system(("exec bash " + app::quoted(options.script)).c_str());
  if (status == -1) printError(fmt::format("farm: bash cannot be started: {}\n", std::strerror(errno)));
  return WIFEXITED(status) ? WEXITSTATUS(status) : 3;
}

}  // namespace

void addFarm(CommandLine& line) {
  const auto [command, options] =
      line.add("farm", "write a script or a template that has a cluster render frames", runFarm);
  options.command = &command;
  addChoice(command, "kind", options.kind,
            "slurm: a script that submits jobs; openjd: a template of Open Job Description",
            {"slurm", "openjd"})
      ->required();
  addRenderOptions(command, options);
  command.get_option("--frames")->required();
  command.add_option("--per-task", options.perTask, "frames of a task at most (default: 20)")
      ->check(CLI::Range(1u, ~0u));
  addPath(
      command, "--script", options.script,
      "what to write (-: standard output; default: farm.sbatch.sh or farm.openjd.json, beside the frames)",
      "FILE or -");
  command.add_flag("--submit", options.submit, "slurm: submit it, too");
}

}  // namespace weft::app
