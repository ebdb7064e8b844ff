// weft dump: what each pass wrote, of the resources that patterns name, into a folder.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <vector>

#include "app/commands/commands.h"
#include "app/output/output_files.h"
#include "app/output/picture_writer.h"
#include "app/output/standard_streams.h"
#include "app/session/device_session.h"
#include "app/session/session.h"
#include "engine/graph/language/suffix.h"
#include "engine/graph/pick/pick.h"
#include "engine/runtime/inspection/capture.h"
#include "engine/text/files/file.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

// Without what a shell or a file system takes in another way: "hdr#2" is "hdr-2", "down[3]" is "down-3".
std::string plainWord(std::string name) {
  std::erase_if(name, [](char c) { return c == ']' || c == '@'; });
  std::ranges::replace_if(
      name, [](char c) { return c == '#' || c == '[' || c == ','; }, '-');
  return name;
}

// "007_glow_down-1.mip1": steps sort as they ran.
std::string fileNameOf(const runtime::CaptureItem& item, const graph::Plan& plan) {
  const graph::FlatGraph& graph = *plan.graph;
  const auto at = std::ranges::find(graph.resourceNames, item.target.resource) - graph.resourceNames.begin();
  const graph::FlatResource& resource = graph.resources[static_cast<std::size_t>(at)];
  const std::size_t digits = std::max<std::size_t>(2, std::to_string(plan.steps.size()).size());
  std::string name = fmt::format("{:0{}}_{}_{}", item.step, digits, plainWord(item.target.resource),
                                 plainWord(item.target.pass));
  if (resource.mips > 1) name += fmt::format(".mip{}", item.target.mip);
  if (resource.layers > 1 || resource.depth > 1) name += fmt::format(".layer{}", item.target.layer);
  return name + (item.target.stencil ? ".stencil" : "");
}

void reportNoMatch(const graph::Plan& plan, const std::vector<std::string>& patterns,
                   text::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<std::string> names;
  for (const std::string& name : graph.resourceNames) names.emplace_back(graph::sharedName(name));
  for (const std::string& pattern : patterns) {
    if (!runtime::captureItems(plan, {&pattern, 1}).empty()) continue;
    diagnostics
        .error(text::Code::unknownResource, text::placeOfOption(pattern),
               fmt::format("no pass that runs writes a resource '{}'", pattern))
        .hint = graph::suffixHint(pattern, names);
  }
}

struct DumpOptions : Options {
  std::vector<std::string> patterns;
  std::string folder;
  bool quiet = false;
};

int runDump(DumpOptions& options) {
  text::Diagnostics diagnostics;
  int exitCode = 0;
  auto opened = openGraph(options, diagnostics, exitCode);
  if (!opened) return exitCode;
  runtime::World& world = opened->world;
  runtime::Renderer& renderer = opened->session->renderer;
  runtime::Execution& execution = *renderer.execution();
  const graph::Plan& plan = execution.plan();
  reportNoMatch(plan, options.patterns, diagnostics);
  const std::vector<runtime::CaptureItem> items = runtime::captureItems(plan, options.patterns);
  std::vector<std::string> stems, written;
  std::vector<OutputFile> outputs;
  for (const runtime::CaptureItem& item : items) {
    stems.push_back(options.folder + "/" + fileNameOf(item, plan));
    for (const char* kind : {".png", ".exr", ".bin"})
      outputs.push_back({"-o", written.emplace_back(stems.back() + kind)});
  }
  if (diagnostics.hasErrors() || !makeFolderOf(options.folder + "/picture", diagnostics) ||
      !checkMadeFiles(written, diagnostics) ||
      !checkDistinct(outputs, filesReadBy(options, renderer, world), diagnostics))
    return report(diagnostics);
  runtime::Capture capture(renderer.device());
  const std::uint32_t begin = execution.remembers(world) ? 0 : options.lastFrame;
  // 64 bits, so that the last frame there is ends it.
  for (std::uint64_t next = begin; next <= options.lastFrame && !diagnostics.hasErrors(); ++next) {
    const auto frame = static_cast<std::uint32_t>(next);
    text::Diagnostics said;
    if (frame == options.lastFrame)
      capture.start(execution, items, [&](std::size_t item, runtime::Inspector& inspector) {
        const auto& [pass, resource] = std::tie(items[item].target.pass, items[item].target.resource);
        std::string path = stems[item] + (inspector.picture().id == 0 ? ".bin" : ".png");
        bool saved = false;
        if (inspector.picture().id == 0) {
          const std::vector<std::byte> bytes = inspector.bytes(0, inspector.bufferBytes());
          saved = text::writeFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, said);
        } else {
          saved =
              saveInspected(inspector, path, said) && saveInspected(inspector, stems[item] + ".exr", said);
        }
        if (saved && !options.quiet)
          print(text::printable(fmt::format("{}  {} after {}", path, resource, pass)) + "\n");
      });
    renderer.frame(world, runtime::headlessFrame(world, frame, options.fps, options.pointer), diagnostics);
    diagnostics.append(said);
    opened->session->context->debugLog().drain(diagnostics);
  }
  capture.stop(execution);
  for (std::size_t i = 0; i < items.size() && !options.quiet; ++i)
    if ((i == 0 || items[i - 1].step != items[i].step) && !execution.steps().hasResults(items[i].step))
      print(text::printable(fmt::format("'{}' did not run in frame {}: nothing of it is written",
                                        items[i].target.pass, options.lastFrame)) +
            "\n");
  return report(diagnostics, !options.quiet);
}

}  // namespace

void addDump(CommandLine& line) {
  const auto [command, options] = line.add("dump",
                                           "write what each pass wrote of some resources, as pictures "
                                           "(.png), values (.exr) and bytes (.bin): weft "
                                           "dump graphs/glow.json 'glow*' -o out",
                                           runDump);
  options.addGraph(command);
  command
      .add_option("name", options.patterns,
                  "names of resources, or any suffix of theirs; * stands for any letters; hdr#2 is a version")
      ->required();
  addPath(command, "-o,--output", options.folder, "folder to write to", "FOLDER")->required();
  options.addFrame(command, "--frames");
  options.addFps(command);
  options.addPointer(command);
  options.addBackend(command);
  command.add_flag("--quiet", options.quiet, "no list of files and no notes");
}

}  // namespace weft::app
