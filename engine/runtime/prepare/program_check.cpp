#include "engine/runtime/prepare/program_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/gl/objects/objects.h"
#include "engine/imports/row_layout.h"
#include "engine/passes/compute/work_groups.h"
#include "engine/runtime/prepare/missing_slot.h"
#include "engine/runtime/prepare/parameter_fit.h"
#include "engine/runtime/prepare/pass_errors.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/runtime/prepare/sampler_types.h"
#include "engine/runtime/prepare/shader_advice.h"
#include "engine/runtime/prepare/shader_words.h"
#include "engine/runtime/prepare/word_check.h"
#include "engine/runtime/storage/block_writer.h"

namespace weft::runtime {

using base::Code;
using graph::Access;
using graph::FlatGraph;
using graph::FlatResource;
using graph::FlatUse;
using graph::Kind;
using graph::PassSpec;
using graph::Plan;
using graph::ShaderShape;
using graph::SlotSpec;

namespace {

// What a uniform of this name has in its place.
std::string hintForLoose(const std::string& name) {
  if (isViewMember(name)) return fmt::format("take it away: #include \"common/view.glsl\" has '{}'", name);
  if (std::string theirs = base::hintForForeign(base::Foreign::shader_name, name); !theirs.empty())
    return theirs;
  return "move it into `layout(std140) uniform Parameters { … };`";
}

class Checker : PassErrors {
 public:
  Checker(const Plan& plan, std::uint32_t pass, const gl::Variant& variant, const gl::Limits& limits,
          RoleCache& roles, base::Diagnostics& diagnostics)
      : PassErrors(plan.graph->specs[pass].name, diagnostics),
        plan_(plan),
        graph_(*plan.graph),
        spec_(graph_.specs[pass]),
        pass_(pass),
        variant_(variant),
        reflection_(variant.program.reflection()),
        limits_(limits),
        diagnostics_(diagnostics),
        words_(variant.stages, variant.defines, roles) {}

  bool run() {
    for (std::uint32_t i = 0; i < spec_.slotCount; ++i) checkSlot(graph_.slots[spec_.firstSlot + i]);
    const bool parametersFit = checkParameters(graph_, spec_, variant_, words_, shaders_, diagnostics_);
    checkRest();
    checkSlices(graph_.passes[pass_]);
    checkGroups();
    warnUnwritten(plan_, pass_, words_, diagnostics_);
    if (reflection_.findUniformBlock("View")) warnTimeless(graph_, pass_, words_, diagnostics_);
    return parametersFit && !any();
  }

 private:
  void missing(const SlotSpec& slot, const char* what, const std::string& other, const FlatUse& use) {
    slotMissing_ = true;
    base::Diagnostic& d = fail(Code::slotNotInShader, slot.place,
                               fmt::format("slot '{}' is not in the shader '{}'", slot.name, shaders_));
    d.expected = fmt::format("{} named '{}'", what, slot.name);
    if (!other.empty()) {
      d.found = other;
      adviseKind(slot, use, d);
      return;
    }
    for (const gl::StageSource& stage : variant_.stages)
      for (const auto& [block, instance] : stage.source->parts.instanceOf)
        if (instance == slot.name) {
          d.found = fmt::format("a block '{}' with the instance name '{}'", block, instance);
          d.hint = fmt::format("a slot has the name of the block: call it '{}'", block);
          return;
        }
    sayMissingSlot(graph_, spec_, slot, words_, shaders_, declaredNames(variant_), d);
  }

  const FlatResource& resourceOf(const FlatUse& use) const { return graph_.resources[use.resource]; }

  // Says what to write when the shader has the name for something else, such as an image in place of a sampler.
  void adviseKind(const SlotSpec& slot, const FlatUse& use, base::Diagnostic& d) {
    const FlatResource& resource = resourceOf(use);
    const std::string& name = graph_.resourceNames[use.resource];
    const bool buffer =
        resource.kind == graph::ResourceKind::buffer || resource.kind == graph::ResourceKind::imported_buffer;
    const bool wantsTexture = reflection_.findSampler(slot.name) || reflection_.findImage(slot.name);
    const std::string declaration = declarationFor(slot, slot.kind, use, resource);
    d.resource = name;
    if (buffer != !wantsTexture && !reflection_.findOutput(slot.name))
      d.hint = fmt::format("'{}' is a {}: name a {}, or declare `{}`", name, buffer ? "buffer" : "texture",
                           buffer ? "texture" : "buffer", declaration);
    else if (slot.kind == Kind::image && slot.access == Access::read)
      d.hint = fmt::format("leave \"as image\" out, or declare `{}`", declaration);
    else if (slot.kind == Kind::sampled && reflection_.findImage(slot.name))
      d.hint = fmt::format("say \"{} as image\", or declare `{}`", name, declaration);
    else
      d.hint = fmt::format("declare `{}`", declaration);
  }

  // Names what else has the name in the shader, for the message.
  std::string otherUse(const std::string& name) const {
    if (reflection_.findSampler(name)) return fmt::format("a sampler '{}'", name);
    if (reflection_.findImage(name)) return fmt::format("an image '{}'", name);
    if (reflection_.findUniformBlock(name)) return fmt::format("a uniform block '{}'", name);
    if (reflection_.findStorageBlock(name)) return fmt::format("a storage block '{}'", name);
    if (reflection_.findOutput(name)) return fmt::format("an output '{}'", name);
    return {};
  }

  void checkSlot(const SlotSpec& slot) {
    if (slot.useCount == 0) return;
    const FlatUse& use = graph_.uses[slot.firstUse];
    if (slot.access != Access::read && !plan_.attached[slot.firstUse]) return;
    switch (slot.kind) {
      case Kind::sampled:
        return checkSampler(slot, use);
      case Kind::image:
        return checkImage(slot, use);
      case Kind::uniform:
        checkBlock(slot, reflection_.findUniformBlock(slot.name), "a uniform block", use);
        checkTable(reflection_.findUniformBlock(slot.name), columnsOf(graph_, use), slot.place);
        return;
      case Kind::storage:
        checkBlock(slot, reflection_.findStorageBlock(slot.name), "a storage block", use);
        checkTable(reflection_.findStorageBlock(slot.name), columnsOf(graph_, use), slot.place);
        return;
      case Kind::color:
        if (!reflection_.findOutput(slot.name) && (!declared(slot) || !otherUse(slot.name).empty()) &&
            !givesRasterAlone(plan_, pass_, slot.firstUse))
          missing(slot, "an output", otherUse(slot.name), use);
        checkOutput(slot, use);
        return;
      case Kind::depth:
        if (reflection_.findOutput(slot.name))
          sayOutputToDepth(graph_, slot, fail(Code::slotTypeMismatch, slot.place, ""));
        return;
      case Kind::copy:
      case Kind::vertex:
      case Kind::index:
      case Kind::indirect:
        return;
    }
  }

  bool declared(const SlotSpec& slot) const { return words_.declares(slot.name, slot.kind); }

  void checkBlock(const SlotSpec& slot, const gl::Block* block, const char* what, const FlatUse& use) {
    if (!block && (!declared(slot) || !otherUse(slot.name).empty()))
      missing(slot, what, otherUse(slot.name), use);
  }

  void checkTable(const gl::Block* block, std::span<const graph::TableColumn> columns,
                  const base::Place& place) {
    if (!block || columns.empty()) return;
    imports::RowLayout layout;
    std::string problem;
    if (imports::rowLayoutOf(*block, columns, layout, problem)) return;
    base::Diagnostic& d = fail(
        Code::notAnInstanceTable, place,
        fmt::format("the block '{}' of '{}' does not fit its table: {}", block->name, shaders_, problem));
    d.expected = "an array of a struct with fields among";
    for (const graph::TableColumn& column : columns)
      d.expected += fmt::format(" {} {},", column.type, column.name);
    d.expected.pop_back();
    d.hint = "include the file of shaders/scene that declares it, or declare a struct of these fields";
  }

  // Writing float outputs to integer formats, or the other way round, leaves undefined texels (OpenGL 4.5 core, 15.2.3).
  void checkOutput(const SlotSpec& slot, const FlatUse& use) {
    const gl::Interface* output = reflection_.findOutput(slot.name);
    const auto shape = output ? gl::shapeOf(output->type) : std::nullopt;
    if (!shape) return;
    const graph::TexelKind kind = graph::infoOf(graph_.resources[use.resource].format).kind;
    const GLenum base = kind == graph::TexelKind::unsigned_integer ? GL_UNSIGNED_INT
                        : kind == graph::TexelKind::signed_integer ? GL_INT
                                                                   : GL_FLOAT;
    if (shape->base == base) return;
    base::Diagnostic& d = fail(
        Code::slotTypeMismatch, slot.place,
        fmt::format("slot '{}' and the shader's {} do not fit", slot.name, gl::glslTypeName(output->type)));
    d.resource = graph_.resourceNames[use.resource];
    d.expected = fmt::format("{} output for {}",
                             base == GL_FLOAT ? "a float"
                             : base == GL_INT ? "an int"
                                              : "an unsigned int",
                             graph::infoOf(graph_.resources[use.resource].format).name);
    d.found = gl::glslTypeName(output->type);
    d.hint = fmt::format("declare `{}`, or write a texture of another format",
                         declarationFor(slot, Kind::color, use, resourceOf(use)));
  }

  void checkSampler(const SlotSpec& slot, const FlatUse& use) {
    const gl::OpaqueUniform* sampler = reflection_.findSampler(slot.name);
    if (!sampler) {
      if (!declared(slot) || !otherUse(slot.name).empty())
        missing(slot, "a sampler", otherUse(slot.name), use);
      return;
    }
    checkOpaque(slot, use, *sampler, slot.sampler.compare);
  }

  void checkImage(const SlotSpec& slot, const FlatUse& use) {
    const gl::OpaqueUniform* image = reflection_.findImage(slot.name);
    if (!image) {
      if (!declared(slot) || !otherUse(slot.name).empty())
        missing(slot, "an image", otherUse(slot.name), use);
      return;
    }
    checkOpaque(slot, use, *image, false);
    checkImageFormat(slot, use);
  }

  // Stores and loads through another format than the texture's are undefined (OpenGL 4.5 core, 8.26), and silent.
  void checkImageFormat(const SlotSpec& slot, const FlatUse& use) {
    const std::string other = otherFormat(words_.imageFormatsOf(slot.name), resourceOf(use).format);
    if (!other.empty())
      sayImageFormat(graph_, slot, other, shaders_, fail(Code::slotTypeMismatch, slot.place, ""));
  }

  void checkOpaque(const SlotSpec& slot, const FlatUse& use, const gl::OpaqueUniform& uniform, bool compare) {
    const OpaqueType type = opaqueTypeOf(uniform.type);
    const FlatResource& resource = graph_.resources[use.resource];
    const std::string problem = opaqueMismatch(type, resource, use, compare);
    if (!problem.empty()) {
      base::Diagnostic& d = fail(
          Code::slotTypeMismatch, slot.place,
          fmt::format("slot '{}' and the shader's {} do not fit", slot.name, gl::glslTypeName(uniform.type)));
      d.resource = graph_.resourceNames[use.resource];
      d.expected = problem;
      d.found = gl::glslTypeName(uniform.type);
      d.hint = fmt::format("declare `{}`, or name another resource",
                           declarationFor(slot, slot.kind, use, resource));
    }
    if (uniform.arraySize < slot.useCount || (!slot.array && uniform.arraySize > 1)) {
      base::Diagnostic& d = fail(Code::slotTypeMismatch, slot.place,
                                 fmt::format("slot '{}' has {} textures and the shader an array of {}",
                                             slot.name, slot.useCount, uniform.arraySize));
      d.expected = fmt::format("{}[{}]", slot.name, slot.useCount);
      d.found = fmt::format("{}[{}]", slot.name, uniform.arraySize);
      d.hint = fmt::format("declare `{}`", declarationFor(slot, slot.kind, use, resource));
    }
  }

  // The instance name of a block, or "" when it has none.
  std::string instanceOf(const std::string& block) const {
    for (const gl::StageSource& stage : variant_.stages)
      if (const auto found = stage.source->parts.instanceOf.find(block);
          found != stage.source->parts.instanceOf.end())
        return found->second;
    return {};
  }

  bool isSlot(const std::string& name) const { return isSlotOf(graph_, spec_, name); }

  // One that has the parameters was reported with them.
  bool hasParameters(const std::string& block) const {
    return std::ranges::any_of(spec_.uniforms, [&](const graph::UniformSpec& uniform) {
      return !words_.declaresParameter(uniform.name) && words_.blockOf(uniform.name) == block;
    });
  }

  // Says nothing when a slot was not found, because one misspelling is one mistake.
  void unfed(const char* what, const std::string& name) {
    if (slotMissing_) return;
    std::vector<std::string> names;
    for (std::uint32_t i = 0; i < spec_.slotCount; ++i)
      names.push_back(graph_.slots[spec_.firstSlot + i].name);
    const std::string instance = instanceOf(name);
    const std::string nearest = base::nearestName(name, names);
    auto& d = fail(Code::undeclaredShaderInput, spec_.shaderPlace,
                   fmt::format("the shader '{}' uses {} '{}', which pass '{}' does not name", shaders_, what,
                               name, spec_.declared));
    d.expected = fmt::format("a slot '{}' in \"read\", \"write\" or \"modify\"", name);
    if (!instance.empty() && isSlot(instance)) {
      d.hint = fmt::format("a slot has the name of the block, not of its instance: call '{}' '{}'", instance,
                           name);
      return;
    }
    d.hint = nearest.empty() ? fmt::format("add \"{}\": \"RESOURCE\", or guard its use with `#ifdef {}`",
                                           name, presenceDefineOf(name))
                             : fmt::format("did you mean '{}'?", nearest);
  }

  void checkRest() {
    for (const auto& sampler : reflection_.samplers)
      if (!isSlot(sampler.name)) unfed("a sampler", sampler.name);
    for (const auto& image : reflection_.images)
      if (!isSlot(image.name)) unfed("an image", image.name);
    for (const auto& block : reflection_.storageBlocks) {
      if (isSlot(block.name)) continue;
      if (block.name == imports::kInstancesBlock && !spec_.list.empty())
        checkTable(&block, instanceColumnsOf(spec_), spec_.shaderPlace);
      else
        unfed("a storage block", block.name);
    }
    for (const auto& block : reflection_.uniformBlocks) {
      if (block.name == "View") {
        for (const gl::BlockMember& member : block.members)
          if (!isViewMember(member.name))
            fail(Code::unknownViewMember, spec_.shaderPlace,
                 fmt::format("the View block of '{}' has an unknown member '{}'", shaders_, member.name))
                .hint = base::nearestHint(member.name, viewMemberNames());
      } else if (block.name == "Slice") {
        for (const gl::BlockMember& member : block.members)
          if (member.name != "first_group" && member.name != "first_invocation")
            fail(Code::unknownViewMember, spec_.shaderPlace,
                 fmt::format("the Slice block of '{}' has an unknown member '{}'", shaders_, member.name))
                .hint = "include common/slice.glsl";
      } else if (block.name != "Parameters" && !isSlot(block.name) && !hasParameters(block.name)) {
        unfed("a uniform block", block.name);
      }
    }
    for (const auto& loose : reflection_.looseUniforms)
      failOnce(graph_, Code::parameterNotInShader, spec_.shaderPlace,
               fmt::format("the shader '{}' has a uniform '{}' outside a block", shaders_, loose.name),
               hintForLoose(loose.name));
  }

  // Reports a sliced compute pass whose shader does not read Slice: every slice would do the whole work.
  void checkSlices(const graph::FlatPass& pass) {
    const bool compute = !variant_.stages.empty() && variant_.stages[0].stage == GL_COMPUTE_SHADER;
    if (!compute || pass.slices < 2 || reflection_.findUniformBlock("Slice")) return;
    fail(Code::badSlices, spec_.shaderPlace,
         fmt::format("the shader '{}' does not know slices, and pass '{}' has {}", shaders_, spec_.name,
                     pass.slices))
        .hint =
        "include common/slice.glsl and use sliceInvocation() for gl_GlobalInvocationID, or remove \"slices\"";
  }

  // Reports work groups beyond the limits of the device. The driver would report them in every frame, and without a place.
  void checkGroups() {
    passes::PassContext context;
    context.spec = &spec_;
    std::copy_n(reflection_.workGroup, 3, context.groupSize);
    std::copy_n(limits_.computeGroups, 3, context.maxGroups);
    if (context.groupSize[0] == 0) return;  // no compute shader
    const passes::WorkGroups groups = passes::workGroupsOf(context);
    for (int axis = 0; axis < 3; ++axis) {
      const std::uint32_t most = context.maxGroups[axis], size = context.groupSize[axis];
      if (groups.count[axis] <= most) continue;
      base::Diagnostic& d = fail(Code::tooManyWorkGroups, spec_.threadsPlace,
                                 fmt::format("pass '{}' has more work groups along {} than the device takes",
                                             spec_.name, "xyz"[axis]));
      d.expected =
          fmt::format("at most {} groups of {} threads, that is {}", most, size, std::uint64_t{most} * size);
      d.found = fmt::format("{} groups for {} threads", groups.count[axis], spec_.threads[axis]);
      d.hint = fmt::format("raise local_size_{} in '{}', or spread the work over the other axes", "xyz"[axis],
                           shaders_);
    }
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  const PassSpec& spec_;
  const std::uint32_t pass_;
  const gl::Variant& variant_;
  const gl::Reflection& reflection_;
  const gl::Limits& limits_;
  base::Diagnostics& diagnostics_;
  // For messages, between quotes.
  const std::string shaders_ =
      spec_.vertexShader.empty() ? spec_.shader : spec_.vertexShader + "' and '" + spec_.shader;
  const ShaderWords words_;
  bool slotMissing_ = false;
};

}  // namespace

bool checkProgram(const Plan& plan, std::uint32_t pass, const gl::Variant& variant, const gl::Limits& limits,
                  RoleCache& roles, base::Diagnostics& diagnostics) {
  roles.makeRoom();
  return Checker(plan, pass, variant, limits, roles, diagnostics).run();
}

}  // namespace weft::runtime
