#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "engine/glsl/interface.h"
#include "engine/graph/subresource.h"
#include "engine/imports/row_table.h"
#include "engine/passes/compute/work_groups.h"
#include "engine/passes/draw/geometry.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/runtime/storage/block_writer.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"
#include "runtime_sentences.h"

namespace weft::runtime {

using glsl::Declaration;
using glsl::Role;
using graph::Access;
using graph::FlatGraph;
using graph::FlatResource;
using graph::FlatUse;
using graph::Kind;
using graph::PassSpec;
using graph::Plan;
using graph::SlotSpec;
using graph::Target;
using graph::TexelKind;
using text::Severity;

namespace {

// What a shader declares for a slot. Nothing: no shader knows of it.
std::optional<Role> roleFor(Kind kind) {
  // In the order of Kind.
  constexpr std::optional<Role> kRoles[] = {Role::sampler,       Role::image,  Role::uniform_block,
                                            Role::storage_block, std::nullopt, Role::output,
                                            Role::output,        std::nullopt};
  return kRoles[static_cast<std::size_t>(kind)];
}

bool isBlock(Role role) {
  return role == Role::uniform_block || role == Role::storage_block;
}

// The first format among the words of an image's layout, when none of them is the texture's; "" when they agree.
std::string otherFormat(std::span<const std::string_view> words, graph::Format format) {
  std::string other;
  for (const std::string_view word : words)
    if (const auto named = graph::findFormat(word)) {
      if (*named == format) return {};
      other = word;
    }
  return other;
}

// The prefix of "sampler2D" and "vec4": "", "u" or "i".
std::string prefixFor(const FlatUse& use, const FlatResource& resource) {
  const TexelKind kind = graph::infoOf(resource.format).kind;
  if (use.planes == 2 || kind == TexelKind::unsigned_integer) return "u";
  return kind == TexelKind::signed_integer ? "i" : "";
}

// The types of samplers or images that can show `use` of `resource`, the most natural first.
std::vector<std::string> opaqueTypesFor(const SlotSpec& slot, const FlatUse& use,
                                        const FlatResource& resource) {
  const bool cubes =
      (resource.target == Target::texture_cube || resource.target == Target::texture_cube_array) &&
      use.layers % 6 == 0 && use.layer % 6 == 0;
  const bool volume = resource.target == Target::texture_3d, flat = resource.samples == 1 && !volume;
  const std::string prefix = prefixFor(use, resource),
                    kind = slot.kind == Kind::image ? fmt::format("{}image", prefix) : prefix + "sampler";
  std::vector<std::string> types;
  for (const auto& [shape, fits] : {std::pair{"Cube", cubes && use.layers == 6},
                                    {"CubeArray", cubes},
                                    {"2D", flat && use.layers == 1},
                                    {"2DArray", flat},
                                    {"3D", volume},
                                    {"2DMS", resource.samples > 1}})
    if (fits)
      types.push_back(kind + shape + (slot.kind == Kind::sampled && slot.sampler.compare ? "Shadow" : ""));
  return types;
}

// "uniform usampler2DArray maps;", "layout(rgba16f) uniform writeonly image2D result;", "out vec4 result;", …: what the
// shader declares for a slot that holds `use` of `resource`.
std::string declarationFor(const SlotSpec& slot, const FlatUse& use, const FlatResource& resource) {
  const std::string count = slot.array ? fmt::format("[{}]", slot.useCount) : "";
  const char* const qualifier = slot.access == Access::read    ? "readonly "
                                : slot.access == Access::write ? "writeonly "
                                                               : "";
  switch (slot.kind) {
    case Kind::sampled:
      return fmt::format("uniform {} {}{};", opaqueTypesFor(slot, use, resource)[0], slot.name, count);
    case Kind::image:
      return fmt::format("layout({}) uniform {}{} {}{};", graph::infoOf(resource.format).name, qualifier,
                         opaqueTypesFor(slot, use, resource)[0], slot.name, count);
    case Kind::storage:
      return fmt::format("layout(std430) {}buffer {} {{ … }};", qualifier, slot.name);
    case Kind::uniform:
      return fmt::format("layout(std140) uniform {} {{ … }};", slot.name);
    case Kind::color:
      return fmt::format("out {}vec4 {};", prefixFor(use, resource), slot.name);
    default:
      return {};
  }
}

class Checker {
 public:
  Checker(const Plan& plan, std::uint32_t pass, std::span<const gl::StageSource> stages,
          std::span<const glsl::Define> defines, const LinkedProgram* linked, text::Diagnostics& diagnostics)
      : plan_(plan),
        graph_(*plan.graph),
        spec_(graph_.specs[pass]),
        pass_(pass),
        stages_(stages),
        linked_(linked),
        diagnostics_(diagnostics) {
    for (const gl::StageSource& stage : stages) interfaces_.push_back(&stage.source->interfaceWith(defines));
  }

  bool run() {
    std::ranges::for_each(graph_.slotsOf(spec_), [this](const SlotSpec& slot) { checkSlot(slot); });
    checkParameters();
    checkViews();
    if (linked_) {
      checkRest();
      checkSlices(graph_.passes[pass_]);
      checkGroups();
    }
    warnUnwritten();
    warnTimeless();
    return !failed_;
  }

 private:
  template <class... Args>
  void fail(text::Saying<Args...> what, const text::Place& place, Args&&... args) {
    failed_ = true;
    diagnostics_.error<Args...>(what, place, std::forward<Args>(args)...).pass = spec_.name;
  }
  // Unless the same was said of another pass, of a shader that both have, say: the mistake is in one place.
  template <class... Args>
  void sayOnce(Severity severity, text::Saying<Args...> what, const text::Place& place, Args&&... args) {
    failed_ = failed_ || severity == Severity::error;
    text::Diagnostic said = text::diagnosticOf(what.sentence, fmt::make_format_args(args...));
    const bool known = std::ranges::any_of(diagnostics_.items(), [&](const text::Diagnostic& d) {
      return d.code == said.code && d.message == said.message;
    });
    if (!known) diagnostics_.add(severity, std::move(said), place).pass = spec_.name;
  }

  const glsl::Interface& of(const gl::StageSource& stage) const {
    return *interfaces_[static_cast<std::size_t>(&stage - stages_.data())];
  }

  // The stages that may declare something of that role for the pass: outputs are those of the last.
  std::span<const gl::StageSource> stagesFor(Role role) const {
    return role == Role::output && !stages_.empty() ? stages_.last(1) : stages_;
  }

  const Declaration* find(std::string_view name, Role role) const {
    for (const gl::StageSource& stage : stagesFor(role))
      if (const Declaration* found = of(stage).find(name, role)) return found;
    return nullptr;
  }

  // The members of a block, each once, in whichever stage.
  std::vector<const Declaration*> membersOf(std::string_view block) const {
    std::vector<const Declaration*> members;
    for (const gl::StageSource& stage : stages_)
      for (const Declaration& each : of(stage).declarations)
        if (each.role == Role::member && each.owner == block &&
            std::ranges::find(members, each.name, &Declaration::name) == members.end())
          members.push_back(&each);
    return members;
  }

  // Whether a stage declares an image or a buffer without `readonly`.
  bool mayWrite(std::string_view name, Role role) const {
    const std::vector<const Declaration*> members = membersOf(name);
    return std::ranges::any_of(stages_, [&](const gl::StageSource& stage) {
      const Declaration* const found = of(stage).find(name, role);
      return found && found->writes &&
             (role == Role::image || std::ranges::any_of(members, &Declaration::writes));
    });
  }

  // True when something for which `is` holds may be declared: here, in a branch that is not taken, or in a text that could not be read whole.
  template <class F>
  bool maybe(Role role, F&& is) const {
    return std::ranges::any_of(stagesFor(role), [&](const gl::StageSource& stage) {
      const auto declares = [&](const glsl::Interface& interface) {
        return interface.unsure || std::ranges::any_of(interface.declarations, [&](const Declaration& each) {
                 return each.role == role && is(each);
               });
      };
      return declares(of(stage)) || declares(stage.source->ofAllBranches());
    });
  }
  bool maybe(std::string_view name, Role role) const {
    return maybe(role, [&](const Declaration& each) { return each.name == name; });
  }

  // Whether main() reaches it, and the linker has kept it.
  bool isLive(const Declaration& declaration) const {
    if (linked_) {
      const gl::Reflection& r = linked_->reflection;
      const std::string_view name = declaration.name;
      return r.findSampler(name) || r.findImage(name) || r.findUniformBlock(name) ||
             r.findStorageBlock(name) || r.findOutput(name);
    }
    return std::ranges::any_of(stagesFor(declaration.role),
                               [&](const gl::StageSource& stage) { return of(stage).isLive(declaration); });
  }
  const FlatResource& resourceOf(const FlatUse& use) const { return graph_.resources[use.resource]; }
  const std::string& nameOf(const FlatUse& use) const { return graph_.resourceNames[use.resource]; }
  std::string declarationOf(const SlotSpec& slot) const {
    const FlatUse& use = graph_.uses[slot.firstUse];
    return declarationFor(slot, use, resourceOf(use));
  }

  // What the name is in the shaders, in any branch: the outputs of a vertex shader are the inputs of what follows it. Null when it is nothing.
  const char* whatIs(std::string_view name) const {
    for (auto stage = stages_.rbegin(); stage != stages_.rend(); ++stage)
      if (const Declaration* found = stage->source->ofAllBranches().find(name))
        return glsl::nameOf(found->role);
    return text::isGlslFunction(name) ? "a built-in function" : nullptr;
  }

  // From that role to members of blocks.
  std::vector<std::string> namesInShaders(Role first) const {
    std::vector<std::string> names;
    for (const gl::StageSource& stage : stages_)
      for (const Declaration& each : stage.source->ofAllBranches().declarations)
        if (each.role >= first && each.role <= Role::member) names.emplace_back(each.name);
    return names;
  }

  void checkSlot(const SlotSpec& slot) {
    if (slot.useCount == 0) return;
    const FlatUse& use = graph_.uses[slot.firstUse];
    if (!roleFor(slot.kind)) return;
    const Role role = *roleFor(slot.kind);
    // Of what nobody reads it is enough that a branch declares it.
    if (slot.access != Access::read && !plan_.attached[slot.firstUse] && maybe(slot.name, role)) return;
    const Declaration* declared = find(slot.name, role);
    if (role == Role::output && (use.layers > 1 || resourceOf(use).depth >> use.mip > 1) &&
        spec_.geometry.empty())
      fail(say::fillsOneLayer, slot.place, spec_.name, nameOf(use));
    if (slot.kind == Kind::depth) {
      if (declared) reportDepth(use);
    } else if (!declared) {
      checkMissing(slot, role);
    } else if (isLive(*declared)) {
      if (slot.kind == Kind::color)
        checkOutput(slot, use, *declared);
      else if (role != Role::sampler && role != Role::uniform_block &&
               (slot.access == Access::read) == mayWrite(slot.name, role))
        slot.access == Access::read
            ? fail(say::readMayBeWritten, slot.place, slot.name, shaders_, declarationOf(slot), nameOf(use))
            : fail(say::writtenIsReadonly, slot.place, slot.name, shaders_, declarationOf(slot), nameOf(use));
      else if (!isBlock(role))
        checkOpaque(slot, use, *declared);
      else if (linked_)
        checkTable(role == Role::uniform_block ? linked_->reflection.findUniformBlock(slot.name)
                                               : linked_->reflection.findStorageBlock(slot.name),
                   columnsOf(graph_, use), slot.place);
    }
  }

  // A slot that this variant does not declare as what it must be.
  void checkMissing(const SlotSpec& slot, Role role) {
    bool other = false;  // something else that it uses has the name
    for (const Role each :
         {Role::sampler, Role::image, Role::uniform_block, Role::storage_block, Role::output})
      if (const Declaration* found = find(slot.name, each)) other = other || isLive(*found);
    // A slot may have the instance name of a block; W187 then says it better, from the side of the shader.
    const auto hasInstance = [&](const Declaration& block) { return block.instance == slot.name; };
    if (!other && (maybe(slot.name, role) || (isBlock(role) && maybe(role, hasInstance)))) return;
    slotMissing_ = true;
    const char* const what = whatIs(slot.name);
    const std::string near = what ? "" : text::nearestName(slot.name, namesInShaders(Role::sampler));
    const std::string& resource = nameOf(graph_.uses[slot.firstUse]);
    const bool namesBoth = resource.substr(resource.rfind('.') + 1) == slot.name;
    const std::string hint = !what && slot.ofSet
                                 ? "declare it, or move it from the set to the passes that need it"
                             : near.empty() ? fmt::format("declare `{}`", declarationOf(slot))
                             : namesBoth ? fmt::format(R"(name the slot: {{ "{}": "{}" }})", near, slot.name)
                                         : fmt::format("did you mean '{}'?", near);
    if (what)
      fail(say::slotIsOther, slot.place, slot.name, what, shaders_, glsl::nameOf(role), hint, resource);
    else
      fail(say::slotNotInShader, slot.place, slot.name, shaders_, glsl::nameOf(role), hint, resource);
  }

  void reportType(const SlotSpec& slot, const FlatUse& use, const std::string& type, std::string expected) {
    fail(say::slotMisfitsShader, slot.place, slot.name, type, expected, declarationOf(slot), nameOf(use));
  }

  // Said where the texture is declared, once for all passes that write colors to it.
  void reportDepth(const FlatUse& use) {
    sayOnce(Severity::error, say::colorsToDepth, graph_.resourcePlaces[use.resource], nameOf(use),
            graph::infoOf(resourceOf(use).format).name);
  }

  // Writing float outputs to integer formats, or the other way round, leaves undefined texels (OpenGL 4.5 core, 15.2.3).
  void checkOutput(const SlotSpec& slot, const FlatUse& use, const Declaration& output) {
    const gl::GlslType* type = gl::findGlslType(output.type);
    const std::string prefix = prefixFor(use, resourceOf(use));
    const GLenum base = prefix == "u" ? GL_UNSIGNED_INT : prefix == "i" ? GL_INT : GL_FLOAT;
    if (type && type->kind == gl::GlslType::Kind::value && type->base != base)
      reportType(slot, use, type->name,
                 fmt::format("{}vec4, or fewer components, for {}", prefix,
                             graph::infoOf(resourceOf(use).format).name));
  }

  void checkOpaque(const SlotSpec& slot, const FlatUse& use, const Declaration& uniform) {
    const std::string type(uniform.type);
    const std::vector<std::string> fitting = opaqueTypesFor(slot, use, resourceOf(use));
    if (std::ranges::find(fitting, type) == fitting.end())
      reportType(slot, use, type, fmt::format("{}", fmt::join(fitting, " or ")));
    const std::uint32_t elements = uniform.elements;
    if (elements != 0 && (elements < slot.useCount || (!slot.array && elements != 1)))
      reportType(slot, use, fmt::format("array of {}", elements),
                 fmt::format("an array of {}", slot.useCount));
    // Stores and loads through another format than the texture's are undefined (OpenGL 4.5 core, 8.26), and silent.
    const std::string other = otherFormat(uniform.layout, resourceOf(use).format);
    if (slot.kind == Kind::image && !other.empty())
      reportType(slot, use, fmt::format("layout({})", other),
                 fmt::format("layout({})", graph::infoOf(resourceOf(use).format).name));
  }

  void checkTable(const gl::Block* block, std::span<const graph::TableColumn> columns,
                  const text::Place& place) {
    if (!block || columns.empty()) return;
    imports::RowLayout layout;
    std::string problem;
    if (imports::rowLayoutOf(*block, columns, layout, problem)) return;
    std::string fields;
    for (const graph::TableColumn& column : columns)
      fields += fmt::format(" {} {};", column.type, column.name);
    fail(say::blockMisfitsTable, place, block->name, shaders_, problem, fields);
  }

  void checkParameters() {
    const std::vector<const Declaration*> members = membersOf("Parameters");
    const Declaration* block = find("Parameters", Role::uniform_block);
    const bool live = block && isLive(*block);
    bool missing = false;
    for (const graph::UniformSpec& uniform : spec_.uniforms) {
      if (const auto member = std::ranges::find(members, uniform.name, &Declaration::name);
          member != members.end()) {
        if (live) checkParameter(uniform, **member);
        continue;
      }
      // A uniform outside a block has a message of its own.
      const auto isParameter = [&](const Declaration& each) {
        return each.owner == "Parameters" && each.name == uniform.name;
      };
      if (!uniform.isFirst() || maybe(Role::member, isParameter) || maybe(uniform.name, Role::uniform))
        continue;
      missing = slotMissing_ = true;
      reportMissing(uniform);
    }
    if (missing || !live) return;  // one misspelling is one mistake
    for (const Declaration* member : members)
      if (std::ranges::find(spec_.uniforms, member->name, &graph::UniformSpec::name) == spec_.uniforms.end())
        reportUnset(*member);
  }

  void reportMissing(const graph::UniformSpec& uniform) {
    const char* const what = whatIs(uniform.name);
    const std::string near = what ? "" : text::nearestName(uniform.name, namesInShaders(Role::member));
    fail(say::parameterNotInShader, uniform.place, uniform.name,
         what ? fmt::format("{}, not a member of the block Parameters,", what) : "not", shaders_,
         what == glsl::nameOf(Role::member) ? "call its block 'Parameters'"
         : !near.empty()                    ? fmt::format("the shader has '{}': name it so", near)
                                            : "declare it in `layout(std140) uniform Parameters { … };`");
  }

  void reportMember(const graph::UniformSpec& uniform, const gl::GlslType& type,
                    const std::string& expected) {
    failed_ = true;
    if (std::exchange(misfit_, uniform.name) == uniform.name) return;
    sayOnce(Severity::error, say::parameterMisfitsShader, uniform.place, uniform.text(), type.name, expected,
            uniform.elements == 0
                ? graph::toText(uniform.value)
                : fmt::format("{} items, the first {}", uniform.elements, graph::toText(uniform.value)));
  }

  void checkParameter(const graph::UniformSpec& uniform, const Declaration& declared) {
    const gl::GlslType* type = gl::findGlslType(declared.type);
    if (!type) return;
    gl::BlockMember member{.name = uniform.name, .type = type->type, .arraySize = declared.elements};
    if (!declared.array.empty()) member.arrayStride = 16;
    const gl::Block* block = linked_ ? linked_->reflection.findUniformBlock("Parameters") : nullptr;
    if (const gl::BlockMember* known = block ? block->find(uniform.name) : nullptr) member = *known;
    if (fieldFor(member, uniform)) return checkWhole(uniform, *type);
    reportMember(uniform, *type, expectedFor(member));
  }

  // Reports numbers in the graph, and sliders, that would lose their fraction in an integer member. What an expression computes is cut.
  void checkWhole(const graph::UniformSpec& uniform, const gl::GlslType& type) {
    const GLenum base = type.base;
    if (base != GL_INT && base != GL_UNSIGNED_INT) return;
    const auto parameter = std::ranges::find(graph_.parameters, uniform.path, &graph::ParameterSpec::path);
    const bool slider = !uniform.path.empty() && parameter != graph_.parameters.end() &&
                        parameter->desc.type == graph::ParameterDesc::Type::number;
    bool whole = true;
    for (std::size_t i = 0; i < uniform.value.count; ++i)
      whole = whole && uniform.value.v[i] == std::floor(uniform.value.v[i]) &&
              (uniform.value.v[i] >= 0 || base == GL_INT);
    if (slider)
      reportMember(uniform, type, fmt::format("\"type\": \"int\", for {}", type.name));
    else if (uniform.constant && !whole)
      reportMember(
          uniform, type,
          fmt::format("{} for {}", base == GL_INT ? "whole numbers" : "whole numbers from 0 on", type.name));
  }

  // A member that the pass does not set: it would be 0, which mostly gives a black picture.
  void reportUnset(const Declaration& member) {
    fail(say::parameterNotSet, spec_.shaderPlace, shaders_, member.name, spec_.declared,
         std::string(member.type) + member.array, glsl::presenceDefineOf(member.name));
  }

  // What the blocks that the engine fills may have.
  void checkViews() {
    for (const std::string name : {"View", "Slice"}) {
      const Declaration* block = find(name, Role::uniform_block);
      if (!block || !isLive(*block)) continue;
      const std::vector<std::string> names =
          name == "View" ? viewMemberNames() : std::vector<std::string>{"first_group", "first_invocation"};
      for (const Declaration* member : membersOf(name))
        if (std::ranges::find(names, member->name) == names.end())
          fail(say::unknownViewMember, spec_.shaderPlace, name, shaders_, member->name,
               text::nearestHint(std::string(member->name), names));
    }
  }

  // Says nothing when a slot or a parameter was not found, because one misspelling is one mistake.
  void unfed(const char* what, const std::string& name) {
    if (slotMissing_) return;
    std::vector<std::string> names;
    for (const SlotSpec& slot : graph_.slotsOf(spec_)) names.push_back(slot.name);
    if (std::ranges::find(names, name) != names.end())
      return fail(say::slotIsEmpty, spec_.shaderPlace, shaders_, what, name, spec_.declared,
                  glsl::presenceDefineOf(name));
    const std::string nearest = text::nearestName(name, names);
    fail(say::inputNotNamed, spec_.shaderPlace, shaders_, what, name, spec_.declared,
         !nearest.empty() ? fmt::format("did you mean '{}'?", nearest)
                          : fmt::format("add \"{}\": \"RESOURCE\", or guard its use with `#ifdef {}`", name,
                                        glsl::presenceDefineOf(name)));
  }

  // What the linked program has besides.
  void checkRest() {
    const gl::Reflection& reflection = linked_->reflection;
    for (const auto* opaque : {&reflection.samplers, &reflection.images})
      for (const gl::OpaqueUniform& each : *opaque)
        if (!graph_.hasSlot(spec_, each.name))
          unfed(opaque == &reflection.images ? "an image" : "a sampler", each.name);
    for (const auto& block : reflection.storageBlocks) {
      if (graph_.hasSlot(spec_, block.name)) continue;
      if (block.name == imports::kInstancesBlock && !spec_.list.empty())
        checkTable(&block, instanceColumnsOf(spec_), spec_.shaderPlace);
      else
        unfed("a storage block", block.name);
    }
    for (const auto& block : reflection.uniformBlocks) {
      const bool ours = block.name == "View" || block.name == "Slice" || block.name == "Parameters";
      if (!ours && !graph_.hasSlot(spec_, block.name)) unfed("a uniform block", block.name);
    }
    std::string known;
    for (graph::GeometryType& each : passes::reflectGeometries())
      if (each.name == spec_.geometry) known = std::move(each.attributes);
    for (const gl::Interface& attribute : reflection.attributes)
      if (fmt::format(" {},", known).find(fmt::format(" {},", attribute.name)) == std::string::npos)
        fail(say::vertexLacks, spec_.shaderPlace, shaders_, attribute.name, spec_.declared,
             known.empty() ? "gl_VertexID alone" : known);
    for (const auto& loose : reflection.looseUniforms) {
      const std::vector<std::string> names = viewMemberNames();
      sayOnce(Severity::error, say::uniformOutsideBlock, spec_.shaderPlace, shaders_, loose.name,
              std::ranges::find(names, loose.name) != names.end()
                  ? fmt::format("remove it: #include \"common/view.glsl\" has '{}'", loose.name)
                  : "move it into `layout(std140) uniform Parameters { … };`");
    }
  }

  // Reports a sliced compute pass whose shader does not read Slice: every slice would do the whole work.
  void checkSlices(const graph::FlatPass& pass) {
    const bool compute = !stages_.empty() && stages_[0].stage == GL_COMPUTE_SHADER;
    if (!compute || pass.slices < 2 || linked_->reflection.findUniformBlock("Slice")) return;
    fail(say::slicesNotKnown, spec_.shaderPlace, shaders_, spec_.name, pass.slices);
  }

  // Reports work groups beyond the limits of the device. The driver would report them in every frame, and without a place.
  void checkGroups() {
    passes::PassContext context;
    context.spec = &spec_;
    std::copy_n(linked_->reflection.workGroup, 3, context.groupSize);
    std::copy_n(linked_->device.computeGroups, 3, context.maxGroups);
    if (context.groupSize[0] == 0) return;  // no compute shader
    const passes::WorkGroups groups = passes::workGroupsOf(context);
    for (int axis = 0; axis < 3; ++axis) {
      if (groups.count[axis] <= context.maxGroups[axis]) continue;
      fail(say::tooManyWorkGroups, spec_.threadsPlace, spec_.name, "xyz"[axis], context.maxGroups[axis],
           context.groupSize[axis], groups.count[axis], spec_.threads[axis]);
    }
  }

  // A pass that does not run in every frame, and whose shader reads what changes in every frame. A variable may hide its name.
  void warnTimeless() {
    const graph::Cadence cadence = graph_.passes[pass_].cadence;
    if (cadence == graph::Cadence::always || cadence == graph::Cadence::every) return;
    for (const char* const member : {"time", "delta_time", "frame"}) {
      const bool reads = std::ranges::any_of(stages_, [&](const gl::StageSource& stage) {
        const Declaration* found = of(stage).find(member, Role::member);
        return found && found->owner == "View" && of(stage).isLive(*found) &&
               !of(stage).find(member, Role::variable);
      });
      if (!reads) continue;
      return sayOnce(Severity::warning, say::readsTime, spec_.place, spec_.declared, member);
    }
  }

  void warnUnwritten() {
    for (const SlotSpec& slot : graph_.slotsOf(spec_)) {
      if (slot.useCount == 0 || slot.kind != Kind::color || !plan_.attached[slot.firstUse]) continue;
      const Declaration* output = find(slot.name, Role::output);
      if (!output || of(stages_.back()).isLive(*output)) continue;
      const std::string& resource = nameOf(graph_.uses[slot.firstUse]);
      sayOnce(Severity::warning, say::outputNeverWritten, slot.place, spec_.declared, spec_.shader, slot.name,
              resource);
    }
  }

  const Plan& plan_;
  const FlatGraph& graph_;
  const PassSpec& spec_;
  const std::uint32_t pass_;
  const std::span<const gl::StageSource> stages_;
  std::vector<const glsl::Interface*> interfaces_;  // of each stage, under the defines of the program
  const LinkedProgram* const linked_;
  text::Diagnostics& diagnostics_;
  // For messages, between quotes.
  const std::string shaders_ =
      spec_.vertexShader.empty() ? spec_.shader : spec_.vertexShader + "' and '" + spec_.shader;
  std::string misfit_;  // the last parameter of which a value was reported
  bool slotMissing_ = false, failed_ = false;
};

}  // namespace

bool checkProgram(const Plan& plan, std::uint32_t pass, std::span<const gl::StageSource> stages,
                  std::span<const glsl::Define> defines, const LinkedProgram* linked,
                  text::Diagnostics& diagnostics) {
  return Checker(plan, pass, stages, defines, linked, diagnostics).run();
}

void warnOfConditions(const graph::PassSpec& pass, std::span<const gl::StageSource> stages,
                      std::span<const glsl::Define> defines, text::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  // Defines that a shader has or that a hint names, and words that an #if or #ifdef asks for.
  std::set<std::string, std::less<>> known, asked;
  for (const glsl::Define& define : defines) names.push_back(define.name);
  for (const gl::StageSource& stage : stages) {
    const glsl::Conditions& conditions = stage.source->conditions();
    const auto warn = [&]<class... Args>(text::Saying<Args...> what, const glsl::Token& word,
                                         Args&&... args) {
      const text::Place place = stage.source->placeOf(word.line, word.column);
      if (std::ranges::none_of(diagnostics.items(), [&](const text::Diagnostic& d) {
            return d.code == what.sentence.code && d.place.inFile() == place;
          }))
        diagnostics.warning<Args...>(what, place, std::forward<Args>(args)...).pass = pass.name;
    };
    std::set<std::string_view> seen;
    const auto look = [&](const glsl::Token& word, bool valued) {
      asked.emplace(word.text);
      if (!seen.insert(word.text).second) return;
      const auto define = std::ranges::find(defines, word.text, &glsl::Define::name);
      if (define != defines.end()) {
        if (define->value == "0" && !conditions.used.contains(word.text))
          warn(say::asksWhetherDefined, word, word.text);
        return;
      }
      if (conditions.made.contains(word.text) || word.text.starts_with("GL_") || word.text.starts_with("__"))
        return;
      const auto other = std::ranges::find_if(
          names, [&](const std::string& name) { return text::lowered(name) == text::lowered(word.text); });
      // A word that is only asked for may well be a slot that this pass does not have.
      const std::string meant = other != names.end() ? *other
                                : valued             ? text::nearestName(word.text, names)
                                                     : "";
      if (meant.empty()) return;
      known.insert(meant);
      warn(say::nothingDefines, word, word.text, meant);
    };
    for (const glsl::Token& word : conditions.valued)
      if (std::ranges::find(conditions.tested, word.text, &glsl::Token::text) == conditions.tested.end())
        look(word, true);
    for (const glsl::Token& word : conditions.tested) look(word, false);
    for (const graph::DefineSpec& define : pass.defines)
      if (conditions.used.contains(define.name) || asked.contains(define.name)) known.insert(define.name);
  }
  // A define that is nearly a word of the preprocessor, which nobody else gives.
  for (const std::string& name : names) asked.erase(name);
  for (const graph::DefineSpec& define : pass.defines) {
    const std::string near = known.contains(define.name)
                                 ? ""
                                 : text::nearestName(define.name, std::vector(asked.begin(), asked.end()));
    const auto isSaid = [&](const text::Diagnostic& d) {  // of another repeat
      return d.message == fmt::format(say::defineNotInShaders.message, pass.declared, define.name);
    };
    if (!near.empty() && std::ranges::none_of(diagnostics.items(), isSaid))
      diagnostics.warning(say::defineNotInShaders, pass.place, pass.declared, define.name, near).pass =
          pass.name;
  }
}

}  // namespace weft::runtime
