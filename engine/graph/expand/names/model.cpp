#include "engine/graph/expand/names/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/limits.h"
#include "engine/graph/language/enough.h"

namespace weft::graph::expansion {

bool isOver(const Model& model) {
  return model.stopped || enoughErrors(model.diagnostics);
}

void stopAt(Model& model, const Where& place, std::string message, std::uint64_t bound, const char* counts) {
  if (!std::exchange(model.stopped, true))
    base::reportLimit(model.diagnostics, place, std::move(message), bound, counts);
  model.incomplete = true;
}

Descent::Descent(Model& model, const Place& place, std::string_view label, bool quiet) : depth_(model.depth) {
  ++depth_;
  if (good() || quiet) return;
  model.incomplete = true;
  if (std::exchange(model.stopped, true)) return;
  auto& d = model.diagnostics.error(
      Code::limitExceeded, place,
      fmt::format("definitions depend on each other in too long a row, which ends at '{}'", label));
  d.expected = fmt::format("at most {} in a row", kMost);
  d.hint = "let some of them use fewer others";
}

std::string cyclePath(const Model& model, const std::string& again) {
  std::string path;
  auto at = std::find(model.evaluating.begin(), model.evaluating.end(), again);
  for (; at != model.evaluating.end(); ++at) path += *at + " -> ";
  return path + again;
}

base::Diagnostic& reportCycle(Model& model, const Place& place, std::string message) {
  base::Diagnostic& d = model.diagnostics.error(Code::dependsOnItself, place, std::move(message));
  d.hint = "one of them must not refer to the next";
  return d;
}

std::string numberText(double x) {
  return toText(Value::number(x));
}

}  // namespace weft::graph::expansion
