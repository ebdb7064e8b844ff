#include "app/trials/fuzz.h"

#include <fmt/format.h>

#include <algorithm>

namespace weft::app {

graph::CompileOptions FuzzTrial::compileOptions() const {
  return {.share = share, .orderSeed = seed, .orderFirst = first, .orderLast = last};
}

std::string FuzzTrial::arguments() const {
  std::string text = fmt::format("--seed {}", seed);
  if (seed != 0 && (first > 0 || last != ~0u)) text += fmt::format(" --order {}:{}", first, last);
  return text + fmt::format(" --share {} --poison {}", share ? "on" : "off",
                            poison ? runtime::nameOf(*poison) : "none");
}

FuzzTrial shrinkTrial(FuzzTrial trial, std::uint32_t passes,
                      const std::function<bool(const FuzzTrial&)>& differs) {
  const auto keepIf = [&](const FuzzTrial& smaller) {
    if (smaller == trial || !differs(smaller)) return false;
    trial = smaller;
    return true;
  };
  FuzzTrial smaller = trial;
  smaller.poison.reset();
  keepIf(smaller);
  smaller = trial;
  smaller.share = true;
  keepIf(smaller);
  smaller = trial;
  smaller.seed = 0;
  keepIf(smaller);
  if (trial.seed == 0 || passes == 0) return trial;
  // Narrows the range from both ends, by steps that halve.
  const std::uint32_t end = std::min(trial.last, passes - 1);
  for (std::uint32_t step = std::max(1u, (end - std::min(trial.first, end)) / 2);; step /= 2) {
    for (bool again = true; again;) {
      again = false;
      const std::uint32_t last = std::min(trial.last, passes - 1);
      smaller = trial;
      smaller.first = trial.first + step;
      if (smaller.first < last) again = keepIf(smaller);
      smaller = trial;
      smaller.last = last - std::min(step, last);
      if (smaller.last > trial.first) again = keepIf(smaller) || again;
    }
    if (step <= 1) return trial;
  }
}

}  // namespace weft::app
