// Rotation and blur of the environment: rotating is shifting the map, for the background and for what it
// lights; blur keeps the mean; there is no seam.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include "tests/theory/lab.h"
#include "tests/theory/oracle.h"

namespace sky_test {

using namespace weft::theory;

namespace {

constexpr int kWidth = 256, kHeight = 128;

// A gradient, a lobe across the seam of the map, and a bright window, moved by whole columns.
std::shared_ptr<const weft::assets::ImageF> environment(int columns) {
  static std::map<int, std::shared_ptr<const weft::assets::ImageF>> made;
  if (const auto known = made.find(columns); known != made.end()) return known->second;
  auto image = std::make_shared<weft::assets::ImageF>();
  image->width = kWidth;
  image->height = kHeight;
  image->channels = 4;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const int from = ((x - columns) % kWidth + kWidth) % kWidth;
      const Vec3 d = equirectDirection(from, y, kWidth, kHeight);
      const double lobe = 2 * std::pow(std::max(0.0, -0.8 * d.x + 0.36 * d.y + 0.48 * d.z), 12.0);
      const double window = from > 40 && from < 72 && y > 40 && y < 60 ? 3 : 0;
      for (const double c : {1 + 0.5 * d.x + lobe, 1 + 0.5 * d.y + window, 1 + 0.5 * d.z, 1.0})
        image->texels.push_back(static_cast<float>(c));
    }
  return made[columns] = image;
}

Setup studio(int columns, double rotation, double blur) {
  Setup setup{.graph = "graphs/studio.json", .width = 160, .height = 120};
  setup.sets = {
      {"bloom", "false"}, {"sky_rotation", std::to_string(rotation)}, {"sky_blur", std::to_string(blur)}};
  setup.balls = {
      {.center = {-1.1, 0, 0}, .roughness = 0},
      {.center = {1.1, 0, 0}, .roughness = 0.4f},
      {.center = {0, 1.5, 0}, .radius = 0.6f, .albedo = {0.8f, 0.8f, 0.8f}, .metallic = 0, .roughness = 1}};
  setup.camera = {
      .position = {5, 0.5, 0}, .target = {0, 0, 0}, .fovDegrees = 80, .nearPlane = 0.1};  // towards the seam
  setup.environment = environment(columns);
  return setup;
}

Picture draw(const Setup& setup) {
  Lab lab(setup);
  lab.frame();
  const Picture picture = lab.read("hdr");
  CHECK(lab.reports() == "");
  return picture;
}

double worstDifference(const Picture& a, const Picture& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.texels.size(); ++i)
    worst = std::max<double>(worst, std::abs(a.texels[i] - b.texels[i]));
  return worst;
}

}  // namespace

namespace {

// By so many columns, with so much blur.
const std::vector<std::pair<int, double>> kTurns = {{64, 0},    {64, 1.6}, {-37, 0},
                                                    {-37, 1.6}, {128, 0},  {128, 1.6}};

}  // namespace

TEST_CASE("rotation by k columns is the map moved by k columns: background, reflections and diffuse light") {
  // All of one map first: its lighting is made once.
  std::vector<Picture> turned, moved;
  for (const auto& [columns, blur] : kTurns)
    turned.push_back(draw(studio(0, 360.0 * columns / kWidth, blur)));
  for (const auto& [columns, blur] : kTurns) moved.push_back(draw(studio(columns, 0, blur)));
  for (std::size_t i = 0; i < turned.size(); ++i) {
    CAPTURE(kTurns[i].first);
    CAPTURE(kTurns[i].second);
    // Rounding of half floats and of the sampler's eight bits between texels; the steps of the window are 3.
    CHECK(worstDifference(turned[i], moved[i]) < 0.02);
  }
  CHECK(worstDifference(draw(studio(0, 90, 0)), draw(studio(0, 0, 0))) > 1);
}

TEST_CASE("rotation by -180 and by 180 degrees is the same") {
  CHECK(worstDifference(draw(studio(0, -180, 0)), draw(studio(0, 180, 0))) < 0.02);
}

namespace {

// Of the background over all directions.
std::array<double, 3> meanAt(double blur, std::shared_ptr<const weft::assets::ImageF> map) {
  std::array<double, 3> sum{};
  double weights = 0;
  Setup setup = studio(0, 25, blur);
  setup.daylight = map == nullptr;
  setup.environment = std::move(map);
  setup.width = setup.height = 64;
  setup.balls = {{.center = {0, 0, 1000}, .radius = 0.001f}};
  setup.camera = {.position = {0, 0, 0}, .target = {1, 0, 0}, .fovDegrees = 90, .nearPlane = 0.1};
  for (const glm::dvec3 to : {glm::dvec3{1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}})
    setup.path.push_back({double(setup.path.size()) / 60, {0, 0, 0}, to, 90});
  Lab lab(setup);
  for (std::uint32_t i = 0; i < setup.path.size(); ++i) {
    lab.frame(i);
    const Picture face = lab.read("hdr");
    for (std::uint32_t y = 0; y < face.height; ++y)
      for (std::uint32_t x = 0; x < face.width; ++x) {
        const double u = (x + 0.5) / face.width * 2 - 1, v = (y + 0.5) / face.height * 2 - 1;
        const double weight = std::pow(1 + u * u + v * v, -1.5);  // solid angle of a pixel of a cube's face
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * static_cast<double>(face.at(x, y)[c]);
        weights += weight;
      }
  }
  CHECK(lab.reports() == "");
  for (double& s : sum) s /= weights;
  return sum;
}

}  // namespace

TEST_CASE("blur of the background keeps its mean over all directions") {
  const auto sharp = meanAt(0, environment(0));
  for (const double blur : {0.5, 1.0, 2.0, 3.0, 4.0}) {
    const auto blurred = meanAt(blur, environment(0));
    CAPTURE(blur);
    for (std::size_t c = 0; c < 3; ++c) CHECK(blurred[c] == doctest::Approx(sharp[c]).epsilon(0.01));
  }
}

TEST_CASE("no seam in the background at +-180 degrees, sharp or blurred, turned or not") {
  for (const double blur : {0.0, 0.7, 2.0, 4.0})
    for (const double rotation : {0.0, 0.3, 120.0}) {
      Setup setup = studio(0, rotation, blur);
      setup.balls = {{.center = {1000, 0, 0}, .radius = 0.001f}};
      const double at = 3.14159265358979 * (1 + rotation / 180);  // azimuth of the map's first column
      setup.camera = {.position = {0, 0, 0},
                      .target = {std::cos(at), -0.35, std::sin(at)},
                      .fovDegrees = 30,
                      .nearPlane = 0.1};
      const Picture picture = draw(setup);
      // Second differences along a row: the map is smooth here, a seam would be a spike at the middle.
      double middle = 0, elsewhere = 0;
      for (std::uint32_t y = 0; y < picture.height; y += 3)
        for (std::uint32_t x = 1; x + 1 < picture.width; ++x) {
          const double bend =
              std::abs(picture.at(x - 1, y)[0] - 2 * picture.at(x, y)[0] + picture.at(x + 1, y)[0]);
          double& worst = x + 3 > picture.width / 2 && x < picture.width / 2 + 3 ? middle : elsewhere;
          worst = std::max(worst, bend);
        }
      CAPTURE(blur);
      CAPTURE(rotation);
      CHECK(middle <= 1.5 * elsewhere + 0.004);
    }
}

TEST_CASE("a camera with a focal length is the camera of that angle of view, and 0 leaves the scene's") {
  Setup setup = studio(0, 0, 0);
  setup.balls = {{.center = {1, 0, 0}}, {.center = {-1, 1, 2}}};
  Setup lens = setup;
  lens.graph = "tests/theory/camera_lens.json";
  for (const double focal : {18.0, 50.0, 85.0}) {
    setup.camera.fovDegrees = 2 * std::atan(12 / focal) * 180 / 3.14159265358979323846;
    lens.camera.fovDegrees = 77;
    lens.sets = setup.sets;
    lens.sets.emplace_back("focal_length", std::to_string(focal));
    CAPTURE(focal);
    CHECK(draw(lens).texels == draw(setup).texels);
  }
  lens.sets.back() = {"focal_length", "36"};
  lens.sets.emplace_back("sensor_height", "18");
  setup.camera.fovDegrees = 2 * std::atan(9.0 / 36) * 180 / 3.14159265358979323846;
  CHECK(draw(lens).texels == draw(setup).texels);
}

TEST_CASE("a blurred background keeps the light of a sun") {
  auto map = std::make_shared<weft::assets::ImageF>(weft::assets::ImageF{512, 256, 4, {}});
  double mean = 0;
  for (int y = 0; y < 256; ++y)
    for (int x = 0; x < 512; ++x) {
      const float value = x >= 200 && x < 203 && y >= 80 && y < 83 ? 20000.0f : 1.0f;
      map->texels.insert(map->texels.end(), {value, value, value, 1});
      mean +=
          value * (std::cos(y * std::numbers::pi / 256) - std::cos((y + 1) * std::numbers::pi / 256)) / 1024;
    }
  CHECK(mean > 2);
  for (const double blur : {2.0, 4.0}) CHECK(meanAt(blur, map)[0] == doctest::Approx(mean).epsilon(0.01));
}

namespace {

constexpr double kDegree = std::numbers::pi / 180;

struct Disc {
  double light[3] = {};  // irradiance on what faces it
  double degrees = 0;    // across, where it is brighter than half of its brightest
  double white = 0;      // across, where a picture is white whatever the curve
};

// Of the disc in a picture of the sky alone, around `at` of the camera's own axes, within so many degrees and two pixels; less the sky of a
// ring around that.
Disc discIn(const Picture& picture, double fov, const glm::dvec3& at, double reach) {
  const double pixel = 2 * std::tan(fov * kDegree / 2) / picture.height;
  const double from[] = {reach * kDegree + 2 * pixel, reach * kDegree + 4 * pixel};
  double brightest = 0, half = 0, white = 0, inside = 0, ring[4] = {};
  Disc disc;
  for (std::uint32_t y = 0; y < picture.height; ++y)
    for (std::uint32_t x = 0; x < picture.width; ++x) {
      const double u = pixel * (x + 0.5 - picture.width / 2.0), v = pixel * (y + 0.5 - picture.height / 2.0);
      const double angle = pixel * pixel * std::pow(1 + u * u + v * v, -1.5);
      const double away = glm::distance(glm::normalize(glm::dvec3(u, v, -1)), at);
      const float* here = picture.at(x, y);
      brightest = std::max<double>(brightest, here[1]);
      white += here[1] > 16 ? angle : 0;
      if (away > from[1]) continue;
      for (std::size_t c = 0; c < 3; ++c) (away < from[0] ? disc.light[c] : ring[c]) += here[c] * angle;
      (away < from[0] ? inside : ring[3]) += angle;
    }
  for (std::size_t c = 0; c < 3; ++c) disc.light[c] -= ring[c] * inside / ring[3];
  for (std::size_t i = 1; i < picture.texels.size(); i += 4)
    half += picture.texels[i] > 0.5 * brightest ? pixel * pixel : 0;
  disc.degrees = 2 * std::sqrt(half / std::numbers::pi) / kDegree;
  disc.white = 2 * std::sqrt(white / std::numbers::pi) / kDegree;
  return disc;
}

glm::dvec3 toSun(double elevation) {
  return {0, std::sin(elevation * kDegree), std::cos(elevation * kDegree)};
}

struct Look {
  double fov = 60;    // degrees
  double beside = 0;  // of fov, to the side
};

// Towards the sun at this elevation, a frame for each look.
Setup towardsSun(double elevation, double blur, std::uint32_t side, std::span<const Look> looks) {
  Setup setup = studio(0, 25, blur);
  setup.width = setup.height = side;
  setup.daylight = true;
  setup.sets.emplace_back("sun_elevation", std::to_string(elevation));
  setup.sets.emplace_back("sun_azimuth", "65");  // with the rotation along +Z
  setup.balls = {{.center = {0, 0, -1000}, .radius = 0.001f}};
  for (const Look& look : looks) {
    const double to = look.beside * look.fov * kDegree;
    setup.path.push_back({double(setup.path.size()) / 60,
                          {0, 0, 0},
                          std::cos(to) * toSun(elevation) + std::sin(to) * glm::dvec3(1, 0, 0),
                          look.fov});
  }
  setup.camera = {.position = {0, 0, 0}, .target = {0, 0, 1}, .fovDegrees = 60, .nearPlane = 0.1};
  return setup;
}

// The B-spline of a degree, at `x` from its middle: the one below it over the unit interval around x (Cox and de Boor).
double spline(int degree, double x) {
  const double half = 0.5 * (degree + 1);
  if (degree == 0) return x >= -0.5 && x < 0.5 ? 1 : 0;
  return ((half + x) * spline(degree - 1, x + 0.5) + (half - x) * spline(degree - 1, x - 0.5)) / degree;
}

// A map towards a direction, as the sum of all texels near, each a spline of that degree.
double splineOf(const weft::assets::ImageF& map, int degree, const glm::dvec3& towards, int channel) {
  const glm::dvec3 d = glm::normalize(towards);
  const double x = (std::atan2(d.z, d.x) / (2 * std::numbers::pi) + 0.5) * map.width - 0.5;
  const double y = (0.5 - std::asin(d.y) / std::numbers::pi) * map.height - 0.5;
  double sum = 0;
  for (int j = static_cast<int>(y) - 3; j <= static_cast<int>(y) + 4; ++j)
    for (int i = static_cast<int>(x) - 3; i <= static_cast<int>(x) + 4; ++i) {
      const int column = (i + map.width) % map.width, row = std::clamp(j, 0, map.height - 1);
      sum += spline(degree, x - i) * spline(degree, y - j) *
             map.texels[static_cast<std::size_t>((row * map.width + column) * 4 + channel)];
    }
  return sum;
}

}  // namespace

// Towards a corner of the window, and others.
TEST_CASE("texels wider than two pixels are cubic B-splines, and those as wide as one linear") {
  const double alike =
      2 / kDegree * std::atan(0.995 * std::numbers::pi / kHeight * 120 / 2);  // degrees for 120 rows
  // At 35 degrees they are drawn with fewer pixels than the picture has, and the window is 3 brighter than the wall.
  for (const auto& [fov, degree, bound] :
       {std::tuple{5.0, 3, 0.03}, {35.0, 3, 0.15}, {60.0, 3, 0.03}, {alike, 1, 0.03}})
    for (const glm::dvec3 to :
         {glm::dvec3{-0.546, 0.668, -0.838}, {0.7, 0.2, -0.4}, {0.1, 1.5, 0.3}, {0.1, -0.4, 1}}) {
      Setup setup = studio(0, 0, 0);
      setup.balls = {{.center = {1000, 0, 0}, .radius = 0.001f}};
      setup.camera = {.position = {0, 0, 0}, .target = to, .fovDegrees = fov, .nearPlane = 0.1};
      const Picture picture = draw(setup);
      const glm::dvec3 ahead = glm::normalize(to), right = glm::normalize(glm::cross(ahead, {0, 1, 0})),
                       up = glm::cross(right, ahead);
      const double pixel = 2 * std::tan(fov * kDegree / 2) / picture.height;
      double worst = 0;
      for (std::uint32_t y = 0; y < picture.height; y += 3)
        for (std::uint32_t x = 0; x < picture.width; x += 3) {
          const double u = pixel * (x + 0.5 - picture.width / 2.0),
                       v = pixel * (y + 0.5 - picture.height / 2.0);
          const double expected = splineOf(*environment(0), degree, ahead + u * right + v * up, 1);
          worst = std::max(worst, std::abs(picture.at(x, y)[1] - expected));
        }
      CAPTURE(fov);
      CAPTURE(to.x);
      CHECK(worst < bound);
    }
}

TEST_CASE(
    "the computed sun has all of its light in every picture: a disc, or a pixel or two wherever they are") {
  double least = 1, most = 1;
  std::vector<Look> looks;
  for (const double beside : {0.0, 0.2133, 0.391})
    for (const double fov : {1.0, 1.7, 4.0, 9.0, 20.0, 37.0, 60.0, 61.0, 62.3, 90.0, 110.0}) {
      const double pixel = 2 * std::tan(fov * kDegree / 2) / 128 / kDegree;
      if ((0.5 - beside) * fov >= 0.4 + 4 * pixel) looks.push_back({fov, beside});  // else it would be cut
    }
  for (const double elevation : {2.0, 10.0, 35.0, 60.0, 85.0}) {
    Lab lab(towardsSun(elevation, 0, 128, looks));
    for (std::uint32_t i = 0; i < looks.size(); ++i) {
      const auto [fov, beside] = looks[i];
      const double pixel = 2 * std::tan(fov * kDegree / 2) / 128 / kDegree;
      lab.frame(i);
      const Disc disc = discIn(lab.read("hdr"), fov, glm::dmat3(lab.viewAt(i).view) * toSun(elevation), 0.4);
      CAPTURE(elevation);
      CAPTURE(beside);
      CAPTURE(fov);
      // 128 klx before the air; optical depths of 680, 550 and 440 nm at the turbidity of 2.5; Kasten and Young 1989.
      const double mass =
          1 / (std::sin(elevation * kDegree) + 0.50572 * std::pow(elevation + 6.07995, -1.6364));
      const double depths[] = {0.041 + 0.069 * 0.76, 0.097 + 0.069, 0.243 + 0.069 * 1.34};
      for (std::size_t c = 0; c < 3; ++c) {
        const double share = disc.light[c] / (0.06 * 128 * std::exp(-depths[c] * mass));
        CHECK(std::abs(share - 1) < 0.03);
        least = std::min(least, share);
        most = std::max(most, share);
      }
      if (fov > 4) continue;
      CHECK(disc.degrees > 0.525);
      CHECK(disc.degrees < (elevation > 11 ? 0.69 : 0.55));
      CHECK(disc.white < disc.degrees + 2 * pixel + 0.02);
    }
    CHECK(lab.reports() == "");
  }
  MESSAGE("shares of the light: ", least, " to ", most);
}

TEST_CASE("the computed sky has the scene's sun, wherever its own would be, and leaves its light to it") {
  const Look ahead[] = {{.fov = 10}};
  const glm::vec3 light(6, 4, 2);
  for (const double elevation : {-8.0, 0.0, 30.0, 80.0})
    for (const double blur : {0.0, 0.3}) {
      Setup setup = towardsSun(elevation, blur, 256, ahead);
      std::erase_if(setup.sets, [](const auto& set) { return set.name == "sun_elevation"; });
      setup.sun = weft::scene::Sun{.direction = glm::vec3(toSun(elevation)), .irradiance = light};
      Lab lab(setup);
      lab.frame();
      const Disc disc = discIn(lab.read("hdr"), 10, {0, 0, -1}, blur > 0 ? 4 : 0.4);
      CAPTURE(elevation);
      CAPTURE(blur);
      const double above = elevation > 0 ? 1 : elevation < 0 ? 0 : 0.5;
      for (int c = 0; c < 3; ++c)  // some of a blur reaches beyond the ring
        CHECK(std::abs(disc.light[c] - above * light[c]) <
              (blur > 0 || elevation == 0 ? 0.06 : 0.03) * light[0]);
      CHECK(lab.readBuffer("ibl.brightest", 33)[32] == 0);  // spots
      const Picture whole = lab.read("ibl.daylight.sky_map"), rest = lab.read("ibl.daylight.rest_map");
      CHECK(worstDifference(whole, rest) == 0);
      // The sky is brightest around the sun.
      const auto at = [&](double x) { return static_cast<std::uint32_t>(x * whole.width); };
      const std::uint32_t row =
          static_cast<std::uint32_t>((0.5 - std::max(elevation, 2.0) / 180) * whole.height);
      CHECK(whole.at(at(0.75), row)[1] >= 1.5 * whole.at(at(0.0), row)[1] * (elevation < 60));
      CHECK(lab.reports() == "");
    }
}

TEST_CASE("the sky is brighter under a sun of more than 100 klx, and dark where that is below the horizon") {
  const auto skyUnder = [](double elevation, float strength) {
    Setup setup{.graph = "graphs/studio.json", .balls = {{}}, .daylight = true};
    setup.sun = weft::scene::Sun{.direction = glm::vec3(toSun(elevation)), .irradiance = glm::vec3(strength)};
    Lab lab(setup);
    lab.frame();
    return lab.read("ibl.daylight.rest_map").at(100, 40)[1];
  };
  const double day = skyUnder(30, 1);
  CHECK(skyUnder(30, 5) == doctest::Approx(day).epsilon(0.01));
  CHECK(skyUnder(30, 60) == doctest::Approx(10 * day).epsilon(0.01));
  CHECK(skyUnder(-6, 5) == doctest::Approx(skyUnder(0, 5) / 200).epsilon(0.1));
}

TEST_CASE("a blur of the sky blurs the computed sun by as much and keeps its light") {
  const double sharp = meanAt(0, nullptr)[1];
  const Look ahead[] = {{.fov = 10}};
  double last = 0;
  for (const double blur : {0.02, 0.1, 0.2, 0.3, 0.5, 1.0, 2.0, 4.0}) {
    CAPTURE(blur);
    CHECK(meanAt(blur, nullptr)[1] == doctest::Approx(sharp).epsilon(0.01));
    if (blur > 0.5) continue;
    Lab lab(towardsSun(20, blur, 256, ahead));
    lab.frame();
    const Disc disc = discIn(lab.read("hdr"), 10, {0, 0, -1}, 0.4);
    CHECK(disc.white >= last);
    if (blur < 0.11) CHECK(disc.white < 0.75);
    last = disc.white;
  }
}

}  // namespace sky_test
