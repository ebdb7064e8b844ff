// The errors of one pass: each names it, and whether there was any is kept. What a check of a pass derives from.
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

  // To be filled in further by the caller.
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
