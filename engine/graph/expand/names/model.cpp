#include "engine/graph/expand/names/model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "engine/graph/language/enough.h"
#include "engine/text/limits.h"

namespace weft::graph::expansion {

bool isOver(const Model& model) {
  return model.stopped || enoughErrors(model.diagnostics);
}

void stopAt(Model& model, const Where& place, std::string message, std::uint64_t bound, const char* counts) {
  if (!std::exchange(model.stopped, true))
    text::reportLimit(model.diagnostics, place, std::move(message), bound, counts);
  model.incomplete = true;
}

bool report(Model& model, Code code, const Where& place, std::string message, Says says) {
  model.diagnostics.add({.code = code,
                         .message = std::move(message),
                         .place = place,
                         .pass = std::move(says.pass),
                         .resource = std::move(says.resource),
                         .expected = std::move(says.expected),
                         .found = std::move(says.found),
                         .hint = std::move(says.hint)});
  return false;
}

Evaluation::Evaluation(Model& model, Progress& state, std::string label, const Place& place,
                       std::string_view before, std::string_view after, std::size_t most)
    : model_(model) {
  auto& stack = model.evaluating;
  if (state == Progress::active) {
    const auto first = std::ranges::find(stack, label);
    report(model, Code::dependsOnItself, place,
           fmt::format("{}{}{}: {} -> {}", before, label, after,
                       fmt::join(std::ranges::subrange(first, stack.end()), " -> "), label),
           {.hint = "one of them must not refer to the next"});
    good_ = false;
  } else if (stack.size() >= most) {
    if (!std::exchange(model.stopped, true))
      report(model, Code::limitExceeded, place,
             fmt::format("definitions depend on each other in too long a row, which ends at {}", label),
             {.expected = fmt::format("at most {} in a row", kMost),
              .hint = "let some of them use fewer others"});
    model.incomplete = true;
    good_ = false;
  }
  state = good_ ? Progress::active : Progress::failed;
  if (good_) stack.push_back(std::move(label));
}

Evaluation::~Evaluation() {
  if (good_) model_.evaluating.pop_back();
}

}  // namespace weft::graph::expansion
