// Prepares a step of a plan: finds units and bindings by introspection of its program, makes views, and chooses samplers.
// Declared in prepared_pass.h.
#include <algorithm>
#include <cassert>

#include "engine/glsl/interface.h"
#include "engine/imports/import.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/runtime/storage/formats.h"
#include "engine/text/hash.h"

namespace weft::runtime {

using graph::Access;
using graph::FlatResource;
using graph::FlatUse;
using graph::Kind;
using graph::kNone;
using graph::PassSpec;
using graph::SlotSpec;

namespace {

class Preparer {
 public:
  Preparer(PrepareContext& context, std::size_t step)
      : c_(context), step_(c_.plan.steps[step]), graph_(*c_.plan.graph), spec_(graph_.specs[step_.pass]) {}

  std::optional<PreparedPass> run() {
    out_.type = c_.types.find(spec_.type);
    out_.context.spec = &spec_;
    const graph::PassType type = out_.type->reflect();
    out_.framebuffers = type.framebuffers;
    out_.group = c_.plan.groups.groupOf(step_.pass);
    collectUses();
    const bool shaded = type.shader != graph::ShaderShape::none;
    if (shaded) takeProgram();
    if (!(shaded ? bindSlots() : bindFixed(type.fromSource))) return std::nullopt;
    if (shaded) prepareGeometry(type);
    collectClears();
    return std::move(out_);
  }

 private:
  int listOf() const {
    const auto* own = spec_.listImport == kNone ? nullptr : &graph_.imports[spec_.listImport].request;
    return static_cast<int>(
        c_.tables.listOf(own ? imports::selectionOf(*own) : *scene::findDrawList(spec_.list)));
  }

  bool isAttached(std::uint32_t use) const { return c_.plan.attached[use] != 0; }

  void collectUses() {
    const auto addOnce = [](std::vector<std::uint32_t>& list, std::uint32_t resource) {
      if (std::ranges::find(list, resource) == list.end()) list.push_back(resource);
    };
    for (const std::uint32_t i : graph_.usesOf(step_.pass)) {
      const FlatUse& use = graph_.uses[i];
      if (use.access == Access::read)
        addOnce(out_.read, use.resource);
      else if (isAttached(i))
        addOnce(out_.written, use.resource);
      out_.feedback |= use.feedback;
    }
  }

  void takeProgram() {
    out_.variant = c_.variant;
    out_.programHash = text::hashBytes(out_.variant->key);
    const gl::Reflection& reflection = out_.variant->program.reflection();
    out_.parametersBlock = reflection.findUniformBlock("Parameters");
    out_.viewBlock = reflection.findUniformBlock("View");
    out_.sliceBlock = reflection.findUniformBlock("Slice");
    std::copy_n(reflection.workGroup, 3, out_.context.groupSize);
  }

  std::vector<GLuint> viewsOf(const FlatUse& use, GLenum target) {
    std::vector<GLuint> views;
    const GpuResource& resource = c_.pool[use.resource];
    if (!resource.texture) return views;  // an import
    for (std::uint32_t copy = 0; copy < resource.copies; ++copy)
      views.push_back(c_.pool.view(c_.plan, use, copy, target, c_.diagnostics).id);
    return views;
  }

  // Null when the use is of a texture of the graph itself, or of a whole import.
  std::shared_ptr<ImportPart> importPartOf(const FlatUse& use, GLenum target) {
    const FlatResource& resource = graph_.resources[use.resource];
    if (resource.kind != graph::ResourceKind::imported_texture) return nullptr;
    const GLenum own = glTargetOf(resource.target);
    if (target == 0) target = own;
    const bool whole = target == own && use.mip == 0 && use.mips == resource.mips && use.layer == 0 &&
                       use.layers == resource.layers && use.planes != 2;
    if (whole) return nullptr;
    const gl::ViewDesc part{.target = target,
                            .mip = use.mip,
                            .mips = use.mips,
                            .layer = use.layer,
                            .layers = use.layers,
                            .stencil = use.planes == 2};
    return std::make_shared<ImportPart>(part, graph_.resourceNames[use.resource]);
  }

  static bool complete(const std::vector<GLuint>& views) {
    return std::ranges::none_of(views, [](GLuint id) { return id == 0; });
  }

  bool bindSlots() {
    bool good = true;
    for (const SlotSpec& slot : graph_.slotsOf(spec_)) {
      for (std::uint32_t k = 0; k < slot.useCount; ++k) {
        const std::uint32_t index = slot.firstUse + k;
        if (slot.access != Access::read && !isAttached(index)) continue;
        good &= bindUse(slot, index, k) && bindFirst(slot, index, k);
      }
    }
    if (out_.attachments.empty()) good &= attachRaster();
    if (spec_.raster[0] > 0) out_.width = spec_.raster[0], out_.height = spec_.raster[1];
    const gl::Block* instances =
        out_.variant->program.reflection().findStorageBlock(imports::kInstancesBlock);
    if (instances && !spec_.list.empty() && !graph_.hasSlot(spec_, imports::kInstancesBlock)) {
      BufferBinding binding{.index = instances->binding};
      binding.drawn = true;
      takeLayout(*instances, instanceColumnsOf(spec_), binding);
      out_.buffers.push_back(binding);
    }
    return good;
  }

  // A draw is never without a framebuffer of its own: where the program has no output for any attachment, one says the size.
  bool attachRaster() {
    for (const SlotSpec& slot : graph_.slotsOf(spec_)) {
      if (slot.useCount == 0 || slot.kind != Kind::color || !isAttached(slot.firstUse)) continue;
      out_.writesColor = false;
      return attach(slot.firstUse, GL_COLOR_ATTACHMENT0);
    }
    return true;
  }

  // For a read of @-n: also binds, in the same place, what "first" of the resource names.
  bool bindFirst(const SlotSpec& slot, std::uint32_t index, std::uint32_t element) {
    if (slot.firstValue == kNone) return true;
    firstOf_ = {graph_.uses[index].resource, graph_.uses[index].history};
    const bool good = bindUse(slot, slot.firstValue, element);
    firstOf_ = {};
    return good;
  }

  // checkProgram() has found that the block is a table.
  static void takeLayout(const gl::Block& block, std::span<const graph::TableColumn> columns,
                         BufferBinding& binding) {
    std::string problem;
    [[maybe_unused]] const bool good = imports::rowLayoutOf(block, columns, binding.layout, problem);
    assert(good);
  }

  bool bindUse(const SlotSpec& slot, std::uint32_t index, std::uint32_t element) {
    const FlatUse& use = graph_.uses[index];
    const gl::Reflection& reflection = out_.variant->program.reflection();
    const FlatResource& resource = graph_.resources[use.resource];
    switch (slot.kind) {
      case Kind::sampled:
      case Kind::image: {
        const bool image = slot.kind == Kind::image;
        const gl::OpaqueUniform* uniform =
            image ? reflection.findImage(slot.name) : reflection.findSampler(slot.name);
        if (!uniform) return true;
        const GLenum target = gl::findGlslType(uniform->type)->target;
        TextureBinding binding{.unit = uniform->unit + element,
                               .resource = use.resource,
                               .history = use.history,
                               .views = viewsOf(use, target),
                               .part = importPartOf(use, target),
                               .firstOf = firstOf_};
        if (image) {
          binding.access = slot.access == Access::read    ? GL_READ_ONLY
                           : slot.access == Access::write ? GL_WRITE_ONLY
                                                          : GL_READ_WRITE;
          binding.format = glFormatOf(resource.format);
          binding.layered = target != GL_TEXTURE_2D && target != GL_TEXTURE_2D_MULTISAMPLE;
        } else {
          const graph::TexelKind texels =
              use.planes == 2 ? graph::TexelKind::unsigned_integer : graph::infoOf(resource.format).kind;
          binding.sampler = c_.samplers.get(slot.sampler, graph_.borderOf(slot), use.mips > 1, texels);
        }
        out_.textures.push_back(std::move(binding));
        return complete(out_.textures.back().views);
      }
      case Kind::uniform:
      case Kind::storage: {
        const bool storage = slot.kind == Kind::storage;
        const gl::Block* block =
            storage ? reflection.findStorageBlock(slot.name) : reflection.findUniformBlock(slot.name);
        if (!block) return true;
        BufferBinding binding{
            .target = static_cast<GLenum>(storage ? GL_SHADER_STORAGE_BUFFER : GL_UNIFORM_BUFFER),
            .index = block->binding,
            .resource = use.resource,
            .history = use.history,
            .import = resource.import,
            .firstOf = firstOf_};
        if (const auto columns = columnsOf(graph_, use); !columns.empty())
          takeLayout(*block, columns, binding);
        out_.buffers.push_back(binding);
        return true;
      }
      case Kind::color: {
        const gl::Interface* output = reflection.findOutput(slot.name);
        if (!output) return true;
        const auto location = static_cast<GLuint>(output->location);
        for (const auto& [name, color] : spec_.state.colors)
          if (name == slot.name) out_.colors.emplace_back(location, color);
        return attach(index, GL_COLOR_ATTACHMENT0 + location);
      }
      case Kind::depth: {
        const bool stencil = graph::hasStencil(resource.format);
        return attach(index, !stencil          ? GL_DEPTH_ATTACHMENT
                             : use.planes == 1 ? GL_DEPTH_ATTACHMENT
                             : use.planes == 2 ? GL_STENCIL_ATTACHMENT
                                               : GL_DEPTH_STENCIL_ATTACHMENT);
      }
      case Kind::indirect:
        out_.buffers.push_back({.target = GL_DRAW_INDIRECT_BUFFER,
                                .resource = use.resource,
                                .history = use.history,
                                .firstOf = firstOf_});
        return true;
      case Kind::copy:
        return true;
    }
    return true;
  }

  std::vector<GLuint> wholesOf(std::uint32_t resource) {
    const FlatResource& desc = graph_.resources[resource];
    return viewsOf({.resource = resource, .mips = desc.mips, .layers = desc.layers}, 0);
  }

  // Attachments go through a view of the whole resource, so that equal storage gives equal framebuffers.
  bool attach(std::uint32_t index, GLenum point) {
    const FlatUse& use = graph_.uses[index];
    const FlatResource& resource = graph_.resources[use.resource];
    AttachmentBinding binding{
        .point = point, .resource = use.resource, .mip = use.mip, .textures = {}, .use = use, .index = index};
    const bool plain = resource.target == graph::Target::texture_2d ||
                       resource.target == graph::Target::texture_2d_multisample;
    binding.layer = plain || use.layers > 1 || resource.target == graph::Target::texture_3d ? -1 : use.layer;
    binding.textures = wholesOf(use.resource);
    out_.width = std::max(1u, resource.width >> use.mip);
    out_.height = std::max(1u, resource.height >> use.mip);
    out_.encodesSrgb |= resource.format == graph::Format::srgb8_a8;
    out_.attachments.push_back(std::move(binding));
    return complete(out_.attachments.back().textures);
  }

  // Pass types without a shader name a source and a target slot.
  bool bindFixed(bool fromSource) {
    std::vector<std::pair<const SlotSpec*, FlatUse>> uses;
    for (const SlotSpec& slot : graph_.slotsOf(spec_)) {
      if (slot.useCount > 0) uses.emplace_back(&slot, graph_.uses[slot.firstUse]);
      if (slot.useCount > 0 && slot.firstValue != kNone)
        uses.emplace_back(&slot, graph_.uses[slot.firstValue]);
    }
    for (const auto& [slot, use] : uses) {
      const bool from = slot->access == Access::read;
      FlatUse span = use;
      if (!from && fromSource) {  // one view from the source level to the last one written
        for (const auto& [other, source] : uses)
          if (other->access == Access::read) span.mip = source.mip;
        span.mips = static_cast<std::uint16_t>(use.mip + use.mips - span.mip);
      }
      FixedBinding binding{.source = from, .resource = use.resource, .history = use.history};
      const FlatResource& resource = graph_.resources[use.resource];
      binding.mip = use.mip;
      if (use.layers < resource.layers && use.layers == 1) binding.layer = use.layer;
      binding.views = out_.framebuffers ? wholesOf(use.resource) : viewsOf(span, 0);
      if (!out_.framebuffers) binding.part = importPartOf(use, 0);
      passes::BoundTexture& bound = from ? out_.context.source : out_.context.destination;
      bound.width = std::max(1u, resource.width >> use.mip);
      bound.height = std::max(1u, resource.height >> use.mip);
      bound.planes = !graph::isDepth(resource.format)
                         ? GL_COLOR_BUFFER_BIT
                         : ((use.planes & 1) != 0 ? GL_DEPTH_BUFFER_BIT : 0u) |
                               ((use.planes & 2) != 0 ? GL_STENCIL_BUFFER_BIT : 0u);
      if (from) out_.context.linear = slot->sampler.linear;
      const FlatUse& read = graph_.uses[slot->firstUse];
      if (use.resource != read.resource || use.history != read.history)
        binding.firstOf = {read.resource, read.history};
      if (!complete(binding.views)) return false;
      out_.fixed.push_back(std::move(binding));
    }
    return true;
  }

  void prepareGeometry(const graph::PassType& type) {
    if (type.shader == graph::ShaderShape::fragment) out_.context.geometry = c_.geometries.empty();
    if (type.shader != graph::ShaderShape::draw) return;
    if (!spec_.list.empty()) out_.list = listOf();
    out_.context.instances = spec_.instances;
    out_.sizesPoints = out_.variant->stages[0].source->ofAllBranches().isLive("gl_PointSize");
    if (spec_.meshes) {
      out_.meshes = std::make_shared<imports::MeshPass>(out_.variant->program.reflection(), spec_.name);
      return;
    }
    out_.context.geometry = c_.geometries.get(spec_.geometry, spec_.geometryArguments,
                                              out_.variant->program.reflection(), c_.diagnostics);
  }

  void collectClears() {
    for (std::uint32_t i = 0; i < step_.clearCount; ++i) {
      ClearCommand command;
      const graph::ClearOp& clear = c_.plan.clears[step_.firstClear + i];
      command.use = clear.use;
      command.format = graph_.resources[command.use.resource].format;
      for (const graph::ClearSpec& spec : graph_.clears)
        if (spec.resource == command.use.resource) command.value = spec.value;
      for (std::size_t a = 0; a < out_.attachments.size(); ++a)
        if (out_.attachments[a].index == clear.attachment) command.attachment = static_cast<int>(a);
      out_.clears.push_back(command);
    }
  }

  PrepareContext& c_;
  const graph::Step& step_;
  const graph::FlatGraph& graph_;
  const PassSpec& spec_;
  FirstOf firstOf_;  // of the use that bindUse() binds
  PreparedPass out_;
};

}  // namespace

std::optional<PreparedPass> preparePass(PrepareContext& context, std::size_t step) {
  return Preparer(context, step).run();
}

std::uint32_t instancesAt(const graph::Expr& timed, const std::function<double(std::uint32_t)>& ageOf) {
  return static_cast<std::uint32_t>(std::clamp(timed.evaluateFolded(ageOf).v[0], 0.0, 2147483647.0));
}

}  // namespace weft::runtime
