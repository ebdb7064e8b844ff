// Reports the errors of one pass: each names the pass, and any() tells whether there was one. Checks of a pass derive from it.
#pragma once

#include <algorithm>
#include <string>
#include <utility>

#include "engine/base/diagnostic.h"
#include "engine/graph/flat_graph.h"

namespace weft::runtime {

class PassErrors {
 public:
  // Both must outlive this.
  PassErrors(const std::string& pass, base::Diagnostics& diagnostics)
      : pass_(pass), diagnostics_(diagnostics) {}

  // The caller fills in the other fields.
  base::Diagnostic& fail(base::Code code, const base::Place& place, std::string message) {
    any_ = true;
    base::Diagnostic& d = diagnostics_.error(code, place, std::move(message));
    d.pass = pass_;
    return d;
  }
  // The same where another pass has the shader, and it was said of that: then null, for the mistake is in one place.
  base::Diagnostic* failOnce(const graph::FlatGraph& graph, base::Code code, const base::Place& place,
                             std::string message, std::string hint) {
    const auto specOf = [&](const std::string& pass) {
      return std::ranges::find(graph.specs, pass, &graph::PassSpec::name);
    };
    const auto own = specOf(pass_);
    for (const base::Diagnostic& said : diagnostics_.items()) {
      if (said.code != code || said.message != message || said.hint != hint) continue;
      const auto other = specOf(said.pass);
      if (other == graph.specs.end() || other->shader != own->shader ||
          other->vertexShader != own->vertexShader)
        continue;
      any_ = true;
      return nullptr;
    }
    base::Diagnostic& d = fail(code, place, std::move(message));
    d.hint = std::move(hint);
    return &d;
  }
  bool any() const { return any_; }

 private:
  const std::string& pass_;
  base::Diagnostics& diagnostics_;
  bool any_ = false;
};

}  // namespace weft::runtime
