// weft diff: how the plan of one graph differs from that of another, and how their pictures do.
#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "app/commands/commands.h"
#include "app/output/output_files.h"
#include "app/output/picture_writer.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/divergence.h"
#include "app/trials/frame_page.h"
#include "app/trials/shot.h"
#include "engine/graph/print/print.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

struct DiffOptions : OtherOptions {
  std::string format = "text", output;
  bool render = false;
  bool wantsPage() const { return output.ends_with(".html"); }
};

// The same frame of both: pictures, how they differ, and the first pass whose output does.
struct ShotPair {
  std::uint32_t frame = 0;
  Shot before, after;
  std::optional<Divergence> first;
  std::optional<PictureDifference> difference;  // of pictures of one size

  const assets::Image8& pictureBefore() const { return before.pictures.at(frame); }
  const assets::Image8& pictureAfter() const { return after.pictures.at(frame); }
  bool same() const { return !first && difference && difference->bytes.equal(); }
  // "pictures: FLIP 0.0123, …", "pictures: the same" or "pictures: of different sizes, 64x36 and 32x18"
  std::string pictureText() const {
    if (!difference)
      return fmt::format("pictures: of different sizes, {} and {}", sizeText(pictureBefore()),
                         sizeText(pictureAfter()));
    return difference->bytes.equal() ? "pictures: the same" : "pictures: " + difference->text();
  }
};

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
  static constexpr const char* kKinds[] = {"differs", "missing", "added"};
  json["first"] = nullptr;
  if (const auto& first = pair.first)
    json["first"] = {{"kind", kKinds[static_cast<std::size_t>(first->kind)]},
                     {"pass", first->pass},
                     {"resource", first->resource},
                     {"frame", first->frame},
                     {"amount", first->amount},
                     {"text", first->text()}};
  return json;
}

std::string textOf(const DiffOptions& options, const std::string& plans, const ShotPair* pair) {
  if (options.format == "text")
    return pair ? plans + pair->pictureText() + "\n" +
                      (pair->first
                           ? "first that differs: " + text::shortened(text::printable(pair->first->text()))
                           : "no pass differs") +
                      "\n"
                : plans;
  Json lines = Json::array();
  std::istringstream stream(plans);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  Json json = {{"before", options.graph}, {"after", options.other}, {"plan", std::move(lines)}};
  if (pair) json["pictures"] = picturesJson(*pair);
  return dumpJson(json) + "\n";
}

// Writes before.png, after.png and difference.png, and nothing over a file that was read. A difference of an earlier run is
// removed where the pictures have different sizes.
void leavePictures(const DiffOptions& options, const ShotPair& pair, text::Diagnostics& diagnostics) {
  std::vector<std::string> files;
  std::vector<OutputFile> outputs;
  for (const char* name : {"/before.png", "/after.png", "/difference.png"})
    outputs.push_back({"-o", files.emplace_back(options.output + name), OutputFile::Over::file});
  if (!checkDistinct(outputs, diagnostics) || !savePng(files[0], pair.pictureBefore(), diagnostics) ||
      !savePng(files[1], pair.pictureAfter(), diagnostics))
    return;
  std::error_code ignored;
  if (pair.difference)
    savePng(files[2], assets::colorFlip(pair.difference->map), diagnostics);
  else
    std::filesystem::remove(files[2], ignored);
}

int renderBoth(gl::Context& context, const DiffOptions& options, std::span<const Options, 2> sides,
               runtime::World& world, text::Diagnostics& diagnostics) {
  const ShotWish wish{.frames = {options.lastFrame}, .records = true};
  auto before = takeShot(context, sides[0], world, wish, diagnostics);
  auto after = before ? takeShot(context, sides[1], world, wish, diagnostics) : std::nullopt;
  if (!after) return 2;
  ShotPair pair{options.lastFrame, *std::move(before), *std::move(after), {}, {}};
  pair.first = findDivergence(pair.before.records, pair.after.records);
  pair.difference = comparePictures(pair.pictureAfter(), pair.pictureBefore());
  const std::string plans = graph::diffText(*pair.before.plan, *pair.after.plan);
  if (options.wantsPage())
    writeFramePage(context, options.typed, sides, 0, options.output, world, diagnostics);
  else if (!options.output.empty())
    leavePictures(options, pair, diagnostics);
  if (diagnostics.hasErrors()) return 2;
  print(textOf(options, plans, &pair));
  return plans.empty() && pair.same() ? 0 : 1;
}

int runDiff(DiffOptions& options) {
  const Options sides[] = {options, options.otherSide()};
  if (options.render)
    return runOnDevice({&sides[0], &sides[1]}, 2,
                       [&](auto& session, auto& world, text::Diagnostics& diagnostics) {
                         return renderBoth(*session->context, options, sides, world, diagnostics);
                       });
  text::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  const auto before = makePlan(sides[0], facts, true, diagnostics);
  const auto after = makePlan(sides[1], facts, true, diagnostics);
  if (!before || !after || diagnostics.hasErrors()) {
    report(diagnostics);
    return 2;
  }
  const std::string plans = graph::diffText(*before, *after);
  print(textOf(options, plans, nullptr));
  report(diagnostics);
  return plans.empty() ? 0 : 1;
}

}  // namespace

// 0: no difference, 1: some, 2: a graph cannot be compiled.
void addDiff(CommandLine& line) {
  const auto [command, options] = line.add(
      "diff", "say how the plan of another graph differs: passes, barriers, bytes; exit 1 when it does",
      runDiff);
  options.addGraph(command);
  options.addOther(command);
  options.addPointer(command);
  options.addBackend(command);
  CLI::Option* render =
      command.add_flag("--render", options.render,
                       "render both: how the pictures differ, and the first pass whose output does");
  addPath(command, "-o,--output", options.output,
          "folder for before.png, after.png and their difference, or a page, .html (with --render)", "PATH")
      ->needs(render);
  options.addFrame(command)->needs(render);
  addChoice(command, "--format", options.format, "text or json", {"text", "json"});
  command.footer(
      "Example: weft diff graphs/glow.json tests/golden/vignette.json --render --size 320x180 -o out");
}

}  // namespace weft::app
