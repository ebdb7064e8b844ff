#include "tests/theory/lens/one_picture.h"

#include <algorithm>
#include <cmath>

namespace weft::theory {

namespace {

constexpr int kSky = -1, kMixed = -2;

}  // namespace

OnePicture::OnePicture(std::vector<Ball> balls, const scene::CameraKey& camera, std::uint32_t width,
                       std::uint32_t height, Radiance picture)
    : balls_(std::move(balls)),
      width_(int(width)),
      height_(int(height)),
      view_(viewOf(camera)),
      targets_(targetsFrom(view_, 0)),
      picture_(std::move(picture)),
      true_colors_(picture_.size()),
      its_colors_(picture_.size()) {
  std::vector<int> seen;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      seen.push_back(hitOf(targets_, view_.eye, {x + 0.5, y + 0.5}, rayOf(view_, {x + 0.5, y + 0.5})).ball);
  balls_seen_ = seen;
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x)
      for (int i = 0; i < 9; ++i) {
        const int beside =
            std::clamp(y + i / 3 - 1, 0, height_ - 1) * width_ + std::clamp(x + i % 3 - 1, 0, width_ - 1);
        const int at = y * width_ + x;
        if (seen[std::size_t(beside)] != seen[std::size_t(at)]) balls_seen_[std::size_t(at)] = kMixed;
      }
  for (int at = 0; at < width_ * height_; ++at) {
    const glm::ivec2 pixel(at % width_, at / width_);
    Box& box = boxes_.try_emplace(balls_seen_[std::size_t(at)], pixel, pixel).first->second;
    box = {glm::min(box.least, pixel), glm::max(box.most, pixel)};
  }
}

OnePicture::View OnePicture::viewOf(const scene::CameraKey& camera) const {
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera.target) - glm::dvec3(camera.position));
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
  return {camera.position, right, glm::cross(right, ahead), ahead,
          height_ / 2.0 / std::tan(glm::radians(double(camera.fovDegrees)) / 2)};
}

glm::dvec3 OnePicture::rayOf(const View& view, glm::dvec2 pixel) const {
  const glm::dvec2 slope = (pixel - glm::dvec2(width_, height_) / 2.0) / view.focal;
  return view.ahead + slope.x * view.right + slope.y * view.up;
}

// By the tangents to the ball's circle in the plane of an axis and the view, and a pixel more.
std::vector<OnePicture::Target> OnePicture::targetsFrom(const View& view, double seconds) const {
  constexpr double kEverywhere = 1e30;
  std::vector<Target> targets;
  for (const Ball& ball : balls_) {
    const glm::dvec3 to = glm::dvec3(ball.center) + seconds * glm::dvec3(ball.velocity) - view.eye;
    Target target{to, glm::dot(to, to) - double(ball.radius) * double(ball.radius), glm::dvec2(-kEverywhere),
                  glm::dvec2(kEverywhere)};
    for (int axis = 0; axis < 2; ++axis) {
      const double aside = glm::dot(to, axis == 0 ? view.right : view.up), deep = glm::dot(to, view.ahead),
                   away = std::hypot(aside, deep), middle = (axis == 0 ? width_ : height_) / 2.0;
      if (away <= double(ball.radius)) continue;
      const double angle = std::atan2(aside, deep), half = std::asin(double(ball.radius) / away);
      if (std::abs(angle) + half > 1.5) continue;
      target.least[axis] = middle + view.focal * std::tan(angle - half) - 1;
      target.most[axis] = middle + view.focal * std::tan(angle + half) + 1;
    }
    targets.push_back(target);
  }
  return targets;
}

OnePicture::Hit OnePicture::hitOf(const std::vector<Target>& targets, glm::dvec3 eye, glm::dvec2 pixel,
                                  glm::dvec3 ray) {
  Hit hit{kSky, 1e30, ray};
  const double squared = glm::dot(ray, ray);
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const glm::dvec2 least = targets[i].least, most = targets[i].most;
    if (pixel.y < least.y || pixel.y > most.y || pixel.x < least.x || pixel.x > most.x) continue;
    const double along = glm::dot(targets[i].to, ray), root = along * along - squared * targets[i].outside;
    if (root < 0) continue;
    const double distance = (along - std::sqrt(root)) / squared;
    if (distance > 0 && distance < hit.distance) hit.ball = int(i), hit.distance = distance;
  }
  if (hit.ball != kSky) hit.position = eye + hit.distance * ray;
  return hit;
}

// `hit` as it lies at the moment of the picture. `pixel`: where it would be seen.
bool OnePicture::isVisible(const Hit& hit, glm::dvec2& pixel) const {
  const glm::dvec3 ray = hit.ball == kSky ? hit.position : hit.position - view_.eye;
  const double deep = glm::dot(ray, view_.ahead);
  if (deep <= 0) return false;
  pixel = glm::dvec2(width_, height_) / 2.0 +
          view_.focal / deep * glm::dvec2(glm::dot(ray, view_.right), glm::dot(ray, view_.up));
  if (pixel.x < 0 || pixel.y < 0 || pixel.x >= width_ || pixel.y >= height_) return false;
  const Hit first = hitOf(targets_, view_.eye, pixel, ray);
  return first.ball == hit.ball && (hit.ball == kSky || first.distance > 1 - 1e-6);
}

// The index of a pixel of the picture, found in growing squares; the nearest of all when the ball is nowhere visible.
int OnePicture::guess(int ball, glm::dvec2 pixel) const {
  const int x = std::clamp(int(std::floor(pixel.x)), 0, width_ - 1);
  const int y = std::clamp(int(std::floor(pixel.y)), 0, height_ - 1);
  int found = y * width_ + x;
  const auto there = boxes_.find(ball);
  if (there == boxes_.end()) return found;
  const auto& [lowest, highest] = there->second;
  double least = 1e30;
  int ring = std::max({0, lowest.x - x, x - highest.x, lowest.y - y, y - highest.y});
  for (; ring < std::max(width_, height_) && double(ring - 2) * (ring - 2) < least; ++ring)
    for (int j = -ring; j <= ring; ++j)
      for (int i = -ring; i <= ring; i += std::abs(j) == ring ? 1 : 2 * ring) {
        if (x + i < 0 || y + j < 0 || x + i >= width_ || y + j >= height_) continue;
        const int at = (y + j) * width_ + x + i;
        const glm::dvec2 apart = glm::dvec2(x + i, y + j) + 0.5 - pixel;
        if (balls_seen_[std::size_t(at)] != ball || glm::dot(apart, apart) >= least) continue;
        least = glm::dot(apart, apart);
        found = at;
      }
  return found;
}

void OnePicture::add(double seconds, const scene::CameraKey& camera, const Picture& sharp, double weight) {
  const View view = viewOf(camera);
  const std::vector<Target> targets = targetsFrom(view, seconds);
  for (int y = 0; y < height_; ++y)
    for (int x = 0; x < width_; ++x) {
      Hit hit = hitOf(targets, view.eye, {x + 0.5, y + 0.5}, rayOf(view, {x + 0.5, y + 0.5}));
      if (hit.ball != kSky) hit.position -= seconds * glm::dvec3(balls_[std::size_t(hit.ball)].velocity);
      glm::dvec2 pixel(x + 0.5, y + 0.5);
      const bool visible = isVisible(hit, pixel);
      const int from = visible ? int(pixel.y) * width_ + int(pixel.x) : guess(hit.ball, pixel);
      const float* now = sharp.at(std::uint32_t(x), std::uint32_t(y));
      const std::size_t at = std::size_t(y * width_ + x) * 3;
      for (std::size_t c = 0; c < 3; ++c) {
        const double carried = picture_[std::size_t(from) * 3 + c];
        true_colors_[at + c] += weight * (visible ? double(now[c]) : carried);
        its_colors_[at + c] += weight * carried;
      }
      hidden_ += visible ? 0 : weight / (width_ * height_);
    }
}

}  // namespace weft::theory
