// How two pictures differ: byte by byte, and to a person who flips between them, as LDR FLIP. Andersson, Nilsson, Akenine-Möller,
// Oskarsson, Åström, Fairchild: "FLIP: A Difference Evaluator for Alternating Images", Proceedings of the ACM on Computer Graphics
// and Interactive Techniques 3(2), 2020. Every pixel gets an error from 0 (looks the same) to 1. Alpha is not looked at.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/assets/images/image.h"

namespace weft::assets {

struct Comparison {
  bool sameShape = false;    // width, height and channels agree; everything below is 0 when they do not
  double maxDifference = 0;  // of any component
  std::size_t differingPixels = 0;  // with a component that differs by more than the tolerance
  int worstX = 0, worstY = 0;       // where maxDifference is; y counts from the top
  bool equal() const { return sameShape && maxDifference == 0; }
};

Comparison compareImages(const Image8& a, const Image8& b, double tolerance = 0);

// Pixels per degree of visual angle: a screen of 3840 pixels and 0.7 m width, seen from 0.7 m, as in the paper.
constexpr double kFlipPixelsPerDegree = 67.02064327658226;

struct FlipMap {
  int width = 0, height = 0;  // 0 when the pictures have different shapes
  std::vector<float> errors;  // per pixel, top row first
};

struct FlipSummary {
  double mean = 0, peak = 0;
  int x = 0, y = 0;  // of the peak, from the upper left
};

// Compares sRGB pictures with 3 or 4 channels.
FlipMap computeFlip(const Image8& reference, const Image8& test,
                    double pixelsPerDegree = kFlipPixelsPerDegree);

// Over the pixels whose weight is not 0; an empty `weights` means all of them.
FlipSummary summarizeFlip(const FlipMap& map, const std::vector<std::uint8_t>& weights = {});

// The errors as colors whose lightness rises evenly: black for 0, purple, orange, pale yellow for 1 (the color map "magma" of
// matplotlib, by a polynomial). 3 channels.
Image8 colorFlip(const FlipMap& map);

}  // namespace weft::assets
