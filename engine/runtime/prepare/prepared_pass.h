// A step of a plan as the frame loop needs it: program, bindings by unit, attachments, state, uniform bytes. It is
// prepared once per plan; running it looks nothing up by name and allocates nothing.
#pragma once

#include <glad/gl.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/gl/programs/program_cache.h"
#include "engine/graph/plan.h"
#include "engine/imports/row_table.h"
#include "engine/imports/scene_tables.h"
#include "engine/passes/draw/geometry.h"
#include "engine/passes/pass_type.h"
#include "engine/runtime/storage/block_writer.h"
#include "engine/runtime/storage/caches.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

// Some levels or layers of an imported texture, as one binding sees them. The texture may be another one in any frame, so the
// view of it is made when it is bound, and kept until the import changes.
class ImportPart {
 public:
  // `import`: its name, for messages. The format of `part` is 0: that of the texture.
  ImportPart(const gl::ViewDesc& part, std::string import) : part_(part), import_(std::move(import)) {}

  // `generation` is another number when `texture` is another one under the name of one that was destroyed. Levels and layers
  // that it lacks are its last ones: the texture that is there while an import is loaded may be one texel. 0: there is none, or W118 was
  // reported.
  GLuint viewOf(const gl::TextureRef& texture, std::uint64_t generation, text::Diagnostics& diagnostics) {
    if (texture.id == texture_ && generation == generation_) return view_.id();
    texture_ = texture.id;
    generation_ = generation;
    view_.reset();
    if (texture.id == 0) return 0;
    gl::ViewDesc part = part_;
    part.mips = std::min(part.mips, texture.desc.mips);
    part.mip = std::min(part.mip, texture.desc.mips - part.mips);
    part.layers = std::min(part.layers, texture.desc.layers);
    part.layer = std::min(part.layer, texture.desc.layers - part.layers);
    gl::remake(view_, texture, part, import_, diagnostics);
    return view_.id();
  }

 private:
  gl::ViewDesc part_;
  std::string import_;
  GLuint texture_ = 0;  // of which view_ is
  std::uint64_t generation_ = 0;
  gl::Texture view_;
};

// Condition of a binding: that of what "first" of a resource names is used until publication @-history of that resource exists.
struct FirstOf {
  std::uint32_t resource = graph::kNone;  // kNone: the binding holds always
  std::uint8_t history = 0;
};

// A sampler or an image.
struct TextureBinding {
  std::uint32_t unit = 0, resource = 0;
  std::uint8_t history = 0;
  GLuint sampler = 0;
  GLenum access = 0, format = GL_NONE;  // of an image; access 0: a sampler
  GLboolean layered = GL_FALSE;
  // Per copy; empty for an import, which is bound by the current texture of its resource.
  std::vector<GLuint> views;
  std::shared_ptr<ImportPart> part{};  // of an import; null: the whole
  FirstOf firstOf{};                   // a binding with one stands behind the binding that it replaces
};

struct BufferBinding {
  GLenum target = GL_SHADER_STORAGE_BUFFER;  // GL_DRAW_INDIRECT_BUFFER: of a draw or a dispatch
  GLuint index = 0;
  std::uint32_t resource = 0;
  std::uint8_t history = 0;
  std::uint32_t import = graph::kNone;  // into FlatGraph::imports
  imports::RowLayout layout;            // of a table
  bool drawn = false;                   // the implicit block `instances`: rows of what the pass draws
  FirstOf firstOf{};
};

struct AttachmentBinding {
  GLenum point = GL_COLOR_ATTACHMENT0;
  std::uint32_t resource = 0;
  std::uint32_t mip = 0;
  std::int32_t layer = -1;
  std::vector<GLuint> textures;  // per copy
  graph::FlatUse use;
  std::uint32_t index = graph::kNone;  // of `use` in FlatGraph::uses
};

// The source or destination of a pass type without a shader.
struct FixedBinding {
  bool source = true;
  std::uint32_t resource = 0, mip = 0;
  std::int32_t layer = -1;  // -1: all
  std::uint8_t history = 0;
  // Per copy, of exactly the levels and layers; of types with framebuffers the whole: Mesa's blits do not see where a view begins.
  std::vector<GLuint> views;
  std::shared_ptr<ImportPart> part{};  // as above; of types without framebuffers
  FirstOf firstOf{};
};

struct ClearCommand {
  graph::FlatUse use;
  graph::Format format = graph::Format::none;
  graph::Value value;
  int attachment = -1;  // index into PreparedPass::attachments: cleared through the framebuffer
};

// A uniform that changes with time.
struct DynamicUniform {
  Field field;
  graph::Expr expr;
};

struct PreparedPass {
  const passes::PassType* type = nullptr;
  passes::PassContext context;
  std::shared_ptr<const gl::Variant> variant;  // null for types without a shader
  std::vector<TextureBinding> textures;
  std::vector<BufferBinding> buffers;
  std::vector<AttachmentBinding> attachments;
  std::vector<FixedBinding> fixed;
  std::vector<ClearCommand> clears;
  std::vector<std::uint32_t> written, read;  // resources (attached writes; reads)
  std::uint32_t width = 0, height = 0;       // of the attachments
  bool feedback = false;
  bool writesColor = true;   // false: the shader has no output, and an attachment only says the size
  bool sizesPoints = false;  // its vertex shader writes gl_PointSize
  bool encodesSrgb = false;  // an attachment is sRGB: GL encodes the linear light of shaders
  std::uint32_t group = graph::kNone;  // as Plan::groups
  bool framebuffers = false;           // as graph::PassType
  int list = -1;                       // scene::DrawList whose rows are the instances of a draw; -1: none
  std::shared_ptr<imports::MeshPass> meshes;  // of a draw of the list's meshes
  // The uniform blocks of the program, null for one that it does not have. The bytes of all passes lie in one buffer;
  // UniformArena gives the offsets in it, which are aligned.
  const gl::Block* parametersBlock = nullptr;
  const gl::Block* viewBlock = nullptr;
  const gl::Block* sliceBlock = nullptr;
  std::uint32_t parametersOffset = 0, viewOffset = 0, sliceOffset = 0;
  std::vector<DynamicUniform> dynamics;
  std::uint64_t programHash = 0;
  using DrawBuffer = std::pair<GLuint, graph::ColorState>;  // by its index
  std::vector<DrawBuffer> colors;
};

// What preparePass() needs of the executor.
struct PrepareContext {
  const graph::Plan& plan;
  const passes::PassRegistry& types;
  std::shared_ptr<const gl::Variant> variant;  // of the pass to prepare; null for types without a shader
  ResourcePool& pool;
  passes::Geometries& geometries;
  SamplerCache& samplers;
  imports::SceneTables& tables;
  text::Diagnostics& diagnostics;
};

// Fills everything but the uniform offsets. Nothing when the device refuses a view, which is reported.
std::optional<PreparedPass> preparePass(PrepareContext& context, std::size_t step);

// How many instances a draw has whose number contains age(), see PassSpec::timedInstances.
std::uint32_t instancesAt(const graph::Expr& timed, const std::function<double(std::uint32_t)>& ageOf);

}  // namespace weft::runtime
