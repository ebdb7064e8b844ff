#include "engine/assets/models/parts/mesh_builder.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "engine/assets/models/parts/model_files.h"
#include "engine/text/limits.h"

namespace weft::assets {

namespace {

using Vec = glm::dvec3;

// `otherwise` for a vector without length.
Vec unit(Vec v, Vec otherwise) {
  const double length = glm::length(v);
  return length > 1e-30 && std::isfinite(length) ? v * (1 / length) : otherwise;
}
// Any unit vector at right angles to `n`. Duff et al., "Building an Orthonormal Basis, Revisited", 2017.
Vec perpendicular(Vec n) {
  const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
  return {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
}

// Calls `act` for each array that has a row for each vertex.
void forColumns(RawMesh& mesh, const auto& act) {
  const auto actUnlessEmpty = [&](auto&... rows) { ((rows.empty() ? void() : act(rows)), ...); };
  actUnlessEmpty(mesh.vertices, mesh.skin, mesh.colors, mesh.secondUvs);
  for (std::vector<MorphTarget>& morph : mesh.morphs) actUnlessEmpty(morph);
}

// glTF 2.0, 3.7.2.1: flat normals where a file has none. A vertex per corner, because corners may not share. A target adds
// what takes them to those of the triangles that it has moved.
void makeNormals(RawMesh& mesh) {
  forColumns(mesh, [&](auto& rows) {
    const auto vertices = std::exchange(rows, {});
    rows.reserve(mesh.indices.size());
    for (const std::uint32_t index : mesh.indices) rows.push_back(vertices[index]);
  });
  std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
  for (std::size_t i = 0; i + 2 < mesh.vertices.size(); i += 3) {
    const auto normalOf = [&](const MorphTarget& a, const MorphTarget& b, const MorphTarget& c) {
      const Vec at = Vec(mesh.vertices[i].position) + Vec(a.position);
      return glm::cross(Vec(mesh.vertices[i + 1].position) + Vec(b.position) - at,
                        Vec(mesh.vertices[i + 2].position) + Vec(c.position) - at);
    };
    const Vec n = normalOf({}, {}, {});
    for (std::size_t c = i; c < i + 3; ++c) {
      mesh.vertices[c].normal = glm::vec3(unit(n, {0, 0, 1}));
      mesh.vertices[c].tangent = glm::vec4(0);
    }
    for (std::vector<MorphTarget>& target : mesh.morphs) {
      const Vec moved = normalOf(target[i], target[i + 1], target[i + 2]);
      const double length = std::max({glm::length(n), 1e-3 * glm::length(moved), 1e-30});
      for (std::size_t c = i; c < i + 3; ++c)
        target[c] = {target[c].position, glm::vec3((moved - n) / length)};
    }
  }
}

struct TriangleFrame {
  glm::vec3 tangent{0};
  float sign = 0;  // of the bitangent; 0: the triangle has no area in uv
};

// Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001; v upwards, as normal maps have green.
TriangleFrame frameOf(const RawMesh& mesh, std::size_t corner) {
  const std::uint32_t* const rows = &mesh.indices[corner];
  const Vertex &a = mesh.vertices[rows[0]], &b = mesh.vertices[rows[1]], &c = mesh.vertices[rows[2]];
  const auto uv = [&](std::size_t i) {
    if (!mesh.tangentsAtSecondUv) return mesh.vertices[rows[i]].uv;
    return mesh.secondUvs.empty() ? glm::vec2(0) : mesh.secondUvs[rows[i]];
  };
  const Vec e1 = Vec(b.position) - Vec(a.position), e2 = Vec(c.position) - Vec(a.position);
  const glm::vec2 ab = uv(1) - uv(0), ac = uv(2) - uv(0);
  const double u1 = ab.x, v1 = -ab.y, u2 = ac.x, v2 = -ac.y;
  const double area = u1 * v2 - u2 * v1;
  if (area == 0 || !std::isfinite(area)) return {};
  const float sign = area > 0 ? 1 : -1;
  return {glm::vec3(e1 * v2 - e2 * v1) * sign, sign};
}

// Each tangent sums those of its triangles, whose length is their area, with the sign of uv as w; it is made a unit vector then.
void makeTangents(RawMesh& mesh) {
  for (Vertex& v : mesh.vertices) v.tangent = glm::vec4(0);
  std::unordered_map<std::uint32_t, std::uint32_t> mirrored;  // vertex to its copy with the other sign
  for (std::size_t corner = 0; corner + 2 < mesh.indices.size(); corner += 3) {
    const TriangleFrame frame = frameOf(mesh, corner);
    if (frame.sign == 0) continue;
    for (std::size_t i = corner; i < corner + 3; ++i) {
      std::uint32_t vertex = mesh.indices[i];
      if (mesh.vertices[vertex].tangent.w == -frame.sign) {
        const auto last = static_cast<std::uint32_t>(mesh.vertices.size());
        const auto [copy, isNew] = mirrored.try_emplace(vertex, last);
        if (isNew) {
          forColumns(mesh, [&](auto& rows) { rows.push_back(rows[vertex]); });
          mesh.vertices.back().tangent = glm::vec4(0);
        }
        mesh.indices[i] = vertex = copy->second;
      }
      glm::vec4& sum = mesh.vertices[vertex].tangent;
      sum = {glm::vec3(sum) + frame.tangent, frame.sign};
    }
  }
  for (Vertex& v : mesh.vertices) {
    const Vec n(v.normal), sum(v.tangent);
    const glm::vec3 t(unit(sum - n * glm::dot(n, sum), perpendicular(n)));
    v.tangent = {t, v.tangent.w < 0 ? -1.0f : 1.0f};
  }
}

bool isSound(const Vertex& v) {
  const double length = glm::dot(Vec(v.tangent), Vec(v.tangent));
  return std::isfinite(length) && length > 1e-12 && (v.tangent[3] == 1 || v.tangent[3] == -1);
}

// Equal vertices become one, in the order in which they come first.
void joinVertices(RawMesh& mesh) {
  std::vector<unsigned> to(mesh.vertices.size());
  std::vector<meshopt_Stream> columns;
  forColumns(mesh, [&](auto& rows) { columns.push_back({rows.data(), sizeof rows[0], sizeof rows[0]}); });
  const std::size_t kept = meshopt_generateVertexRemapMulti(
      to.data(), mesh.indices.data(), mesh.indices.size(), to.size(), columns.data(), columns.size());
  forColumns(mesh, [&](auto& rows) {
    meshopt_remapVertexBuffer(rows.data(), rows.data(), to.size(), sizeof rows[0], to.data());
    rows.resize(kept);
  });
  meshopt_remapIndexBuffer(mesh.indices.data(), mesh.indices.data(), mesh.indices.size(), to.data());
}

}  // namespace

bool normalizeRotation(glm::vec4& q) {
  const double length = glm::length(glm::dvec4(q));
  if (!(length > 1e-12)) return false;
  q = glm::vec4(glm::dvec4(q) / length);
  return true;
}

// The exponent of Blinn–Phong as the width of GGX: alpha² = 2 / (n + 2) (Walter et al. 2007), alpha = roughness². What
// has no diffuse color but a bright highlight with a color, or a color map, is taken for metal; that of black lacquer is white.
void toMetallicRoughness(Material& material) {
  const auto [darkest, brightest] =
      std::minmax({material.specular.x, material.specular.y, material.specular.z});
  material.blinnPhong = true;
  material.roughness = std::pow(2 / (material.shininess + 2), 0.25f);
  if (std::max({material.albedo.x, material.albedo.y, material.albedo.z}) >= 0.04f || brightest < 0.25f ||
      (material.albedoMap == kNoRow && darkest > 0.9f * brightest))
    return;
  material.metallic = 1;
  material.albedo = material.specular;
}

SkinVertex heaviest(const std::array<std::uint32_t, 8>& joints, const std::array<float, 8>& weights) {
  std::array<std::size_t, 8> order{0, 1, 2, 3, 4, 5, 6, 7};
  std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) { return weights[a] > weights[b]; });
  SkinVertex out;
  double sum = 0;
  for (std::size_t i = 0; i < 4; ++i) sum += std::max(0.0f, weights[order[i]]);
  for (std::size_t i = 0; i < 4; ++i) {
    const float weight = std::max(0.0f, weights[order[i]]);
    if (sum > 0 && !(weight > 0)) continue;
    out.joints[i] = static_cast<std::uint16_t>(joints[order[i]]);
    out.weights[i] = sum > 0 ? static_cast<float>(weight / sum) : (i == 0 ? 1.0f : 0.0f);
  }
  return out;
}

bool MeshBuilder::hasRoom(std::uint64_t vertices, std::uint64_t corners, const text::Place& place,
                          text::Diagnostics& diagnostics) {
  vertices_ += vertices;
  corners_ += corners;
  const std::uint64_t counted = std::max(vertices_, corners_ / 3);
  if (counted <= text::raised(kMaxVertices)) return true;
  if (!full_)
    text::reportLimit(diagnostics, place, "the model has too many vertices", kMaxVertices,
                      "vertices of one model with its morph targets, and a third of its corners", counted)
        .found = fmt::format("{} vertices and {} corners of triangles", vertices_, corners_);
  full_ = true;
  return false;
}

std::uint32_t MeshBuilder::add(RawMesh mesh) {
  assert(mesh.indices.size() % 3 == 0);
  if (mesh.join) joinVertices(mesh);
  if (!mesh.normals) makeNormals(mesh);
  for (Vertex& v : mesh.vertices)
    if (mesh.normals) v.normal = glm::vec3(unit(Vec(v.normal), {0, 0, 1}));
  if (!std::ranges::all_of(mesh.vertices, isSound)) makeTangents(mesh);

  Mesh row;
  row.name = std::move(mesh.name);
  row.firstVertex = static_cast<std::uint32_t>(model_.vertices.size());
  row.vertexCount = static_cast<std::uint32_t>(mesh.vertices.size());
  row.firstIndex = static_cast<std::uint32_t>(model_.indices.size());
  row.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
  row.skinned = !mesh.skin.empty();
  row.firstTarget = static_cast<std::uint32_t>(model_.targets.size());
  row.targetBounds.resize(mesh.morphs.size());
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    const glm::vec3 position = mesh.vertices[v].position;
    row.bounds.add(position);
    for (std::size_t t = 0; t < mesh.morphs.size(); ++t) {
      mesh.targets.push_back(mesh.morphs[t][v]);
      row.targetBounds[t].add(mesh.targets.back().position);
    }
    for (std::size_t i = 0; row.skinned && i < 4; ++i) {
      const std::size_t joint = mesh.skin[v].joints[i];
      if (!(mesh.skin[v].weights[i] > 0)) continue;
      if (row.jointBounds.size() <= joint) row.jointBounds.resize(joint + 1);
      row.jointBounds[joint].add(position);
    }
  }
  row.clear = std::ranges::any_of(mesh.colors, [](const glm::vec4& color) { return color.a < 1; });
  moveInto(model_, std::move(mesh));
  model_.meshes.push_back(std::move(row));
  return static_cast<std::uint32_t>(model_.meshes.size() - 1);
}

void windMirrored(Model& model) {
  // A product of rotations, translations and scales mirrors when an odd number of scales is negative.
  std::vector<bool> mirrors(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    const glm::vec3 scale = node.local.scale;
    const bool own =
        ((scale.x < 0) != (scale.y < 0)) != ((scale.z < 0) != (glm::determinant(node.inner) < 0));
    mirrors[i] = own != (node.parent != kNoRow && mirrors[node.parent]);
  }
  std::map<std::uint32_t, std::uint32_t> turned;
  for (ModelInstance& instance : model.instances) {
    if (instance.skin != kNoRow || !mirrors[instance.node]) continue;
    const auto [found, isNew] =
        turned.try_emplace(instance.mesh, static_cast<std::uint32_t>(model.meshes.size()));
    if (isNew) {
      Mesh copy = model.meshes[instance.mesh];
      const std::uint32_t from = copy.firstIndex;
      copy.firstIndex = static_cast<std::uint32_t>(model.indices.size());
      for (std::uint32_t i = 0; i + 2 < copy.indexCount; i += 3)
        for (const std::uint32_t corner : {0u, 2u, 1u})
          model.indices.push_back(model.indices[from + i + corner]);
      model.meshes.push_back(std::move(copy));
    }
    instance.mesh = found->second;
  }
}

}  // namespace weft::assets
