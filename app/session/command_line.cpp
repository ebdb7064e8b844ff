#include "app/session/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/text/files/file.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

// Text as messages print it.
std::string shown(const std::string& text) {
  return text::shortened(text::printable(text));
}

// Names of commands before 0.2, and what they are now.
const std::map<std::string, std::vector<std::string>> kOldNames{{"dot", {"plan", "--format=dot"}},
                                                                {"bisect", {"diff", "--render"}}};

// What every command takes.
void addCommon(CLI::App& command) {
  const auto confine = [](const std::string& folder) { return text::confineTo(folder).value_or(""); };
  const auto ignore = [](const std::vector<std::string>&) {};  // the check takes them
  command
      .add_option_function<std::vector<std::string>>(
          "--confine", ignore, "read only below this folder and what the command line names; repeatable")
      ->check(CLI::Validator(confine, "FOLDER"));
  command
      .add_option_function<std::uint32_t>(
          "--limit", [](std::uint32_t times) { text::limitsRaised = times; },
          "make the limits of docs/limits.md this many times as large")
      ->check(CLI::Range(1u, static_cast<unsigned>(text::kMaxRaise)));
}

// The first word that neither the program nor the chosen command knows, with the nearest that it does; "" when there is none. CLI11
// tells of what is missing first, and a misspelt option is missing under its right name.
std::string unknownWord(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  const CLI::App& command = chosen.empty() ? app : *chosen.front();
  const std::vector<std::string> unknown = app.remaining(true);
  if (unknown.empty()) return {};
  const std::string word = unknown.front().substr(0, unknown.front().find('='));
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
    for (const std::string& name : option->get_snames()) known.push_back("-" + name);
  }
  if (chosen.empty())
    for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; }))
      known.push_back(each->get_name());
  const std::string nearest = text::nearestName(word, known);
  return fmt::format("{}: unknown {} '{}'{}\n", chosen.empty() ? "weft" : "weft " + command.get_name(),
                     word.starts_with('-') ? "option"
                     : chosen.empty()      ? "command"
                                           : "argument",
                     shown(word), nearest.empty() ? "" : fmt::format("; did you mean '{}'?", nearest));
}

// Help, the version, or what is wrong. 0 when it was asked for.
int tell(const CLI::App& app, const CLI::ParseError& error) {
  if (const std::string unknown = error.get_exit_code() == 0 ? "" : unknownWord(app); !unknown.empty()) {
    printError(unknown);
    return 2;
  }
  std::ostringstream out, err;
  const int code = app.exit(error, out, err);
  std::string help = out.str();  // without what a flag that says no is set to
  for (std::size_t at = 0; (at = help.find("{false}", at)) != std::string::npos;) help.replace(at, 7, 7, ' ');
  print(help);
  // What is wrong repeats what was written; the rest is of the parser.
  const std::string said = err.str(), what = error.what();
  printError(said.starts_with(what) ? shown(what) + said.substr(what.size()) : said);
  return code == 0 ? 0 : 2;
}

// What the command line names for reading is the person's own choice, also where reading is confined, and may be a pipe. An option for a file
// or a folder that was given as "", as by a variable of a script that is not set, is wrong: returns what is.
std::string chooseFiles(const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string type = option->get_type_name();
    const bool folder = type.find("FOLDER") != std::string::npos;
    if (!folder && type.find("FILE") == std::string::npos) continue;
    const std::string& name = option->get_name();
    const bool reads = type == "FILE" && name != "--output" && name != "--report" && name != "--screenshot" &&
                       name != "--record";
    for (const std::string& value : option->results()) {
      if (value.empty() && !option->get_positional())
        return fmt::format("{}: expected the name of a {}, found ''", name, folder ? "folder" : "file");
      if (reads) text::chooseFile(value);
    }
  }
  return {};
}

}  // namespace

CommandLine::CommandLine() : app_("Weft: a frame is a JSON file", "weft") {
  app_.require_subcommand(1);
  app_.set_version_flag("--version", fmt::format("weft {}", kVersion));
}

int CommandLine::run(int argc, char** argv) {
  std::vector<std::string> words(argv + 1, argv + std::max(argc, 1));
  for (CLI::App* command : app_.get_subcommands([](CLI::App*) { return true; })) addCommon(*command);
  if (!words.empty())
    if (const auto old = kOldNames.find(words[0]); old != kOldNames.end()) {
      words.erase(words.begin());
      words.insert(words.begin(), old->second.begin(), old->second.end());
    }
  typed_ = "weft";
  for (const std::string& word : words) typed_ += " " + quoted(word);
  try {
    app_.parse(std::vector<std::string>(words.rbegin(), words.rend()));
  } catch (const CLI::ParseError& error) {
    return tell(app_, error);
  }
  const CLI::App& command = *app_.get_subcommands().front();
  if (const std::string wrong = chooseFiles(command); !wrong.empty()) {
    printError(fmt::format("weft {}: {}\n", command.get_name(), shown(wrong)));
    return 2;
  }
  for (const char* folder : {"graphs", "shaders", "scenes", "materials", "app/commands", "app/report"})
    text::allowFolder(dataFolder() + "/" + folder);
  return run_();
}

}  // namespace weft::app
