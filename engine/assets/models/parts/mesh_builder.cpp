#include "engine/assets/models/parts/mesh_builder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string_view>
#include <unordered_map>

#include "engine/assets/models/parts/model_files.h"
#include "engine/base/hash.h"
#include "engine/base/limits.h"

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

template <class T>
void pick(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  if (values.empty()) return;
  std::vector<T> picked;
  picked.reserve(order.size());
  for (const std::uint32_t i : order) picked.push_back(values[i]);
  values = std::move(picked);
}

// The vertices become those of `order`, in that order.
void reorder(RawMesh& mesh, const std::vector<std::uint32_t>& order) {
  pick(mesh.positions, order);
  pick(mesh.normals, order);
  pick(mesh.tangents, order);
  pick(mesh.uvs, order);
  pick(mesh.colors, order);
  pick(mesh.joints, order);
  pick(mesh.weights, order);
}

// glTF 2.0, 3.7.2.1: flat normals where a file has none. A vertex per corner, because corners may not share.
void makeNormals(RawMesh& mesh) {
  reorder(mesh, std::vector<std::uint32_t>(mesh.indices));
  mesh.normals.resize(mesh.positions.size());
  mesh.tangents.clear();
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) mesh.indices[i] = static_cast<std::uint32_t>(i);
  for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    const Vec a = Vec(mesh.positions[i]);
    const Vec n = glm::cross(Vec(mesh.positions[i + 1]) - a, Vec(mesh.positions[i + 2]) - a);
    mesh.normals[i] = mesh.normals[i + 1] = mesh.normals[i + 2] = glm::vec3(unit(n, {0, 0, 1}));
  }
}

void cleanNormals(RawMesh& mesh) {
  for (glm::vec3& normal : mesh.normals) {
    if (!std::isfinite(normal.x + normal.y + normal.z)) normal = {0, 0, 0};
    normal = glm::vec3(unit(Vec(normal), {0, 0, 1}));
  }
}

struct TriangleFrame {
  Vec tangent{0};
  double sign = 0;  // of the bitangent; 0: the triangle has no area in uv
};

// Lengyel, "Computing Tangent Space Basis Vectors for an Arbitrary Mesh", 2001; v upwards, as normal maps have green.
TriangleFrame frameOf(const RawMesh& mesh, std::size_t corner) {
  const std::uint32_t a = mesh.indices[corner], b = mesh.indices[corner + 1], c = mesh.indices[corner + 2];
  const Vec e1 = Vec(mesh.positions[b]) - Vec(mesh.positions[a]);
  const Vec e2 = Vec(mesh.positions[c]) - Vec(mesh.positions[a]);
  const double u1 = mesh.uvs[b][0] - mesh.uvs[a][0], v1 = mesh.uvs[a][1] - mesh.uvs[b][1];
  const double u2 = mesh.uvs[c][0] - mesh.uvs[a][0], v2 = mesh.uvs[a][1] - mesh.uvs[c][1];
  const double area = u1 * v2 - u2 * v1;
  if (area == 0 || !std::isfinite(area)) return {};
  const double sign = area > 0 ? 1 : -1;
  return {(e1 * v2 - e2 * v1) * sign, sign};
}

template <class T>
void repeatRow(std::vector<T>& values, std::uint32_t row) {
  if (values.empty()) return;
  const T value = values[row];
  values.push_back(value);
}

void makeTangents(RawMesh& mesh) {
  std::vector<Vec> sums(mesh.positions.size(), Vec(0));
  std::vector<double> signs(mesh.positions.size(), 0);
  std::unordered_map<std::uint32_t, std::uint32_t> mirrored;  // vertex to its copy with the other sign
  for (std::size_t corner = 0; corner + 2 < mesh.indices.size() && !mesh.uvs.empty(); corner += 3) {
    const TriangleFrame frame = frameOf(mesh, corner);
    if (frame.sign == 0) continue;
    for (std::size_t i = corner; i < corner + 3; ++i) {
      std::uint32_t vertex = mesh.indices[i];
      if (signs[vertex] == -frame.sign) {
        const auto [found, isNew] = mirrored.try_emplace(vertex, static_cast<std::uint32_t>(sums.size()));
        if (isNew) {
          repeatRow(mesh.positions, vertex);
          repeatRow(mesh.normals, vertex);
          repeatRow(mesh.uvs, vertex);
          repeatRow(mesh.colors, vertex);
          repeatRow(mesh.joints, vertex);
          repeatRow(mesh.weights, vertex);
          sums.emplace_back(0);
          signs.push_back(frame.sign);
        }
        mesh.indices[i] = vertex = found->second;
      }
      signs[vertex] = frame.sign;
      sums[vertex] = sums[vertex] + frame.tangent;  // longer where the triangle is larger: it counts for more
    }
  }
  mesh.tangents.resize(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec n = Vec(mesh.normals[v]);
    const glm::vec3 t(unit(sums[v] - n * glm::dot(n, sums[v]), perpendicular(n)));
    mesh.tangents[v] = {t, signs[v] < 0 ? -1.0f : 1.0f};
  }
}

bool soundTangents(const RawMesh& mesh) {
  return mesh.tangents.size() == mesh.positions.size() &&
         std::ranges::all_of(mesh.tangents, [](const glm::vec4& t) {
           const double length = glm::dot(Vec(t), Vec(t));
           return std::isfinite(length) && length > 1e-12 && (t[3] == 1 || t[3] == -1);
         });
}

// The four heaviest, adding up to 1.
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

struct BytesHash {
  std::size_t operator()(std::string_view bytes) const { return std::hash<std::string_view>()(bytes); }
};

// Equal vertices become one, in the order in which they come first.
void joinVertices(RawMesh& mesh) {
  const bool normals = !mesh.normals.empty(), uvs = !mesh.uvs.empty(), colors = !mesh.colors.empty(),
             skin = !mesh.weights.empty();
  constexpr std::size_t kBytes = sizeof(glm::vec3) * 2 + sizeof(glm::vec2) + sizeof(glm::vec4) + 64;
  std::vector<char> keys(mesh.positions.size() * kBytes, 0);
  std::unordered_map<std::string_view, std::uint32_t, BytesHash> known;
  known.reserve(mesh.positions.size());
  std::vector<std::uint32_t> order, to(mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    char* key = keys.data() + v * kBytes;
    const auto put = [&](const auto& value) {
      key = std::copy_n(reinterpret_cast<const char*>(&value), sizeof value, key);
    };
    put(mesh.positions[v]);
    if (normals) put(mesh.normals[v]);
    if (uvs) put(mesh.uvs[v]);
    if (colors) put(mesh.colors[v]);
    if (skin) {
      put(mesh.joints[v]);
      put(mesh.weights[v]);
    }
    const auto [found, isNew] =
        known.try_emplace({keys.data() + v * kBytes, kBytes}, static_cast<std::uint32_t>(order.size()));
    if (isNew) order.push_back(static_cast<std::uint32_t>(v));
    to[v] = found->second;
  }
  if (order.size() == mesh.positions.size()) return;
  for (std::uint32_t& index : mesh.indices) index = to[index];
  mesh.tangents.clear();
  reorder(mesh, order);
}

}  // namespace

bool MeshBuilder::hasRoom(std::uint64_t vertices, std::uint64_t corners, const base::Place& place,
                          base::Diagnostics& diagnostics) {
  vertices_ += vertices;
  corners_ += corners;
  const std::uint64_t most = base::raised(kMostVertices);
  const std::uint64_t counted = std::max(vertices_, corners_ / 3);
  if (counted <= most) return true;
  if (!full_)
    base::reportLimit(diagnostics, place, "the model has too many vertices", kMostVertices,
                      "vertices of one model, and a third of its corners", counted)
        .found = fmt::format("{} vertices and {} corners of triangles", vertices_, corners_);
  full_ = true;
  return false;
}

std::uint32_t MeshBuilder::add(RawMesh mesh) {
  assert(mesh.indices.size() % 3 == 0);
  if (mesh.join) joinVertices(mesh);
  if (mesh.normals.empty())
    makeNormals(mesh);
  else
    cleanNormals(mesh);
  if (!soundTangents(mesh)) makeTangents(mesh);

  Mesh row;
  row.name = std::move(mesh.name);
  row.firstVertex = static_cast<std::uint32_t>(model_.vertices.size());
  row.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  row.firstIndex = static_cast<std::uint32_t>(model_.indices.size());
  row.indexCount = static_cast<std::uint32_t>(mesh.indices.size());
  row.skinned = !mesh.weights.empty();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    model_.vertices.push_back({mesh.positions[v], mesh.normals[v], mesh.tangents[v],
                               mesh.uvs.empty() ? glm::vec2(0) : mesh.uvs[v]});
  if (row.skinned || !model_.skin.empty()) {
    model_.skin.resize(row.firstVertex);
    for (std::size_t v = 0; v < mesh.weights.size(); ++v)
      model_.skin.push_back(heaviest(mesh.joints[v], mesh.weights[v]));
    model_.skin.resize(model_.vertices.size());
  }
  for (std::uint32_t v = row.firstVertex; v < model_.vertices.size(); ++v) {
    const glm::vec3 position = model_.vertices[v].position;
    row.bounds.add(position);
    for (std::size_t i = 0; row.skinned && i < 4; ++i) {
      const std::size_t joint = model_.skin[v].joints[i];
      if (!(model_.skin[v].weights[i] > 0)) continue;
      if (row.jointBounds.size() <= joint) row.jointBounds.resize(joint + 1);
      row.jointBounds[joint].add(position);
    }
  }
  if (!mesh.colors.empty() || !model_.colors.empty()) {
    model_.colors.resize(row.firstVertex, {1, 1, 1, 1});
    model_.colors.insert(model_.colors.end(), mesh.colors.begin(), mesh.colors.end());
    model_.colors.resize(model_.vertices.size(), {1, 1, 1, 1});
  }
  model_.indices.insert(model_.indices.end(), mesh.indices.begin(), mesh.indices.end());
  model_.meshes.push_back(std::move(row));
  return static_cast<std::uint32_t>(model_.meshes.size() - 1);
}

void windMirrored(Model& model) {
  // A product of rotations, translations and scales mirrors when an odd number of scales is negative.
  std::vector<bool> mirrors(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const ModelNode& node = model.nodes[i];
    const glm::vec3 scale = node.local.scale;
    const bool own = (scale.x < 0) != ((scale.y < 0) != (scale.z < 0));
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
        for (const std::uint32_t corner : {0u, 2u, 1u}) {
          const std::uint32_t index = model.indices[from + i + corner];
          model.indices.push_back(index);
        }
      model.meshes.push_back(std::move(copy));
    }
    instance.mesh = found->second;
  }
}

}  // namespace weft::assets
