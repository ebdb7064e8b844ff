#include "engine/passes/draw/geometry.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

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

std::vector<graph::GeometryType> reflectGeometries() {
  const graph::GeometryArgument subdivision{
      .name = "subdivision", .min = 0, .max = kMaxSubdivision, .initial = 2};
  return {{"quad", {}}, {"octagon", {}}, {"icosphere", {subdivision}}, {"triangle", {}}, {"mesh", {}, true}};
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
  if (name != "icosphere") return geometry;

  assert(arguments.size() == 1 && arguments[0] >= 0 && arguments[0] <= kMaxSubdivision);
  const int subdivisions = static_cast<int>(arguments[0]);
  Mesh& mesh = icospheres_[subdivisions];
  if (mesh.count == 0) {
    const ShapeMesh shape = makeIcosphere(subdivisions);
    auto vertices =
        gl::Buffer::create(shape.positions.size() * 4, 0, "icosphere", diagnostics, shape.positions.data());
    auto indices =
        gl::Buffer::create(shape.indices.size() * 4, 0, "icosphere", diagnostics, shape.indices.data());
    if (!vertices || !indices) return {};
    mesh = {std::move(*vertices), std::move(*indices), static_cast<GLsizei>(shape.indices.size())};
  }
  GLint position = -1, normal = -1;
  for (const gl::Interface& attribute : reflection.attributes) {
    if (attribute.name == "position") position = attribute.location;
    if (attribute.name == "normal") normal = attribute.location;
  }
  geometry.count = mesh.count;
  geometry.indexType = GL_UNSIGNED_INT;
  for (const Bound& each : bound_)
    if (each.subdivisions == subdivisions && each.position == position && each.normal == normal) {
      geometry.vertexArray = each.vertexArray.id();
      return geometry;
    }
  Bound bound{subdivisions, position, normal, gl::VertexArray::create("icosphere")};
  std::vector<gl::VertexAttribute> attributes;
  for (const GLint location : {position, normal})
    if (location >= 0) attributes.push_back({.location = static_cast<GLuint>(location), .components = 3});
  bound.vertexArray.setVertices(0, mesh.vertices.id(), 0, 12, attributes);
  bound.vertexArray.setIndices(mesh.indices.id());
  geometry.vertexArray = bound.vertexArray.id();
  bound_.push_back(std::move(bound));
  return geometry;
}

}  // namespace weft::passes
