// The built-in shapes of draw passes: vertices without attributes (strips of 4 and 8: quad, octagon; one triangle; n points, lines or
// triangles), and a box and icospheres, whose vertex arrays bind `position` and `normal` to the locations of the program that draws.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "engine/gl/programs/program.h"
#include "engine/passes/pass_type.h"
#include "engine/text/diagnostic.h"

namespace weft::passes {

struct ShapeMesh {
  std::vector<float> positions;        // xyz per vertex
  std::vector<float> normals;          // the same; empty: the normal equals the position
  std::vector<std::uint32_t> indices;  // counter-clockwise triangles seen from outside
};
// 20 * 4^n triangles from an icosahedron; midpoints are shared. n from 0 to kMaxSubdivision.
constexpr int kMaxSubdivision = 6;
ShapeMesh makeIcosphere(int subdivisions);
// From -1 to 1 along each axis.
ShapeMesh makeBox();

// What graphs may write as "geometry".
std::vector<graph::GeometryType> reflectGeometries();

class Geometries {
 public:
  // `name` is one of reflectGeometries(), with all its arguments, in their ranges. Count 0 after an error.
  Geometry get(const std::string& name, const std::vector<double>& arguments,
               const gl::Reflection& reflection, text::Diagnostics& diagnostics);
  Geometry empty();  // for fullscreen triangles

 private:
  struct Mesh {
    gl::Buffer vertices, indices;
    GLsizei count = 0;
    std::uint32_t normals = 0;  // where they begin, in bytes
  };
  gl::VertexArray empty_;
  std::map<int, Mesh> shapes_;                                      // icospheres by subdivision, and the box
  std::map<std::tuple<int, GLint, GLint>, gl::VertexArray> bound_;  // by shape, and where its attributes go
};

}  // namespace weft::passes
