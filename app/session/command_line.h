// The command line as a description: what shells complete and what the man page says. Made from CLI11's own tables, so that it
// is what the program takes. Does not: parse.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace weft::app {

struct OptionText {
  std::vector<std::string>
      names;          // "--output", "-o", the long one first; none for what stands without a name
  std::string value;  // what is written behind it: "WxH", "FILE"; "" for a switch
  std::vector<std::string> choices;  // the only words that it takes; empty: any
  std::string kind;                  // "file" or "folder", for shells to complete; "" for any other value
  std::string doc;
  bool required = false, repeatable = false;
};

struct CommandText {
  std::string name, doc, footer;  // "render"; "new pass", behind the "new" that it belongs to
  std::vector<OptionText> options;
  std::vector<std::string> inner;  // "pass" of "new": what stands behind it
};

// All commands, those of commands behind them.
std::vector<CLI::App*> allCommands(CLI::App& app);
std::vector<CommandText> describeCommands(CLI::App& app);

// "bash", "zsh", "fish": a script that the shell reads.
std::string completionScript(const std::vector<CommandText>& commands, const std::string& shell);
// The text as one word of a shell.
std::string quotedForShell(const std::string& text);
// For man(1), in the macros of groff_man(7).
std::string manPage(const std::vector<CommandText>& commands);

}  // namespace weft::app
