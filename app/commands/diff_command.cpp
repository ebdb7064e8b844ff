// weft diff: how the plan of one graph differs from that of another, and how their pictures do.
#include <fmt/format.h>

#include <sstream>

#include "app/commands/commands.h"
#include "app/output/file_batch.h"
#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/device_run.h"
#include "app/trials/shot_pair.h"
#include "engine/base/printable.h"
#include "engine/graph/print/diff.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

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

// `pair`: null without --render.
void printFound(const Options& options, const std::string& plans, const ShotPair* pair) {
  if (options.format == "json") {
    Json lines = Json::array();
    std::istringstream stream(plans);
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    Json json = {{"before", options.graph}, {"after", options.otherGraph}, {"plan", std::move(lines)}};
    if (pair) json["pictures"] = picturesJson(*pair);
    print(dumpJson(json) + "\n");
    return;
  }
  print(plans);
  if (!pair) return;
  print(pair->pictureText() + "\n");
  print(pair->first ? "first that differs: " + base::shortened(base::printable(pair->first->text())) + "\n"
                    : "no pass writes anything else\n");
}

int exitCodeOf(const std::string& plans, const ShotPair* pair) {
  const bool samePictures = !pair || (!pair->first && pair->difference && pair->difference->bytes.equal());
  return plans.empty() && samePictures ? 0 : 1;
}

// before.png, after.png, difference.png; the last is removed where the pictures have different sizes, because that of an earlier
// run is not theirs.
std::vector<std::string> pictureFiles(const std::string& folder) {
  return {folder + "/before.png", folder + "/after.png", folder + "/difference.png"};
}

// Writes all pictures or none, and none over a file that was read.
void leavePictures(const Options& options, const ShotPair& pair, base::Diagnostics& diagnostics) {
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

int renderBoth(gl::Context& context, const Options& options, const Options& other,
               const runtime::World& world, base::Diagnostics& diagnostics) {
  if (!options.output.empty() && !checkMadeFiles(pictureFiles(options.output), {}, "-o", diagnostics))
    return 2;
  const auto pair = shootPair(context, options, other, world, options.lastFrame, diagnostics);
  if (!pair) return 2;
  const std::string plans = graph::diffText(*pair->before.plan, *pair->after.plan);
  if (!options.output.empty()) leavePictures(options, *pair, diagnostics);
  if (diagnostics.hasErrors()) return 2;
  printFound(options, plans, &*pair);
  return exitCodeOf(plans, &*pair);
}

}  // namespace

int runDiff(const Options& options) {
  Options other = options;
  other.graph = options.otherGraph;
  const Options both[] = {options, other};
  if (options.trial.render)
    return runOnDevice(
        both, 2, [&](gl::Context& context, const runtime::World& world, base::Diagnostics& diagnostics) {
          return renderBoth(context, options, other, world, diagnostics);
        });
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  const auto before = makePlan(options, facts, true, diagnostics);
  const auto after = makePlan(other, facts, true, diagnostics);
  if (!before || !after || diagnostics.hasErrors()) {
    report(diagnostics);
    return 2;
  }
  const std::string plans = graph::diffText(*before, *after);
  printFound(options, plans, nullptr);
  report(diagnostics);
  return exitCodeOf(plans, nullptr);
}

}  // namespace weft::app
