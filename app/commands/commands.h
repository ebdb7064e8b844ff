// One function per command, which adds it with its options to the command line.
#pragma once

#include <string>

#include "app/session/command_line.h"
#include "engine/text/diagnostic.h"

namespace weft::app {

void addRender(CommandLine& line);
void addDump(CommandLine& line);
void addCheck(CommandLine& line);
void addPlan(CommandLine& line);
void addExplain(CommandLine& line);
void addDiff(CommandLine& line);
void addReport(CommandLine& line);
void addTest(CommandLine& line);
void addAblate(CommandLine& line);
void addFuzz(CommandLine& line);
void addNew(CommandLine& line);
void addParams(CommandLine& line);
void addPresets(CommandLine& line);
void addFormat(CommandLine& line);
void addImport(CommandLine& line);
void addSchema(CommandLine& line);
void addTypes(CommandLine& line);
void addBench(CommandLine& line);

// What `weft check` says of a graph; of its shaders as much as can be said without OpenGL where there is none.
text::Diagnostics checkGraph(const std::string& path);

}  // namespace weft::app
