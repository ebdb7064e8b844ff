// weft diff: how the plan of one graph differs from that of another, and how their pictures do.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "app/commands/commands.h"
#include "app/output/file_batch.h"
#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/session/device_session.h"
#include "app/session/session.h"
#include "app/trials/divergence.h"
#include "app/trials/picture_difference.h"
#include "app/trials/shot.h"
#include "engine/base/counted.h"
#include "engine/base/printable.h"
#include "engine/graph/print/print.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

struct DiffOptions : Options {
  std::string other, format = "text", output;
  bool render = false;
  bool plans = true;  // say how the plans differ, too
  std::vector<graph::Setting> otherSets;
  std::vector<graph::Disable> otherDisables;
  std::vector<std::string> otherPresets;
};

Options otherOf(const DiffOptions& options) {
  Options other = options;
  if (!options.other.empty()) other.graph = options.other;
  other.sets.insert(other.sets.end(), options.otherSets.begin(), options.otherSets.end());
  other.disables.insert(other.disables.end(), options.otherDisables.begin(), options.otherDisables.end());
  other.presets.insert(other.presets.end(), options.otherPresets.begin(), options.otherPresets.end());
  other.finish();
  return other;
}

// The same frame of both: pictures, how they differ, and the first pass whose output does.
struct ShotPair {
  std::uint32_t frame = 0;
  Shot before, after;
  std::optional<Divergence> first;
  assets::FlipMap map;                          // empty when the pictures have different sizes
  std::optional<PictureDifference> difference;  // of pictures of one size

  const assets::Image8& pictureBefore() const { return before.pictures.at(frame); }
  const assets::Image8& pictureAfter() const { return after.pictures.at(frame); }
  // "pictures: FLIP 0.0123, …", "pictures: the same" or "pictures: of different sizes, 64x36 and 32x18"
  std::string pictureText() const;
};

std::string ShotPair::pictureText() const {
  const assets::Image8 &a = pictureBefore(), &b = pictureAfter();
  if (!difference)
    return fmt::format("pictures: of different sizes, {}x{} and {}x{}", a.width, a.height, b.width, b.height);
  return difference->bytes.equal() ? "pictures: the same" : "pictures: " + difference->text();
}

std::optional<ShotPair> shootPair(gl::Context& context, const Options& before, const Options& after,
                                  const runtime::World& world, std::uint32_t frame,
                                  base::Diagnostics& diagnostics) {
  const ShotWish wish{.frames = {frame}, .records = true};
  auto a = takeShot(context, before, world, wish, diagnostics);
  auto b = a ? takeShot(context, after, world, wish, diagnostics) : std::nullopt;
  if (!b) return std::nullopt;
  ShotPair pair{frame, *std::move(a), *std::move(b), {}, {}, {}};
  const std::string& driver = context.device().driverKey;
  pair.first = findDivergence(recordsOf(pair.before, driver), recordsOf(pair.after, driver));
  pair.map = assets::computeFlip(pair.pictureBefore(), pair.pictureAfter());
  if (!pair.map.errors.empty())
    pair.difference = measureDifference(pair.pictureBefore(), pair.pictureAfter(), pair.map);
  return pair;
}

Json firstJson(const Divergence& first) {
  static constexpr const char* kKinds[] = {"differs", "missing", "added"};
  return {{"kind", kKinds[static_cast<std::size_t>(first.kind)]},
          {"pass", first.pass},
          {"resource", first.resource},
          {"frame", first.frame},
          {"amount", first.amount},
          {"text", first.text()}};
}

Json picturesJson(const ShotPair& pair) {
  const auto sizeOf = [](const assets::Image8& image) { return Json{image.width, image.height}; };
  Json json = {{"frame", pair.frame},
               {"size_before", sizeOf(pair.pictureBefore())},
               {"size_after", sizeOf(pair.pictureAfter())}};
  if (pair.difference) {
    const PictureDifference& found = *pair.difference;
    json.update({{"flip", found.flip.mean},
                 {"flip_peak", found.flip.peak},
                 {"flip_peak_at", {found.flip.x, found.flip.y}},
                 {"differing_pixels", found.bytes.differingPixels},
                 {"largest_difference", found.bytes.maxDifference},
                 {"largest_difference_at", {found.bytes.worstX, found.bytes.worstY}}});
  }
  json["first"] = pair.first ? firstJson(*pair.first) : Json();
  return json;
}

// "96 of 100 texels differ (96 %), by at most 0.5, on average by 0.2"
std::string compareTexels(const runtime::WrittenTexels& a, const runtime::WrittenTexels& b) {
  if (a.values.size() != b.values.size() || a.stride != b.stride || a.width != b.width)
    return fmt::format("{}, {}: another size or format", base::counted(a.values.size() / a.stride, "texel"),
                       base::counted(b.values.size() / b.stride, "texel"));
  std::size_t differ = 0, broken = 0;
  double most = 0, sum = 0;
  for (std::size_t i = 0; i < a.values.size(); i += a.stride) {
    bool other = false, odd = false;
    for (std::size_t c = i; c < i + a.stride; ++c) {
      const float x = a.values[c], y = b.values[c];
      if (x == y || (std::isnan(x) && std::isnan(y))) continue;
      other = true;
      const double difference = std::abs(static_cast<double>(x) - static_cast<double>(y));
      odd = odd || !std::isfinite(difference);
      if (!std::isfinite(difference)) continue;
      most = std::max(most, difference);
      sum += difference;
    }
    differ += other;
    broken += odd;
  }
  const std::size_t texels = a.values.size() / a.stride;
  return fmt::format(
      "{} of {} {} ({:.3g} %), by at most {:.4g}, on average by {:.4g}{}", differ,
      base::counted(texels, "texel"), differ == 1 ? "differs" : "differ",
      100.0 * static_cast<double>(differ) / static_cast<double>(std::max<std::size_t>(1, texels)), most,
      sum / static_cast<double>(std::max<std::size_t>(1, a.values.size())),
      broken ? fmt::format("; {} of them are infinite or no number in one of the two", broken) : "");
}

std::string countSame(const Shot& shot, const Divergence& found) {
  std::size_t before = 0, all = 0;
  bool passed = false;
  for (const FrameRecord& frame : shot.records)
    if (frame.frame == found.frame)
      for (const runtime::StepRecord& step : frame.steps) {
        passed = passed || (step.pass == found.pass && step.resource == found.resource);
        before += !passed;
        ++all;
      }
  return fmt::format("{} of {} {} before it and {} the same", before, base::counted(all, "result"),
                     before == 1 ? "comes" : "come", before == 1 ? "is" : "are");
}

// What the first pass that differs wrote in both, rendered once more.
std::string firstText(gl::Context& context, std::span<const Options, 2> sides, const runtime::World& world,
                      const ShotPair& pair, base::Diagnostics& diagnostics) {
  const Divergence& first = *pair.first;
  std::string text =
      fmt::format("first that differs: {}\n    {}\n", base::shortened(base::printable(first.text())),
                  countSame(pair.after, first));
  if (first.kind != Divergence::Kind::differs) return text;
  const ShotWish wish{.frames = {pair.frame}, .keep = {first.pass, first.resource}, .keepFrame = first.frame};
  const auto a = takeShot(context, sides[0], world, wish, diagnostics);
  const auto b = takeShot(context, sides[1], world, wish, diagnostics);
  if (a && b && a->kept && b->kept) text += "    " + compareTexels(*a->kept, *b->kept) + "\n";
  return text;
}

void printJson(const DiffOptions& options, const std::string& plans, const ShotPair* pair) {
  Json lines = Json::array();
  std::istringstream stream(plans);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  Json json = {{"before", options.graph}, {"after", options.other}, {"plan", std::move(lines)}};
  if (pair) json["pictures"] = picturesJson(*pair);
  print(dumpJson(json) + "\n");
}

// before.png, after.png, difference.png; the last is removed where the pictures have different sizes, because that of an earlier
// run is not theirs.
std::vector<std::string> pictureFiles(const std::string& folder) {
  return {folder + "/before.png", folder + "/after.png", folder + "/difference.png"};
}

// Writes all pictures or none, and none over a file that was read.
void leavePictures(const DiffOptions& options, const ShotPair& pair, base::Diagnostics& diagnostics) {
  const std::vector<std::string> files = pictureFiles(options.output);
  std::vector<std::string> read = pair.before.files;
  read.insert(read.end(), pair.after.files.begin(), pair.after.files.end());
  std::vector<OutputFile> outputs;
  for (const std::string& file : files) outputs.push_back({"-o", file});
  if (!checkDistinct(outputs, read, diagnostics)) return;
  const assets::Image8 difference = assets::colorFlip(pair.map);
  const assets::Image8* images[] = {&pair.pictureBefore(), &pair.pictureAfter(), &difference};
  FileBatch batch;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const assets::Image8& image = *images[i];
    if (image.texels.empty()) {
      batch.remove(files[i]);
      continue;
    }
    const auto write = [&](const std::string& path, base::Diagnostics& said) {
      return assets::savePng8(path, image.width, image.height, image.channels, image.texels, said);
    };
    if (!batch.write(files[i], write, diagnostics)) return;
  }
  batch.publish(diagnostics);
}

int renderBoth(gl::Context& context, const DiffOptions& options, std::span<const Options, 2> sides,
               const runtime::World& world, base::Diagnostics& diagnostics) {
  if (!options.output.empty() && !checkMadeFiles(pictureFiles(options.output), {}, "-o", diagnostics))
    return 2;
  const auto pair = shootPair(context, sides[0], sides[1], world, options.lastFrame, diagnostics);
  if (!pair) return 2;
  const std::string plans =
      options.plans ? graph::diffText(*pair->before.plan, *pair->after.plan) : std::string();
  if (!options.output.empty()) leavePictures(options, *pair, diagnostics);
  if (diagnostics.hasErrors()) return 2;
  if (options.format == "json")
    printJson(options, plans, &*pair);
  else
    print(plans + pair->pictureText() + "\n" +
          (pair->first ? firstText(context, sides, world, *pair, diagnostics)
                       : std::string("no pass differs\n")));
  const bool same = !pair->first && pair->difference && pair->difference->bytes.equal();
  return plans.empty() && same ? 0 : 1;
}

int runDiff(DiffOptions& options) {
  const Options sides[] = {options, otherOf(options)};
  if (options.render)
    return runOnDevice(
        sides, 2, [&](gl::Context& context, const runtime::World& world, base::Diagnostics& diagnostics) {
          return renderBoth(context, options, sides, world, diagnostics);
        });
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  const auto before = makePlan(sides[0], facts, true, diagnostics);
  const auto after = makePlan(sides[1], facts, true, diagnostics);
  if (!before || !after || diagnostics.hasErrors()) {
    report(diagnostics);
    return 2;
  }
  const std::string plans = graph::diffText(*before, *after);
  options.format == "json" ? printJson(options, plans, nullptr) : print(plans);
  report(diagnostics);
  return plans.empty() ? 0 : 1;
}

DiffOptions& addDiffNamed(CommandLine& line, const char* name, const char* doc, const char* example) {
  const auto [command, options] = line.add(name, doc, runDiff);
  options.addGraph(command);
  addPath(command, "other", options.other, "the other graph file (default: the same, in other settings)");
  addSets(command, "--other-set", options.otherSets, "set a parameter in the other graph alone; repeatable");
  addDisables(command, "--other-disable", options.otherDisables,
              "disable a pass in the other graph alone; repeatable");
  addPath(command, "--other-preset", options.otherPresets,
          "lay an overlay over the other graph alone; repeatable");
  options.addPointer(command);
  options.addBackend(command);
  command.footer(example);
  return options;
}

}  // namespace

// 0: no difference, 1: some, 2: a graph cannot be compiled.
void addDiff(CommandLine& line) {
  DiffOptions& options = addDiffNamed(
      line, "diff", "say how the plan of another graph differs: passes, barriers, bytes; exit 1 when it does",
      "Example: weft diff graphs/glow.json tests/golden/vignette.json --render --size 320x180 -o out");
  CLI::App& diff = *line.app().get_subcommand("diff");
  CLI::Option* render =
      diff.add_flag("--render", options.render,
                    "render both: how the pictures differ, and the first pass whose output does");
  addPath(diff, "-o,--output", options.output,
          "folder for before.png, after.png and their difference (with --render)", "FOLDER")
      ->needs(render);
  options.addFrame(diff)->needs(render);
  addChoice(diff, "--format", options.format, "text or json", {"text", "json"});
  // Its name before, without the plans.
  DiffOptions& bisect = addDiffNamed(line, "bisect", "the same as diff --render, without the plans",
                                     "Example: weft bisect graphs/studio.json --other-set threshold=2");
  bisect.render = true;
  bisect.plans = false;
  bisect.addFrame(*line.app().get_subcommand("bisect")->group(""));
}

}  // namespace weft::app
