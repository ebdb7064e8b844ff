#include "app/ui/log.h"

#include <algorithm>
#include <utility>

namespace weft::app::ui {

void Log::set(Topic topic, std::vector<text::Diagnostic> items) {
  topics_[topic] = {std::move(items), ++calls_, false};
}

void Log::addPast(const text::Diagnostics& diagnostics) {
  List& past = topics_[kPast];
  for (const text::Diagnostic& each : diagnostics.items()) {
    const auto same = [&](const text::Diagnostic& old) {
      return old.code == each.code && old.message == each.message;
    };
    if (std::ranges::any_of(past.items, same)) continue;
    past.items.push_back(each);
    past.said = ++calls_;
  }
  if (past.items.size() <= 100) return;
  const std::size_t old = past.items.size() - 100;
  past.items.erase(past.items.begin(), past.items.begin() + static_cast<std::ptrdiff_t>(old));
  dismissedPast_ -= std::min(dismissedPast_, old);
}

void Log::dismiss() {
  for (List& list : topics_) list.dismissed = true;
  dismissedPast_ = topics_[kPast].items.size();
}

std::size_t Log::errors() const {
  const auto isError = [](const text::Diagnostic* each) { return each->severity == text::Severity::error; };
  return static_cast<std::size_t>(std::ranges::count_if(shown(true), isError));
}

std::vector<const text::Diagnostic*> Log::shown(bool all) const {
  std::array<std::size_t, kTopicCount> order = {kFiles, kEnvironment, kChange, kPast};
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return topics_[a].said > topics_[b].said; });
  const auto isError = [](const text::Diagnostic& each) { return each.severity == text::Severity::error; };
  std::vector<const text::Diagnostic*> out;
  for (const std::size_t topic : order) {
    const List& list = topics_[topic];
    if (topic == kPast) {
      for (std::size_t i = list.items.size(); all && i-- > dismissedPast_;) out.push_back(&list.items[i]);
      continue;
    }
    const bool urgent = topic != kEnvironment || std::ranges::any_of(list.items, isError);
    if (list.dismissed || (!all && !urgent)) continue;
    for (const text::Diagnostic& each : list.items) out.push_back(&each);
  }
  std::ranges::stable_sort(out, [](const auto* a, const auto* b) { return a->severity > b->severity; });
  return out;
}

}  // namespace weft::app::ui
