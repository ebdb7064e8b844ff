#include "app/output/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace weft::app {

namespace {

constexpr int kBarWidth = 40;
constexpr double kMinute = 60, kHour = 60 * kMinute, kDay = 24 * kHour;

// "2 h 13 min": the whole ones of the greater unit, and the rest rounded down to the smaller one.
std::string twoUnits(double seconds, double greater, const char* name, double smaller,
                     const char* smallerName) {
  const double whole = std::floor(seconds / greater),
               rest = std::floor((seconds - whole * greater) / smaller);
  return rest > 0 ? fmt::format("{:.0f} {} {:.0f} {}", whole, name, rest, smallerName)
                  : fmt::format("{:.0f} {}", whole, name);
}

// "12/501 frames, 2 h 13 min left".
std::string countText(const Progress& p) {
  std::string text = fmt::format("{}/{} {}", p.done, p.total, p.unit);
  if (p.lead > 0 && p.done < p.total)
    text += fmt::format(", {} of them lead up to the first picture", p.lead);
  if (p.done > 0 && p.done < p.total)
    text += fmt::format(", {} left", durationText(p.seconds / static_cast<double>(p.done) *
                                                  static_cast<double>(p.total - p.done)));
  if (p.done == p.total) text += fmt::format(" in {}", durationText(p.seconds));
  return text;
}

}  // namespace

std::string durationText(double seconds) {
  if (!(seconds > 0)) return "0 s";
  if (seconds < 10) return fmt::format("{:.1f} s", seconds);
  if (seconds < 1.5 * kMinute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 10 * kMinute) return twoUnits(seconds, kMinute, "min", 1, "s");
  if (seconds < kHour) return fmt::format("{:.0f} min", std::floor(seconds / kMinute));
  if (seconds < 2 * kDay) return twoUnits(seconds, kHour, "h", kMinute, "min");
  return twoUnits(seconds, kDay, "days", kHour, "h");
}

std::string progressText(const Progress& p) {
  const auto filled = static_cast<std::size_t>(p.done * kBarWidth / std::max<std::uint64_t>(1, p.total));
  return fmt::format("[{}{}] {}", std::string(filled, '#'), std::string(kBarWidth - filled, '.'),
                     countText(p));
}

std::string ProgressLines::after(const Progress& p) {
  const bool last = p.done == p.total;
  if (terminal_) return fmt::format("\r{}\033[K{}", progressText(p), last ? "\n" : "");
  if (!last && p.seconds - last_ < kPause) return {};
  last_ = p.seconds;
  return countText(p) + "\n";
}

}  // namespace weft::app
