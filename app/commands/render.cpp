// weft render: frames of a graph to image files, reproducible to the byte. weft dump: what each pass wrote in one of them.
#include "app/commands/commands.h"
#include "app/output/pictures.h"
#include "engine/graph/language/names.h"
#include "engine/runtime/inspection/inspector.h"

namespace weft::app {

namespace {

// A texture or buffer of the graph that is written to files, or to those of patterns.
struct Part {
  std::string name;  // as it was asked for
  std::vector<std::string> files;
  runtime::CaptureItem item;
  bool saved = false;  // in the last frame
};

// What a run of frames writes, and what is known of it afterwards.
struct FrameRun {
  std::string output;  // the presented picture; empty: only the parts
  std::vector<Part> parts;
  PictureWriter writer{};
  runtime::FrameReport last{};
  std::uint64_t frames = 0;
  double firstMs = 0;  // of the first frame
};

const graph::FlatResource& resourceOf(const graph::FlatGraph& graph, const runtime::CaptureItem& item) {
  const auto at = std::ranges::find(graph.resourceNames, item.target.resource) - graph.resourceNames.begin();
  return graph.resources[static_cast<std::size_t>(at)];
}

// Runs the frames up to options.lastFrame and writes those from options.firstFrame on. Frames before them run too when one of
// them may look back, so frame N does not depend on where the range starts. `onWritten` is called after each that was written.
void runFrames(DeviceSession& session, runtime::World& world, const Options& options, FrameRun& run,
               const std::function<void()>& onWritten, text::Diagnostics& diagnostics) {
  runtime::Renderer& renderer = session.renderer;
  runtime::Execution& execution = *renderer.execution();
  const std::uint32_t begin = execution.remembers(world) ? 0 : options.firstFrame;
  run.frames = std::uint64_t{options.lastFrame} - begin + 1;
  ProgressLines lines({.total = run.frames, .lead = options.firstFrame - begin});
  std::vector<runtime::CaptureItem> items;
  for (const Part& part : run.parts) items.push_back(part.item);
  runtime::Capture capture(renderer.device());
  std::uint32_t frame = begin;
  text::Diagnostics said;
  const auto save = [&](std::size_t i, runtime::Inspector& inspector) {
    Part& part = run.parts[i];
    part.saved = std::ranges::all_of(part.files, [&](const std::string& file) {
      return saveInspected(inspector, *outputNameOf(file, frame), said);
    });
  };
  for (std::uint64_t done = 1; done <= run.frames && !diagnostics.hasErrors(); ++done) {
    frame = static_cast<std::uint32_t>(begin + (done - 1));
    if (frame == options.firstFrame && !items.empty()) capture.start(execution, items, save);
    for (Part& part : run.parts) part.saved = false;
    const double before = gl::steadyMs();
    run.last = drawFrame(renderer, world, options, frame, diagnostics);
    renderer.dropUploaded(world);
    if (done == 1) {
      glFinish();
      run.firstMs = gl::steadyMs() - before;
    }
    if (run.frames > 1 && !options.quiet) lines.countOne();
    if (frame < options.firstFrame) continue;
    diagnostics.append(std::exchange(said, {}));
    onWritten();
    if (!run.output.empty() && !diagnostics.hasErrors())
      run.writer.save(renderer, *outputNameOf(run.output, frame), diagnostics);
  }
  if (!items.empty()) capture.stop(execution);
  session.context->drainMessages(diagnostics);
  run.writer.tell(diagnostics);
}

struct RenderOptions : Options {
  std::vector<std::string> outputs;  // -o, as they were written
  std::string present;
};

// `-o FILE`, `-o NAME=FILE` and `--present NAME`: the parts are those of options.kept. What is wrong with them, or nothing.
std::string takeOutputs(RenderOptions& options, FrameRun& run) {
  const auto add = [&](graph::Pick pick, const char* option, std::string file) {
    pick.option = option;
    run.parts.push_back({pick.text, {std::move(file)}, {}});
    options.kept.push_back(std::move(pick));
  };
  for (const std::string& text : options.outputs) {
    const std::string name = text.substr(0, text.find('='));
    if (name != text && name.find('/') == std::string::npos)
      // A word that is spelled in another way names nothing; then the graph's names tell which one is near.
      add(graph::parsePick(name).value_or(graph::Pick{.text = name, .name = name, .pass = {}}), "-o",
          text.substr(name.size() + 1));
    else if (run.output.empty())
      run.output = text;
    else
      return fmt::format(
          "the picture would be written to '{}' and to '{}'; of another texture write NAME=FILE", run.output,
          text);
  }
  if (options.present.empty()) return {};
  const std::optional<graph::Pick> shown = graph::parsePick(options.present);
  if (!shown)
    return fmt::format("--present takes a texture such as depth, hdr#1 or 'glow.mip[2]', found '{}'",
                       options.present);
  if (run.output.empty()) return "--present needs a file: -o FILE";
  add(*shown, "--present", std::exchange(run.output, {}));
  return {};
}

// Finds the parts in the plan.
void findParts(const RenderOptions& options, const graph::Plan& plan, FrameRun& run,
               text::Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < run.parts.size(); ++i) {
    const auto item = runtime::captureItemOf(plan, options.kept[i], diagnostics);
    if (!item) continue;
    run.parts[i].item = *item;
    if (resourceOf(*plan.graph, *item).kind == graph::ResourceKind::buffer)
      refuseOutput(run.parts[i].files[0],
                   fmt::format("'{}' is a buffer and no picture", options.kept[i].name),
                   "weft dump writes the bytes of buffers", diagnostics);
  }
}

int runRender(RenderOptions& options) {
  const double start = gl::steadyMs();
  FrameRun run;
  if (const std::string wrong = takeOutputs(options, run); !wrong.empty()) {
    printError("weft render: " + text::shortened(text::printable(wrong)) + "\n");
    return 2;
  }
  text::Diagnostics wrong;
  std::vector<OutputFile> outputs;
  if (!run.output.empty()) outputs.push_back({"-o", run.output});
  for (const Part& part : run.parts) outputs.push_back({"-o " + part.name, part.files[0]});
  for (const OutputFile& each : outputs)
    checkOutput(each.pattern, options.firstFrame, options.lastFrame > options.firstFrame, wrong);
  if (wrong.hasErrors()) return report(wrong);
  return runOnDevice({&options}, 1, [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
    runtime::Renderer& renderer = session->renderer;
    if (!renderer.load(settingsOf(options, session->context->device().software), world, diagnostics) ||
        (!run.output.empty() && !checkPresents(options, renderer, diagnostics)))
      return 1;
    const double prepared = gl::steadyMs();
    findParts(options, renderer.execution()->plan(), run, diagnostics);
    if (!checkDistinct(outputs, diagnostics) || diagnostics.hasErrors()) return 1;
    renderer.device().timers.setEnabled(options.profile);
    const auto checkSaved = [&] {
      for (const Part& part : run.parts)
        if (!part.saved && !diagnostics.hasErrors())
          refuseOutput(part.files[0], fmt::format("nothing was in '{}' to write", part.name),
                       "its import may be missing, or its pass did not run", diagnostics);
    };
    runFrames(*session, world, options, run, checkSaved, diagnostics);
    if (diagnostics.hasErrors() || !options.stats) return 0;
    auto stats = statsOf(*session, {{"setup_ms", prepared - start},
                                    {"first_frame_ms", run.firstMs},
                                    {"total_ms", gl::steadyMs() - start},
                                    {"frames_run", run.frames},
                                    {"passes_run_last_frame", run.last.passesRun},
                                    {"passes_skipped_last_frame", run.last.passesSkipped},
                                    {"barriers_last_frame", run.last.barriers}});
    stats["pictures"] = {{"written", run.writer.counts().pictures},
                         {"with_nan_or_infinity", run.writer.counts().broken},
                         {"pixels_nan_or_infinite", run.writer.counts().pixels}};
    stats["gl_objects_left"] = closeDevice(std::move(session));
    printError(text::dumpJson(stats) + "\n");
    return 0;
  });
}

// ---- dump ----

struct DumpOptions : Options {
  std::vector<std::string> patterns;
  std::string folder;
};

// Without what a shell or a file system takes in another way: "hdr#2" is "hdr-2", "down[3]" is "down-3".
std::string plainWord(std::string name) {
  std::erase_if(name, [](char c) { return c == ']' || c == '@'; });
  std::ranges::replace_if(
      name, [](char c) { return c == '#' || c == '[' || c == ','; }, '-');
  return name;
}

// "007_glow_down-1.mip1.layer0": steps sort as they ran.
std::string fileNameOf(const runtime::CaptureItem& item, const graph::Plan& plan) {
  const graph::FlatResource& resource = resourceOf(*plan.graph, item);
  std::string name =
      fmt::format("{:03}_{}_{}", item.step, plainWord(item.target.resource), plainWord(item.target.pass));
  if (resource.mips > 1) name += fmt::format(".mip{}", item.target.mip);
  if (resource.layers > 1 || resource.depth > 1) name += fmt::format(".layer{}", item.target.layer);
  return name + (item.target.stencil ? ".stencil" : "");
}

// The parts of the plan that the patterns name; each of them names some.
std::vector<Part> matchingParts(const DumpOptions& options, const graph::Plan& plan,
                                text::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const std::string& name : plan.graph->resourceNames)
    if (!name.starts_with('@')) names.emplace_back(graph::sharedName(name));
  for (const std::string& pattern : options.patterns) {
    const bool unread = !graph::suffixMatches(names, pattern).empty();
    if (runtime::captureItems(plan, {&pattern, 1}).empty())
      diagnostics.error(
          text::Code::unknownResource, text::placeOfOption(pattern),
          unread ? fmt::format("'{}' is not attached in a pass that runs: nobody reads it", pattern)
                 : fmt::format("no pass that runs writes a resource '{}'", pattern),
          {.hint = unread ? fmt::format("`weft render -o {}=FILE` reads it", pattern)
                          : graph::suffixHint(pattern, names)});
  }
  std::vector<Part> parts;
  for (const runtime::CaptureItem& item : runtime::captureItems(plan, options.patterns)) {
    const std::string stem = options.folder + "/" + fileNameOf(item, plan);
    std::vector<std::string> files{stem + ".png", stem + ".exr"};
    if (resourceOf(*plan.graph, item).kind == graph::ResourceKind::buffer) files = {stem + ".bin"};
    parts.push_back({item.target.resource, std::move(files), item});
  }
  return parts;
}

int runDump(DumpOptions& options) {
  options.firstFrame = options.lastFrame;
  return runOnDevice({&options}, 1, [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
    runtime::Renderer& renderer = session->renderer;
    if (!renderer.load(settingsOf(options, session->context->device().software), world, diagnostics))
      return 1;
    FrameRun run{.output = {}, .parts = matchingParts(options, renderer.execution()->plan(), diagnostics)};
    std::vector<OutputFile> outputs;
    for (const Part& part : run.parts)
      for (const std::string& file : part.files) outputs.push_back({"-o", file, OutputFile::Over::file});
    if (diagnostics.hasErrors() || !checkDistinct(outputs, diagnostics)) return 1;
    runFrames(
        *session, world, options, run, [] {}, diagnostics);
    for (const Part& part : run.parts)
      if (!options.quiet && !diagnostics.hasErrors())
        print(text::printable(
                  part.saved ? fmt::format("{}  {} after {}", part.files[0], part.name, part.item.target.pass)
                             : fmt::format("'{}' did not run in frame {}: nothing of it is written",
                                           part.item.target.pass, options.lastFrame)) +
              "\n");
    return 0;
  });
}

}  // namespace

void addRender(CommandLine& line) {
  const auto [command, options] =
      line.add("render", "render frames of a graph to image files, without a display", runRender);
  options.addGraph(command);
  options.addMeasurements(command);
  addPath(command, "-o,--output", options.outputs,
          "image to write, .png or .exr, of frames f_%04d.png, of a texture depth=FILE; repeatable")
      ->required();
  command.add_option("--present", options.present,
                     "texture to show instead of the picture: depth, 'hdr after skybox', 'glow.mip[2]'");
  const auto takeFrames = [&options = options](const std::string& text) {
    return takeRange(text, options.firstFrame, options.lastFrame);
  };
  addTaken(command, "--frames", takeFrames, "A:B", "a frame number, or FIRST:LAST");
  options.addDrawing(command);
  command.add_flag("--wait-for-assets")->description("as always without a window");
  command.add_flag("--quiet", options.quiet, "no progress bar and no notes");
}

void addDump(CommandLine& line) {
  const auto [command, options] =
      line.add("dump", "write what each pass wrote: pictures (.png), values (.exr), bytes (.bin)", runDump);
  options.addGraph(command);
  command
      .add_option("name", options.patterns,
                  "names of resources or their ends; * is any letters, hdr#2 a version")
      ->required();
  addPath(command, "-o,--output", options.folder, "folder to write to", "FOLDER")->required();
  options.addFrame(command, "--frame,--frames");
  options.addDrawing(command);
  command.add_flag("--quiet", options.quiet, "no list of files and no notes");
}

}  // namespace weft::app
