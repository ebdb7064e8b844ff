// One function per command, which adds it with its options to the command line.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/session/command_line.h"
#include "app/session/session.h"
#include "engine/text/printable.h"

namespace weft::app {

void addRender(CommandLine& line);
void addDump(CommandLine& line);
void addCheck(CommandLine& line);
void addPlan(CommandLine& line);
void addExplain(CommandLine& line);
void addDiff(CommandLine& line);
void addReport(CommandLine& line);
void addTest(CommandLine& line);
void addFuzz(CommandLine& line);
void addFarm(CommandLine& line);
void addNew(CommandLine& line);
void addParams(CommandLine& line);
void addPresets(CommandLine& line);
void addFormat(CommandLine& line);
void addImport(CommandLine& line);
void addSchema(CommandLine& line);
void addTypes(CommandLine& line);

// Draws one or two `sides`, writes the page of `weft report` to `path` and says on it that `command` made it. Milliseconds of each step are
// medians over `repeats` frames; 0: no times. False after errors.
bool writeFramePage(gl::Context& context, const std::string& command, std::span<const Options> sides,
                    std::uint32_t repeats, const std::string& path, runtime::World& world,
                    text::Diagnostics& diagnostics);

// What `weft check` says of a graph; of its shaders as much as can be said without OpenGL where there is none.
text::Diagnostics checkGraph(const std::string& path);

}  // namespace weft::app
