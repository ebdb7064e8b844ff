// The oracles themselves, against closed forms.
#include "tests/theory/oracle.h"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <numbers>

using namespace weft::theory;

TEST_CASE("directional albedo: roughness 1 seen from above is 1 - ln 2") {
  // D = 1/pi, G2 = 2 u / (1 + u) with u = N.L, so the albedo is the integral of u / (1 + u) over 0..1.
  CHECK(directionalAlbedo(1.0, 1.0).sum() == doctest::Approx(1 - std::numbers::ln2).epsilon(1e-4));
}

TEST_CASE("directional albedo: a mirror loses nothing and its bias is Schlick's term") {
  for (const double nv : {0.2, 0.5, 0.9}) {
    const Albedo albedo = directionalAlbedo(nv, 0.02);
    CHECK(albedo.sum() == doctest::Approx(1).epsilon(1e-4));
    CHECK(albedo.bias == doctest::Approx(std::pow(1 - nv, 5)).epsilon(2e-3));
  }
}

TEST_CASE("directional albedo: never gains energy, and converges") {
  for (const double roughness : {0.1, 0.4, 0.7, 1.0})
    for (const double nv : {0.01, 0.1, 0.5, 1.0}) {
      const Albedo coarse = directionalAlbedo(nv, roughness, 250),
                   fine = directionalAlbedo(nv, roughness, 500);
      CHECK(fine.sum() <= 1.0);
      CHECK(std::abs(coarse.sum() - fine.sum()) < 1.5e-3);
      CHECK(std::abs(coarse.bias - fine.bias) < 1e-4);
    }
}

TEST_CASE("projected sphere: a distant one is a disc, an oblique one is wider by 1 / cos^3") {
  CHECK(projectedSphereArea(1000, 1, 1000, 1000) == doctest::Approx(std::numbers::pi).epsilon(1e-5));
  const double slant = std::cos(0.5);
  CHECK(projectedSphereArea(1000, 1, 1000, 1000 * slant) ==
        doctest::Approx(std::numbers::pi / (slant * slant * slant)).epsilon(1e-5));
}

TEST_CASE("irradiance and reflection of simple lobes") {
  const Vec3 up{0, 1, 0};
  // Power 0: constant over the lobe's hemisphere. Power 1 around the normal: 2 * integral of u^2 du.
  CHECK(lobeIrradiance(up, up, 0) == doctest::Approx(1));
  CHECK(lobeIrradiance(up, up, 1) == doctest::Approx(2.0 / 3).epsilon(1e-4));
  CHECK(lobeIrradiance(up, {0, -1, 0}, 1) == 0);
  CHECK(lobeReflection(up, up, 1, 0.05) == doctest::Approx(1).epsilon(1e-3));
  CHECK(lobeReflection(up, up, 0, 1.0) == doctest::Approx(1));
}

TEST_CASE("equirectangular directions: top row is +Y, the middle column is +X") {
  CHECK(equirectDirection(0, 0, 8, 512).y > 0.99);
  const Vec3 middle = equirectDirection(512, 256, 1024, 512);
  CHECK(middle.x > 0.999);
  CHECK(equirectDirection(768, 256, 1024, 512).z > 0.999);  // u = 3/4 is +Z
}
