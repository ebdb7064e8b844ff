#include "app/trials/case_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "app/session/session.h"
#include "app_sentences.h"
#include "engine/text/files/file.h"
#include "engine/text/json/fields.h"

namespace weft::app {

namespace {

using text::Code;
using text::JsonFields;
using text::JsonMember;
using text::JsonValue;

constexpr std::string_view kSuffix = ".cases.json";
constexpr text::NumberRange kShare{.min = 0, .max = 1};
constexpr text::NumberRange kStep{.min = 0, .max = 255};
constexpr text::NumberRange kFrame{.min = 0, .max = 4294967295.0, .whole = true};
constexpr text::NumberRange kRate{.min = 1, .max = 1000};

bool isCaseName(std::string_view text) {
  return !text.empty() && text.size() <= 100 &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isalnum(c) || c == '_' || c == '-'; });
}

class CaseReader {
 public:
  CaseReader(const std::string& path, const Options& base, text::Diagnostics& diagnostics)
      : base_(base), diagnostics_(diagnostics), file_(path) {
    const std::filesystem::path parent = std::filesystem::path(path).parent_path();
    folder_ = parent.empty() ? "" : parent.string() + "/";
  }

  void read(std::vector<TestCase>& cases) {
    const auto read = text::readTextFile(*file_, diagnostics_);
    if (!read) return;
    text_ = *read;
    const auto document = text::parseJson(text_, file_, diagnostics_);
    if (!document) return;
    JsonFields fields(*document, "the file of cases", Code::outOfRange, diagnostics_);
    fields.require({"cases"});
    fields.find("about");
    TestCase defaults;
    defaults.options = base_;
    defaults.folder = folder_;
    if (const JsonValue* object = fields.object("defaults")) {
      JsonFields given(*object, "the defaults", Code::outOfRange, diagnostics_);
      readShared(given, defaults);
      given.finish();
    }
    if (const JsonValue* list = fields.array("cases"))
      for (const JsonValue& value : list->items) readCase(value, defaults, cases);
    fields.finish();
  }

 private:
  void readCase(const JsonValue& value, const TestCase& defaults, std::vector<TestCase>& cases) {
    TestCase test = defaults;
    test.place = value.place;
    const JsonValue* named = value.find("name");
    JsonFields fields(value,
                      named && named->is(JsonValue::Type::string) ? "case '" + named->text + "'" : "a case",
                      Code::outOfRange, diagnostics_);
    fields.require({"name"});
    if (test.options.graph.empty()) fields.require({"graph"});
    if (const auto name = fields.text("name")) readName(*name, fields.find("name")->textPlace(), test);
    test.plan = fields.boolean("plan").value_or(false);
    readShared(fields, test);
    fields.finish();
    const bool picture =
        fields.find("mask") || fields.find("tolerance") || fields.find("frame") || fields.find("frames");
    if (test.plan && picture) diagnostics_.error(say::pictureKeysOfPlan, value.place, test.name);
    cases.push_back(std::move(test));
  }

  void readName(const std::string& name, const text::Place& place, TestCase& test) {
    test.name = name;
    if (!isCaseName(name)) {
      diagnostics_.error(say::noCaseName, place, name);
    } else if (!names_.insert(name).second) {
      diagnostics_.error(say::twoCasesOfName, place, name);
    }
  }

  // Reads the keys that "defaults" may have, too.
  void readShared(JsonFields& fields, TestCase& test) {
    Options& options = test.options;
    for (const auto& [key, target] : {std::pair("graph", &options.graph),
                                      {"scene", &options.scene},
                                      {"environment", &options.environment},
                                      {"materials", &options.materials},
                                      {"mask", &test.mask}})
      if (const JsonValue* value = fields.find(key); value && !value->is(JsonValue::Type::null))
        if (const auto path = fields.text(key)) *target = besideFile(value->place, *path);
    if (const auto camera = fields.text("camera")) options.camera = *camera;
    if (const auto fps = fields.number("fps", kRate)) options.fps = *fps;
    take(fields, "size",
         [&](const std::string& text) { return takeSize(text, options.width, options.height); });
    take(fields, "mouse", [&](const std::string& text) { return takePointer(text, options.pointer); });
    readFrames(fields, test);
    readNames(fields, "preset", [&](const JsonValue& item) {
      // A word is a bundled preset whoever runs the case, and where: what lies here or is a person's own does not count.
      const bool word = item.text.find_first_of("/.") == std::string::npos;
      options.presets.push_back(word ? dataFolder() + kPresets + "/" + item.text + ".json"
                                     : besideFile(item.textPlace(), item.text));
    });
    readNames(fields, "disable", [&](const JsonValue& item) {
      options.disables.emplace_back(item.text);
      test.settingPlaces["--disable " + item.text] = item.textPlace();
    });
    if (const JsonValue* sets = fields.object("set"))
      for (const JsonMember& member : sets->members) readSet(member, test);
    if (const JsonValue* object = fields.object("tolerance")) readTolerance(*object, test.tolerance);
  }

  void readSet(const JsonMember& member, TestCase& test) {
    const JsonValue& value = member.value;
    if (value.is(JsonValue::Type::null) || value.is(JsonValue::Type::object)) {
      diagnostics_.error(say::noParameterValue, value.place, member.key, text::nameOf(value.type));
      return;
    }
    // As it would be behind --set NAME=.
    const std::string text =
        value.is(JsonValue::Type::string) ? value.text : text_.substr(value.begin, value.end - value.begin);
    test.options.sets.emplace_back(member.key, text);
    test.settingPlaces[fmt::format("--set {}={}", member.key, text)] = member.value.place;
  }

  void readTolerance(const JsonValue& object, Tolerance& tolerance) {
    JsonFields fields(object, "the tolerance", Code::outOfRange, diagnostics_);
    if (const auto flip = fields.number("flip", kShare)) tolerance.flip = *flip;
    if (const auto peak = fields.number("flip_peak", kShare)) tolerance.flipPeak = *peak;
    if (const auto step = fields.number("step", kStep)) tolerance.step = *step;
    if (const auto fraction = fields.number("fraction", kShare)) tolerance.fraction = *fraction;
    fields.finish();
  }

  // A text that the command line takes, too.
  template <class Take>
  void take(JsonFields& fields, const char* key, const Take& taken) {
    const auto text = fields.text(key);
    if (const std::string wrong = text ? taken(*text) : ""; !wrong.empty())
      diagnostics_.error(say::badCaseOption, fields.find(key)->textPlace(), key, wrong);
  }

  void readFrames(JsonFields& fields, TestCase& test) {
    if (const auto frame = fields.number("frame", kFrame)) test.frames = {static_cast<std::uint32_t>(*frame)};
    const JsonValue* frames = fields.array("frames");
    if (!frames) return;
    std::set<std::uint32_t> numbers;
    for (const JsonValue& item : frames->items)
      if (const auto number = text::readNumber(item, "a frame", kFrame, Code::outOfRange, diagnostics_))
        numbers.insert(static_cast<std::uint32_t>(*number));
    if (frames->items.empty()) diagnostics_.error(say::noFrames, frames->place);
    if (!numbers.empty()) test.frames.assign(numbers.begin(), numbers.end());
  }

  template <class Take>
  void readNames(JsonFields& fields, const char* key, Take&& take) {
    const JsonValue* list = fields.array(key);
    for (std::size_t i = 0; list && i < list->items.size(); ++i)
      if (text::readText(list->items[i], fmt::format("an entry of \"{}\"", key), diagnostics_))
        take(list->items[i]);
  }

  const Options& base_;
  text::Diagnostics& diagnostics_;
  text::FileName file_;
  std::string folder_, text_;
  std::set<std::string> names_;
};

std::vector<std::string> findCaseFiles(const std::string& path, text::Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  if (!text::isFolder(path)) return {path};
  std::vector<std::string> files;
  std::error_code ec;
  for (fs::recursive_directory_iterator at(path, ec), end; !ec && at != end; at.increment(ec))
    if (std::string name = at->path().string(); name.ends_with(kSuffix))
      files.push_back(std::move(name));  // also what is no file: reading it says so
  // A case that is not run must not count as one that holds.
  if (ec) diagnostics.error(say::cannotReadFolder, {path}, ec.message());
  std::ranges::sort(files);
  if (files.empty() && !diagnostics.hasErrors()) diagnostics.error(say::noCaseFiles, {path}, kSuffix);
  return files;
}

}  // namespace

std::string TestCase::goldenOf(std::uint32_t frame) const {
  return folder + (frames.size() == 1 ? name : fmt::format("{}_{:04}", name, frame)) + ".png";
}

std::vector<std::string> TestCase::acceptedFiles() const {
  if (plan) return {planGolden()};
  std::vector<std::string> files{recordFile()};
  for (const std::uint32_t frame : frames) files.push_back(goldenOf(frame));
  return files;
}

std::vector<TestCase> readCases(const std::string& path, const Options& base,
                                text::Diagnostics& diagnostics) {
  std::vector<TestCase> cases;
  for (const std::string& file : findCaseFiles(path, diagnostics))
    CaseReader(file, base, diagnostics).read(cases);
  return cases;
}

void appendWithPlaces(const TestCase& test, const text::Diagnostics& said, text::Diagnostics& diagnostics) {
  for (text::Diagnostic each : said.items()) {
    if (!each.place.file) {
      const auto known = test.settingPlaces.find(each.place.option.value_or(""));
      each.place = known == test.settingPlaces.end() ? test.place : known->second;
    }
    if (each.severity != text::Severity::note)
      each.message = fmt::format("{} (case '{}')", each.message, test.name);
    diagnostics.add(std::move(each));
  }
}

}  // namespace weft::app
