// weft test: cases of pictures and plans against their goldens.
#include <fmt/format.h>

#include <map>

#include "app/commands/commands.h"
#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "app/trials/case_run.h"
#include "app/trials/report_page.h"
#include "engine/base/counted.h"
#include "engine/base/files/file.h"
#include "engine/base/nearest.h"
#include "engine/base/printable.h"

namespace weft::app {

namespace {

using State = CaseResult::State;

const char* wordOf(State state) {
  static constexpr const char* kWords[] = {"ok", "FAILED", "written", "kept", "BROKEN"};
  return kWords[static_cast<std::size_t>(state)];
}

void printResult(const TestCase& test, const CaseResult& result) {
  print(fmt::format("{:8}{}\n", wordOf(result.state), test.name));
  for (const std::string& line : result.lines) print(fmt::format("        {}\n", base::printable(line)));
  if (result.first) print(fmt::format("        first that differs: {}\n", result.first->text()));
  flushPrinted();
}

bool isWanted(const TestCase& test, const std::vector<std::string>& only) {
  return only.empty() || std::ranges::any_of(only, [&](const std::string& part) {
           return test.name.find(part) != std::string::npos;
         });
}

// The cases to run; what is wrong with any of them ends the run.
std::vector<TestCase> chooseCases(const Options& options, base::Diagnostics& diagnostics) {
  std::vector<TestCase> all, wanted;
  for (const std::string& file : findCaseFiles(options.trial.folder, diagnostics))
    readCases(file, options, all, diagnostics);
  std::vector<std::string> names;
  std::map<std::string, const TestCase*> goldens;
  for (const TestCase& test : all) {
    names.push_back(test.name);
    const auto [known, fresh] = goldens.emplace(test.plan ? test.planGolden() : test.recordFile(), &test);
    if (!fresh)
      diagnostics
          .error(base::Code::duplicateName, test.place,
                 fmt::format("'{}' is also a case of '{}', and both have one golden", test.name,
                             known->second->place.file ? *known->second->place.file : ""))
          .hint = "give one of them another name";
    if (isWanted(test, options.trial.only)) wanted.push_back(test);
  }
  if (wanted.empty() && !diagnostics.hasErrors()) {
    base::Diagnostic& d = diagnostics.error(
        base::Code::unknownWord, graph::placeOfOption(all.empty() ? options.trial.folder : "--only"),
        all.empty() ? "there are no cases" : "no case has such a name");
    if (!all.empty()) d.hint = base::nearestHint(options.trial.only.front(), names);
  }
  return wanted;
}

// Without ".png": where -o puts the picture of a case.
std::string leftName(const std::string& folder, const TestCase& test, std::uint32_t frame) {
  return fmt::format("{}/{}{}", folder, test.name,
                     test.frames.size() > 1 ? fmt::format("_{:04}", frame) : "");
}

// That what --report and -o write is none of the files that the cases are made of, and each picture another file.
bool checkOutputs(const Options& options, const std::vector<TestCase>& cases,
                  base::Diagnostics& diagnostics) {
  std::vector<OutputFile> outputs;
  std::vector<std::string> inputs, made;
  if (!options.trial.report.empty()) outputs.push_back({"--report", options.trial.report});
  for (const TestCase& test : cases) {
    inputs.insert(inputs.end(),
                  {test.options.graph, test.options.scene, test.options.materials, test.options.environment});
    inputs.insert(inputs.end(), {test.mask, test.place.file ? *test.place.file : std::string()});
    inputs.insert(inputs.end(), {test.planGolden(), test.recordFile()});
    if (options.trial.accept) made.push_back(test.plan ? test.planGolden() : test.recordFile());
    for (const std::uint32_t frame : test.frames) {
      inputs.push_back(test.goldenOf(frame));
      if (test.plan) continue;
      if (options.trial.accept) made.push_back(test.goldenOf(frame));
      if (options.output.empty()) continue;
      for (const char* end : {".png", "_flip.png"}) {
        made.push_back(leftName(options.output, test, frame) + end);
        outputs.push_back({"-o", made.back()});
      }
    }
  }
  std::erase(inputs, "");
  const bool plain = checkMadeFiles(made, {}, "-o", diagnostics);
  return checkDistinct(outputs, inputs, diagnostics) && plain;
}

// The picture and the difference of what failed.
void leaveFiles(const std::string& folder, const TestCase& test, const CaseResult& result,
                base::Diagnostics& diagnostics) {
  for (const CaseResult::Pair& pair : result.pairs) {
    if (!pair.failed) continue;
    const std::string stem = leftName(folder, test, pair.frame);
    const assets::Image8 difference = assets::colorFlip(pair.map);
    if (!makeFolderOf(stem + ".png", diagnostics)) return;
    assets::savePng8(stem + ".png", pair.picture.width, pair.picture.height, pair.picture.channels,
                     pair.picture.texels, diagnostics);
    if (!difference.texels.empty())
      assets::savePng8(stem + "_flip.png", difference.width, difference.height, 3, difference.texels,
                       diagnostics);
  }
}

}  // namespace

int runTest(const Options& options) {
  base::Diagnostics diagnostics;
  const std::vector<TestCase> cases = chooseCases(options, diagnostics);
  if (diagnostics.hasErrors() || !checkOutputs(options, cases, diagnostics)) {
    report(diagnostics);
    return 2;
  }
  CaseRunner runner(options);
  std::vector<std::pair<TestCase, CaseResult>> results;
  std::size_t counts[5] = {};
  for (const TestCase& test : cases) {
    CaseResult result = runner.run(test, options.trial.accept, diagnostics);
    report(diagnostics, false);
    diagnostics.clear();
    printResult(test, result);
    ++counts[static_cast<std::size_t>(result.state)];
    if (!options.output.empty() && result.state == State::different)
      leaveFiles(options.output, test, result, diagnostics);
    if (result.state == State::same || options.trial.report.empty()) result.pairs.clear();
    results.emplace_back(test, std::move(result));
  }
  std::string sum;
  for (const State state : {State::same, State::kept, State::written, State::different, State::broken})
    if (const std::size_t count = counts[static_cast<std::size_t>(state)])
      sum += fmt::format("{}{} {}", sum.empty() ? "" : ", ", count, wordOf(state));
  print(fmt::format("{}: {}\n", base::counted(cases.size(), "case"), sum));
  if (!options.trial.report.empty() && makeFolderOf(options.trial.report, diagnostics))
    base::writeFile(options.trial.report, reportPage(results), diagnostics);
  const bool written = report(diagnostics) == 0;
  if (runner.lacksContext()) return 3;
  if (counts[static_cast<std::size_t>(State::broken)] > 0 || !written) return 2;
  return counts[static_cast<std::size_t>(State::different)] > 0 ? 1 : 0;
}

}  // namespace weft::app
