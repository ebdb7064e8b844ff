// Writes what a person changed while a graph ran (values of parameters, disabled passes) into the files it came from. The
// edits are the smallest ones (engine/text/json/edit.h), planned on the texts as they were read. Before anything is saved
// they are proved: the edited texts, read and expanded without the changes, must give the graph that runs with them.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/expand/expand.h"
#include "engine/graph/registry.h"
#include "engine/text/diagnostic.h"

namespace weft::graph {

struct WriteBack {
  struct File {
    std::string path, before, after;
  };
  std::vector<File> files;  // those that change
  Settings rest;            // the settings with which the edited files give the same graph
};

// `desc` is what runs (read from its path with `presets`), `settings` what it runs with. A value goes where
// it comes from: into the `set` that decides it; else into a `set` of the last preset, or of the file itself
// when it extends another; else into the `default`, also of an included file; else into a `set` of the file
// itself. Disabled instances of repeats and disabled includes have no place in a file and stay in `rest`.
// Empty after W196: something cannot be written.
std::optional<WriteBack> planWriteBack(const GraphDesc& desc, std::span<const std::string> presets,
                                       const Registry& registry, const Settings& settings,
                                       text::Diagnostics& diagnostics);

// Replaces the files, each whole (W180). False, and no file is changed, after W195: one is not what it was when it was read.
bool saveWriteBack(const WriteBack& plan, text::Diagnostics& diagnostics);

// The stanzas of a graph and of all that it includes, with their full names.

// Calls visit(prefix of its names, file) for the graph and then for every file that it includes.
template <class Visit>
void eachFile(const GraphDesc& desc, const Visit& visit, const std::string& prefix = "") {
  visit(prefix, desc);
  for (const PassDesc& pass : desc.passes)
    if (pass.include && pass.include->graph)
      eachFile(*pass.include->graph, visit, prefix + pass.include->as + ".");
}

// Calls visit(full name, pass) for every pass and include of the graph and of what it includes.
template <class Visit>
void eachPass(const GraphDesc& desc, const Visit& visit) {
  eachFile(desc, [&](const std::string& prefix, const GraphDesc& file) {
    for (const PassDesc& pass : file.passes) visit(prefix + pass.name, pass);
  });
}

}  // namespace weft::graph
