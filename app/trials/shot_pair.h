// The same frame of two graphs, or of two settings of one: both pictures, how they differ, and the first pass whose output
// does. Does not: print, or write files.
#pragma once

#include <optional>
#include <string>

#include "app/trials/divergence.h"
#include "app/trials/picture_difference.h"
#include "app/trials/shot.h"

namespace weft::app {

struct ShotPair {
  std::uint32_t frame = 0;
  Shot before, after;
  std::optional<Divergence> first;
  assets::FlipMap map;                          // empty when the pictures have different sizes
  std::optional<PictureDifference> difference;  // of pictures of one size

  const assets::Image8& pictureBefore() const { return before.pictures.at(frame); }
  const assets::Image8& pictureAfter() const { return after.pictures.at(frame); }
  // "pictures: FLIP 0.0123, …", "pictures: the same" or "pictures: of different sizes, 64x36 and 32x18"
  std::string pictureText() const;
};

// Empty after errors.
std::optional<ShotPair> shootPair(gl::Context& context, const Options& before, const Options& after,
                                  const runtime::World& world, std::uint32_t frame,
                                  base::Diagnostics& diagnostics);

}  // namespace weft::app
