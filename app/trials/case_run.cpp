#include "app/trials/case_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/output/output_files.h"
#include "app/output/picture_writer.h"
#include "app/session/session.h"
#include "engine/graph/print/print.h"
#include "engine/text/files/file.h"
#include "engine/text/printable.h"

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

// 0 where pixels do not count; empty: all count. Empty as a whole after an error.
std::optional<std::vector<std::uint8_t>> readMask(const TestCase& test, const assets::Image8& picture,
                                                  text::Diagnostics& diagnostics) {
  if (test.mask.empty()) return std::vector<std::uint8_t>{};
  auto mask = assets::loadImage8(test.mask, 1, diagnostics);
  if (!mask) return std::nullopt;
  if (mask->width != picture.width || mask->height != picture.height) {
    text::Diagnostic& d =
        diagnostics.error(text::Code::badImageSize, test.place,
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
  if (picture.width != golden.width || picture.height != golden.height) return picture;
  for (std::size_t p = 0; p < weights.size(); ++p)
    for (std::size_t c = 0; weights[p] == 0 && c < 4; ++c)
      picture.texels[4 * p + c] = golden.texels[4 * p + c];
  return picture;
}

std::string firstLineOfDifference(const std::string& before, const std::string& after) {
  const auto end = std::mismatch(before.begin(), before.end(), after.begin(), after.end()).first;
  const std::string same(before.begin(), end);
  const std::size_t begin = same.rfind('\n') + 1;
  const auto lineOf = [&](const std::string& text) {
    return text::shortened(text.substr(begin, text.find('\n', begin) - begin));
  };
  return fmt::format("line {} is '{}', not '{}'", 1 + std::ranges::count(same, '\n'), lineOf(after),
                     lineOf(before));
}

CaseResult runPlan(const TestCase& test, bool accept, text::Diagnostics& diagnostics) {
  CaseResult result;
  const auto plan = planOf(test.options, diagnostics);
  if (!plan || diagnostics.hasErrors()) return result;
  const std::string text = graph::dumpText(*plan), file = test.planGolden();
  const OutputFile written{"--accept", file, OutputFile::Over::file};
  if (accept && !checkDistinct({&written, 1}, diagnostics)) return result;
  text::Diagnostics ignored;  // what cannot be read is written anew
  const auto golden = isThere(file) ? text::readFile(file, accept ? ignored : diagnostics) : std::nullopt;
  if (!golden)
    result.lines.push_back(fmt::format("there is no golden plan '{}' yet; --accept writes it", file));
  if (golden == text) return result;
  result.state = accept ? State::written : State::different;
  if (golden) result.lines.push_back(firstLineOfDifference(*golden, text));
  if (accept) text::writeFile(file, text, diagnostics);
  return result;
}

// Compares a picture with its golden, or with `accept` writes it as that where they differ. False when it is not good enough, or
// was written.
bool judgePicture(const TestCase& test, std::uint32_t frame, const assets::Image8& picture, bool accept,
                  CaseResult& result, text::Diagnostics& diagnostics) {
  const std::string file = test.goldenOf(frame);
  text::Diagnostics ignored;  // what cannot be read is written anew
  const auto golden =
      isThere(file) ? assets::loadImage8(file, 4, accept ? ignored : diagnostics) : std::nullopt;
  const auto weights = readMask(test, picture, diagnostics);
  if (!weights || diagnostics.hasErrors()) return false;
  std::optional<PictureDifference> found;
  bool good = false;
  if (golden) {
    const assets::Image8 compared = laidUnder(picture, *golden, *weights);
    if (compared.texels == golden->texels && compared.width == golden->width) return true;
    found = comparePictures(compared, *golden, *weights);
    good = found && fits(*found, test.tolerance);
    result.lines.push_back(fmt::format(
        "frame {} changed: {}", frame,
        found ? found->text()
              : fmt::format("the picture is {}, its golden {}", sizeText(picture), sizeText(*golden))));
    if (found && !good && !accept) result.lines.push_back(text(test.tolerance));
  } else {
    result.lines.push_back(fmt::format("there is no golden '{}' yet; --accept writes it", file));
  }
  if (accept) {
    savePng(file, picture, diagnostics);
    return false;
  }
  result.pairs.push_back({frame, file, picture, golden.value_or(assets::Image8{}),
                          found ? std::move(found->map) : assets::FlipMap{}, !good});
  return good;
}

}  // namespace

CaseResult CaseRunner::run(const TestCase& test, bool accept, text::Diagnostics& diagnostics) {
  text::Diagnostics said;
  CaseResult result = test.plan ? runPlan(test, accept, said) : runPictures(test, accept, said);
  const bool warned = std::ranges::count(said.items(), text::Severity::warning, &text::Diagnostic::severity);
  appendWithPlaces(test, said, diagnostics);
  if (said.hasErrors()) {
    result.state = State::broken;
  } else if (warned && !accept) {
    result.lines.emplace_back("it has warnings: see above");
    result.state = State::different;
  }
  return result;
}

std::optional<Shot> CaseRunner::shoot(const TestCase& test, text::Diagnostics& diagnostics) {
  const auto world = loadWorld(test.options, diagnostics);
  if (!world) makePlan(test.options, factsWithoutWorld(), true, diagnostics);
  if (!world || (!context_ && isWrong(test.options, world->facts(), diagnostics))) return std::nullopt;
  if (!context_ && !lacksContext_) {
    context_ = openContext(options_, diagnostics);
    lacksContext_ = !context_;
  }
  if (!context_) return std::nullopt;
  return takeShot(*context_, test.options, *world, {.frames = test.frames, .records = true}, diagnostics);
}

CaseResult CaseRunner::runPictures(const TestCase& test, bool accept, text::Diagnostics& diagnostics) {
  CaseResult result;
  const auto shot = shoot(test, diagnostics);
  if (!shot) return result;
  const std::string record = test.recordFile();
  if (accept) {
    std::vector<OutputFile> outputs;
    for (const std::string& file : test.acceptedFiles())
      outputs.push_back({"--accept", file, OutputFile::Over::file});
    if (!checkDistinct(outputs, diagnostics)) return result;
    for (const auto& [frame, picture] : shot->pictures)
      if (!readMask(test, picture, diagnostics)) return result;
  }
  bool same = true;
  for (const auto& [frame, picture] : shot->pictures)
    same = judgePicture(test, frame, picture, accept, result, diagnostics) && same;
  if (accept) {
    if (diagnostics.hasErrors()) return result;  // a picture is not written: the record would be of another
    text::Diagnostics ignored;
    const std::string text = toText(shot->records);
    const auto before = isThere(record) ? text::readFile(record, ignored) : std::nullopt;
    if (before != text) text::writeFile(record, text, diagnostics);
    result.state = same && before == text ? State::same : State::written;
    return result;
  }
  result.state = same ? State::same : State::different;
  if (!same && isThere(record))
    if (const auto before = readRecords(record, diagnostics))
      result.first = findDivergence(*before, shot->records);
  return result;
}

}  // namespace weft::app
