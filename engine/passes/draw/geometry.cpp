#include "engine/passes/draw/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace weft::passes {

ShapeMesh makeIcosphere(int subdivisions) {
  ShapeMesh mesh;
  const auto add = [&](double x, double y, double z) {
    const double length = std::sqrt(x * x + y * y + z * z);
    for (const double c : {x, y, z}) mesh.positions.push_back(static_cast<float>(c / length));
    return static_cast<std::uint32_t>(mesh.positions.size() / 3 - 1);
  };
  const double t = (1 + std::sqrt(5.0)) / 2;
  for (const auto& v : std::array<std::array<double, 3>, 12>{{{-1, t, 0},
                                                              {1, t, 0},
                                                              {-1, -t, 0},
                                                              {1, -t, 0},
                                                              {0, -1, t},
                                                              {0, 1, t},
                                                              {0, -1, -t},
                                                              {0, 1, -t},
                                                              {t, 0, -1},
                                                              {t, 0, 1},
                                                              {-t, 0, -1},
                                                              {-t, 0, 1}}})
    add(v[0], v[1], v[2]);
  mesh.indices = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                  4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                  6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
  for (int level = 0; level < subdivisions; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
      const auto [found, inserted] = midpoints.try_emplace(std::minmax(a, b), 0u);
      if (inserted) {
        const auto p = [&](std::uint32_t v, std::size_t i) {
          return static_cast<double>(mesh.positions[v * 3 + i]);
        };
        found->second = add(p(a, 0) + p(b, 0), p(a, 1) + p(b, 1), p(a, 2) + p(b, 2));
      }
      return found->second;
    };
    std::vector<std::uint32_t> finer;
    finer.reserve(mesh.indices.size() * 4);
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
      const std::uint32_t ab = midpoint(a, b), bc = midpoint(b, c), ca = midpoint(c, a);
      for (const std::uint32_t v : {a, ab, ca, b, bc, ab, c, ca, bc, ab, bc, ca}) finer.push_back(v);
    }
    mesh.indices = std::move(finer);
  }
  return mesh;
}

ShapeMesh makeBox() {
  ShapeMesh mesh;
  for (std::uint32_t face = 0; face < 6; ++face) {
    const float side = face % 2 == 0 ? -1.0F : 1.0F;
    std::array<float, 3> position{}, normal{};
    const std::size_t axis = face / 2;
    position[axis] = normal[axis] = side;
    for (std::uint32_t corner = 0; corner < 4; ++corner) {
      position[(axis + 1) % 3] = (corner & 1) != 0 ? side : -side;
      position[(axis + 2) % 3] = (corner & 2) != 0 ? 1.0F : -1.0F;
      mesh.positions.insert(mesh.positions.end(), position.begin(), position.end());
      mesh.normals.insert(mesh.normals.end(), normal.begin(), normal.end());
    }
    for (const std::uint32_t corner : {0u, 1u, 2u, 2u, 1u, 3u}) mesh.indices.push_back(4 * face + corner);
  }
  return mesh;
}

namespace {

// Without attributes, with as many vertices as the graph says.
constexpr std::tuple<const char*, GLenum, int> kTopologies[] = {{"points", GL_POINTS, 1},
                                                                {"lines", GL_LINES, 2},
                                                                {"line_strip", GL_LINE_STRIP, 1},
                                                                {"triangles", GL_TRIANGLES, 3},
                                                                {"triangle_strip", GL_TRIANGLE_STRIP, 1}};
constexpr int kBox = -1;  // among the icospheres
constexpr const char* kOfMeshes = "position, normal, tangent, uv, joints, weights, instance";

}  // namespace

std::vector<graph::GeometryType> reflectGeometries() {
  const graph::GeometryArgument subdivision{
      .name = "subdivision", .min = 0, .max = kMaxSubdivision, .initial = 2};
  const graph::GeometryArgument vertices{.name = "vertices", .min = 0, .max = 2147483647};
  std::vector<graph::GeometryType> types = {
      {"quad", {}},
      {"octagon", {}},
      {.name = "icosphere", .arguments = {subdivision}, .indexed = true, .attributes = "position, normal"},
      {"triangle", {}},
      {.name = "box", .arguments = {}, .indexed = true, .attributes = "position, normal"},
      {.name = "mesh", .arguments = {}, .meshes = true, .attributes = kOfMeshes}};
  for (const auto& [name, mode, multiple] : kTopologies)
    types.push_back({.name = name, .arguments = {vertices}, .counted = multiple});
  return types;
}

Geometry Geometries::empty() {
  if (!empty_) empty_ = gl::VertexArray::create("no attributes");
  return {.vertexArray = empty_.id(), .mode = GL_TRIANGLES, .count = 3, .indexType = 0};
}

Geometry Geometries::get(const std::string& name, const std::vector<double>& arguments,
                         const gl::Reflection& reflection, text::Diagnostics& diagnostics) {
  Geometry geometry = empty();
  if (name == "quad" || name == "octagon") {
    geometry.mode = GL_TRIANGLE_STRIP;
    geometry.count = name == "quad" ? 4 : 8;
  }
  for (const auto& [topology, mode, multiple] : kTopologies)
    if (name == topology) {
      geometry.mode = mode;
      geometry.count = arguments.empty() ? 0 : static_cast<GLsizei>(arguments[0]);
    }
  const bool box = name == "box";
  if (!box && name != "icosphere") return geometry;

  const int subdivisions = box ? kBox : static_cast<int>(arguments[0]);
  Mesh& mesh = shapes_[subdivisions];
  if (mesh.count == 0) {
    ShapeMesh shape = box ? makeBox() : makeIcosphere(subdivisions);
    mesh.normals = shape.normals.empty() ? 0 : static_cast<std::uint32_t>(shape.positions.size() * 4);
    shape.positions.insert(shape.positions.end(), shape.normals.begin(), shape.normals.end());
    const auto send = [&](gl::Buffer& buffer, const auto& numbers) {
      return gl::remake(buffer, numbers.size() * 4, GLbitfield{0}, name, diagnostics, numbers.data());
    };
    if (!send(mesh.vertices, shape.positions) || !send(mesh.indices, shape.indices)) return {};
    mesh.count = static_cast<GLsizei>(shape.indices.size());
  }
  GLint position = -1, normal = -1;
  for (const gl::Interface& attribute : reflection.attributes) {
    if (attribute.name == "position") position = attribute.location;
    if (attribute.name == "normal") normal = attribute.location;
  }
  geometry.count = mesh.count;
  geometry.indexType = GL_UNSIGNED_INT;
  gl::VertexArray& bound = bound_[{subdivisions, position, normal}];
  if (!bound) {
    bound = gl::VertexArray::create(name);
    for (const auto& [binding, location, offset] :
         {std::tuple(0u, position, 0u), std::tuple(1u, normal, mesh.normals)})
      if (const gl::VertexAttribute each{.location = static_cast<GLuint>(location)}; location >= 0)
        bound.setVertices(binding, mesh.vertices.id(), offset, 12, {&each, 1});
    bound.setIndices(mesh.indices.id());
  }
  geometry.vertexArray = bound.id();
  return geometry;
}

}  // namespace weft::passes
