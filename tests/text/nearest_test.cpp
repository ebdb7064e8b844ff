#include "engine/text/nearest.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cctype>
#include <limits>
#include <random>

using namespace weft::text;

TEST_CASE("edit distance counts swaps once") {
  CHECK(editDistance("depth", "dpeth", 9) == 1);
  CHECK(editDistance("", "abc", 9) == 3);
  CHECK(editDistance("Scene", "scene", 9) == 0);
}

TEST_CASE("nearest name, or the list when nothing is near") {
  const std::vector<std::string> names = {"scene", "glow", "ldr"};
  CHECK(nearestName("scne", names) == "scene");
  CHECK(nearestName("velocity", names).empty());
  CHECK(nearestHint("glwo", names) == "did you mean 'glow'?");
  CHECK(nearestHint("velocity", names) == "known: scene, glow, ldr");
}

TEST_CASE("two edits make another word of a short name") {
  CHECK(nearestName("mul", {{"all"}}).empty());
  CHECK(nearestName("round", {{"count"}}).empty());
  CHECK(nearestName("lerp", {{"exp"}}).empty());
  CHECK(nearestName("D32", {{"r32f"}}).empty());
  CHECK(nearestName("gllow", {{"glow"}}) == "glow");
  CHECK(nearestName("lrde", {{"ldr"}}) == "ldr");
}

TEST_CASE("names that are as near are all offered") {
  const std::vector<std::string> formats = {"rgba8", "rgba16", "rgba16f", "r8"};
  CHECK(weft::text::nearestHint("rgba16q", formats) == "did you mean 'rgba16' or 'rgba16f'?");
}

namespace {

// By the definition: the whole table, every candidate.
std::size_t wholeDistance(const std::string& a, const std::string& b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  const auto same = [&](std::size_t i, std::size_t j) { return std::tolower(a[i]) == std::tolower(b[j]); };
  for (std::size_t i = 0; i <= a.size(); ++i)
    for (std::size_t j = 0; j <= b.size(); ++j) {
      if (i == 0 || j == 0) {
        d[i][j] = i + j;
        continue;
      }
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i - 1, j - 1) ? 0 : 1)});
      if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1))
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

std::string wholeNearest(const std::string& name, const std::vector<std::string>& candidates) {
  std::size_t best = std::numeric_limits<std::size_t>::max();
  std::string found;
  for (const std::string& candidate : candidates)
    if (const std::size_t distance = wholeDistance(name, candidate);
        distance < best && (distance < 2 || name.size() > 5 || candidate.empty() ||
                            std::tolower(name[0]) == std::tolower(candidate[0]))) {
      best = distance;
      found = candidate;
    }
  return best <= std::max<std::size_t>(2, name.size() / 3) && best < name.size() ? found : "";
}

}  // namespace

TEST_CASE("distances within a limit, and nearest names, are those of the whole table") {
  std::mt19937 random(7);
  const auto text = [&](std::size_t longest) {
    std::string out(random() % (longest + 1), ' ');
    for (char& c : out) c = "abcAB_1."[random() % 8];
    return out;
  };
  for (int i = 0; i < 20000; ++i) {
    const std::string a = text(14), b = text(14);
    CAPTURE(a);
    CAPTURE(b);
    const std::size_t whole = wholeDistance(a, b), limit = random() % 16;
    CHECK(editDistance(a, b, 14) == whole);
    CHECK((whole <= limit ? editDistance(a, b, limit) == whole : editDistance(a, b, limit) > limit));
  }
  for (int i = 0; i < 3000; ++i) {
    std::vector<std::string> names(20);
    for (std::string& name : names) name = text(10);
    const std::string name = text(12);
    CAPTURE(name);
    CHECK(nearestName(name, names) == wholeNearest(name, names));
  }
}

TEST_CASE("a name longer than any has no nearest one, and nothing is compared with it") {
  const std::vector<std::string> names{std::string(10'000'000, 'x') + "y"};
  CHECK(nearestName(std::string(10'000'000, 'x'), names).empty());
  CHECK(nearestName("scene", names).empty());
  CHECK(nearestName(std::string(kLongestName, 'x'),
                    std::vector<std::string>{std::string(kLongestName + 1, 'x')})
            .size() == kLongestName + 1);
  CHECK(nearestName(std::string(kLongestName + 1, 'x'),
                    std::vector<std::string>{std::string(kLongestName, 'x')})
            .empty());
}

TEST_CASE("names as they are get their hints, a thousand against a thousand") {
  std::vector<std::string> names, wrong;
  for (int i = 0; i < 1000; ++i) {
    names.push_back("lighting.material_" + std::to_string(i * 7919));
    wrong.push_back("lighting.mateiral_" + std::to_string(i * 7919));
  }
  for (int i = 0; i < 1000; ++i)
    CHECK(nearestName(wrong[static_cast<std::size_t>(i)], names) == names[static_cast<std::size_t>(i)]);
}
