// weft diff: how the plan of one graph differs from that of another, and how their pictures do.

#include "app/commands/commands.h"
#include "app/output/pictures.h"
#include "app/trials/divergence.h"
#include "app/trials/shot.h"
#include "engine/graph/print/print.h"
#include "engine/text/chars.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

struct DiffOptions : OtherOptions {
  std::string format = "text", output;
  bool render = false;
};

// The lines of the plans' difference, then as JSON or text what is known of the `pictures`, where they were made.
std::string textOf(const DiffOptions& options, const std::string& plans, const std::string& pictureText,
                   const Json& pictures) {
  if (options.format == "text") return plans + pictureText;
  Json json = {{"before", options.graph}, {"after", options.other}, {"plan", text::linesOf(plans)}};
  if (!pictures.is_null()) json["pictures"] = pictures;
  return text::dumpJson(json) + "\n";
}

// Writes before.png, after.png and, of pictures of one size, difference.png; nothing over a file that was read.
void leavePictures(const std::string& folder, const assets::Image8& before, const assets::Image8& after,
                   const std::optional<PictureDifference>& difference, text::Diagnostics& diagnostics) {
  std::vector<OutputFile> outputs;
  for (const char* name : {"/before.png", "/after.png", "/difference.png"})
    outputs.push_back({"-o", folder + name, OutputFile::Over::file});
  if (!checkDistinct(outputs, diagnostics) || !savePng(outputs[0].pattern, before, diagnostics) ||
      !savePng(outputs[1].pattern, after, diagnostics))
    return;
  std::error_code ignored;
  if (difference)
    savePng(outputs[2].pattern, assets::colorFlip(difference->map), diagnostics);
  else
    std::filesystem::remove(outputs[2].pattern, ignored);
}

// The same frame of both: pictures, how they differ, and the first pass whose output does.
int renderBoth(gl::Context& context, const DiffOptions& options, std::span<const Options, 2> sides,
               runtime::World& world, text::Diagnostics& diagnostics) {
  const ShotWish wish{.frames = {options.lastFrame}, .records = true};
  const auto before = takeShot(context, sides[0], world, wish, diagnostics);
  const auto after = before ? takeShot(context, sides[1], world, wish, diagnostics) : std::nullopt;
  if (!after) return 2;
  const assets::Image8 &old = before->pictures.at(options.lastFrame),
                       &fresh = after->pictures.at(options.lastFrame);
  const auto first = findDivergence(before->records, after->records);
  const auto difference = comparePictures(fresh, old);
  const std::string plans = graph::diffText(*before->plan, *after->plan);
  Json json = {{"frame", options.lastFrame},
               {"size_before", {old.width, old.height}},
               {"size_after", {fresh.width, fresh.height}}};
  std::string text = "pictures: ";
  if (difference) {
    json.update({{"flip", difference->flip.mean},
                 {"flip_peak", difference->flip.peak},
                 {"flip_peak_at", {difference->flip.x, difference->flip.y}},
                 {"differing_pixels", difference->bytes.differingPixels},
                 {"largest_difference", difference->bytes.maxDifference},
                 {"largest_difference_at", {difference->bytes.worstX, difference->bytes.worstY}}});
    text += difference->bytes.equal() ? "the same" : difference->text();
  } else {
    text += fmt::format("of different sizes, {} and {}", sizeText(old), sizeText(fresh));
  }
  static constexpr const char* kKinds[] = {"differs", "missing", "added"};
  json["first"] = nullptr;
  if (first)
    json["first"] = {{"kind", kKinds[static_cast<std::size_t>(first->kind)]},
                     {"pass", first->pass},
                     {"resource", first->resource},
                     {"frame", first->frame},
                     {"text", first->text()}};
  text += first ? "\nfirst that differs: " + text::shortened(text::printable(first->text())) + "\n"
                : "\nno pass differs\n";
  if (options.output.ends_with(".html"))
    writeFramePage(context, options.typed, sides, 0, options.output, world, diagnostics);
  else if (!options.output.empty())
    leavePictures(options.output, old, fresh, difference, diagnostics);
  if (diagnostics.hasErrors()) return 2;
  print(textOf(options, plans, text, json));
  return plans.empty() && !first && difference && difference->bytes.equal() ? 0 : 1;
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
  print(textOf(options, plans, "", nullptr));
  report(diagnostics);
  return plans.empty() ? 0 : 1;
}

}  // namespace

// 0: no difference, 1: some, 2: a graph cannot be compiled.
void addDiff(CommandLine& line) {
  const auto [command, options] =
      line.add("diff", "how the plan of another graph differs; exit 1 when it does", runDiff);
  options.addGraph(command);
  options.addOther(command);
  options.addDrawing(command);
  CLI::Option* render = command.add_flag(
      "--render", options.render, "how the pictures differ, too, and the first pass whose output does");
  addPath(command, "-o,--output", options.output,
          "folder for pictures of both and their difference, or a page, .html", "PATH")
      ->needs(render);
  options.addFrame(command)->needs(render);
  addChoice(command, "--format", options.format, "text or json", {"text", "json"});
  command.footer(
      "Example: weft diff graphs/glow.json tests/golden/vignette.json --render --size 320x180 -o out");
}

}  // namespace weft::app
