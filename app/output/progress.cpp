#include "app/output/progress.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "app/output/standard_streams.h"

namespace weft::app {

std::string durationText(double seconds) {
  if (seconds < 10) return fmt::format("{:.1f} s", std::max(0.0, seconds));
  if (seconds < 90) return fmt::format("{:.0f} s", seconds);
  return seconds < 5400 ? fmt::format("{:.0f} min", seconds / 60) : fmt::format("{:.1f} h", seconds / 3600);
}

std::string progressText(const Progress& p) {
  std::string text = fmt::format("{}/{} {}", p.done, p.total, p.unit);
  if (p.done >= p.total) return text + " in " + durationText(p.seconds);
  if (p.lead > 0) text += fmt::format(", {} of them lead up to the first picture", p.lead);
  const double each = p.seconds / static_cast<double>(std::max<std::uint64_t>(1, p.done));
  return text + fmt::format(", {} left", durationText(each * static_cast<double>(p.total - p.done)));
}

void ProgressLines::countOne() {
  constexpr std::uint64_t kBarWidth = 40;
  constexpr double kPause = 10;  // seconds
  ++progress_.done;
  progress_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  const bool last = progress_.done == progress_.total, terminal = ::isatty(STDERR_FILENO) == 1;
  const std::size_t filled = progress_.done * kBarWidth / progress_.total;
  if (terminal)
    printError(fmt::format("\r[{}{}] {}\033[K{}", std::string(filled, '#'),
                           std::string(kBarWidth - filled, '.'), progressText(progress_), last ? "\n" : ""));
  if (terminal || (progress_.seconds - printed_ < kPause && !(last && printed_ > 0))) return;
  printError(progressText(progress_) + "\n");
  printed_ = progress_.seconds;
}

}  // namespace weft::app
