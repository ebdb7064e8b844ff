// What can be known of an open shutter from one sharp picture, by a judge that needs no shader: he knows where every sphere is at every moment.
// At each moment he takes what is at the center of a pixel, and asks whether that point is visible in the one picture. Where it is not, he
// guesses: the nearest point of the same sphere, or of the same sky, that is visible and one pixel away from everything else.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "tests/theory/lab.h"
#include "tests/theory/lens/compare.h"

namespace weft::theory {

class OnePicture {
 public:
  // As all is at the moment of the picture; the balls move on from there. `picture`: row 0 at the bottom.
  OnePicture(std::vector<Ball> balls, const scene::CameraKey& camera, std::uint32_t width,
             std::uint32_t height, Radiance picture);
  // A moment, `seconds` after the picture, that counts by `weight`. `sharp` is the picture of that moment.
  void add(double seconds, const scene::CameraKey& camera, const Picture& sharp, double weight);

  // Sums over the moments, with the same guesses. What is visible has the color of that moment, ...
  const Radiance& withTrueColors() const { return true_colors_; }
  // ... or that of the picture's nearest texel. That is what a gather can do that knows where everything is.
  const Radiance& withItsColors() const { return its_colors_; }
  double hidden() const { return hidden_; }  // share of pixels and moments

 private:
  struct View {
    glm::dvec3 eye, right, up, ahead;
    double focal;  // pixels
  };
  struct Hit {
    int ball;             // -1: the sky
    double distance;      // in units of the ray's length
    glm::dvec3 position;  // of the sky: a direction
  };
  View viewOf(const scene::CameraKey& camera) const;
  glm::dvec3 rayOf(const View& view, glm::dvec2 pixel) const;
  // The balls as they lie `seconds` after the picture's moment.
  struct Target {
    glm::dvec3 to;
    double outside = 0;      // the distance squared, less the radius squared
    glm::dvec2 least, most;  // pixels beyond which no ray meets it
  };
  std::vector<Target> targetsFrom(const View& view, double seconds) const;
  static Hit hitOf(const std::vector<Target>& targets, glm::dvec3 eye, glm::dvec2 pixel, glm::dvec3 ray);
  bool isVisible(const Hit& hit, glm::dvec2& pixel) const;
  int guess(int ball, glm::dvec2 pixel) const;

  std::vector<Ball> balls_;
  int width_, height_;
  View view_;
  std::vector<Target> targets_;  // from the picture's eye, at its moment
  std::vector<int> balls_seen_;  // of each pixel; kMixed where a neighbor sees another
  struct Box {
    glm::ivec2 least, most;
  };
  std::map<int, Box> boxes_;  // around the pixels that have one ball, or the sky
  Radiance picture_, true_colors_, its_colors_;
  double hidden_ = 0;
};

}  // namespace weft::theory
