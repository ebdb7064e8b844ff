#include "engine/scene/frame/animation.h"

#include <algorithm>
#include <cmath>

namespace weft::scene {

namespace {

using assets::ModelTrack;
using assets::TrackInterpolation;
using assets::TrackPath;

glm::vec4 slerp(glm::vec4 a, glm::vec4 b, float f) {
  float cosine = glm::dot(a, b);
  if (cosine < 0) {
    b = -b;
    cosine = -cosine;
  }
  if (cosine > 0.9995f) return glm::normalize(a + (b - a) * f);
  const float angle = std::acos(cosine);
  return (a * std::sin((1 - f) * angle) + b * std::sin(f * angle)) / std::sin(angle);
}

}  // namespace

glm::vec4 sampleTrack(const ModelTrack& track, float time) {
  const std::vector<float>& times = track.times;
  const bool cubic = track.interpolation == TrackInterpolation::cubic;
  const auto key = [&](std::size_t i) { return track.values[cubic ? 3 * i + 1 : i]; };
  const std::size_t after =
      static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), time) - times.begin());
  if (after == 0) return key(0);
  if (after == times.size()) return key(after - 1);
  const std::size_t a = after - 1, b = after;
  if (track.interpolation == TrackInterpolation::step) return key(a);
  const float span = times[b] - times[a], f = (time - times[a]) / span;
  const bool rotation = track.path == TrackPath::rotation;
  if (!cubic) return rotation ? slerp(key(a), key(b), f) : key(a) + (key(b) - key(a)) * f;
  const glm::vec4 leaving = track.values[3 * a + 2] * span, arriving = track.values[3 * b] * span;
  const float f2 = f * f, f3 = f2 * f;
  const glm::vec4 v = key(a) * (2 * f3 - 3 * f2 + 1) + leaving * (f3 - 2 * f2 + f) +
                      key(b) * (3 * f2 - 2 * f3) + arriving * (f3 - f2);
  return rotation ? glm::normalize(v) : v;
}

float animationTime(const Animation& animation, double time) {
  const double duration = animation.tracks->duration;
  if (duration <= 0) return 0;
  const double local = std::fmod(time * static_cast<double>(animation.speed), duration);
  return static_cast<float>(local < 0 ? local + duration : local);
}

void applyAnimation(const Animation& animation, double time, std::span<const std::uint32_t> rows,
                    std::span<Transform> locals) {
  const float at = animationTime(animation, time);
  for (std::size_t i = 0; i < animation.tracks->tracks.size(); ++i) {
    const ModelTrack& track = animation.tracks->tracks[i];
    const glm::vec4 v = sampleTrack(track, at);
    Transform& local = locals[rows[i]];
    if (track.path == TrackPath::rotation)
      local.rotation = glm::quat(v.w, v.x, v.y, v.z);
    else
      (track.path == TrackPath::translation ? local.translation : local.scale) = glm::vec3(v);
  }
}

}  // namespace weft::scene
