#include "engine/graph/expand/names/model.h"

#include <fmt/format.h>

#include <algorithm>

namespace weft::graph::expansion {

std::string Called::text() const {
  return named_ ? fmt::format(fmt::runtime(words_), name_) : std::string(words_);
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
