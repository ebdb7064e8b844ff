// weft explain: what the plan knows of one pass, resource or parameter; or what a diagnostic code means.
#include <algorithm>
#include <cctype>
#include <fstream>

#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/graph/print/print.h"

namespace weft::app {

namespace {

// The section of docs/errors.md of a code such as "W053"; "" where there is none.
std::string sectionOfCode(std::string code) {
  std::ranges::transform(code, code.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  std::ifstream page(dataFolder() + "/docs/errors.md");
  std::string section;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## " + code + ":"))
      section = line.substr(3) + "\n";
    else if (!section.empty() && line.starts_with("## "))
      break;
    else if (!section.empty() && !line.starts_with("```"))
      section += line + "\n";
  }
  while (section.ends_with("\n\n")) section.pop_back();
  return section;
}

struct ExplainOptions : Options {
  std::string name;
};

int runExplain(ExplainOptions& options) {
  if (options.name.empty()) {
    if (const std::string section = sectionOfCode(options.graph); !section.empty()) return print(section), 0;
    printError("explain: give a graph and a name, or a code such as W053\n");
    return 2;
  }
  text::Diagnostics diagnostics;
  if (const auto plan = planOf(options, diagnostics))
    if (const auto text = graph::describe(*plan, options.name, diagnostics)) print(*text);
  return report(diagnostics);
}

}  // namespace

void addExplain(CommandLine& line) {
  const auto [command, options] = line.add(
      "explain",
      "say what is known of one pass, resource or parameter: order, storage, barriers, readers; or, with "
      "a code such as W053 alone, what it means",
      runExplain);
  options.addGraph(command);
  command.add_option("name", options.name, "any unique suffix of its name");
}

}  // namespace weft::app
