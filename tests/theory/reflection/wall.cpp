#include "tests/theory/reflection/wall.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "tests/load_image.h"

namespace weft::theory {

namespace {

constexpr const char* kMap = WEFT_SOURCE_DIR "/scenes/environments/spiaggia_di_mondello_1k.hdr";
constexpr double kSpacing = 2.1, kDistance = 40, kSlope = kSpacing * ReflectionWall::kRows / 2 / kDistance;

Vec3 vec(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

}  // namespace

ReflectionWall::ReflectionWall(double azimuth) {
  const double a = azimuth * std::numbers::pi / 180;
  back_ = {std::sin(a), 0, std::cos(a)};
  right_ = {std::cos(a), 0, -std::sin(a)};
  setup.graph = "tests/theory/draw_modes.json";
  setup.width = kSide * kColumns;
  setup.height = kSide * kRows;
  setup.camera = {.position = glm::vec3(back_ * kDistance),
                  .target = {0, 0, 0},
                  .fovDegrees = static_cast<float>(2 * std::atan(kSlope) * 180 / std::numbers::pi),
                  .nearPlane = 0.1f};
  for (std::size_t i = 0; i < kRoughness.size(); ++i)
    setup.balls.push_back({.center = glm::vec3(center(i)), .roughness = static_cast<float>(kRoughness[i])});
  weft::text::Diagnostics said;
  auto image = weft::assets::loadEnvironment(kMap, said);
  REQUIRE(image);
  setup.environment = std::make_shared<const weft::assets::ImageF>(std::move(*image));
}

glm::dvec3 ReflectionWall::center(std::size_t i) const {
  return right_ * (kSpacing * (static_cast<double>(i % kColumns) - (kColumns - 1) * 0.5)) +
         glm::dvec3(0, kSpacing * ((kRows - 1) * 0.5 - static_cast<double>(i / kColumns)), 0);
}

bool ReflectionWall::hit(std::size_t i, double x, double y, Vec3& normal, Vec3& view) const {
  const glm::dvec3 eye = back_ * kDistance;
  const glm::dvec3 ray = glm::normalize(right_ * ((x / setup.width * 2 - 1) * kSlope * kColumns / kRows) +
                                        glm::dvec3(0, (y / setup.height * 2 - 1) * kSlope, 0) - back_);
  const glm::dvec3 to = center(i) - eye;
  const double along = glm::dot(to, ray), root2 = along * along - glm::dot(to, to) + 1;
  if (root2 <= 0) return false;
  normal = vec(ray * (along - std::sqrt(root2)) - to);
  view = vec(-ray);
  return true;
}

bool ReflectionWall::truth(const ReflectionOracle& oracle, const ReflectionOracle::Metal& metal,
                           std::size_t ball, std::uint32_t x, std::uint32_t y, unsigned set, Vec3& out,
                           int fewer) const {
  // Points of the pixel along a side: fewer where the picture is smoother.
  const int side = metal.roughness == 0 ? 16 : metal.roughness < 0.15 ? 4 : metal.roughness < 0.35 ? 2 : 1;
  const int samples = std::max((side < 4 ? 8192 : 2048) / (side * side * fewer), 1);
  Vec3 normal, view;
  out = {};
  for (int corner = 0; corner < 4; ++corner)
    if (!hit(ball, x + corner % 2, y + corner / 2, normal, view)) return false;
  for (int i = 0; i < side * side; ++i) {
    if (!hit(ball, x + (i % side + 0.5) / side, y + (i / side + 0.5) / side, normal, view)) return false;
    const Vec3 one =
        oracle.radiance(normal, view, metal, samples, set + x + y * kSide * kColumns, i, side * side);
    out = {out.x + one.x, out.y + one.y, out.z + one.z};
  }
  hit(ball, x + 0.5, y + 0.5, normal, view);
  const Vec3 several = oracle.severalBounces(normal, view, metal);
  const double share = 1.0 / (side * side);
  out = {out.x * share + several.x, out.y * share + several.y, out.z * share + several.z};
  return true;
}

ReflectionOracle bundledOracle() {
  weft::text::Diagnostics said;
  const auto map = weft::assets::loadImage(kMap, said);
  REQUIRE(map);
  return ReflectionOracle(*map);
}

}  // namespace weft::theory
