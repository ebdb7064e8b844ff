// Ambient occlusion of models on a floor against rays over the hemisphere through all of their triangles, by the definition: the share of
// directions, weighted by their cosine, in which nothing is near, where what fades with distance counts by its share.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "engine/scene/frame/transforms.h"
#include "tests/theory/mesh_scene.h"

namespace deferred_occlusion_rays_test {

using namespace weft;
using namespace weft::theory;
using runtime::test::CleanScope;

namespace {

// Nearest hits among the opaque triangles and the spheres of a scene, by a tree of boxes.
class Rays {
 public:
  struct Hit {
    float distance;
    glm::vec3 normal{0};  // of the triangle or the sphere itself
  };

  explicit Rays(const scene::Scene& scene) {
    scene::WorldTransforms transforms;
    transforms.update(scene, 1, 0, 0);
    for (const scene::MeshInstance& instance : scene.meshInstances.rows()) {
      if (!(instance.lists & scene::maskOf(scene::DrawList::opaque))) continue;
      const scene::Mesh& mesh = *scene.meshes.find(instance.mesh);
      const glm::mat4& world = transforms.now()[instance.node.index];
      const auto corner = [&](std::uint32_t i) {
        const std::uint32_t index = scene.meshData->indices[mesh.firstIndex + i];
        return glm::vec3(world * glm::vec4(scene.meshData->vertices[mesh.firstVertex + index].position, 1));
      };
      for (std::uint32_t i = 0; i < mesh.indexCount; i += 3)
        triangles_.push_back({corner(i), corner(i + 1), corner(i + 2)});
    }
    for (const scene::Sphere& sphere : scene.spheres.rows())
      if (sphere.lists & scene::maskOf(scene::DrawList::spheres))
        spheres_.push_back(glm::vec4(sphere.center, sphere.radius));
    split(0, static_cast<std::uint32_t>(triangles_.size()));
  }

  Hit nearest(glm::vec3 from, glm::vec3 to, float most) const {
    Hit hit{most};
    for (const glm::vec4& sphere : spheres_) {
      const glm::vec3 off = glm::vec3(sphere) - from;
      const float along = glm::dot(off, to), root2 = sphere.w * sphere.w - glm::dot(off, off) + along * along;
      if (root2 < 0 || along - std::sqrt(root2) <= 0 || along - std::sqrt(root2) >= hit.distance) continue;
      hit.distance = along - std::sqrt(root2);
      hit.normal = glm::normalize(to * hit.distance - off);
    }
    const glm::vec3 per = 1.0f / to;
    std::uint32_t stack[64], height = 0, at = 0;
    for (;;) {
      const Box& box = boxes_[at];
      const glm::vec3 a = (box.low - from) * per, b = (box.high - from) * per, lo = glm::min(a, b),
                      hi = glm::max(a, b);
      if (std::max({lo.x, lo.y, lo.z, 0.0f}) <= std::min({hi.x, hi.y, hi.z, hit.distance})) {
        if (box.count == 0) {
          stack[height++] = box.first;
          ++at;
          continue;
        }
        for (std::uint32_t i = box.first; i < box.first + box.count; ++i) meet(triangles_[i], from, to, hit);
      }
      if (height == 0) return hit;
      at = stack[--height];
    }
  }

 private:
  struct Triangle {
    glm::vec3 a, b, c;
    glm::vec3 middle() const { return a + b + c; }
  };
  struct Box {
    glm::vec3 low, high;
    std::uint32_t first,
        count;  // triangles; without any, the second half's box, and the first half's is the next
  };

  static void meet(const Triangle& triangle, glm::vec3 from, glm::vec3 to, Hit& hit) {
    const glm::vec3 u = triangle.b - triangle.a, v = triangle.c - triangle.a, p = glm::cross(to, v);
    const float size = glm::dot(u, p);
    if (size == 0) return;
    const glm::vec3 off = from - triangle.a, q = glm::cross(off, u);
    const float x = glm::dot(off, p) / size, y = glm::dot(to, q) / size, away = glm::dot(v, q) / size;
    if (x < 0 || y < 0 || x + y > 1 || away <= 0 || away >= hit.distance) return;
    hit = {away, glm::normalize(glm::cross(u, v))};
  }

  void split(std::uint32_t first, std::uint32_t count) {
    Box box{glm::vec3(1e30f), glm::vec3(-1e30f), first, count};
    glm::vec3 low = box.low, high = box.high;
    for (std::uint32_t i = first; i < first + count; ++i) {
      for (const glm::vec3& corner : {triangles_[i].a, triangles_[i].b, triangles_[i].c}) {
        box.low = glm::min(box.low, corner);
        box.high = glm::max(box.high, corner);
      }
      low = glm::min(low, triangles_[i].middle());
      high = glm::max(high, triangles_[i].middle());
    }
    const std::size_t at = boxes_.size();
    boxes_.push_back(box);
    if (count <= 4) return;
    const glm::vec3 wide = high - low;
    const int axis = wide.x > wide.y && wide.x > wide.z ? 0 : wide.y > wide.z ? 1 : 2;
    const auto begin = triangles_.begin() + first;
    std::nth_element(begin, begin + count / 2, begin + count, [&](const Triangle& a, const Triangle& b) {
      return a.middle()[axis] < b.middle()[axis];
    });
    boxes_[at].count = 0;
    split(first, count / 2);
    boxes_[at].first = static_cast<std::uint32_t>(boxes_.size());
    split(first + count / 2, count - count / 2);
  }

  std::vector<Triangle> triangles_;
  std::vector<glm::vec4> spheres_;
  std::vector<Box> boxes_;
};

float random(std::uint32_t& state) {
  state = state * 747796405u + 2891336453u;
  const std::uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
  return static_cast<float>((word >> 22) ^ word) * 2.3283064e-10f;
}

// What a place sees of the sky; -1 where a primary ray does not find it. What lies below the surface itself, which the mapped normal may
// look at, does not count.
float seenFrom(const Rays& rays, glm::vec3 eye, glm::vec3 place, glm::vec3 normal, float radius, int side,
               std::uint32_t seed) {
  const glm::vec3 ray = glm::normalize(place - eye);
  const float far = glm::distance(place, eye);
  const Rays::Hit own = rays.nearest(eye, ray, 1e9f);
  if (std::abs(own.distance - far) > 2e-3f * far) return -1;
  const glm::vec3 flat = glm::dot(own.normal, ray) > 0 ? -own.normal : own.normal;
  const glm::vec3 from = eye + ray * own.distance + flat * 2e-4f;
  const glm::vec3 across = glm::normalize(std::abs(normal.y) < 0.7f ? glm::cross(normal, glm::vec3(0, 1, 0))
                                                                    : glm::cross(normal, glm::vec3(1, 0, 0)));
  float seen = 0, all = 0;
  for (int i = 0; i < side * side; ++i) {
    const float u = (static_cast<float>(i % side) + random(seed)) / static_cast<float>(side);
    const float turn = 2 * std::numbers::pi_v<float> * (static_cast<float>(i / side) + random(seed)) /
                       static_cast<float>(side);
    const glm::vec3 to =
        std::sqrt(u) * (std::cos(turn) * across + std::sin(turn) * glm::cross(normal, across)) +
        std::sqrt(1 - u) * normal;
    if (glm::dot(to, flat) <= 0) continue;
    ++all;
    seen += 1 - std::clamp((radius - rays.nearest(from, to, radius).distance) / (0.4f * radius), 0.0f, 1.0f);
  }
  return all > 0 ? seen / all : -1;
}

}  // namespace

TEST_CASE(
    "ambient occlusion: helmets and spheres on a floor are as rays find them, and the floor has no stripes") {
  const CleanScope clean;
  constexpr std::uint32_t width = 1280, height = 720, step = 12;
  runtime::test::Stage stage("tests/theory/deferred/occlusion_rays.json", width, height,
                             "scenes/helmets.json");
  REQUIRE_MESSAGE(stage.load(), stage.diagnostics.text());
  stage.run();
  const std::vector<float> panels = stage.read("panels");
  const auto texel = [&](std::uint32_t panel, std::uint32_t x, std::uint32_t y) {
    return &panels[4 * (std::size_t{4 * width} * y + panel * width + x)];
  };
  const auto onFloor = [&](std::uint32_t x, std::uint32_t y) {
    return texel(2, x, y)[3] != 0 && std::abs(texel(1, x, y)[1]) < 1e-3f;
  };
  const scene::Scene& scene = stage.world.scene();
  const glm::vec3 eye(scene.cameras.rows()[0].pose.position);
  const Rays rays(scene);
  double sums[2] = {};
  int counts[2] = {};
  for (std::uint32_t row = 0; row < height; row += step)
    for (std::uint32_t column = 0; column < width; column += step) {
      const std::uint32_t x = std::min(column + row / step * 7 % step, width - 1),
                          y = row + column / step * 5 % step;
      if (texel(2, x, y)[3] == 0) continue;
      const float *place = texel(1, x, y), *normal = texel(2, x, y);
      const float truth = seenFrom(rays, eye, {place[0], place[1], place[2]},
                                   {normal[0], normal[1], normal[2]}, 0.5f, 16, x + width * y);
      if (truth < 0) continue;
      sums[onFloor(x, y)] += std::abs(texel(0, x, y)[0] - truth);
      ++counts[onFloor(x, y)];
    }
  // Second differences over four pixels, the half of the period of what was sampled differently.
  double ripple = 0;
  int floors = 0;
  for (std::uint32_t y = 4; y + 4 < height; ++y)
    for (std::uint32_t x = 4; x + 4 < width; ++x) {
      const float here = texel(0, x, y)[0];
      if (here > 0.98f || !onFloor(x, y) || !onFloor(x + 4, y) || !onFloor(x - 4, y) || !onFloor(x, y + 4) ||
          !onFloor(x, y - 4))
        continue;
      ripple += std::abs(texel(0, x - 4, y)[0] + texel(0, x + 4, y)[0] - 2 * here) +
                std::abs(texel(0, x, y - 4)[0] + texel(0, x, y + 4)[0] - 2 * here);
      ++floors;
    }
  const double helmets = sums[0] / counts[0], floor = sums[1] / counts[1];
  MESSAGE("mean difference of ", counts[0], " points of helmets: ", helmets, ", of ", counts[1],
          " of the floor: ", floor, "; ripple ", ripple / floors);
  REQUIRE(counts[0] > 1000);
  REQUIRE(counts[1] > 1000);
  CHECK(helmets < 0.067);
  CHECK(floor < 0.016);
  CHECK(ripple / floors < 0.021);
}

}  // namespace deferred_occlusion_rays_test
