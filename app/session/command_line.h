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
  std::string doc;
  bool required = false, repeatable = false;
};

struct CommandText {
  std::string name, doc, footer;
  std::vector<OptionText> options;
};

std::vector<CommandText> describeCommands(const CLI::App& app);

// "bash", "zsh", "fish": a script that the shell reads.
std::string completionScript(const std::vector<CommandText>& commands, const std::string& shell);
// For man(1), in the macros of groff_man(7).
std::string manPage(const std::vector<CommandText>& commands);

}  // namespace weft::app
