// Highlights out of focus that move slowly over the picture, across its tiles, alone, beside many others, and past something nearer: in each of
// 48 frames they are the aperture's outline as far as the lens sees it, with the same light, and no frame looks unlike the one before.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/theory/lens/thin_lens.h"

namespace lens_glide_test {

using namespace weft::theory;

namespace {

constexpr std::uint32_t kWidth = 160, kHeight = 120, kFrames = 48;
constexpr int kSame = 4;  // frames after which the lights have moved by whole pixels
// Tiles are 32 pixels wide; the lights cross a border of them along x and one along y.
constexpr double kStartX = 84.3, kStartY = 57.4, kRight = 0.5, kUp = 0.25;
constexpr double kBlack = 45;  // radius in pixels of the black ball in which lights are half sunk

struct Glide {
  std::string name;
  bool near = false;
  double diameter = 20;
  int blades = 0;
  double passing = 0;  // distance of a thing that does not move; 0: none
  int columns = 1;     // lights
  double apart = 13;   // pixels between them
  double light = 1.6;  // radius of a light in pixels
  double from =
      0;  // distance at which it begins, to move away along the line of sight and end at 60; 0: it moves across
  double radiance = 20000, around = 0;  // of the lights, and of the ball in which they are half sunk
};

// The black ball that stands in the way, beside the middle of the light's path. The middle of the lens always sees the light, because what it does not
// see no picture knows of.
Blocker blockerOf(const Glide& glide, const ThinLens& lens) {
  const double pixel = lens.unitsPerPixel(glide.passing), radius = 20;
  const glm::dvec2 step(kRight, kUp), beside = glm::dvec2(-kUp, kRight) / glm::length(step);
  const glm::dvec2 at = glm::dvec2(kStartX - kWidth / 2.0, kStartY - kHeight / 2.0) + step * (kFrames / 2.0) +
                        beside * (radius + glide.light + 2.5);
  return {glm::dvec3(at * pixel, glide.passing), radius * pixel};
}

std::vector<glm::dvec2> lightsOf(const Glide& glide) {
  std::vector<glm::dvec2> lights;
  for (int y = 0; y < glide.columns; ++y)
    for (int x = 0; x < glide.columns; ++x)
      lights.emplace_back(
          kStartX - kWidth / 2.0 - 0.5 * glide.apart * (glide.columns - 1) + glide.apart * x,
          kStartY - kHeight / 2.0 - 0.5 * glide.apart * (glide.columns - 1) + glide.apart * y);
  return lights;
}

Setup setupOf(const Glide& glide, const ThinLens& lens) {
  Setup setup{.graph = "tests/theory/lens/lens.json", .width = kWidth, .height = kHeight};
  setup.sets = lens.sets();
  const double pixel = lens.unitsPerPixel(lens.distance);
  const double away = glide.from > 0 ? lens.distance - glide.from : 0;
  const glm::dvec3 step =
      glide.from > 0 ? glm::dvec3(0, 0, -away / kFrames) : glm::dvec3(kRight, kUp, 0) * pixel;
  const glm::vec3 velocity(step * 60.0);
  const double black = kBlack * pixel;
  const glm::dvec3 middle((kStartX - kWidth / 2.0) * pixel, (kStartY - kHeight / 2.0) * pixel,
                          20 - lens.distance + away - black);
  for (const glm::dvec2& light : lightsOf(glide)) {
    setup.balls.push_back({.center = {light * pixel, 20 - lens.distance + away},
                           .radius = float(glide.light * pixel),
                           .albedo = glm::vec3(float(glide.radiance)),
                           .velocity = velocity});
  }
  setup.balls.push_back({.center = middle,
                         .radius = float(black),
                         .albedo = glm::vec3(float(glide.around)),
                         .velocity = velocity});
  if (glide.passing > 0) {
    const Blocker blocker = blockerOf(glide, lens);
    setup.balls.push_back({.center = {blocker.center.x, blocker.center.y, 20 - blocker.center.z},
                           .radius = float(blocker.radius),
                           .albedo = {0, 0, 0}});
  }
  return setup;
}

struct Course {
  double least_overlap = 1;  // intersection over union of the pixels brighter than half of the plateau
  double most_drop = 0;      // the same of pixels by their shares, how far a frame is below its neighbors
  double least_light = 1e9, most_light = 0;  // over what the lens lets through
  double largest_change = 0;  // of a frame from the same place before, summed over all pixels, over all light
  double largest_error = 0;   // of a frame from the ideal, likewise
};

Course courseOf(const Glide& glide) {
  const ThinLens last{.distance = glide.near ? 12.0 : 60.0,
                      .diameter = glide.diameter,
                      .height = kHeight,
                      .blades = glide.blades};
  std::vector<Blocker> blockers;
  if (glide.passing > 0) blockers.push_back(blockerOf(glide, last));
  Lab lab(setupOf(glide, last));
  std::vector<glm::dvec2> points;
  for (int y = -3; y <= 3; ++y)
    for (int x = -3; x <= 3; ++x)
      if (x * x + y * y <= 10) points.emplace_back(x * glide.light / 3.5, y * glide.light / 3.5);
  const std::vector<glm::dvec2> starts = lightsOf(glide);
  Course course;
  std::vector<double> overlaps;
  std::vector<std::vector<double>> differences;
  for (std::uint32_t frame = 0; frame < kFrames; ++frame) {
    lab.frame(frame);
    const Picture panels = lab.read("panels");
    CHECK(lab.reports() == "");
    ThinLens lens = last;
    glm::dvec2 moved(kRight * frame, kUp * frame);
    double larger = 1;
    if (glide.from > 0) {
      moved = {0, 0};
      lens.distance = glide.from + (last.distance - glide.from) * frame / kFrames;
      lens.diameter *= (1 - last.focus / lens.distance) / (1 - last.focus / last.distance);
      larger = last.distance / lens.distance;
    }
    const double area =
        M_PI * lens.diameter * lens.diameter / 4 *
        (glide.blades < 3 ? 1 : 0.5 * glide.blades * std::sin(2 * M_PI / glide.blades) / M_PI);
    std::vector<double> found(kWidth * kHeight), ideal(kWidth * kHeight);
    // The lights' light is that of the sharp picture: how true its edges are is not the lens's matter.
    double sharp = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) sharp += std::max(double(panels.at(x, y)[1]) - 1.0001, 0.0);
    const double plateau = sharp / (glide.columns * glide.columns) / area;
    double sum_found = 0, sum_ideal = 0, both = 0, either = 0, soft_both = 0, soft_either = 0, error = 0;
    for (std::uint32_t y = 0; y < kHeight; ++y)
      for (std::uint32_t x = 0; x < kWidth; ++x) {
        const std::size_t i = y * kWidth + x;
        bool near_a_light = false;
        for (const glm::dvec2& start : starts) {
          const glm::dvec2 light = start * larger + moved,
                           middle(x + 0.5 - kWidth / 2.0, y + 0.5 - kHeight / 2.0);
          if (glm::distance(light, middle) > glide.diameter / 2 + 6) continue;
          near_a_light = true;
          for (int k = 0; k < 4; ++k)
            for (const glm::dvec2& point : points)
              ideal[i] += arrives(lens, light + point * larger,
                                  middle + glm::dvec2(k % 2 - 0.5, k / 2 - 0.5) / 2.0, blockers) /
                          (4.0 * double(points.size()));
        }
        if (near_a_light) found[i] = (double(panels.at(kWidth + x, y)[1]) - glide.around) / plateau;
        sum_found += found[i];
        sum_ideal += ideal[i];
        both += found[i] > 0.5 && ideal[i] > 0.5;
        soft_both += std::min(found[i], ideal[i]);
        soft_either += std::max(found[i], ideal[i]);
        either += found[i] > 0.5 || ideal[i] > 0.5;
        error += std::abs(found[i] - ideal[i]);
      }
    course.least_overlap = std::min(course.least_overlap, both / either);
    overlaps.push_back(soft_both / soft_either);
    course.least_light = std::min(course.least_light, sum_found / sum_ideal);
    course.most_light = std::max(course.most_light, sum_found / sum_ideal);
    course.largest_error = std::max(course.largest_error, error / sum_ideal);
    for (std::size_t i = 0; i < found.size(); ++i) found[i] -= ideal[i];
    differences.push_back(std::move(found));
    if (frame >= kSame) {
      // What the ideal does not do by itself, from frame to frame: over whole pixels of motion.
      double change = 0;
      const std::size_t by =
          glide.from > 0 ? 0 : std::size_t(kRight * kSame) + kWidth * std::size_t(kUp * kSame);
      for (std::size_t i = by; i < ideal.size(); ++i)
        change += std::abs(differences[frame][i] - differences[frame - kSame][i - by]);
      course.largest_change = std::max(course.largest_change, change / sum_ideal);
    }
  }
  for (std::size_t i = 1; i + 1 < overlaps.size(); ++i)
    course.most_drop = std::max(course.most_drop, std::max(overlaps[i - 1], overlaps[i + 1]) - overlaps[i]);
  return course;
}

}  // namespace

TEST_CASE(
    "glide: highlights that move across tiles, and past nearer things, are the aperture's outline in every "
    "frame") {
  for (const Glide& glide :
       {Glide{.name = "far"}, Glide{.name = "near", .near = true}, Glide{.name = "far blades", .blades = 6},
        Glide{.name = "near blades", .near = true, .blades = 5}, Glide{.name = "small", .diameter = 9},
        Glide{.name = "growing", .diameter = 9, .from = 32},
        Glide{.name = "many", .diameter = 9, .columns = 3},
        Glide{.name = "crowd", .diameter = 13, .columns = 2, .apart = 17, .light = 3.5},
        Glide{.name = "dim", .radiance = 7, .around = 1},
        Glide{.name = "dim near", .near = true, .diameter = 13, .radiance = 12, .around = 1},
        Glide{.name = "far past far", .passing = 25}, Glide{.name = "far past near", .passing = 14},
        Glide{.name = "near past near", .near = true, .passing = 8.5},
        Glide{.name = "blades past far", .diameter = 28, .blades = 6, .passing = 30},
        Glide{.name = "blades past near", .near = true, .blades = 5, .passing = 9}}) {
    const Course course = courseOf(glide);
    CAPTURE(glide.name);
    CAPTURE(course.least_overlap);
    CAPTURE(course.largest_error);
    CHECK(course.least_light / course.most_light > 0.95);
    CHECK(course.most_light < 1.03);
    // Measured: 0.026. A light only seven times as bright as what is around it is partly left in the fields, more or less of it as it lies on their
    // texels: 0.050.
    CHECK(course.most_drop < (glide.around > 0 ? 0.055 : 0.05));
    // Measured: 0.06 behind the focus, 0.09 before it; 0.11 where discs grow from 5 to 9 pixels. Where what is nearer left discs at half size it was up to
    // 0.25, and the overlap from 0.53.
    CHECK(course.largest_change < (glide.from > 0 || glide.around > 0 ? 0.12 : glide.near ? 0.1 : 0.07));
    // Measured: 0.93, past a nearer thing 0.89; 0.81 below 6 pixels, where a pixel is a twentieth.
    CHECK(course.least_overlap > (glide.from > 0 ? 0.8 : glide.passing > 0 ? 0.88 : 0.92));
  }
}

}  // namespace lens_glide_test
