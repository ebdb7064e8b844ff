// Whether the picture has come to rest, for idle mode: looks at it now and then until several looks in a row,
// spread over longer than any fade's slowest visible step, saw the same. Nobody has to list what may move:
// histories, fades, grain and animations all show. Does not: look; it says when to, and is told a hash.
#pragma once

#include <cstdint>

namespace weft::app {

class PictureRest {
 public:
  static constexpr double kBetweenLooks = 0.1;  // seconds
  static constexpr int kLooks = 5;

  // Something happened that may move the picture, even if it cannot be seen yet.
  void disturb() { same_ = 0; }
  bool resting() const { return same_ >= kLooks; }
  bool wantsLook(double now) const { return !resting() && (same_ == 0 || now - lookedAt_ >= kBetweenLooks); }
  void look(double now, std::uint64_t hash) {
    same_ = same_ > 0 && hash == hash_ ? same_ + 1 : 1;
    hash_ = hash;
    lookedAt_ = now;
  }

 private:
  std::uint64_t hash_ = 0;
  double lookedAt_ = 0;  // seconds
  int same_ = 0;         // looks in a row
};

}  // namespace weft::app
