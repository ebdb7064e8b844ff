// The command line: commands that each declare their own options, one of which is chosen and run.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <type_traits>

#include "app/session/options.h"

namespace weft::app {

// A command and its options: `auto [command, options] = line.add("dump", "write …", runDump);`
template <class O>
struct Command {
  CLI::App& line;
  O& options;
};

class CommandLine {
 public:
  CommandLine();

  // `action` returns the exit code: 0 done, 1 something is wrong with the input, 2 usage, 3 the machine cannot (no context).
  template <class O>
  Command<O> add(const char* name, const char* doc, int (*action)(O&)) {
    const auto options = std::make_shared<O>();
    CLI::App& command = *app_.add_subcommand(name, doc);
    command.callback([this, options, action] {
      run_ = [this, options, action] {
        if constexpr (std::is_base_of_v<Options, O>) {
          options->typed = typed_;
          options->finish();
        }
        return action(*options);
      };
    });
    return {command, *options};
  }

  // Reads the arguments and runs the command that they choose. Help, the version and what is wrong are printed.
  int run(int argc, char** argv);

 private:
  CLI::App app_;
  std::string typed_;         // as a shell takes it
  std::function<int()> run_;  // the command that was chosen
};

}  // namespace weft::app
