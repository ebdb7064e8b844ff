// Meshes on the device: the vertices and indices of all of a scene, once, and of each draw pass what its view sees of a list,
// as commands for one glMultiDrawElementsIndirect.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/gl/programs/program.h"
#include "engine/imports/row_table.h"
#include "engine/scene/frame/mesh_views.h"
#include "engine/scene/scene.h"
#include "engine/text/diagnostic.h"

namespace weft::imports {

class MeshBuffers {
 public:
  // Sends the vertices when the scene's are others. False after an error.
  bool renew(const scene::Scene& scene, std::uint64_t generation, text::Diagnostics& diagnostics);
  GLuint vertices() const { return vertices_.id(); }
  GLuint skin() const { return skin_.id(); }  // 0: no mesh has one
  GLuint indices() const { return indices_.id(); }
  std::uint64_t serial() const { return serial_; }  // another one when the buffers are others

 private:
  std::shared_ptr<const scene::MeshData> data_;
  std::uint64_t generation_ = 0, serial_ = 0;
  gl::Buffer vertices_, skin_, indices_;
};

// `commands`: DrawCommand[count] in a buffer of their own. Count 0: nothing is seen.
struct MeshDraw {
  GLuint vertexArray = 0, commands = 0;
  GLsizei count = 0;
};

// The meshes of one draw pass: where its program wants the attributes, and what it draws. What its view sees is brought up to
// date from outside, with that of other passes.
class MeshPass {
 public:
  // The names of vertex attributes: position, normal, tangent, uv, joints, weights; and `instance`, the row.
  MeshPass(const gl::Reflection& reflection, std::string label);

  scene::MeshView& view() { return view_; }
  // Draws what its view sees now.
  MeshDraw draw(const MeshBuffers& buffers, text::Diagnostics& diagnostics);

 private:
  void attach(const MeshBuffers& buffers);

  std::string label_;
  std::vector<gl::VertexAttribute> vertex_, skin_, instance_;
  gl::VertexArray vertexArray_;
  gl::Buffer visibleRows_, commandBuffer_;
  std::uint64_t serial_ = 0;  // of the buffers that are attached
  GLuint attachedRows_ = 0;
  scene::MeshView view_;
  std::uint64_t sent_ = 0;  // generation of the view that the buffers hold
};

}  // namespace weft::imports
