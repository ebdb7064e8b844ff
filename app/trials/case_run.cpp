#include "app/trials/case_run.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/output/output_files.h"
#include "app/session/session.h"
#include "app/trials/picture_difference.h"
#include "engine/base/files/file.h"
#include "engine/base/printable.h"
#include "engine/graph/print/print.h"

namespace weft::app {

namespace {

using State = CaseResult::State;

bool isThere(const std::string& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored);
}

bool fits(const PictureDifference& found, const Tolerance& tolerance) {
  return found.flip.mean <= tolerance.flip && found.flip.peak <= tolerance.flipPeak &&
         found.bytes.maxDifference <= tolerance.step && found.share <= tolerance.fraction;
}

std::string text(const Tolerance& t) {
  return fmt::format("allowed: FLIP {:g}, at most {:g}; {:g} % of the pixels, by up to {:g}", t.flip,
                     t.flipPeak, 100 * t.fraction, t.step);
}

std::string sizeText(const assets::Image8& image) {
  return fmt::format("{}x{}", image.width, image.height);
}

// 0 where pixels do not count; empty: all count. Empty as a whole after an error.
std::optional<std::vector<std::uint8_t>> readMask(const TestCase& test, const assets::Image8& picture,
                                                  base::Diagnostics& diagnostics) {
  if (test.mask.empty()) return std::vector<std::uint8_t>{};
  auto mask = assets::loadImage8(test.mask, 1, diagnostics);
  if (!mask) return std::nullopt;
  if (mask->width != picture.width || mask->height != picture.height) {
    base::Diagnostic& d =
        diagnostics.error(base::Code::badImageSize, test.place,
                          fmt::format("the mask '{}' has another size than the picture", test.mask));
    d.expected = sizeText(picture);
    d.found = sizeText(*mask);
    return std::nullopt;
  }
  for (std::uint8_t& weight : mask->texels) weight = weight >= 128;
  return std::move(mask->texels);
}

// Pixels that do not count are copied from the golden, so that they do not affect the pixels beside them, either.
assets::Image8 laidUnder(assets::Image8 picture, const assets::Image8& golden,
                         const std::vector<std::uint8_t>& weights) {
  for (std::size_t p = 0; p < weights.size(); ++p)
    for (std::size_t c = 0; weights[p] == 0 && c < 4; ++c)
      picture.texels[4 * p + c] = golden.texels[4 * p + c];
  return picture;
}

std::string firstLineOfDifference(const std::string& before, const std::string& after) {
  std::size_t line = 1, begin = 0;
  for (std::size_t i = 0; i < before.size() && i < after.size() && before[i] == after[i]; ++i)
    if (before[i] == '\n') ++line, begin = i + 1;
  const auto lineOf = [&](const std::string& text) {
    return base::shortened(text.substr(begin, text.find('\n', begin) - begin));
  };
  return fmt::format("line {} is '{}', not '{}'", line, lineOf(after), lineOf(before));
}

}  // namespace

CaseResult CaseRunner::run(const TestCase& test, bool accept, base::Diagnostics& diagnostics) {
  base::Diagnostics said;
  CaseResult result = test.plan ? runPlan(test, accept, said) : runPictures(test, accept, said);
  bool warned = false;
  for (const base::Diagnostic& each : said.items())
    warned = warned || each.severity == base::Severity::warning;
  appendWithPlaces(test, said, diagnostics);
  if (said.hasErrors()) {
    result.state = State::broken;
  } else if (warned && !accept) {
    result.lines.emplace_back("it has warnings: see above");
    result.state = State::different;
  }
  return result;
}

CaseResult CaseRunner::runPlan(const TestCase& test, bool accept, base::Diagnostics& diagnostics) {
  CaseResult result;
  const auto plan = planOf(test.options, diagnostics);
  if (!plan || diagnostics.hasErrors()) return result;
  result.files = plan->graph->files;
  const std::string text = graph::dumpText(*plan), file = test.planGolden();
  const bool known = isThere(file);
  base::Diagnostics unreadable;  // which ends with being written anew
  const auto golden = known ? base::readFile(file, accept ? unreadable : diagnostics) : std::nullopt;
  if (known && !golden && accept)
    result.lines.push_back(fmt::format("'{}' could not be read, and is written anew", file));
  const bool same = golden && *golden == text;
  if (golden && !same) result.lines.push_back(firstLineOfDifference(*golden, text));
  if (!known) result.lines.push_back(fmt::format("there is no golden plan '{}' yet", file));
  if (accept) {
    const OutputFile written{"--accept", file};
    if (!checkDistinct({&written, 1}, plan->graph->files, diagnostics)) return result;
    result.state = same ? State::kept : State::written;
    if (!same) base::writeFile(file, text, diagnostics);
  } else {
    result.state = same ? State::same : State::different;
    if (!known) result.lines.back() += "; --accept writes it";
  }
  return result;
}

std::optional<Shot> CaseRunner::shoot(const TestCase& test, base::Diagnostics& diagnostics) {
  const auto world = loadWorld(test.options, diagnostics);
  if (!world) makePlan(test.options, factsWithoutWorld(), true, diagnostics);
  if (!world || (!context_ && isWrong(test.options, world->facts(), diagnostics))) return std::nullopt;
  if (!context_ && !lacksContext_) {
    context_ = openContext(options_, diagnostics);
    lacksContext_ = !context_;
  }
  if (!context_) {
    makePlan(test.options, world->facts(), true, diagnostics);
    return std::nullopt;
  }
  return takeShot(*context_, test.options, *world, {.frames = test.frames, .records = true}, diagnostics);
}

bool CaseRunner::comparePair(const TestCase& test, std::uint32_t frame, const assets::Image8& picture,
                             CaseResult& result, base::Diagnostics& diagnostics) {
  const std::string file = test.goldenOf(frame);
  const std::string which = test.frames.size() > 1 ? fmt::format("frame {}: ", frame) : "";
  if (!isThere(file)) {
    result.lines.push_back(fmt::format("{}there is no golden '{}' yet; --accept writes it", which, file));
    result.pairs.push_back({frame, file, picture, {}, {}, true});
    return false;
  }
  const auto golden = assets::loadImage8(file, 4, diagnostics);
  const auto weights = readMask(test, picture, diagnostics);
  if (!golden || !weights) return false;
  if (golden->width != picture.width || golden->height != picture.height) {
    result.lines.push_back(
        fmt::format("{}the picture is {}, its golden {}", which, sizeText(picture), sizeText(*golden)));
    result.pairs.push_back({frame, file, picture, *golden, {}, true});
    return false;
  }
  const assets::Image8 compared = laidUnder(picture, *golden, *weights);
  if (compared.texels == golden->texels) return true;
  assets::FlipMap map = assets::computeFlip(*golden, compared);
  const PictureDifference found = measureDifference(compared, *golden, map, *weights);
  const bool good = fits(found, test.tolerance);
  result.lines.push_back(which + found.text());
  if (!good) result.lines.push_back(text(test.tolerance));
  result.pairs.push_back({frame, file, picture, *golden, std::move(map), !good});
  return good;
}

bool CaseRunner::acceptPair(const TestCase& test, std::uint32_t frame, const assets::Image8& picture,
                            CaseResult& result, base::Diagnostics& diagnostics) {
  const std::string file = test.goldenOf(frame);
  if (isThere(file)) {
    base::Diagnostics unreadable;  // which ends with being written anew
    const auto golden = assets::loadImage8(file, 4, unreadable);
    if (!golden) result.lines.push_back(fmt::format("'{}' could not be read, and is written anew", file));
    if (golden && golden->width == picture.width && golden->height == picture.height) {
      if (golden->texels == picture.texels) return false;
      const PictureDifference found =
          measureDifference(picture, *golden, assets::computeFlip(*golden, picture));
      result.lines.push_back(fmt::format("'{}' changed: {}", file, found.text()));
    } else if (golden) {
      result.lines.push_back(
          fmt::format("'{}' is {} now, it was {}", file, sizeText(picture), sizeText(*golden)));
    }
  } else {
    result.lines.push_back(fmt::format("'{}' is new", file));
  }
  assets::savePng8(file, picture.width, picture.height, picture.channels, picture.texels, diagnostics);
  return true;
}

CaseResult CaseRunner::runPictures(const TestCase& test, bool accept, base::Diagnostics& diagnostics) {
  CaseResult result;
  const auto shot = shoot(test, diagnostics);
  if (!shot) return result;
  result.files = shot->files;
  const PassRecords records = recordsOf(*shot, context_->device().driverKey);
  const std::string record = test.recordFile();
  if (accept) {
    std::vector<OutputFile> outputs;
    for (const std::string& file : test.acceptedFiles()) outputs.push_back({"--accept", file});
    if (!checkDistinct(outputs, shot->files, diagnostics)) return result;
    for (const auto& [frame, picture] : shot->pictures)
      if (!readMask(test, picture, diagnostics)) return result;
  }
  bool same = true;
  for (const auto& [frame, picture] : shot->pictures) {
    const bool fits = accept ? !acceptPair(test, frame, picture, result, diagnostics)
                             : comparePair(test, frame, picture, result, diagnostics);
    same = same && fits;
  }
  if (accept) {
    if (diagnostics.hasErrors()) return result;  // a picture is not written: the record would be of another
    base::Diagnostics ignored;
    const std::string text = toText(records);
    const auto before = isThere(record) ? base::readFile(record, ignored) : std::nullopt;
    if (before != text) base::writeFile(record, text, diagnostics);
    result.state = !same ? State::written : State::kept;
    if (same && before != text) {
      result.lines.push_back(fmt::format("'{}' is written anew, the pictures are the same", record));
      result.state = State::written;
    }
    return result;
  }
  result.state = same ? State::same : State::different;
  if (!same && isThere(record))
    if (const auto before = readRecords(record, diagnostics)) result.first = findDivergence(*before, records);
  return result;
}

}  // namespace weft::app
