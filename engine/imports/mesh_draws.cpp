#include "engine/imports/mesh_draws.h"

#include <array>
#include <cstddef>

namespace weft::imports {

namespace {

struct Attribute {
  std::string_view name;
  GLint components;
  GLenum type;
  std::uint32_t offset;
  bool integer;
};
constexpr std::array<Attribute, 4> kVertex = {
    {{"position", 3, GL_FLOAT, offsetof(scene::Vertex, position), false},
     {"normal", 3, GL_FLOAT, offsetof(scene::Vertex, normal), false},
     {"tangent", 4, GL_FLOAT, offsetof(scene::Vertex, tangent), false},
     {"uv", 2, GL_FLOAT, offsetof(scene::Vertex, uv), false}}};
constexpr std::array<Attribute, 2> kSkin = {
    {{"joints", 4, GL_UNSIGNED_SHORT, offsetof(scene::SkinVertex, joints), true},
     {"weights", 4, GL_FLOAT, offsetof(scene::SkinVertex, weights), false}}};
constexpr std::array<Attribute, 1> kInstance = {{{"instance", 1, GL_UNSIGNED_INT, 0, true}}};

std::vector<gl::VertexAttribute> wantedOf(const gl::Reflection& reflection,
                                          std::span<const Attribute> known) {
  std::vector<gl::VertexAttribute> wanted;
  for (const gl::Interface& each : reflection.attributes)
    for (const Attribute& attribute : known)
      if (each.name == attribute.name)
        wanted.push_back({.location = static_cast<GLuint>(each.location),
                          .components = attribute.components,
                          .type = attribute.type,
                          .offset = attribute.offset,
                          .integer = attribute.integer});
  return wanted;
}

template <class T>
bool create(gl::Buffer& buffer, const std::vector<T>& rows, const char* label,
            text::Diagnostics& diagnostics) {
  buffer = {};
  if (rows.empty()) return true;
  auto made = gl::Buffer::create(rows.size() * sizeof(T), 0, label, diagnostics, rows.data());
  if (!made) return false;
  buffer = std::move(*made);
  return true;
}

}  // namespace

bool MeshBuffers::renew(const scene::Scene& scene, std::uint64_t generation, text::Diagnostics& diagnostics) {
  if (generation_ == generation || data_ == scene.meshData) {
    generation_ = generation;
    return true;
  }
  ++serial_;
  generation_ = generation;
  data_ = scene.meshData;
  if (!data_) return true;
  return create(vertices_, data_->vertices, "mesh vertices", diagnostics) &&
         create(skin_, data_->skin, "mesh skins", diagnostics) &&
         create(indices_, data_->indices, "mesh indices", diagnostics);
}

MeshPass::MeshPass(const gl::Reflection& reflection, std::string label)
    : label_(std::move(label)),
      vertex_(wantedOf(reflection, kVertex)),
      skin_(wantedOf(reflection, kSkin)),
      instance_(wantedOf(reflection, kInstance)),
      vertexArray_(gl::VertexArray::create(label_)) {}

void MeshPass::attach(const MeshBuffers& buffers) {
  if (serial_ != buffers.serial()) {
    serial_ = buffers.serial();
    vertexArray_.setVertices(0, buffers.vertices(), 0, sizeof(scene::Vertex), vertex_);
    vertexArray_.setIndices(buffers.indices());
    if (buffers.skin())
      vertexArray_.setVertices(1, buffers.skin(), 0, sizeof(scene::SkinVertex), skin_);
    else
      vertexArray_.disable(skin_);  // joints and weights are the constant 0 then
  }
  if (attachedRows_ == visibleRows_.id()) return;
  attachedRows_ = visibleRows_.id();
  vertexArray_.setVertices(2, attachedRows_, 0, sizeof(std::uint32_t), instance_, 1);
}

MeshDraw MeshPass::draw(const MeshBuffers& buffers, text::Diagnostics& diagnostics) {
  const std::span<const scene::DrawCommand> commands = view_.commands();
  if (commands.empty()) return {};
  if (sent_ != view_.generation()) {
    if (!sendTo(visibleRows_, std::as_bytes(view_.visible()), label_, true, diagnostics) ||
        !sendTo(commandBuffer_, std::as_bytes(commands), label_, true, diagnostics))
      return {};
    sent_ = view_.generation();
  }
  attach(buffers);
  return {vertexArray_.id(), commandBuffer_.id(), static_cast<GLsizei>(commands.size())};
}

}  // namespace weft::imports
