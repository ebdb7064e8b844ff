#include "engine/imports/scene_tables.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace weft::imports {

namespace {

// By their names; the program says where.
using Attribute = std::pair<std::string_view, gl::VertexAttribute>;
constexpr Attribute kVertex[] = {{"position", {.offset = offsetof(scene::Vertex, position)}},
                                 {"normal", {.offset = offsetof(scene::Vertex, normal)}},
                                 {"tangent", {.components = 4, .offset = offsetof(scene::Vertex, tangent)}},
                                 {"uv", {.components = 2, .offset = offsetof(scene::Vertex, uv)}}};
constexpr Attribute kSkin[] = {
    {"joints",
     {.components = 4,
      .type = GL_UNSIGNED_SHORT,
      .offset = offsetof(scene::SkinVertex, joints),
      .integer = true}},
    {"weights", {.components = 4, .offset = offsetof(scene::SkinVertex, weights)}}};
constexpr Attribute kInstance[] = {{"instance", {.components = 1, .type = GL_UNSIGNED_INT, .integer = true}}};

std::vector<gl::VertexAttribute> wantedOf(const gl::Reflection& reflection,
                                          std::span<const Attribute> known) {
  std::vector<gl::VertexAttribute> wanted;
  for (const gl::Interface& each : reflection.attributes)
    for (const auto& [name, attribute] : known)
      if (each.name == name) {
        wanted.push_back(attribute);
        wanted.back().location = static_cast<GLuint>(each.location);
      }
  return wanted;
}

template <class T>
bool create(gl::Buffer& buffer, const std::vector<T>& rows, const char* label,
            text::Diagnostics& diagnostics) {
  buffer = {};
  return rows.empty() ||
         gl::remake(buffer, rows.size() * sizeof(T), GLbitfield{0}, label, diagnostics, rows.data());
}

}  // namespace

MeshPass::MeshPass(const gl::Reflection& reflection, std::string label)
    : label_(std::move(label)),
      vertex_(wantedOf(reflection, kVertex)),
      skin_(wantedOf(reflection, kSkin)),
      instance_(wantedOf(reflection, kInstance)),
      vertexArray_(gl::VertexArray::create(label_)) {}

void MeshPass::attach(const MeshBuffers& buffers) {
  if (std::exchange(serial_, buffers.serial) != buffers.serial) {
    vertexArray_.setVertices(0, buffers.vertices.id(), 0, sizeof(scene::Vertex), vertex_);
    vertexArray_.setIndices(buffers.indices.id());
    if (buffers.skin)
      vertexArray_.setVertices(1, buffers.skin.id(), 0, sizeof(scene::SkinVertex), skin_);
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

Columns<scene::Instance> sphereColumns() {
  using Row = scene::Instance;
  return {column<Row, &Row::center>("center", "world"),
          column<Row, &Row::radius>("radius", "world units"),
          column<Row, &Row::previous_center>("previous_center", "of the frame before"),
          column<Row, &Row::roughness>("roughness", "perceptual"),
          column<Row, &Row::albedo>("albedo", "linear; F0 of a metal"),
          column<Row, &Row::metallic>("metallic", "0 to 1")};
}

Columns<scene::MeshRow> meshColumns() {
  using Row = scene::MeshRow;
  return {column<Row, &Row::transform>("transform", "model to world"),
          column<Row, &Row::previous_transform>("previous_transform", "of the frame before"),
          column<Row, &Row::material>("material", "row of @materials"),
          column<Row, &Row::first_joint>("first_joint", "of @joints; of a mesh whose weights are not 0"),
          column<Row, &Row::first_weight>("first_weight", "of @morph_weights; of a mesh with targets"),
          column<Row, &Row::first_target>("first_target", "of @morph_targets, for gl_VertexID 0"),
          column<Row, &Row::targets>("targets", "of each vertex, one after another; 0: nothing morphs it")};
}

SceneTables::SceneTables() {
  for (int i = 0; i < scene::kDrawListCount; ++i)
    add(static_cast<scene::DrawList>(i), scene::drawListNames()[static_cast<std::size_t>(i)]);
}

void SceneTables::add(const scene::Selection& selection, const std::string& label) {
  lists_.push_back({.selection = selection,
                    .spheres = {label, sphereColumns()},
                    .meshes = {label + " meshes", meshColumns()},
                    .rows = {}});
}

scene::DrawList SceneTables::listOf(const scene::Selection& selection) {
  const auto known = std::ranges::find(lists_, selection, &List::selection);
  const auto list = static_cast<scene::DrawList>(known - lists_.begin());
  if (known == lists_.end()) {
    add(selection, "draw list");
    chosen_.push_back(selection);
    meshFrameNumber_ = 0;
  }
  return list;
}

void SceneTables::beginFrame(const World& world, const FrameInput& input, std::uint64_t number) {
  world_ = &world;
  input_ = &input;
  number_ = number;
  const auto moment = std::pair(input.time, input.deltaTime);
  if (moment != moment_) ++moments_;
  moment_ = moment;
}

const SceneTables::List& SceneTables::factsOf(scene::DrawList list) {
  List& mine = of(list);
  if (mine.scene != world_->sceneGeneration()) {
    mine.scene = world_->sceneGeneration();
    const scene::Members members(mine.selection, world_->scene());
    mine.count = static_cast<std::uint32_t>(members.count(world_->scene().spheres));
    mine.moving = scene::isMoving(world_->scene(), mine.selection);
  }
  return mine;
}

std::uint64_t SceneTables::generation(scene::DrawList list) {
  const std::uint64_t still = world_->sceneGeneration() << 32;
  return factsOf(list).moving ? still + moments_ : still;
}

const std::vector<scene::Instance>& SceneTables::rows(scene::DrawList list) {
  List& mine = of(list);
  const std::uint64_t wanted = generation(list);
  if (mine.generation != wanted) {
    scene::fillInstances(world_->scene(), mine.selection, input_->time, input_->time - input_->deltaTime,
                         mine.rows);
    mine.generation = wanted;
  }
  return mine.rows;
}

BufferRef SceneTables::spheres(scene::DrawList list, const RowLayout& layout,
                               text::Diagnostics& diagnostics) {
  const auto all = [&] { return std::span(rows(list)); };
  return of(list).spheres.get(layout, generation(list), all, diagnostics);
}

const scene::MeshFrame& SceneTables::meshFrame() {
  if (meshFrameNumber_ != number_) {
    meshFrame_.update(world_->scene(), world_->sceneGeneration(), input_->time,
                      input_->time - input_->deltaTime, chosen_);
    meshFrameNumber_ = number_;
  }
  return meshFrame_;
}

BufferRef SceneTables::meshes(scene::DrawList list, const RowLayout& layout, text::Diagnostics& diagnostics) {
  const auto all = [&] { return meshFrame().rows(list); };
  return of(list).meshes.get(layout, meshFrame().generation(list), all, diagnostics);
}

void SceneTables::see(std::span<scene::MeshView* const> views) {
  scene::MeshView::update(world_->scene(), meshFrame(), views);
}

MeshDraw SceneTables::draw(MeshPass& pass, text::Diagnostics& diagnostics) {
  MeshBuffers& buffers = meshBuffers_;
  const auto& data = world_->scene().meshData;
  if (std::exchange(buffers.data, data) != data) {
    ++buffers.serial;
    if (data && !(create(buffers.vertices, data->vertices, "mesh vertices", diagnostics) &&
                  create(buffers.skin, data->skin, "mesh skins", diagnostics) &&
                  create(buffers.indices, data->indices, "mesh indices", diagnostics)))
      return {};
  }
  return pass.draw(buffers, diagnostics);
}

}  // namespace weft::imports
