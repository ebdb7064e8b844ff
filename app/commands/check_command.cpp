// weft check: everything wrong with a graph, as text, JSON or SARIF; once, or again after every save.
// Declared in commands.h.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>

#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "app/commands/commands.h"
#include "app/commands/shader_check.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/base/counted.h"
#include "engine/base/files/file_watcher.h"
#include "engine/base/printable.h"
#include "engine/base/report.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/read/read.h"
#include "engine/graph/survey/matrix.h"
#include "engine/runtime/imports/registry.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

struct CheckOptions : Options {
  std::string format = "text";
  bool shaders = true;       // compile every shader, too
  bool matrix = false;       // try every variation
  bool allVariants = false;  // compile what the variations reach
  bool watch = false;        // again after every save
};

struct Checked {
  base::Diagnostics diagnostics;
  std::shared_ptr<const graph::Plan> plan;  // null after errors of the graph
  std::optional<graph::Matrix> matrix;
  std::size_t variants = 0;        // of shaders that were compiled
  std::vector<std::string> files;  // that were read
  base::Diagnostics unread;        // why shaders were not looked at (--no-shaders)
};

// Compiled, or with --no-shaders by what they declare.
void checkShaders(const CheckOptions& options, ShaderCheck& shaders, const graph::Plan& plan,
                  const std::string& with, base::Diagnostics& diagnostics) {
  if (options.shaders)
    shaders.check(plan, with, diagnostics);
  else
    shaders.checkDeclared(plan, with, diagnostics);
}

// The variations of the graph: what they refuse, and with --all the shader variants that they reach.
graph::Matrix tryVariations(const CheckOptions& options, const graph::GraphDesc& desc,
                            const runtime::WorldFacts& facts, ShaderCheck& shaders,
                            base::Diagnostics& diagnostics) {
  const graph::Registry registry = runtime::makeRegistry({}, facts);
  graph::MatrixOptions wanted{.pairs = options.matrix};
  if (options.allVariants)
    wanted.visit = [&](const graph::Variation& variation, std::shared_ptr<const graph::FlatGraph> flat) {
      const bool changed = !variation.disables.empty() || !variation.parameter.empty();
      checkShaders(options, shaders, graph::compile(std::move(flat)), changed ? variation.text() : "",
                   diagnostics);
    };
  return graph::tryMatrix(desc, registry, settingsOf(options, true), wanted);
}

Checked checkOnce(const CheckOptions& options) {
  Checked checked;
  base::Diagnostics& diagnostics = checked.diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  checked.plan = makePlan(options, facts, true, diagnostics);
  ShaderCheck shaders(options);
  if (checked.plan) checkShaders(options, shaders, *checked.plan, "", diagnostics);
  // Beyond a limit nothing that follows can be trusted, and there may be very much of it.
  const bool over = diagnostics.contains(base::Code::limitExceeded);
  const bool vary = checked.plan && !diagnostics.hasErrors() && (options.matrix || options.allVariants);
  base::Diagnostics again;
  if (const auto desc = over || (checked.plan && !vary)
                            ? nullptr
                            : graph::readGraph(options.graph, options.presets, again)) {
    if (!checked.plan) shaders.checkFiles(*desc, diagnostics);
    if (vary) checked.matrix = tryVariations(options, *desc, facts, shaders, diagnostics);
    checked.files = desc->files;
  }
  if (checked.plan) checked.files = checked.plan->graph->files;
  if (checked.files.empty()) checked.files = {options.graph};
  for (std::string& file : shaders.files()) checked.files.push_back(std::move(file));
  checked.variants = shaders.variants();
  checked.unread = shaders.unread();
  if (checked.matrix && options.matrix)
    for (const auto* told : {&checked.matrix->broken, &checked.matrix->lost})
      for (const graph::RefusedVariation& variation : *told)
        for (base::Diagnostic each : variation.said.items()) {
          each.message += fmt::format(" (with {})", variation.variation.text());
          diagnostics.add(std::move(each));
        }
  diagnostics.sortByPlace();
  return checked;
}

// ---- told as text ----

std::string matrixText(const CheckOptions& options, const Checked& checked) {
  const graph::Matrix& matrix = *checked.matrix;
  std::string text;
  if (options.matrix) {
    text = fmt::format("matrix: {} and {} disabled, {} set\n", base::counted(matrix.passes, "pass"),
                       base::counted(matrix.pairs, "pair"), base::counted(matrix.values, "value"));
    for (const graph::RefusedVariation& needed : matrix.needed)
      text += fmt::format("  needed: {}: {}\n",
                          base::printable(fmt::format("{}", fmt::join(needed.variation.disables, " or "))),
                          base::printable(needed.said.items()[0].message));
    text += matrix.broken.empty()
                ? "  nothing else is refused\n"
                : fmt::format("  {} of these are refused without saying so\n", matrix.broken.size());
  }
  if (options.allVariants && options.shaders)
    text += fmt::format("shaders: {} compiled\n", base::counted(checked.variants, "variant"));
  return text;
}

int tellText(const CheckOptions& options, Checked& checked) {
  const int code = report(checked.diagnostics);
  if (checked.matrix) print(matrixText(options, checked));
  if (code == 0)
    print(fmt::format("{}: {}, {} run, {} {} {} of {} declared bytes\n", base::printable(options.graph),
                      base::counted(checked.plan->graph->passes.size(), "pass"), checked.plan->steps.size(),
                      base::counted(checked.plan->storages.size(), "texture"),
                      checked.plan->storages.size() == 1 ? "takes" : "share", checked.plan->bytesAllocated,
                      checked.plan->bytesDeclared));
  // A graph may stand apart from its shaders: no mistake, but then nobody has looked at them.
  for (const base::Diagnostic& each : checked.unread.items())
    if (code == 0) print(fmt::format("  not looked at: {}\n", base::printable(each.message)));
  return code;
}

// ---- told as data ----

Json refusedJson(const std::vector<graph::RefusedVariation>& refused) {
  Json all = Json::array();
  for (const graph::RefusedVariation& each : refused)
    all.push_back({{"with", each.variation.text()},
                   {"diagnostics", Json::parse(base::diagnosticsJson(each.said, -1))}});
  return all;
}

Json documentOf(const CheckOptions& options, const Checked& checked) {
  Json out{{"graph", options.graph},
           {"errors", checked.diagnostics.errorCount()},
           {"diagnostics", Json::parse(base::diagnosticsJson(checked.diagnostics, -1))}};
  if (checked.plan)
    out["plan"] = {{"passes", checked.plan->graph->passes.size()},
                   {"run", checked.plan->steps.size()},
                   {"textures", checked.plan->storages.size()},
                   {"bytes_declared", checked.plan->bytesDeclared},
                   {"bytes_allocated", checked.plan->bytesAllocated}};
  for (const base::Diagnostic& each : checked.unread.items()) out["not_looked_at"].push_back(each.message);
  if (options.shaders) out["shader_variants"] = checked.variants;
  if (checked.matrix && options.matrix)
    out["matrix"] = {{"passes", checked.matrix->passes},
                     {"pairs", checked.matrix->pairs},
                     {"values", checked.matrix->values},
                     {"needed", refusedJson(checked.matrix->needed)},
                     {"broken", refusedJson(checked.matrix->broken)},
                     {"lost", refusedJson(checked.matrix->lost)}};
  return out;
}

int tell(const CheckOptions& options, Checked& checked) {
  if (options.format == "text") return tellText(options, checked);
  if (options.format == "sarif")
    print(base::diagnosticsSarif(checked.diagnostics, kVersion) + "\n");
  else if (options.watch)  // a line for each time
    print(base::printableJson(
              documentOf(options, checked).dump(-1, ' ', false, Json::error_handler_t::replace)) +
          "\n");
  else
    print(dumpJson(documentOf(options, checked)) + "\n");
  return checked.diagnostics.hasErrors() ? 1 : 0;
}

// Returns when some of the files changed and then nothing did for a moment: a save may be several writes.
std::vector<std::string> waitForChange(base::FileWatcher& watcher) {
  constexpr int kQuiet = 50;  // milliseconds
  std::vector<std::string> changed;
  while (true) {
    pollfd waiting{watcher.descriptor(), POLLIN, 0};
    poll(&waiting, 1, changed.empty() ? -1 : kQuiet);
    const std::vector<std::string> more = watcher.poll();
    if (more.empty() && !changed.empty()) return changed;
    changed.insert(changed.end(), more.begin(), more.end());
  }
}

using FileClock = std::chrono::file_clock;

// Until Linux 6.13 a file's time is that of the last tick, so a save may seem to be older by as much.
constexpr auto kGrain = std::chrono::milliseconds(20);

// The files that were saved since `began`: while they were checked, nobody watched them. A time in the future is no save.
std::vector<std::string> savedSince(const std::vector<std::string>& files, FileClock::time_point began) {
  std::vector<std::string> saved;
  for (const std::string& file : files) {
    std::error_code ec;
    const auto at = std::filesystem::last_write_time(file, ec);
    if (!ec && at >= began - kGrain && at <= FileClock::now()) saved.push_back(file);
  }
  return saved;
}

int runCheck(CheckOptions& options) {
  base::FileWatcher watcher;
  while (true) {
    const FileClock::time_point began = FileClock::now();
    Checked checked = checkOnce(options);
    if (options.watch) watcher.watch(checked.files);
    const int code = tell(options, checked);
    if (!options.watch) return code;
    if (options.format == "text")
      print(fmt::format("watching {}\n", base::counted(checked.files.size(), "file")));
    flushPrinted();
    std::vector<std::string> changed = savedSince(checked.files, began);
    if (changed.empty())
      changed = waitForChange(watcher);
    else
      std::this_thread::sleep_for(kGrain);  // so that the same save is not found again
    if (options.format == "text") print(fmt::format("\nchanged: {}\n", base::printable(changed[0])));
  }
}

}  // namespace

void addCheck(CommandLine& line) {
  const auto [command, options] =
      line.add("check", "report everything wrong with a graph; exit 1 when it cannot run", runCheck);
  options.addGraph(command);
  command.add_flag("!--no-shaders", options.shaders, "do not compile the shaders (needs no OpenGL)");
  addChoice(command, "--format", options.format, "text, json, or sarif for code hosts and editors",
            {"text", "json", "sarif"});
  command.add_flag(
      "--matrix", options.matrix,
      "also with each pass disabled, each pair of passes, and each value that a parameter offers");
  command.add_flag("--all", options.allVariants,
                   "compile every shader variant that disabling a pass or setting a parameter reaches");
  command.add_flag("--watch", options.watch,
                   "check again whenever a file that was read changes, until ended");
}

}  // namespace weft::app
