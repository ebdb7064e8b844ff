// weft test: cases of pictures and plans against their goldens.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "app/commands/commands.h"
#include "app/output/output_files.h"
#include "app/output/page.h"
#include "app/output/picture_writer.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/case_run.h"
#include "engine/text/files/file.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

using State = CaseResult::State;

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

struct TestOptions : Options {
  std::string folder;             // of cases
  bool accept = false;            // write goldens
  std::vector<std::string> only;  // names of cases
  std::string report;             // page of failures
  std::string output;             // folder for what fails
};

struct Cases {
  std::vector<TestCase> all, wanted;
};

// The cases to run; what is wrong with any of them ends the run.
Cases chooseCases(const TestOptions& options, text::Diagnostics& diagnostics) {
  Cases cases;
  for (const std::string& file : findCaseFiles(options.folder, diagnostics))
    readCases(file, options, cases.all, diagnostics);
  std::ranges::copy_if(cases.all, std::back_inserter(cases.wanted),
                       [&](const TestCase& test) { return isWanted(test, options.only); });
  if (cases.wanted.empty() && !diagnostics.hasErrors())
    diagnostics.error(text::Code::unknownWord,
                      text::placeOfOption(cases.all.empty() ? options.folder : "--only"),
                      cases.all.empty() ? "there are no cases" : "no case has such a name");
  return cases;
}

// Without ".png": where -o puts the picture of a case.
std::string leftName(const std::string& folder, const TestCase& test, std::uint32_t frame) {
  return fmt::format("{}/{}{}", folder, test.name,
                     test.frames.size() > 1 ? fmt::format("_{:04}", frame) : "");
}

// Checks that --report, -o and --accept write none of the files that the cases are made of, also of cases that do not run,
// and that each picture is another file. The files that a graph names are known only when it is loaded.
bool checkOutputs(const TestOptions& options, const Cases& cases, text::Diagnostics& diagnostics) {
  std::vector<OutputFile> outputs;
  std::vector<std::string> inputs;
  if (!options.report.empty()) outputs.push_back({"--report", options.report});
  for (const TestCase& test : cases.all) {
    inputs.insert(inputs.end(),
                  {test.options.graph, test.options.scene, test.options.materials, test.options.environment});
    inputs.insert(inputs.end(), {test.mask, test.place.file ? *test.place.file : std::string()});
    inputs.insert(inputs.end(), test.options.presets.begin(), test.options.presets.end());
    const std::vector<std::string> goldens = test.acceptedFiles();
    if (!options.accept || !isWanted(test, options.only))
      inputs.insert(inputs.end(), goldens.begin(), goldens.end());
  }
  const auto make = [&](const char* option, const std::string& file) {
    outputs.push_back({option, file, OutputFile::Over::file});
  };
  for (const TestCase& test : cases.wanted) {
    if (options.accept)
      for (const std::string& file : test.acceptedFiles()) make("--accept", file);
    for (const std::uint32_t frame : test.frames)
      for (const char* end : {".png", "_flip.png"})
        if (!options.output.empty() && !test.plan) make("-o", leftName(options.output, test, frame) + end);
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
  const Cases chosen = chooseCases(options, diagnostics);
  const std::vector<TestCase>& cases = chosen.wanted;
  if (diagnostics.hasErrors() || !checkOutputs(options, chosen, diagnostics)) {
    report(diagnostics);
    return 2;
  }
  CaseRunner runner(options);
  std::vector<std::pair<TestCase, CaseResult>> results;
  std::size_t counts[4] = {};
  for (const TestCase& test : cases) {
    CaseResult result = runner.run(test, options.accept, diagnostics);
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
  if (runner.lacksContext()) return 3;
  if (counts[static_cast<std::size_t>(State::broken)] > 0 || !written) return 2;
  return counts[static_cast<std::size_t>(State::different)] > 0 ? 1 : 0;
}

}  // namespace

void addTest(CommandLine& line) {
  const auto [command, options] = line.add(
      "test", "render the cases of *.cases.json and compare them with their goldens; exit 1 when one differs",
      runTest);
  addPath(command, "folder", options.folder, "a folder with *.cases.json, or one such file")->required();
  command.add_option("--only", options.only, "run the cases whose name contains this; repeatable");
  command.add_flag("--accept", options.accept, "write what is rendered as the goldens, and say what changed");
  addPath(command, "--report", options.report,
          "write a page of the failures: picture, golden, difference, first pass that differs");
  addPath(command, "-o,--output", options.output,
          "folder for the picture and the difference of each case that fails", "FOLDER");
  options.addBackend(command);
  command.footer("Example: weft test tests/golden --report out/report.html");
}

}  // namespace weft::app
