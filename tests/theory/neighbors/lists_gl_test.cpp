// The lists of graphs/neighbors.json, made with a grid and without one, against all pairs of spheres.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/theory/lab.h"

namespace neighbors_lists_test {

using namespace weft;
using namespace weft::theory;

namespace {

constexpr std::size_t kMost = 48, kCandidates = 120, kAcross = 64;
constexpr double kHidden = 0.03, kClose = 4e-3, kRounding = 1e-6;

struct Entry {
  glm::vec3 center{0};
  float radius = 0;
  float albedo = 0;
  double left = 0, roughness = 0, metallic = 0;
};

// Half the share, then whole steps: 128 of roughness for each of metallic.
void unpack(float matter, Entry& entry) {
  const double whole = std::floor(double(matter));
  entry.left = 2 * (double(matter) - whole);
  entry.metallic = std::floor(whole / 128) / 15;
  entry.roughness = std::fmod(whole, 128) / 127;
}

std::vector<Entry> readList(const Picture& lists, std::size_t row) {
  std::vector<Entry> list;
  for (std::size_t i = 0; i < kMost; ++i) {
    const auto x = static_cast<std::uint32_t>((row % kAcross) * 2 * kMost + 2 * i);
    const auto y = static_cast<std::uint32_t>(row / kAcross + 1);
    const float *ball = lists.at(x, y), *light = lists.at(x + 1, y);
    if (ball[3] <= 0) break;
    list.push_back({.center = {ball[0], ball[1], ball[2]}, .radius = ball[3], .albedo = light[0]});
    unpack(light[3], list.back());
  }
  return list;
}

struct Candidate {
  const Ball* ball = nullptr;
  std::size_t row = 0;
  double sine = 0, distance = 0, left = 1;
  glm::dvec3 direction{0};
};

// How much of a cap of half angle b one of half angle a covers: smooth between touching and covering.
double overlap(double a, double b, double apart) {
  const double most = a >= b ? 1 : (1 - std::cos(a)) / (1 - std::cos(b));
  const double x = std::clamp((a + b - apart) / (a + b - std::abs(a - b)), 0.0, 1.0);
  return most * x * x * (3 - 2 * x);
}

std::vector<Candidate> bruteList(const std::vector<Ball>& balls, std::size_t self, double reach) {
  std::vector<Candidate> all;
  const double own = double(balls[self].radius);
  for (std::size_t i = 0; i < balls.size(); ++i) {
    if (i == self) continue;
    const glm::dvec3 to = glm::dvec3(balls[i].center) - glm::dvec3(balls[self].center);
    const double distance = glm::length(to), radius = double(balls[i].radius);
    if (distance >= reach * radius + own) continue;
    if (distance + std::min(radius, own) <= std::max(radius, own)) continue;
    all.push_back({.ball = &balls[i],
                   .row = i,
                   .sine = std::min(radius / distance, 1.0),
                   .distance = distance,
                   .direction = to / distance});
  }
  std::ranges::sort(all, [](const Candidate& a, const Candidate& b) {
    return a.sine != b.sine ? a.sine > b.sine : a.row < b.row;
  });
  if (all.size() > kCandidates) all.resize(kCandidates);
  for (Candidate& each : all)
    for (const Candidate& other : all)
      if (other.distance < each.distance * 0.999999)
        each.left *= 1 - overlap(std::asin(other.sine), std::asin(each.sine),
                                 std::acos(std::clamp(glm::dot(each.direction, other.direction), -1.0, 1.0)));
  return all;
}

Setup labOf(std::vector<Ball> balls, const char* reach, bool grid) {
  return {.graph = "tests/theory/neighbors/neighbors.json",
          .sets = {{"neighbors.reach", reach}, {"neighbors.grid_from", grid ? "1" : "65537"}},
          .balls = std::move(balls)};
}

std::vector<Ball> randomBalls(int count, float side, float least, float most, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> place(-side, side), share(0, 1);
  std::vector<Ball> balls;
  for (int i = 0; i < count; ++i)
    balls.push_back({.center = {place(random), place(random), place(random)},
                     .radius = least * std::pow(most / least, share(random)),
                     .albedo = glm::vec3(share(random)),
                     .metallic = share(random),
                     .roughness = share(random)});
  return balls;
}

// Checks every `step`-th list.
void checkListsOf(bool grid, const std::vector<Ball>& balls, std::size_t step, double reach) {
  CAPTURE(grid);
  Lab lab(labOf(balls, std::to_string(reach).c_str(), grid));
  lab.frame();
  CHECK((lab.passNames().find("neighbor_grid") != std::string::npos) == grid);
  const Picture lists = lab.read("neighbors.lists");
  CHECK(double(lists.at(0, 0)[0]) == reach);
  std::size_t entries = 0, wrong = 0;
  for (std::size_t self = 0; self < balls.size(); self += step) {
    CAPTURE(self);
    const std::vector<Entry> list = readList(lists, self);
    const std::vector<Candidate> brute = bruteList(balls, self, reach);
    std::size_t matched = 0;
    double before = 2;
    for (const Entry& entry : list) {
      const auto same = std::ranges::find_if(brute, [&](const Candidate& c) {
        return c.ball->center == entry.center && c.ball->radius == entry.radius;
      });
      const bool fits = same != brute.end() && same->ball->albedo.x == entry.albedo &&
                        std::abs(same->left - entry.left) < kClose &&
                        std::abs(double(same->ball->roughness) - entry.roughness) < 0.0041 &&
                        std::abs(double(same->ball->metallic) - entry.metallic) < 0.0341 &&
                        same->sine < before * (1 + kRounding);
      fits ? ++matched : ++wrong;
      if (same != brute.end()) before = same->sine;
    }
    // What is missing is hidden, or narrower than all of a full list.
    for (const Candidate& each : brute) {
      if (each.left < kHidden + kClose) continue;
      if (list.size() == kMost && each.sine < before * (1 + kRounding)) continue;
      if (std::ranges::none_of(list, [&](const Entry& e) { return e.center == each.ball->center; })) ++wrong;
    }
    entries += matched;
  }
  MESSAGE(balls.size(), " spheres: ", entries, " entries");
  CHECK(wrong == 0);
  CHECK((balls.size() == 1 || entries > 0));
  CHECK(lab.reports() == "");
}

void checkLists(const std::vector<Ball>& balls, std::size_t step, double reach = 8) {
  checkListsOf(true, balls, step, reach);
  if (balls.size() < 1000) checkListsOf(false, balls, step, reach);
}

}  // namespace

TEST_CASE(
    "neighbors: the grid's lists are those of all pairs, for one sphere, two, a hundred and ten thousand") {
  checkLists(randomBalls(1, 1, 1, 1, 1), 1);
  checkLists({{.center = {0, 0, 0}}, {.center = {2.5f, 0, 0}}}, 1);
  checkLists(randomBalls(100, 8, 0.3f, 1.2f, 2), 1);
  checkLists(randomBalls(100, 8, 0.3f, 1.2f, 2), 1, 3);
  checkLists(randomBalls(10000, 40, 0.4f, 0.8f, 3), 37);
}

TEST_CASE(
    "neighbors: spheres of very different sizes, flat scenes and crowds in one cell give all pairs' lists, "
    "too") {
  std::vector<Ball> sizes = randomBalls(200, 10, 0.01f, 1, 4);
  sizes.push_back({.center = {0, -1010, 0}, .radius = 1000});
  sizes.push_back({.center = {30, 0, 0}, .radius = 15});
  checkLists(sizes, 1);

  std::vector<Ball> flat = randomBalls(150, 12, 0.5f, 0.6f, 5);
  for (Ball& ball : flat) ball.center.y = 3;
  checkLists(flat, 1);

  // All but one in one cell, and more than a list holds: the widest are in it.
  std::vector<Ball> crowd = randomBalls(300, 1, 0.02f, 0.03f, 6);
  crowd.push_back({.center = {5000, 0, 0}, .radius = 0.02f});
  checkLists(crowd, 1, 40);
}

TEST_CASE("neighbors: the studio makes lists of up to 65,536 spheres, and none of more or of no spheres") {
  for (const int count : {0, 1, 65536, 65537}) {
    CAPTURE(count);
    const Setup setup{.graph = "graphs/studio.json",
                      .width = 16,
                      .height = 16,
                      .sets = {{"occlusion", "true"}},
                      .balls = randomBalls(count, 100, 0.1f, 0.2f, 7)};
    const Lab lab(setup);
    const bool listed = lab.passNames().find("neighbors.neighbor_lists") != std::string::npos;
    CHECK(listed == (count >= 1 && count <= 65536));
  }
}

}  // namespace neighbors_lists_test
