#include "engine/text/message_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/text/limits.h"
#include "engine/text/nearest.h"

namespace weft::text {

namespace {

std::string countText(std::size_t count, const char* one, const char* many) {
  return count == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", count, many);
}

}  // namespace

std::uint64_t mostErrors() {
  return std::max<std::uint64_t>(1000, raised(kMaxMessages));
}

Diagnostics chooseMessages(const Diagnostics& all, bool notes) {
  Diagnostics sorted = all;
  sorted.sortByPlace();
  constexpr std::array kOrder{Severity::error, Severity::warning, Severity::note};
  std::array<std::size_t, 3> there{}, room{};
  for (const Diagnostic& each : sorted.items())
    if (notes || each.severity != Severity::note) ++there[static_cast<std::size_t>(each.severity)];
  std::size_t left = raised(kMaxMessages);
  for (const Severity severity : kOrder) {
    const auto i = static_cast<std::size_t>(severity);
    room[i] = std::min(there[i], left);
    left -= room[i];
  }
  std::array<std::size_t, 3> omitted{};
  for (std::size_t i = 0; i < 3; ++i) omitted[i] = there[i] - room[i];
  Diagnostics chosen;
  for (const Diagnostic& each : sorted.items()) {
    std::size_t& seats = room[static_cast<std::size_t>(each.severity)];
    if (seats == 0) continue;
    --seats;
    chosen.add(each);
  }
  const auto at = [&](Severity severity) { return omitted[static_cast<std::size_t>(severity)]; };
  if (const std::size_t rest = at(Severity::error) + at(Severity::warning) + at(Severity::note); rest > 0) {
    Diagnostic& d =
        chosen.add({.severity = Severity::note,
                    .code = Code::messagesLeftOut,
                    .message = fmt::format(
                        "{} left out: {}, {}, {}",
                        rest == 1 ? "1 further message is" : fmt::format("{} further messages are", rest),
                        countText(at(Severity::error), "error", "errors"),
                        countText(at(Severity::warning), "warning", "warnings"),
                        countText(at(Severity::note), "note", "notes")),
                    .place = {}});
    const std::string raise = hintToRaise(kMaxMessages);
    d.hint = raise.empty() ? "correct these first" : "correct these first, or " + raise;
  }
  if (all.errorCount() >= mostErrors())
    chosen
        .add({.severity = Severity::note,
              .code = Code::messagesLeftOut,
              .message = fmt::format("after {} errors no more were looked for", all.errorCount()),
              .place = {}})
        .hint = "correct these first; there may be many more";
  if (const std::size_t names = takeUncompared(); names > 0)
    chosen
        .add({.severity = Severity::note,
              .code = Code::messagesLeftOut,
              .message =
                  fmt::format("{} without a hint at the nearest one: too many names are unknown",
                              names == 1 ? "1 unknown name is" : fmt::format("{} unknown names are", names)),
              .place = {}})
        .hint = "correct the others first; the next run compares what is left";
  return chosen;
}

}  // namespace weft::text
