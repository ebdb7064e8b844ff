// weft render: frames of a graph to image files, reproducible to the byte. weft dump: what each pass wrote in one of them.
#include "app/commands/render.h"

#include <unistd.h>

#include <csignal>

#include "app/commands/commands.h"
#include "app/output/frame_set.h"
#include "app/output/manifest.h"
#include "app/output/pictures.h"
#include "app/output/video.h"
#include "app/session/checkpoints.h"
#include "app_sentences.h"
#include "engine/graph/language/names.h"
#include "engine/runtime/inspection/inspector.h"
#include "engine/text/hash.h"

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
  std::vector<std::uint32_t> frames{};  // to write, ascending
  std::string output;                   // the presented picture; empty: only the parts
  std::vector<Part> parts;
  std::map<std::string, std::unique_ptr<Video>> videos{};  // those of the files that are
  std::optional<Manifest> manifest{};
  CheckpointOptions checkpoints{};
  PictureWriter writer{};
  runtime::FrameReport last{};
  std::uint64_t ran = 0, written = 0;  // frames
  double firstMs = 0;                  // of the first frame
  int signal = 0;                      // that ended it

  Video* videoOf(const std::string& file) const {
    const auto found = videos.find(file);
    return found == videos.end() ? nullptr : found->second.get();
  }
  std::vector<std::string> filesOf(std::uint32_t frame) const {
    std::vector<std::string> files;
    if (!output.empty()) files.push_back(*outputNameOf(output, frame));
    for (const Part& part : parts)
      for (const std::string& file : part.files) files.push_back(*outputNameOf(file, frame));
    return files;
  }
};

// SIGINT or SIGTERM, which ends a run between two frames; 0: none came.
volatile std::sig_atomic_t cameSignal = 0;

void noteSignal(int signal) {
  constexpr std::string_view kText = "\nweft ends after this frame; a second signal ends it at once\n";
  cameSignal = signal;
  const int error = errno;
  for (const int each : {SIGINT, SIGTERM}) {
    struct sigaction now {};
    ::sigaction(each, nullptr, &now);
    if (now.sa_handler == noteSignal) std::signal(each, SIG_DFL);
  }
  [[maybe_unused]] const ssize_t said = ::write(STDERR_FILENO, kText.data(), kText.size());
  errno = error;
}

// From now on. A second one, of either, ends the program at once.
void noteSignals() {
  struct sigaction action {};
  action.sa_handler = noteSignal;
  action.sa_flags = SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);  // as nohup leaves it
  }
}

const graph::FlatResource& resourceOf(const graph::FlatGraph& graph, const runtime::CaptureItem& item) {
  const auto at = std::ranges::find(graph.resourceNames, item.target.resource) - graph.resourceNames.begin();
  return graph.resources[static_cast<std::size_t>(at)];
}

// Starts those of the outputs that are videos. False after an error.
bool startVideos(const Options& options, runtime::Execution& execution, FrameRun& run,
                 text::Diagnostics& diagnostics) {
  const auto start = [&](const std::string& file, std::uint32_t width, std::uint32_t height) {
    return !isVideo(file) || (run.videos[file] = Video::start(file, width, height, options.fps, diagnostics));
  };
  bool good = true;
  if (!run.output.empty()) {
    const gl::TextureDesc desc = execution.presented().desc;
    good = start(run.output, desc.width, desc.height);
  }
  for (const Part& part : run.parts) {
    const graph::FlatResource& resource = resourceOf(*execution.plan().graph, part.item);
    const auto sideOf = [&](std::uint32_t side) { return std::max(1u, side >> part.item.target.mip); };
    good = good && start(part.files[0], sideOf(resource.width), sideOf(resource.height));
  }
  return good;
}

// Runs the frames of a set and writes them. Where one may look back, those before them run too, from the nearest checkpoint on, so
// what frame N shows does not depend on the set. `onWritten` is called after each that was drawn.
void runFrames(DeviceSession& session, const runtime::World& world, const Options& options, FrameRun& run,
               const std::function<void()>& onWritten, text::Diagnostics& diagnostics) {
  if (run.frames.empty()) return;
  runtime::Renderer& renderer = session.renderer;
  runtime::Execution& execution = *renderer.execution();
  const bool all = execution.remembers(world);
  Checkpoints checkpoints(run.checkpoints, session, world, options);
  const std::uint32_t begin = all ? checkpoints.begin(run.frames.front(), diagnostics) : 0;
  const std::uint64_t total = all ? std::uint64_t{run.frames.back()} + 1 - begin : run.frames.size();
  if (diagnostics.hasErrors()) return;
  ProgressLines lines({.total = total, .lead = all ? run.frames.front() - begin : 0});
  std::vector<runtime::CaptureItem> items;
  for (const Part& part : run.parts) items.push_back(part.item);
  runtime::Inspector inspector(renderer.device());
  std::uint32_t frame = 0;
  text::Diagnostics said;
  const auto save = [&](std::size_t i) {
    Part& part = run.parts[i];
    part.saved = std::ranges::all_of(part.files, [&](const std::string& file) {
      return saveInspected(inspector, *outputNameOf(file, frame), said, run.videoOf(file));
    });
  };
  noteSignals();
  if (!startVideos(options, execution, run, diagnostics)) return;
  while (run.ran < total && !diagnostics.hasErrors() && (run.signal = cameSignal) == 0) {
    frame = all ? begin + static_cast<std::uint32_t>(run.ran) : run.frames[run.written];
    const bool wanted = frame == run.frames[run.written];
    if (!items.empty() && wanted) runtime::watchItems(execution, inspector, items, save);
    for (Part& part : run.parts) part.saved = false;
    const double before = gl::steadyMs();
    run.last = drawFrame(renderer, world, options, frame, diagnostics);
    if (run.ran++ == 0) {
      glFinish();
      run.firstMs = gl::steadyMs() - before;
    }
    if (!items.empty()) inspector.release(execution);
    if (wanted) {
      diagnostics.append(std::exchange(said, {}));
      onWritten();
      if (!run.output.empty() && !diagnostics.hasErrors())
        run.writer.save(renderer, *outputNameOf(run.output, frame), diagnostics, run.videoOf(run.output));
      if (run.manifest && !diagnostics.hasErrors())
        run.manifest->add(frame, run.filesOf(frame), (gl::steadyMs() - before) / 1000, diagnostics);
      run.written += !diagnostics.hasErrors();
    }
    if (!diagnostics.hasErrors()) checkpoints.save(frame, diagnostics);
    if (total > 1 && !options.quiet) lines.countOne();
  }
  for (const auto& [file, video] : run.videos)
    if (run.signal == 0 && !diagnostics.hasErrors()) video->finish(diagnostics);
  session.context->drainMessages(diagnostics);
  run.writer.tell(diagnostics);
}

// Says what a signal has left, and how to go on. The exit code.
int tellInterrupted(const FrameRun& run) {
  const auto left = std::span(run.frames).subspan(run.written);
  std::string next = "go on with --frames " + text::shortened(framesText(left));
  if (run.manifest) next = "the same command with --skip-done goes on";
  if (!run.videos.empty()) next = fmt::format("'{}' is not written", run.videos.begin()->first);
  printError(text::printable(fmt::format("{}: {} of {} written; {}", strsignal(run.signal), run.written,
                                         text::counted(run.frames.size(), "frame"), next)) +
             "\n");
  return 128 + run.signal;
}

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
      refuseOutput(diagnostics, say::bufferAsPicture, run.parts[i].files[0], options.kept[i].name);
  }
}

// The manifest of the options, if any, once the graph is loaded; frames that it knows as done are taken out of the run. False after an error.
bool openManifest(const RenderOptions& options, const std::string& path, DeviceSession& session,
                  std::span<const OutputFile> outputs, FrameRun& run, text::Diagnostics& diagnostics) {
  const gl::DeviceInfo& device = session.context->device();
  std::uint64_t settings = hashOfSettings(options, session);
  for (const OutputFile& output : outputs)
    settings =
        text::hashBytes(output.option + std::filesystem::path(output.pattern).filename().string(), settings);
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  run.manifest.emplace(
      path, fmt::format("{:016x}", settings),
      nlohmann::ordered_json{{"host", host},
                             {"command", options.typed},
                             {"weft", fmt::format("{} ({:016x})", kVersion, hashOfProgram())},
                             {"driver", device.renderer + ", " + device.version}});
  if (!makeFolderOf(path, diagnostics) || !run.manifest->read(diagnostics)) return false;
  if (!options.skipDone) return true;
  std::erase_if(run.frames,
                [&](std::uint32_t frame) { return run.manifest->isDone(frame, run.filesOf(frame)); });
  const auto others =
      std::ranges::count_if(run.frames, [&](std::uint32_t frame) { return run.manifest->hasOther(frame); });
  if (others > 0 && !options.quiet)
    printError(
        fmt::format("{} of '{}' drawn before with other settings, files, program or driver: drawn again\n",
                    text::counted(static_cast<std::uint64_t>(others), "frame"), text::printable(path)));
  return true;
}

// What is wrong with the options, or nothing.
std::string checkTogether(const RenderOptions& options, std::span<const OutputFile> outputs) {
  for (const OutputFile& output : outputs) {
    if (!isVideo(output.pattern)) continue;
    if (options.skipDone || !options.manifest.empty())
      return fmt::format("{} is for pictures, which are files of their own: '{}' is one film of all frames",
                         options.skipDone ? "--skip-done" : "--manifest", output.pattern);
    if (output.pattern.find('%') != std::string::npos)
      return fmt::format("'{}' is one film of all frames, and its name has no place for a number",
                         output.pattern);
  }
  return {};
}

// ---- dump ----

struct DumpOptions : Options {
  std::vector<std::string> patterns;
  std::string folder;
  CheckpointOptions checkpoints;
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
    if (!runtime::captureItems(plan, {&pattern, 1}).empty()) continue;
    if (graph::suffixMatches(names, pattern).empty())
      diagnostics.error(say::noPassWrites, text::placeOfOption(pattern), pattern,
                        graph::suffixHint(pattern, names));
    else
      diagnostics.error(say::textureNotAttached, text::placeOfOption(pattern), pattern);
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
  return runOnDevice({&options}, 1, [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
    runtime::Renderer& renderer = session->renderer;
    if (!renderer.load(settingsOf(options, session->context->device().software), world, diagnostics))
      return 1;
    FrameRun run{.frames = {options.lastFrame},
                 .output = {},
                 .parts = matchingParts(options, renderer.execution()->plan(), diagnostics),
                 .checkpoints = options.checkpoints.beside(options.folder + "/")};
    std::vector<OutputFile> outputs;
    for (const Part& part : run.parts)
      for (const std::string& file : part.files) outputs.push_back({"-o", file, OutputFile::Over::file});
    if (diagnostics.hasErrors() || !checkDistinct(outputs, diagnostics)) return 1;
    runFrames(
        *session, world, options, run, [] {}, diagnostics);
    if (run.signal != 0) return tellInterrupted(run);
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

int runRender(RenderOptions& options) {
  const double start = gl::steadyMs();
  FrameRun run{.frames = options.frames, .output = {}, .parts = {}};
  std::string unfit = takeOutputs(options, run);
  std::vector<OutputFile> outputs;
  if (!run.output.empty()) outputs.push_back({"-o", run.output});
  for (const Part& part : run.parts) outputs.push_back({"-o " + part.name, part.files[0]});
  if (unfit.empty()) unfit = checkTogether(options, outputs);
  if (!unfit.empty()) {
    printError("weft render: " + text::shortened(text::printable(unfit)) + "\n");
    return 2;
  }
  text::Diagnostics wrong;
  for (const OutputFile& each : outputs)
    if (!isVideo(each.pattern)) checkOutput(each.pattern, run.frames[0], run.frames.size() > 1, wrong);
  if (wrong.hasErrors()) return report(wrong);
  const std::string manifest =
      options.manifest.empty() && options.skipDone ? manifestNameOf(outputs[0].pattern) : options.manifest;
  if (!manifest.empty()) text::chooseFile(manifest);
  run.checkpoints = options.checkpoints.beside(outputs[0].pattern);
  return runOnDevice({&options}, 1, [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
    runtime::Renderer& renderer = session->renderer;
    if (!renderer.load(settingsOf(options, session->context->device().software), world, diagnostics) ||
        (!run.output.empty() && !checkPresents(options, renderer, diagnostics)))
      return 1;
    const double prepared = gl::steadyMs();
    findParts(options, renderer.execution()->plan(), run, diagnostics);
    std::vector<OutputFile> all = outputs;
    all.push_back({"--manifest", manifest});
    if (!checkDistinct(all, diagnostics) || diagnostics.hasErrors()) return 1;
    if (options.instead) return options.instead(renderer.execution()->remembers(world), all, diagnostics);
    if (!manifest.empty() && !openManifest(options, manifest, *session, outputs, run, diagnostics)) return 1;
    renderer.device().timers.setEnabled(options.profile);
    const auto checkSaved = [&] {
      for (const Part& part : run.parts)
        if (!part.saved && !diagnostics.hasErrors())
          refuseOutput(diagnostics, say::nothingToWrite, part.files[0], part.name);
    };
    runFrames(*session, world, options, run, checkSaved, diagnostics);
    if (run.signal != 0) return tellInterrupted(run);
    if (diagnostics.hasErrors()) return 0;
    if (options.skipDone && !options.quiet)
      printError(fmt::format("{}: {} done already, {} drawn\n", text::counted(options.frames.size(), "frame"),
                             options.frames.size() - run.frames.size(), run.written));
    if (!options.stats) return 0;
    auto stats = statsOf(*session, {{"setup_ms", prepared - start},
                                    {"first_frame_ms", run.firstMs},
                                    {"total_ms", gl::steadyMs() - start},
                                    {"frames_run", run.ran},
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

void addRender(CommandLine& line) {
  const auto [command, options] =
      line.add("render", "render frames of a graph to image files, without a display", runRender);
  addRenderOptions(command, options);
}

void addRenderOptions(CLI::App& command, RenderOptions& options) {
  options.addGraph(command);
  options.addMeasurements(command);
  addPath(command, "-o,--output", options.outputs,
          "image to write, .png or .exr, of frames f_%04d.png, of a texture depth=FILE; or a film of the "
          "frames, .mp4 or .mkv (lossless), by ffmpeg; repeatable")
      ->required();
  command.add_option("--present", options.present,
                     "texture to show instead of the picture: depth, 'hdr after skybox', 'glow.mip[2]'");
  const auto take = [&options = options](const std::string& text) {
    return takeFrames(text, options.frames);
  };
  addTaken(command, "--frames", take, "FRAMES", "frames to write: 7, 1:100, 1-100x3,200 (x: every third)");
  addPath(command, "--manifest", options.manifest,
          "file to add a line of JSON to for each frame that is written");
  command.add_flag("--skip-done", options.skipDone,
                   "draw no frame that the manifest has, with its files and the same settings (default "
                   "manifest: f_.frames.jsonl beside f_%04d.png)");
  options.checkpoints.add(command);
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
  options.checkpoints.add(command);
  options.addDrawing(command);
  command.add_flag("--quiet", options.quiet, "no list of files and no notes");
}

}  // namespace weft::app
