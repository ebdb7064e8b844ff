#include "app/ui/log.h"

#include <algorithm>
#include <utility>

namespace weft::app::ui {

void Log::set(Topic topic, std::vector<text::Diagnostic> items) {
  std::erase_if(entries_, [&](const Entry& entry) { return entry.topic == topic; });
  ++calls_;
  for (text::Diagnostic& item : items) entries_.push_back({topic, calls_, std::move(item)});
}

void Log::addPast(const text::Diagnostics& diagnostics) {
  const auto isPast = [](const Entry& entry) { return entry.topic == kPast; };
  for (const text::Diagnostic& each : diagnostics.items()) {
    const auto same = [&](const Entry& old) {
      return isPast(old) && old.item.code == each.code && old.item.message == each.message;
    };
    if (std::ranges::none_of(entries_, same)) entries_.push_back({kPast, ++calls_, each});
    if (std::ranges::count_if(entries_, isPast) > 100) entries_.erase(std::ranges::find_if(entries_, isPast));
  }
}

std::size_t Log::errors() const {
  const auto isError = [](const text::Diagnostic* each) { return each->severity == text::Severity::error; };
  return static_cast<std::size_t>(std::ranges::count_if(shown(true), isError));
}

std::vector<const text::Diagnostic*> Log::shown(bool all) const {
  const bool failed = std::ranges::any_of(entries_, [](const Entry& entry) {
    return entry.topic == kEnvironment && entry.item.severity == text::Severity::error;
  });
  std::vector<const Entry*> chosen;
  for (const Entry& entry : entries_) {
    const bool urgent = entry.topic != kPast && (entry.topic != kEnvironment || failed);
    if (!entry.dismissed && (all || urgent)) chosen.push_back(&entry);
  }
  std::ranges::stable_sort(chosen, std::ranges::greater(),
                           [](const Entry* entry) { return std::pair(entry->item.severity, entry->said); });
  std::vector<const text::Diagnostic*> out;
  for (const Entry* entry : chosen) out.push_back(&entry->item);
  return out;
}

}  // namespace weft::app::ui
