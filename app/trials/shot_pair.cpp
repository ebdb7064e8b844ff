#include "app/trials/shot_pair.h"

#include <fmt/format.h>

namespace weft::app {

std::string ShotPair::pictureText() const {
  const assets::Image8 &a = pictureBefore(), &b = pictureAfter();
  if (!difference)
    return fmt::format("pictures: of different sizes, {}x{} and {}x{}", a.width, a.height, b.width, b.height);
  return difference->bytes.equal() ? "pictures: the same" : "pictures: " + difference->text();
}

std::optional<ShotPair> shootPair(gl::Context& context, const Options& before, const Options& after,
                                  const runtime::World& world, std::uint32_t frame,
                                  base::Diagnostics& diagnostics) {
  const ShotWish wish{.frames = {frame}, .records = true};
  auto a = takeShot(context, before, world, wish, diagnostics);
  auto b = a ? takeShot(context, after, world, wish, diagnostics) : std::nullopt;
  if (!b) return std::nullopt;
  ShotPair pair{frame, *std::move(a), *std::move(b), {}, {}, {}};
  const std::string& driver = context.device().driverKey;
  pair.first = findDivergence(recordsOf(pair.before, driver), recordsOf(pair.after, driver));
  pair.map = assets::computeFlip(pair.pictureBefore(), pair.pictureAfter());
  if (!pair.map.errors.empty())
    pair.difference = measureDifference(pair.pictureBefore(), pair.pictureAfter(), pair.map);
  return pair;
}

}  // namespace weft::app
