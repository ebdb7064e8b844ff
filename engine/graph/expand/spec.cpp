// What is checked of a stanza, and what the executor needs of a pass instance besides its uses and state: defines, uniforms, threads,
// draw list, geometry and view. Declared in passes.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/passes.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

// ---- what is checked once per stanza, however often it repeats ----

namespace {

// A file says by its name for which stage it is written; another stage would not compile it, with riddles for messages.
void checkShaders(const SlotContext& context, const PassDesc& desc) {
  constexpr const char* kEndings[] = {".comp.glsl", ".vert.glsl", ".frag.glsl"};
  const ShaderShape shader = context.type->shader;
  const bool draw = shader == ShaderShape::draw, pair = !desc.vertexShader.empty();
  const auto endsOtherwise = [&](const std::string& path, std::string_view own) {
    return std::ranges::any_of(kEndings,
                               [&](const char* each) { return path.ends_with(each) && each != own; });
  };
  const char* const ending = shader == ShaderShape::compute ? ".comp.glsl"
                             : draw && !pair                ? ""
                                                            : ".frag.glsl";
  if ((pair || !desc.shader.empty()) && (!pair || shader != ShaderShape::compute) &&
      !endsOtherwise(desc.shader, ending) && !endsOtherwise(desc.vertexShader, ".vert.glsl"))
    return;
  const std::string expected =
      draw ? "\"shader\": a path without stage and ending, or { \"vertex\": …, \"fragment\": … }"
           : fmt::format("\"shader\": \"folder/name{}\"", ending);
  if (!pair && desc.shader.empty())
    context.report(say::lacksShader, desc.namePlace, expected);
  else
    context.report(say::shaderOfOtherStage, desc.shaderPlace, context.type->name, expected, desc.shader);
}

const GeometryType* findGeometry(const SlotContext& context, const PassDesc& desc) {
  return findNamed(context.model.registry.geometries, desc.geometry);
}
const SlotDesc* findIndirect(const PassDesc& desc) {
  const auto found = std::ranges::find(desc.slots, std::optional(Kind::indirect),
                                       [](const SlotDesc& slot) { return slot.ref.kind; });
  return found == desc.slots.end() ? nullptr : &*found;
}
bool isCounted(const SlotContext& context, const PassDesc& desc) {
  const GeometryType* const type = findGeometry(context, desc);
  return type && type->counted;
}

// What a pass says beside a buffer that says it.
void checkIndirect(const SlotContext& context, const PassDesc& desc) {
  const SlotDesc* const slot = findIndirect(desc);
  const GeometryType* const geometry = findGeometry(context, desc);
  const auto isOther = [&](const SlotDesc& each) { return &each != slot && each.ref.kind == Kind::indirect; };
  const struct {
    const char* what;
    bool said;
    Place place;
  } refused[] = {
      {"two buffers as indirect", std::ranges::any_of(desc.slots, isOther), slot ? slot->place : Place{}},
      {"\"threads\"", desc.threads.present(), desc.threads.place()},
      {"\"instances\"", desc.instances.present(), desc.instances.place()},
      {"\"slices\"", desc.slices.present(), desc.slices.place()},
      {"a number of vertices", geometry && geometry->counted && !desc.geometryArguments.empty(),
       desc.geometryPlace},
      {"the geometry \"mesh\"", geometry && geometry->meshes, desc.geometryPlace}};
  for (const auto& [what, said, place] : refused)
    if (slot && said) context.report(say::saidBesideIndirect, place, what, slot->ref.name);
}

void checkKeys(const SlotContext& context, const PassDesc& desc) {
  const ShaderShape shader = context.type->shader;
  const bool hasShader = shader != ShaderShape::none, draw = shader == ShaderShape::draw;
  const auto placeOf = [](const auto& list) { return list.empty() ? Place{} : list[0].place; };
  const struct {
    const char* key;
    bool present, taken;
    Place place;
  } keys[] = {{"threads", desc.threads.present(), false, desc.threads.place()},
              {"draws", desc.draws.present(), false, desc.draws.place()},
              {"raster", desc.raster.present(), false, desc.raster.place()},
              {"samples", desc.samples.present(), false, desc.samples.place()},
              {"instances", desc.instances.present(), false, desc.instances.place()},
              {"list", !desc.list.empty(), false, desc.listPlace},
              {"geometry", !desc.geometry.empty(), false, desc.geometryPlace},
              {"shader", !desc.shader.empty(), hasShader, desc.shaderPlace},
              {"state", !desc.state.empty(), draw || shader == ShaderShape::fragment, placeOf(desc.state)},
              {"view", desc.view.has_value(), hasShader, desc.view ? desc.view->place : Place{}},
              {"screen", desc.screen.present(), hasShader, desc.screen.place()},
              {"parameters", !desc.parameters.empty(), hasShader, placeOf(desc.parameters)},
              {"defines", !desc.defines.empty(), hasShader, placeOf(desc.defines)}};
  for (const auto& [key, present, taken, place] : keys)
    if (present && !taken && std::ranges::find(context.type->keys, key) == context.type->keys.end())
      context.report(say::keyNotTaken, place, key, context.type->name,
                     std::string_view(key) == "list" ? ", or say \"geometry\" to draw" : "");
  const auto modifies = [](const SlotDesc& slot) { return slot.access == Access::modify; };
  const struct {
    bool idle;
    Place place;
    text::SentenceFor<> what;
  } rules[] = {
      {desc.feedback && std::ranges::none_of(desc.slots, modifies), desc.namePlace, say::feedbackOfNothing},
      {!desc.list.empty() && desc.instances.present(), desc.instances.place(), say::instancesAndList},
      {desc.draws.present() && !findIndirect(desc), desc.draws.place(), say::drawsWithoutBuffer},
      {hasShader && desc.samples.present() && !desc.raster.present(), desc.samples.place(),
       say::samplesWithoutRaster}};
  for (const auto& [idle, place, what] : rules)
    if (idle) context.reportChecked(what, place);
  checkIndirect(context, desc);
  if (!hasShader) return;
  checkShaders(context, desc);
  const char* const lacking = draw && desc.geometry.empty()
                                  ? "a geometry: \"quad\", \"triangles(6)\", \"mesh\", …"
                              : draw && desc.list.empty() && !desc.instances.present() &&
                                      !isCounted(context, desc) && !findIndirect(desc)
                                  ? "what to draw: \"list\" or \"instances\""
                                  : nullptr;
  if (lacking) context.report(say::lacksKeyOrSlot, desc.namePlace, lacking);
}

// Reports what a list of the graph's own says of meshes, while spheres are drawn.
void checkOwnList(const SlotContext& context, const PassDesc& desc, const ImportRequest& list) {
  const ImportType& type = *findNamed(context.model.registry.imports, list.type);
  for (const ImportArgument& argument : type.arguments)
    if (argument.ofMeshes && !(list.at(argument.name) == argument.initial))
      context.report(say::spheresOfMeshList, desc.listPlace, desc.list, argument.name);
}

void checkLists(const SlotContext& context, const PassDesc& desc) {
  Model& model = context.model;
  const auto& geometries = model.registry.geometries;
  std::vector<std::string> lists = model.registry.drawLists;
  const std::uint32_t own = findDeclared(model, context.names.scope(), desc.list, ImportKind::list);
  if (!desc.list.empty() && own == kNone && std::ranges::find(lists, desc.list) == lists.end()) {
    for (const std::string& name : resourceNames(model, context.names.scope()))
      if (findDeclared(model, context.names.scope(), name, ImportKind::list) != kNone) lists.push_back(name);
    context.report(say::drawsUnknownList, desc.listPlace, desc.list, text::nearestHint(desc.list, lists));
  }
  if (desc.geometry.empty()) return;
  const GeometryType* const geometry = findGeometry(context, desc);
  if (!geometry)
    context.report(say::drawsUnknownGeometry, desc.geometryPlace, desc.geometry,
                   text::nearestHint(desc.geometry, namesOf(geometries)));
  else if (own != kNone && !geometry->meshes && ensureShape(model, own))
    checkOwnList(context, desc, model.graph.imports[model.entities[own].import].request);
  else if (geometry->meshes && desc.list.empty())
    context.report(say::meshesOfNoList, desc.geometryPlace, desc.geometry);
  else if (desc.geometryArguments.size() > geometry->arguments.size())
    context.report(say::tooManyGeometryArguments, desc.geometryPlace, desc.geometry,
                   geometry->arguments.size(), desc.geometryArguments.size());
  else if (geometry->counted && desc.geometryArguments.empty() && !findIndirect(desc))
    context.report(say::verticesNotCounted, desc.geometryPlace, desc.geometry);
}

// The slots of a pass type without a shader. What is wrong with them is one mistake.
void checkFixedSlots(const SlotContext& context, const PassDesc& desc) {
  const auto& fixed = context.type->fixedSlots;
  const auto& slots = desc.slots;
  if (fixed.empty()) return;
  const auto isWrong = [&](const SlotDesc& slot) {
    const FixedSlot* const own = findNamed(fixed, slot.name);
    return !own || (own->access == Access::read) != (slot.access == Access::read);
  };
  const auto isLacking = [&](const FixedSlot& slot) { return !findNamed(slots, slot.name); };
  const auto wrong = std::ranges::find_if(slots, isWrong);
  if (wrong == slots.end() && std::ranges::none_of(fixed, isLacking)) return;
  std::string expected;
  for (const FixedSlot& slot : fixed)
    expected += fmt::format("{}\"{}\": {{ \"{}\": … }}", expected.empty() ? "" : ", ", nameOf(slot.access),
                            slot.name);
  if (wrong == slots.end())
    context.report(say::lacksSlot, desc.namePlace, expected);
  else
    context.report(say::hasNoSuchSlot, wrong->place, wrong->name, context.type->name, expected,
                   text::nearestHint(wrong->name, namesOf(fixed)));
}

void checkCadence(const SlotContext& context, const PassDesc& desc) {
  if (desc.cadence == Cadence::always || desc.cadence == Cadence::every) {
    if (desc.slices.present()) context.report(say::slicedByClock, desc.slices.place());
    return;
  }
  const auto check = [&](const Expr& expr, std::string_view what) {
    if (isDynamic(context.model, context.names.scope(), expr))
      context.report(say::seesTime, expr.place(), what, expr.text());
  };
  for (const PassParameterDesc& parameter : desc.parameters)
    if (!parameter.declared)
      for (const Expr& value : parameter.values())
        check(value, fmt::format("parameter '{}'", parameter.name));
  check(desc.instances, "\"instances\"");
}

}  // namespace

bool checkStanza(const SlotContext& context, const PassDesc& desc) {
  const std::size_t before = context.model.diagnostics.errorCount();
  if (context.type) {
    checkKeys(context, desc);
    checkLists(context, desc);
    checkFixedSlots(context, desc);
  } else {
    context.report(say::unknownPassType, desc.typePlace, desc.type,
                   text::hintOrNearest("pass_type", desc.type, namesOf(context.model.registry.passTypes)));
  }
  const auto check = [&](const Expr& expr) {
    checkExpr(context.model, context.names.scope(), expr, desc.repeat);
  };
  visitPass(
      desc, check, [](const RefDesc&) {}, check);
  checkCadence(context, desc);
  return context.model.diagnostics.errorCount() == before;
}

// ---- what the executor needs besides slots ----

namespace {

// The import that a view names, and which layer and face of it; none means the default camera.
void resolveView(const SlotContext& context, const PassDesc& desc, PassSpec& spec) {
  Model& model = context.model;
  Scope& scope = context.names.scope();
  spec.screen = screenOf(model, scope);
  if (desc.screen.present())
    if (const auto size = evaluateSize(context.names, desc.screen, kMaxSize,
                                       fmt::format("the screen of pass '{}'", context.pass)))
      spec.screen = *size;
  if (!desc.view) {
    if (const std::uint32_t view = findFileView(model, scope); view != kNone)
      spec.view = model.entities[view].import;
    return;
  }
  const RefDesc& ref = *desc.view;
  const std::uint32_t found =
      findEntityOrReport(model, scope, ref, context.user, "is seen from", context.pass);
  if (found == kNone || !ensureShape(model, found)) return;
  const Entity& entity = model.entities[found];
  const ImportSpec* import = entity.import == kNone ? nullptr : &model.graph.imports[entity.import];
  const ImportType* type = import ? findNamed(model.registry.imports, import->request.type) : nullptr;
  const bool views = import && (import->kind == ImportKind::view || (type && type->views));
  const bool missing = context.versions && !entity.exists;
  RefDesc whole = ref;
  whole.element.reset();
  if (whole.face && !whole.face->range) whole.face.reset();
  if (!isWhole(whole) || missing || !views) {
    std::vector<std::string> known;
    for (const ImportType& each : model.registry.imports)
      if (each.kind == ImportKind::view || each.views) known.push_back("@" + each.name);
    const std::string all = fmt::format("{}", fmt::join(known, ", "));
    missing ? context.report(say::viewNotThere, ref.place, ref.text, all, ref.name)
            : context.report(say::notAView, ref.place, ref.text, all);
    return;
  }
  const std::int64_t last =
      entity.count > 0 && context.ranges ? static_cast<std::int64_t>(entity.count) - 1 : 65535;
  const Expr none;
  const auto element = evaluateWhole(context.names, ref.element ? ref.element->first : none, 0, 0, last,
                                     "the element of the view");
  const auto face =
      evaluateWhole(context.names, ref.face ? ref.face->first : none, 0, 0, 5, "the face of the view");
  if (!element || !face) return;
  spec.viewLayer = static_cast<std::uint16_t>(*element);
  spec.viewFace = static_cast<std::uint16_t>(*face);
  spec.view = entity.import;
}

std::string upper(std::string name) {
  for (char& c : name)
    c = std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::toupper(c)) : '_';
  return name;
}

// ---- defines and uniforms ----

// `choices`: the words that the value may be, of which each becomes a define too.
void emitDefine(const SlotContext& context, PassSpec& spec, const std::string& name, const Value& value,
                const std::vector<std::string>& choices, const Place& place) {
  const auto found = std::ranges::find(choices, value.symbol);
  if (value.type == Value::Type::none) return;
  if (value.isNumeric()) {
    spec.defines.push_back({name, toText(Value::number(value.v[0]))});
  } else if (value.type == Value::Type::symbol && found != choices.end()) {
    spec.defines.push_back({name, fmt::format("{}", found - choices.begin())});
    for (std::size_t i = 0; i < choices.size(); ++i)
      spec.defines.push_back({name + "_" + upper(choices[i]), fmt::format("{}", i)});
  } else {
    context.report(say::cannotDefine, place, name, value.type == Value::Type::list ? "a list" : "a word",
                   toText(value), hintForWord(context.names, value));
  }
}

void addDefine(const SlotContext& context, PassSpec& spec, const NamedExpr& define) {
  const std::size_t before = context.model.diagnostics.errorCount();
  const Value value = define.expr.evaluate(context.names, context.model.diagnostics);
  if (context.model.diagnostics.errorCount() > before) return;
  std::vector<std::string> choices;
  if (value.type == Value::Type::symbol)
    for (const std::string& variable : define.expr.variables()) {
      choices = context.names.choicesOf(variable);
      if (std::ranges::find(choices, value.symbol) != choices.end()) break;
    }
  emitDefine(context, spec, define.name, value, choices, define.expr.place());
}

// The parameter behind a uniform: one that the pass declares, or the only $variable of its expression. kNone: there is none.
std::uint32_t parameterOf(const SlotContext& context, const PassDesc& pass, const PassParameterDesc& desc,
                          const Expr& value) {
  const std::string own = pass.name + "." + desc.name;
  const std::string* const name = desc.declared ? &own : value.onlyVariable();
  const Variable variable = name ? findVariable(context.model, context.names.scope(), *name) : Variable{};
  return variable.kind == Variable::Kind::parameter ? variable.index : kNone;
}

// `uniform`: which element it is.
void addUniform(const SlotContext& context, const PassDesc& pass, const PassParameterDesc& desc,
                const Expr& value, UniformSpec uniform, PassSpec& spec,
                std::vector<DeferredUniform>& deferred) {
  Model& model = context.model;
  Scope& scope = context.names.scope();
  const std::uint32_t index = parameterOf(context, pass, desc, value);
  uniform.place = desc.place;
  if (index != kNone) {
    const Parameter& parameter = model.parameters[index];
    uniform.path = parameter.path;
    uniform.value = parameter.value;
    if (parameter.desc->define && uniform.element == kNone)
      return emitDefine(context, spec, upper(desc.name), parameter.value, parameter.desc->choices,
                        desc.place);
    if (!parameter.structural) uniform.dynamic = Expr::parameter(index, desc.place);
  } else {
    const bool dynamic = isDynamic(model, scope, value);
    uniform.constant = value.isConstant();
    context.names.follows = true;
    context.names.absent = !context.versions;
    if (!dynamic) uniform.value = value.evaluate(context.names, model.diagnostics);
    context.names.follows = false;
    if (!dynamic && uniform.value.type == Value::Type::none) return;
    if (dynamic || value.watched() || isLive(model, scope, value))
      deferred.push_back({.uniform = static_cast<std::uint32_t>(spec.uniforms.size()), .expr = &value});
  }
  if (uniform.value.type == Value::Type::symbol) {
    context.report(say::parameterIsWord, desc.place, uniform.text(), toText(uniform.value),
                   hintForWord(context.names, uniform.value));
    return;
  }
  spec.uniforms.push_back(std::move(uniform));
}

// One uniform, or one for each element of an array or column of a matrix.
void addParameter(const SlotContext& context, const PassDesc& pass, const PassParameterDesc& desc,
                  PassSpec& spec, std::vector<DeferredUniform>& deferred) {
  constexpr std::uint8_t kColumns = 4;
  Model& model = context.model;
  const bool matrix =
      desc.items.empty() && !desc.declared && isMatrix(model, context.names.scope(), desc.value);
  if (desc.items.empty() && !matrix)
    return addUniform(context, pass, desc, desc.value, {.name = desc.name}, spec, deferred);
  const std::uint32_t size = matrix ? kColumns : static_cast<std::uint32_t>(desc.items.size());
  for (std::uint32_t i = 0; i < size; ++i)
    addUniform(context, pass, desc,
               matrix ? model.matrixColumns.emplace_back(desc.value.column(static_cast<std::uint8_t>(i)))
                      : desc.items[i],
               {.name = desc.name, .element = i, .elements = size}, spec, deferred);
}

void checkDefineNames(const SlotContext& context, const PassDesc& desc, const PassSpec& spec) {
  std::set<std::string_view> all;
  for (const DefineSpec& define : spec.defines)
    if (!all.insert(define.name).second) {
      context.report(say::definedTwice, desc.namePlace, define.name);
      return;
    }
}

// ---- compute and draw ----

// Where "threads" says nothing, the texels of the first texture that is written.
void addThreads(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
                PassSpec& spec) {
  const Expr& said = desc.threads;
  spec.threadsPlace = said.present() ? said.place() : desc.namePlace;
  if (said.present()) {
    constexpr std::uint64_t kMax = 2147483647, kBounds[] = {kMax, kMax, kMax};
    const auto threads = evaluateCounts(context.names, said, kBounds,
                                        fmt::format("the number of threads of pass '{}'", context.pass),
                                        "a number, or a list of 2 or 3");
    for (std::size_t i = 0; threads && i < 3; ++i)
      spec.threads[i] = static_cast<std::uint32_t>(threads->each[i]);
    return;
  }
  bool failed = context.model.incomplete;  // the slot that would say may have been left out for its mistakes
  for (const SlotWork& work : slots) {
    if (work.reads()) continue;
    failed = failed || work.state == SlotWork::State::failed;
    if (work.entity == kNone || work.state == SlotWork::State::failed) continue;
    const FlatResource& shape = context.model.entities[work.entity].shape;
    if (shape.kind != ResourceKind::texture) continue;
    std::ranges::copy(sizeAt(shape, work.use.mip), spec.threads);
    if (shape.target != Target::texture_3d) spec.threads[2] = work.use.layers;
    return;
  }
  if (!failed) context.report(say::lacksThreads, desc.namePlace);
}

// A buffer that is read as indirect holds records of the command (OpenGL 4.5 core, 10.4 and 19).
void addIndirect(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
                 PassSpec& spec) {
  const auto work =
      std::ranges::find_if(slots, [](const SlotWork& each) { return each.use.kind == Kind::indirect; });
  if (work == slots.end() || work->entity == kNone) return;
  spec.indirect = true;
  const auto draws = evaluateWhole(context.names, desc.draws, 1, 0, 1 << 20, "the number of draws", true);
  if (!draws) return;
  spec.draws = static_cast<std::uint32_t>(*draws);
  const GeometryType* const geometry = findGeometry(context, desc);
  const bool dispatch = context.type->shader == ShaderShape::compute, indexed = geometry && geometry->indexed;
  const std::uint64_t record = dispatch  ? 12
                               : indexed ? 20
                                         : 16,
                      has = context.model.entities[work->entity].shape.bytes;
  if (has < record * spec.draws)
    context.report(say::bufferTooShort, work->slot->ref.place,
                   spec.draws == 1 ? "a record" : fmt::format("{} records", spec.draws), record,
                   work->slot->ref.name, has,
                   dispatch  ? "uint groups_x, groups_y, groups_z"
                   : indexed ? "uint count, instances, first_index, base_vertex, base_instance"
                             : "uint count, instances, first, base_instance",
                   record * spec.draws);
}

// What a pass draws over: its attachments, or "raster".
void addRaster(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
               PassSpec& spec) {
  const auto attaches = [](const SlotWork& work) {
    return work.isConnected() && (work.use.kind == Kind::color || work.use.kind == Kind::depth);
  };
  const bool attached = std::ranges::any_of(slots, attaches);
  if (!desc.raster.present()) {
    if (!attached && !context.model.incomplete && std::ranges::all_of(slots, &SlotWork::isConnected))
      context.report(say::lacksAttachment, desc.namePlace);
    return;
  }
  if (attached) context.report(say::rasterAndAttachment, desc.raster.place());
  // kMaxSize is GL_MAX_FRAMEBUFFER_WIDTH and _HEIGHT of every device.
  const auto size = evaluateSize(context.names, desc.raster, kMaxSize,
                                 fmt::format("the raster of pass '{}'", context.pass));
  const auto samples = evaluateWhole(context.names, desc.samples, 1, 1, 4, "the number of samples");
  if (!size || !samples) return;
  spec.raster = *size;
  spec.rasterSamples = static_cast<std::uint8_t>(*samples);
}

void addGeometry(const SlotContext& context, const PassDesc& desc, PassSpec& spec,
                 std::vector<DeferredUniform>& deferred) {
  if (const std::uint32_t own =
          findDeclared(context.model, context.names.scope(), desc.list, ImportKind::list);
      own != kNone && ensureShape(context.model, own))
    spec.listImport = context.model.entities[own].import;
  if (isDynamic(context.model, context.names.scope(), desc.instances))
    deferred.push_back({.expr = &desc.instances});
  else if (const auto instances = evaluateWhole(context.names, desc.instances, 1, 0, 2147483647,
                                                "the number of instances", true))
    spec.instances = static_cast<std::uint32_t>(*instances);
  const GeometryType* const type = findGeometry(context, desc);
  if (!type) return;
  spec.meshes = type->meshes;
  for (std::size_t i = 0; i < type->arguments.size(); ++i) {
    const GeometryArgument& argument = type->arguments[i];
    std::optional<std::int64_t> value = argument.initial;
    if (spec.indirect && type->counted) break;
    if (i < desc.geometryArguments.size())
      value = evaluateWhole(context.names, desc.geometryArguments[i], argument.initial, argument.min,
                            argument.max, "an argument of the geometry", type->counted > 0);
    if (value && type->counted > 1 && *value % type->counted != 0)
      context.report(say::verticesLeftOver, desc.geometryPlace, desc.geometry, *value, type->counted);
    if (value) spec.geometryArguments.push_back(static_cast<double>(*value));
  }
}

}  // namespace

void fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::uint32_t pass, std::vector<DeferredUniform>& deferred) {
  const ShaderShape shader = context.type->shader;
  const std::size_t before = deferred.size();
  fillState(context, desc, slots, spec.state);
  for (const NamedExpr& define : desc.defines) addDefine(context, spec, define);
  for (const PassParameterDesc& parameter : desc.parameters)
    addParameter(context, desc, parameter, spec, deferred);
  checkDefineNames(context, desc, spec);
  addIndirect(context, desc, slots, spec);
  if (shader == ShaderShape::fragment || shader == ShaderShape::draw) addRaster(context, desc, slots, spec);
  if (shader == ShaderShape::compute && !spec.indirect) addThreads(context, desc, slots, spec);
  if (shader == ShaderShape::draw) addGeometry(context, desc, spec, deferred);
  if (desc.view || shader != ShaderShape::none) resolveView(context, desc, spec);
  for (std::size_t i = before; i < deferred.size(); ++i) {
    deferred[i].pass = pass;
    deferred[i].scope = &context.names.scope();
    deferred[i].indices = context.names.indices;
  }
}

}  // namespace weft::graph::expansion
