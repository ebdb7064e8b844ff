#include "app/session/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <sstream>

#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/base/files/file_access.h"
#include "engine/base/limits.h"
#include "engine/base/nearest.h"
#include "engine/base/printable.h"

namespace weft::app {

namespace {

// Text as messages print it.
std::string shown(const std::string& text) {
  return base::shortened(base::printable(text));
}

std::vector<CLI::App*> commandsOf(CLI::App& app) {
  return app.get_subcommands([](CLI::App*) { return true; });
}

// What every command takes.
void addCommon(CLI::App& command) {
  const auto confine = [](const std::string& folder) { return base::confineTo(folder).value_or(""); };
  const auto limit = [](const std::string& text) -> std::string {
    std::uint64_t times = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), times);
    if (error != std::errc() || end != text.data() + text.size() || times < 1 || times > base::kMostRaise)
      return fmt::format("expected a whole number from 1 to {}, found '{}'", base::kMostRaise, text);
    base::raiseLimits(times);
    return "";
  };
  const auto ignore = [](const std::vector<std::string>&) {};  // the checks take them
  command
      .add_option_function<std::vector<std::string>>(
          "--confine", ignore,
          "read only below this folder and those named on the command line, whatever files name; repeatable")
      ->check(CLI::Validator(confine, "FOLDER"));
  command
      .add_option_function<std::vector<std::string>>(
          "--limit", ignore, "make the limits of docs/limits.md this many times as large")
      ->check(CLI::Validator(limit, "N"));
  for (CLI::App* inner : commandsOf(command)) addCommon(*inner);
}

// Whether there was an unknown option.
bool tellUnknownOption(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> names;
  std::string title = command.get_name();
  const auto take = [&](const CLI::App& part) {
    for (const CLI::Option* option : part.get_options())
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  };
  take(command);
  for (const CLI::App* inner : command.get_subcommands()) {  // what was written: "pass" behind "new"
    take(*inner);
    title += " " + inner->get_name();
  }
  bool told = false;
  for (int i = 2; i < argc; ++i) {
    const std::string argument = std::string(argv[i]).substr(0, std::string(argv[i]).find('='));
    if (!argument.starts_with("--") || std::ranges::find(names, argument) != names.end()) continue;
    const std::string near = base::nearestName(argument, names);
    printError(
        fmt::format("weft {}: unknown option '{}'; {}\n", title, shown(argument),
                    near.empty() ? "--help lists what there is" : fmt::format("did you mean '{}'?", near)));
    told = true;
  }
  return told;
}

// Help, the version, or what is wrong. 0 when it was asked for.
int tell(const CLI::App& app, const CLI::ParseError& error) {
  std::ostringstream out, err;
  const int code = app.exit(error, out, err);
  print(out.str());
  // What is wrong repeats what was written; the rest is of the parser.
  const std::string said = err.str(), what = error.what();
  const std::size_t twice = what.find(": At Most 1 required");
  const std::string own =
      twice == std::string::npos ? what : what.substr(0, twice) + ": given more than once";
  printError(said.starts_with(what) ? shown(own) + said.substr(what.size()) : said);
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
      if (reads) base::chooseFile(value);
    }
  }
  for (const CLI::App* inner : command.get_subcommands())
    if (std::string wrong = chooseFiles(*inner); !wrong.empty()) return wrong;
  return {};
}

}  // namespace

CommandLine::CommandLine() : app_("Weft: a frame is a JSON file", "weft") {
  app_.require_subcommand(1);
  app_.set_version_flag("--version", fmt::format("weft {}", kVersion));
}

int CommandLine::run(int argc, char** argv) {
  std::vector<std::string> names;
  for (CLI::App* command : commandsOf(app_)) {
    addCommon(*command);
    names.push_back(command->get_name());
  }
  if (argc > 1 && argv[1][0] != '-' && std::ranges::find(names, argv[1]) == names.end()) {
    printError(
        fmt::format("weft: unknown command '{}'; {}\n", shown(argv[1]), base::nearestHint(argv[1], names)));
    return 2;
  }
  try {
    app_.parse(argc, argv);
  } catch (const CLI::ExtrasError& error) {
    const auto chosen = app_.get_subcommands();
    if (chosen.empty() || !tellUnknownOption(*chosen.front(), argc, argv)) tell(app_, error);
    return 2;
  } catch (const CLI::ParseError& error) {
    return tell(app_, error);
  }
  const CLI::App& command = *app_.get_subcommands().front();
  if (const std::string wrong = chooseFiles(command); !wrong.empty()) {
    printError(fmt::format("weft {}: {}\n", command.get_name(), shown(wrong)));
    return 2;
  }
  for (const char* folder : {"graphs", "shaders", "scenes", "materials"})
    base::allowFolder(dataFolder() + "/" + folder);
  return run_();
}

}  // namespace weft::app
