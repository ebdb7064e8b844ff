// weft test: cases of pictures and plans against their goldens.
#include "app/commands/commands.h"
#include "app/output/pictures.h"
#include "app/trials/case_file.h"
#include "app/trials/divergence.h"
#include "app_sentences.h"
#include "engine/graph/print/print.h"

namespace weft::app {

namespace {

struct TestOptions : Options {
  std::string folder;             // of cases
  bool accept = false;            // write goldens
  std::vector<std::string> only;  // names of cases
  std::string report;             // page of failures
  std::string output;             // folder for what fails
};

// ---- a case ----

struct CaseResult {
  // written: accepted. broken: it could not be rendered, or its golden not be read.
  enum class State { same, different, written, broken };
  // A frame and its golden.
  struct Pair {
    std::uint32_t frame = 0;
    std::string golden;  // file
    assets::Image8 picture, expected;
    assets::FlipMap map;
    bool failed = false;
  };
  State state = State::same;
  std::vector<std::string> lines;  // what was found, a sentence each
  std::vector<Pair> pairs;         // those that differ
  std::optional<Divergence> first;
};

using State = CaseResult::State;

bool fits(const PictureDifference& found, const Tolerance& tolerance) {
  return found.flip.mean <= tolerance.flip && found.flip.peak <= tolerance.flipPeak &&
         found.bytes.maxDifference <= tolerance.step && found.share <= tolerance.fraction;
}

// 0 where pixels do not count; empty: all count. Empty as a whole after an error.
std::optional<std::vector<std::uint8_t>> readMask(const TestCase& test, const assets::Image8& picture,
                                                  text::Diagnostics& diagnostics) {
  if (test.mask.empty()) return std::vector<std::uint8_t>{};
  auto mask = assets::loadImage8(test.mask, 1, diagnostics);
  if (!mask) return std::nullopt;
  if (mask->width != picture.width || mask->height != picture.height) {
    diagnostics.error(say::maskOfOtherSize, test.place, test.mask, sizeText(picture), sizeText(*mask));
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
  const auto golden =
      text::isThere(file) ? text::readFile(file, accept ? ignored : diagnostics) : std::nullopt;
  if (!golden)
    result.lines.push_back(fmt::format("there is no golden plan '{}' yet; --accept writes it", file));
  if (golden == text) return result;
  result.state = accept ? State::written : State::different;
  if (golden) result.lines.push_back(firstLineOfDifference(*golden, text));
  if (accept) text::writeFile(file, text, diagnostics);
  return result;
}

// Compares a picture with its golden, or with `accept` writes it where they differ. False when it differs too much, or was written.
bool judgePicture(const TestCase& test, std::uint32_t frame, const assets::Image8& picture, bool accept,
                  CaseResult& result, text::Diagnostics& diagnostics) {
  const std::string file = test.goldenOf(frame);
  text::Diagnostics ignored;  // what cannot be read is written anew
  const auto golden =
      text::isThere(file) ? assets::loadImage8(file, 4, accept ? ignored : diagnostics) : std::nullopt;
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
    if (found && !good && !accept) {
      const Tolerance& t = test.tolerance;
      result.lines.push_back(
          fmt::format("allowed: FLIP {:g}, at most {:g}; {:g} % of the pixels, by up to {:g}", t.flip,
                      t.flipPeak, 100 * t.fraction, t.step));
    }
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

// Renders the case and compares it with its golden, or with `accept` writes that. `context` is opened for the first case with a picture.
CaseResult runPictures(const TestCase& test, const TestOptions& options,
                       std::optional<std::unique_ptr<gl::Context>>& context, text::Diagnostics& diagnostics) {
  CaseResult result;
  const auto world = loadWorld(test.options, diagnostics);
  if (!world) makePlan(test.options, factsWithoutWorld(), true, diagnostics);
  if (!world || (!context && isWrong(test.options, world->facts(), diagnostics))) return result;
  if (!context) context = openContext(options, diagnostics);
  if (!*context) return result;
  const auto shot =
      takeShot(**context, test.options, *world, {.frames = test.frames, .records = true}, diagnostics);
  if (!shot) return result;
  const bool accept = options.accept;
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
    const auto before = text::isThere(record) ? text::readFile(record, ignored) : std::nullopt;
    if (before != text) text::writeFile(record, text, diagnostics);
    result.state = same && before == text ? State::same : State::written;
    return result;
  }
  result.state = same ? State::same : State::different;
  if (!same && text::isThere(record))
    if (const auto before = readRecords(record, diagnostics))
      result.first = findDivergence(*before, shot->records);
  return result;
}

CaseResult runCase(const TestCase& test, const TestOptions& options,
                   std::optional<std::unique_ptr<gl::Context>>& context, text::Diagnostics& diagnostics) {
  text::Diagnostics said;
  CaseResult result =
      test.plan ? runPlan(test, options.accept, said) : runPictures(test, options, context, said);
  const bool warned = std::ranges::count(said.items(), text::Severity::warning, &text::Diagnostic::severity);
  appendWithPlaces(test, said, diagnostics);
  if (said.hasErrors()) {
    result.state = State::broken;
  } else if (warned && !options.accept) {
    result.lines.emplace_back("it has warnings: see above");
    result.state = State::different;
  }
  return result;
}

// ---- all of them ----

const char* wordOf(State state) {
  static constexpr const char* kWords[] = {"ok", "FAILED", "written", "BROKEN"};
  return kWords[static_cast<std::size_t>(state)];
}

void printResult(const TestCase& test, const CaseResult& result) {
  print(fmt::format("{:8}{}\n", wordOf(result.state), test.name));
  for (const std::string& line : result.lines) print(fmt::format("        {}\n", text::printable(line)));
  if (result.first)
    print(fmt::format("        first that differs: {}\n",
                      text::shortened(text::printable(result.first->text()))));
  flushPrinted();
}

bool isWanted(const TestCase& test, const std::vector<std::string>& only) {
  return only.empty() || std::ranges::any_of(only, [&](const std::string& part) {
           return test.name.find(part) != std::string::npos;
         });
}

// Without ".png": where -o puts the picture of a case.
std::string leftName(const std::string& folder, const TestCase& test, std::uint32_t frame) {
  return fmt::format("{}/{}{}", folder, test.name,
                     test.frames.size() > 1 ? fmt::format("_{:04}", frame) : "");
}

// Checks that --report, -o and --accept write none of the files that the cases are made of, also of cases that do not run,
// and that each picture is another file. The files that a graph names are known only when it is loaded.
bool checkOutputs(const TestOptions& options, const std::vector<TestCase>& cases,
                  text::Diagnostics& diagnostics) {
  std::vector<OutputFile> outputs;
  std::vector<std::string> inputs;
  const auto make = [&](const char* option, const std::string& file) {
    outputs.push_back({option, file, OutputFile::Over::file});
  };
  if (!options.report.empty()) outputs.push_back({"--report", options.report});
  for (const TestCase& test : cases) {
    const Options& of = test.options;
    inputs.insert(inputs.end(), {of.graph, of.scene, of.materials, of.environment, test.mask});
    if (test.place.file) inputs.push_back(*test.place.file);
    inputs.insert(inputs.end(), of.presets.begin(), of.presets.end());
    const bool runs = isWanted(test, options.only);
    for (const std::string& file : test.acceptedFiles())
      options.accept&& runs ? make("--accept", file) : inputs.push_back(file);
    for (const std::uint32_t frame : test.frames)
      for (const char* end : {".png", "_flip.png"})
        if (runs && !options.output.empty() && !test.plan)
          make("-o", leftName(options.output, test, frame) + end);
  }
  std::erase(inputs, "");
  return checkDistinct(outputs, diagnostics, inputs);
}

// Writes the picture and the difference of what failed, when all cases have read their files.
void leaveFiles(const std::string& folder, const TestCase& test, const CaseResult& result,
                text::Diagnostics& diagnostics) {
  for (const CaseResult::Pair& pair : result.pairs) {
    if (!pair.failed) continue;
    const std::string stem = leftName(folder, test, pair.frame);
    const OutputFile outputs[] = {{"-o", stem + ".png", OutputFile::Over::file},
                                  {"-o", stem + "_flip.png", OutputFile::Over::file}};
    if (!checkDistinct(outputs, diagnostics)) continue;
    const bool written = savePng(stem + ".png", pair.picture, diagnostics);
    if (written && !pair.map.errors.empty())
      savePng(stem + "_flip.png", assets::colorFlip(pair.map), diagnostics);
  }
}

// For the page: of the cases that failed, pictures and goldens.
nlohmann::ordered_json casesOf(const std::vector<std::pair<TestCase, CaseResult>>& results) {
  nlohmann::ordered_json cases = nlohmann::ordered_json::array();
  for (const auto& [test, result] : results) {
    auto& each = cases.emplace_back();
    each = {{"name", test.name}, {"graph", test.options.graph}, {"state", wordOf(result.state)}};
    if (result.state != State::different && result.state != State::broken) continue;
    each.update({{"lines", result.lines}, {"first", result.first ? result.first->text() : ""}});
    for (const CaseResult::Pair& pair : result.pairs)
      each["pairs"].push_back(
          {{"frame", pair.frame},
           {"golden", pair.golden},
           {"picture", pictureAddress(pair.picture)},
           {"expected", pictureAddress(pair.expected)},
           {"flip", pair.map.errors.empty() ? "" : pictureAddress(assets::colorFlip(pair.map))}});
  }
  return cases;
}

int runTest(TestOptions& options) {
  text::Diagnostics diagnostics;
  std::vector<TestCase> cases = readCases(options.folder, options, diagnostics);
  const auto isLeftOut = [&](const TestCase& test) { return !isWanted(test, options.only); };
  if (std::ranges::all_of(cases, isLeftOut) && !diagnostics.hasErrors())
    diagnostics.error(say::noCase, text::placeOfOption(cases.empty() ? options.folder : "--only"),
                      cases.empty() ? "there are no cases" : "no case has such a name");
  if (diagnostics.hasErrors() || !checkOutputs(options, cases, diagnostics)) {
    report(diagnostics);
    return 2;
  }
  std::erase_if(cases, isLeftOut);
  std::optional<std::unique_ptr<gl::Context>> context;  // null: there is none
  std::vector<std::pair<TestCase, CaseResult>> results;
  std::size_t counts[4] = {};
  for (const TestCase& test : cases) {
    CaseResult result = runCase(test, options, context, diagnostics);
    report(diagnostics, false);
    diagnostics.clear();
    printResult(test, result);
    ++counts[static_cast<std::size_t>(result.state)];
    const bool left = !options.output.empty() && result.state == State::different;
    if (result.state == State::same || (options.report.empty() && !left)) result.pairs.clear();
    results.emplace_back(test, std::move(result));
  }
  std::string sum;
  for (const State state : {State::same, State::written, State::different, State::broken})
    if (const std::size_t count = counts[static_cast<std::size_t>(state)])
      sum += fmt::format("{}{} {}", sum.empty() ? "" : ", ", count, wordOf(state));
  print(fmt::format("{}: {}\n", text::counted(cases.size(), "case"), sum));
  if (!options.output.empty())
    for (const auto& [test, result] : results) leaveFiles(options.output, test, result, diagnostics);
  const OutputFile output{"--report", options.report, OutputFile::Over::file};
  if (!options.report.empty() && checkDistinct({&output, 1}, diagnostics) &&
      makeFolderOf(options.report, diagnostics))
    if (const auto page = pageOf({{"cases", casesOf(results)}}, "weft test", diagnostics))
      text::writeFile(options.report, *page, diagnostics);
  const bool written = report(diagnostics) == 0;
  if (context && !*context) return 3;
  if (counts[static_cast<std::size_t>(State::broken)] > 0 || !written) return 2;
  return counts[static_cast<std::size_t>(State::different)] > 0 ? 1 : 0;
}

}  // namespace

void addTest(CommandLine& line) {
  const auto [command, options] = line.add(
      "test", "compare the cases of *.cases.json with their goldens; exit 1 when one differs", runTest);
  addPath(command, "folder", options.folder, "a folder with *.cases.json, or one such file")->required();
  command.add_option("--only", options.only, "cases whose name contains this; repeatable");
  command.add_flag("--accept", options.accept, "write what is rendered as the goldens");
  addPath(command, "--report", options.report, "page of the failures to write, .html");
  addPath(command, "-o,--output", options.output, "folder for pictures of what fails", "FOLDER");
  options.addBackend(command);
  command.footer("Example: weft test tests/golden --report out/report.html");
}

}  // namespace weft::app
