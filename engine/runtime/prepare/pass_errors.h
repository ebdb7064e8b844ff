// Reports the errors of one pass: each names the pass, and any() tells whether there was one. Checks of a pass derive from it.
#pragma once

#include <string>
#include <utility>

#include "engine/base/diagnostic.h"

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
  bool any() const { return any_; }

 private:
  const std::string& pass_;
  base::Diagnostics& diagnostics_;
  bool any_ = false;
};

}  // namespace weft::runtime
