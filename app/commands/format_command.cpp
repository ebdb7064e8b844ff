// The command format: graph files, overlays and presets in one layout.
#include <algorithm>
#include <memory>

#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/text/files/file.h"
#include "engine/text/files/text_file.h"
#include "engine/text/json/dom.h"
#include "engine/text/json/layout.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

void formatFile(const std::string& path, bool checkOnly, text::Diagnostics& diagnostics) {
  const auto text = text::readTextFile(path, diagnostics);
  if (!text) return;
  const auto file = std::make_shared<const std::string>(path);
  text::Diagnostics said;
  text::parseJson(*text, file, said);
  diagnostics.append(said);
  if (said.hasErrors()) return;
  const std::string laid =
      text::layoutJson(*text, {.packed = {"set"}, .starts = {"read", "write", "modify"}});
  if (laid == *text) return;
  if (checkOnly) {
    const auto same = std::ranges::mismatch(*text, laid).in1;
    const auto line = static_cast<std::uint32_t>(1 + std::count(text->begin(), same, '\n'));
    diagnostics
        .error(text::Code::laidOutDifferently, {file, line, 1},
               "the file is not laid out as `weft format` does it")
        .hint = "weft format " + path;
  } else if (text::writeFile(path, laid, diagnostics)) {
    print(text::printable(path) + "\n");
  }
}

struct FormatOptions {
  std::vector<std::string> files;
  bool checkOnly = false;
};

int runFormat(FormatOptions& options) {
  text::Diagnostics diagnostics;
  for (const std::string& file : options.files) formatFile(file, options.checkOnly, diagnostics);
  return report(diagnostics);
}

}  // namespace

void addFormat(CommandLine& line) {
  const auto [command, options] =
      line.add("format", "format graph files, overlays and presets in place; comments are kept", runFormat);
  addPath(command, "file", options.files, "JSON files")->required();
  command.add_flag("--check", options.checkOnly,
                   "write nothing; exit 1 and name the first line that differs");
}

}  // namespace weft::app
