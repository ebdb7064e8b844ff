// The stanzas of a graph and of all that it includes, with their full names.
#pragma once

#include <string>

#include "engine/graph/desc.h"

namespace weft::graph {

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
