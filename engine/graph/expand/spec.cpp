// What is checked of a stanza, and what the executor needs of a pass instance besides its uses: state, defines, uniforms, threads,
// draw list, geometry and view. Declared in passes.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/passes.h"
#include "engine/graph/language/expr_node.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "engine/text/words/foreign_words.h"

namespace weft::graph::expansion {

// ---- what is checked once per stanza, however often it repeats ----

namespace {

std::string hintOrNearest(text::Foreign kind, const std::string& name,
                          const std::vector<std::string>& known) {
  std::string theirs = text::hintForForeign(kind, name);
  return theirs.empty() ? text::nearestHint(text::lowered(name), known) : theirs;
}

template <class T>
std::vector<std::string> namesOf(const std::vector<T>& things) {
  std::vector<std::string> names;
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

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
  const bool lacks = !pair && desc.shader.empty();
  context.report(
      lacks ? Code::keyNeeded : Code::keyNotTaken, lacks ? desc.namePlace : desc.shaderPlace,
      lacks ? "lacks a shader"
            : fmt::format("is a {} pass and names a shader for another stage", context.type->name),
      {.expected = draw ? "\"shader\": a path without stage and ending, or { \"vertex\": …, \"fragment\": … }"
                        : fmt::format("\"shader\": \"folder/name{}\"", ending),
       .found = desc.shader});
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
              {"instances", desc.instances.present(), false, desc.instances.place()},
              {"list", !desc.list.empty(), false, desc.listPlace},
              {"geometry", !desc.geometry.empty(), false, desc.geometryPlace},
              {"shader", !desc.shader.empty(), hasShader, desc.shaderPlace},
              {"state", !desc.state.empty(), draw || shader == ShaderShape::fragment, placeOf(desc.state)},
              {"view", desc.view.has_value(), hasShader, desc.view ? desc.view->place : Place{}},
              {"parameters", !desc.parameters.empty(), hasShader, placeOf(desc.parameters)},
              {"defines", !desc.defines.empty(), hasShader, placeOf(desc.defines)}};
  for (const auto& [key, present, taken, place] : keys)
    if (present && !taken && std::ranges::find(context.type->keys, key) == context.type->keys.end())
      context.report(Code::keyNotTaken, place,
                     fmt::format("has the key '{}', which a {} pass does not take", key, context.type->name),
                     {.hint = fmt::format("remove \"{}\"", key)});
  const auto modifies = [](const SlotDesc& slot) { return slot.access == Access::modify; };
  if (desc.feedback && std::ranges::none_of(desc.slots, modifies))
    context.report(Code::keyNotTaken, desc.namePlace, "has the key 'feedback' and modifies nothing",
                   {.hint = "leave \"feedback\" out, or say \"modify\" where the slot says \"write\""});
  if (!desc.list.empty() && desc.instances.present())
    context.report(Code::keyNotTaken, desc.instances.place(),
                   "has \"instances\" and a \"list\", which says how many",
                   {.hint = "leave one of the two out"});
  if (!hasShader) return;
  checkShaders(context, desc);
  const auto attaches = [](const SlotDesc& slot) {
    return slot.access != Access::read && slot.ref.kind != Kind::image && slot.ref.kind != Kind::storage;
  };
  const char* const lacking =
      draw && desc.list.empty() && !desc.instances.present() ? "what to draw: \"list\" or \"instances\""
      : draw && desc.geometry.empty() ? "a geometry: \"quad\", \"icosphere(3)\", \"mesh\", …"
      : shader != ShaderShape::compute && !context.model.incomplete &&
              std::ranges::none_of(desc.slots, attaches)
          ? "something to draw into: a slot in \"write\" or \"modify\" that is an attachment says how large "
            "it is"
          : nullptr;
  if (lacking)
    context.report(Code::keyNeeded, desc.namePlace, "lacks a key or a slot", {.expected = lacking});
}

void checkLists(const SlotContext& context, const PassDesc& desc) {
  const auto& drawLists = context.model.registry.drawLists;
  const auto& geometries = context.model.registry.geometries;
  if (!desc.list.empty() && std::ranges::find(drawLists, desc.list) == drawLists.end())
    context.report(Code::unknownDrawList, desc.listPlace,
                   fmt::format("draws the unknown list '{}'", desc.list),
                   {.hint = text::nearestHint(desc.list, drawLists)});
  if (desc.geometry.empty()) return;
  const auto geometry = std::ranges::find(geometries, desc.geometry, &GeometryType::name);
  if (geometry == geometries.end())
    context.report(Code::unknownGeometry, desc.geometryPlace,
                   fmt::format("draws the unknown geometry '{}'", desc.geometry),
                   {.hint = text::nearestHint(desc.geometry, namesOf(geometries))});
  else if (geometry->meshes && desc.list.empty())
    context.report(Code::keyNeeded, desc.geometryPlace, fmt::format("draws '{}' of no list", desc.geometry),
                   {.expected = "\"list\": the draw list whose meshes are drawn"});
  else if (desc.geometryArguments.size() > geometry->arguments.size())
    context.report(Code::numberOutOfRange, desc.geometryPlace,
                   fmt::format("gives '{}' too many arguments", desc.geometry),
                   {.expected = fmt::format("at most {}", geometry->arguments.size()),
                    .found = fmt::format("{}", desc.geometryArguments.size())});
}

// The slots of a pass type without a shader. What is wrong with them is one mistake.
void checkFixedSlots(const SlotContext& context, const PassDesc& desc) {
  const auto& fixed = context.type->fixedSlots;
  const auto& slots = desc.slots;
  if (fixed.empty()) return;
  const auto isWrong = [&](const SlotDesc& slot) {
    const auto own = std::ranges::find(fixed, slot.name, &FixedSlot::name);
    return own == fixed.end() || (own->access == Access::read) != (slot.access == Access::read);
  };
  const auto isLacking = [&](const FixedSlot& slot) {
    return std::ranges::find(slots, slot.name, &SlotDesc::name) == slots.end();
  };
  const auto wrong = std::ranges::find_if(slots, isWrong);
  if (wrong == slots.end() && std::ranges::none_of(fixed, isLacking)) return;
  std::string expected;
  for (const FixedSlot& slot : fixed)
    expected += fmt::format("{}\"{}\": {{ \"{}\": … }}", expected.empty() ? "" : ", ", nameOf(slot.access),
                            slot.name);
  const bool lacks = wrong == slots.end();
  context.report(Code::badSlots, lacks ? desc.namePlace : wrong->place,
                 lacks ? "lacks a slot"
                       : fmt::format("has the slot '{}', which a {} pass does not have there", wrong->name,
                                     context.type->name),
                 {.expected = expected, .hint = lacks ? "" : text::nearestHint(wrong->name, namesOf(fixed))});
}

void checkCadence(const SlotContext& context, const PassDesc& desc) {
  if (desc.cadence == Cadence::always || desc.cadence == Cadence::every) {
    if (desc.slices.present())
      context.report(Code::badSlices, desc.slices.place(), "is time-sliced but runs by the clock",
                     {.hint = "slices go with \"update\": \"on_change\" or \"once\""});
    return;
  }
  const auto check = [&](const Expr& expr, std::string_view what) {
    if (isDynamic(context.model, context.names.scope(), expr))
      context.report(Code::badTime, expr.place(),
                     fmt::format("sees time in {}, but does not run in every frame", what),
                     {.found = expr.text(),
                      .hint = "use age() in passes that are \"update\": \"always\" or \"every(n)\""});
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
    context.report(
        Code::unknownPassType, desc.typePlace, fmt::format("is of the unknown type '{}'", desc.type),
        {.hint =
             hintOrNearest(text::Foreign::pass_type, desc.type, namesOf(context.model.registry.passTypes))});
  }
  const auto check = [&](const Expr& expr) {
    checkExpr(context.model, context.names.scope(), expr, desc.repeat);
  };
  visitPass(desc, check, [](const RefDesc&) {});
  checkCadence(context, desc);
  return context.model.diagnostics.errorCount() == before;
}

// ---- what the executor needs besides slots ----

namespace {

// The import that a view names, and which layer and face of it; none means the default camera.
void resolveView(const SlotContext& context, const PassDesc& desc, PassSpec& spec) {
  Model& model = context.model;
  Scope& scope = context.names.scope();
  if (!desc.view) {
    // Declared under the name of such a type, here or in an enclosing file.
    for (const ImportType& type : model.registry.imports) {
      if (!type.everyPass) continue;
      const std::uint32_t view = findEntity(model, scope, type.name, true);
      if (view != kNone && model.entities[view].desc && ensureShape(model, view))
        spec.view = model.entities[view].import;
    }
    return;
  }
  const RefDesc& ref = *desc.view;
  const std::uint32_t found =
      findEntityOrReport(model, scope, ref, context.user, "is seen from", context.pass);
  if (found == kNone || !ensureShape(model, found)) return;
  const Entity& entity = model.entities[found];
  const ImportSpec* import = entity.import == kNone ? nullptr : &model.graph.imports[entity.import];
  const ImportType* type = import ? findImportType(model.registry, import->request.type) : nullptr;
  const bool views = import && (import->kind == ImportKind::view || (type && type->views));
  const bool missing = context.versions && !entity.exists;
  RefDesc whole = ref;
  whole.element.reset();
  if (whole.face && !whole.face->range) whole.face.reset();
  if (!isWhole(whole) || missing || !views) {
    std::vector<std::string> known;
    for (const ImportType& each : model.registry.imports)
      if (each.kind == ImportKind::view || each.views) known.push_back("@" + each.name);
    context.report(missing ? Code::emptyImport : Code::notAView, ref.place,
                   fmt::format("is seen from '{}', which {}", ref.text,
                               missing ? "the scene does not have" : "is no view"),
                   {.expected = fmt::format("one of {}, perhaps with [element] and one .face, without '?'",
                                            fmt::join(known, ", ")),
                    .hint = fmt::format("\"enabled\": \"has({})\" leaves the pass out", ref.name)});
    return;
  }
  const std::int64_t last =
      entity.count > 0 && context.ranges ? static_cast<std::int64_t>(entity.count) - 1 : 65535;
  const Expr none;
  const auto element =
      evaluateWhole(context.names, ref.element ? *ref.element : none, 0, 0, last, "the element of the view");
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
    context.report(
        Code::wordForNumber, place,
        fmt::format("cannot define '{}' as {}", name, value.type == Value::Type::list ? "a list" : "a word"),
        {.expected = "true, false, a number or a choice parameter",
         .found = toText(value),
         .hint = hintForWord(context.names, value)});
  }
}

void addDefine(const SlotContext& context, PassSpec& spec, const NamedExpr& define) {
  const std::size_t before = context.model.diagnostics.errorCount();
  const Value value = define.expr.evaluate(context.names, context.model.diagnostics);
  if (context.model.diagnostics.errorCount() > before) return;
  std::vector<std::string> choices;
  if (value.type == Value::Type::symbol)
    for (const std::string& variable : variablesOf(define.expr)) {
      choices = context.names.choicesOf(variable);
      if (std::ranges::find(choices, value.symbol) != choices.end()) break;
    }
  emitDefine(context, spec, define.name, value, choices, define.expr.place());
}

// The parameter behind a uniform: one that the pass declares, or the only $variable of its expression. kNone: there is none.
std::uint32_t parameterOf(const SlotContext& context, const PassDesc& pass, const PassParameterDesc& desc,
                          const Expr& value) {
  const std::string own = pass.name + "." + desc.name;
  const std::string* const name = desc.declared ? &own : onlyVariableOf(value);
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
    context.report(
        Code::wordForNumber, desc.place, fmt::format("gives its parameter '{}' a word", uniform.text()),
        {.expected = "a number, true, false or a list; a choice becomes a define by \"define\": true",
         .found = toText(uniform.value),
         .hint = hintForWord(context.names, uniform.value)});
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
      context.report(Code::nameUsedTwice, desc.namePlace, fmt::format("defines '{}' twice", define.name),
                     {.hint = "a choice also defines NAME_CHOICE, a parameter its name in capitals"});
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
    const auto threads =
        evaluateCounts(context.names, said, kBounds, fmt::format("the number of threads of {}", context.user),
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
    const auto side = [&](std::uint32_t texels) { return std::max(1u, texels >> work.use.mip); };
    spec.threads[0] = side(shape.width);
    spec.threads[1] = side(shape.height);
    spec.threads[2] = shape.target == Target::texture_3d ? side(shape.depth) : work.use.layers;
    return;
  }
  if (!failed)
    context.report(Code::keyNeeded, desc.namePlace, "lacks threads",
                   {.expected = "\"threads\": a number or a list, as no texture is written"});
}

void addGeometry(const SlotContext& context, const PassDesc& desc, PassSpec& spec,
                 std::vector<DeferredUniform>& deferred) {
  spec.list = desc.list;
  spec.geometry = desc.geometry;
  if (isDynamic(context.model, context.names.scope(), desc.instances))
    deferred.push_back({.expr = &desc.instances});
  else if (const auto instances = evaluateWhole(context.names, desc.instances, 1, 0, 2147483647,
                                                "the number of instances", true))
    spec.instances = static_cast<std::uint32_t>(*instances);
  const auto& types = context.model.registry.geometries;
  const auto type = std::ranges::find(types, desc.geometry, &GeometryType::name);
  if (type == types.end()) return;
  spec.meshes = type->meshes;
  for (std::size_t i = 0; i < type->arguments.size(); ++i) {
    const GeometryArgument& argument = type->arguments[i];
    std::optional<std::int64_t> value = argument.initial;
    if (i < desc.geometryArguments.size())
      value = evaluateWhole(context.names, desc.geometryArguments[i], argument.initial, argument.min,
                            argument.max, "an argument of the geometry");
    if (value) spec.geometryArguments.push_back(static_cast<double>(*value));
  }
}

// ---- state: from "state" and the slots that it is for ----

struct StateFiller {
  const SlotContext& context;
  const PassDesc& desc;
  const std::vector<SlotWork>& slots;
  StateSpec& state;
  bool failed = false;

  void fill() {
    for (const NamedExpr& each : desc.state)
      if (!failed) add(each);
    if (failed) return;
    checkDepth();
    checkBlends();
    checkCover();
  }

  void error(const Place& place, std::string_view message, Says says) const {
    context.report(Code::badState, place, message, std::move(says));
  }
  const NamedExpr* find(std::string_view name) const {
    const auto found = std::ranges::find(desc.state, name, &NamedExpr::name);
    return found == desc.state.end() ? nullptr : &*found;
  }

  // Index among the words of the key; 0 after a report.
  int word(const NamedExpr& said) {
    const std::string_view key = std::string_view(said.name).substr(0, said.name.find('.'));
    const auto& known = std::ranges::find(kStateKeys, key, &KeySpec::key)->words;
    const std::vector<std::string> words(known.begin(), known.end());
    const Value value = said.expr.evaluate(context.names, context.model.diagnostics);
    const auto found = std::ranges::find(words, value.symbol);
    if (value.type == Value::Type::symbol && found != words.end())
      return static_cast<int>(found - words.begin());
    failed = true;
    if (value.type == Value::Type::none) return 0;
    const std::string text = toText(value);
    error(said.expr.place(), fmt::format("has an unknown value for the state '{}'", said.name),
          {.expected = fmt::format("{}", fmt::join(words, ", ")),
           .found = text,
           .hint = hintOrNearest(text::Foreign::state_word, text, words)});
    return 0;
  }

  void addBlend(const NamedExpr& said) {
    std::vector<std::string> colors;
    for (const SlotWork& work : slots)
      if (!work.reads() && (work.entity == kNone || work.use.kind == Kind::color))
        colors.push_back(work.slot->name);
    const std::string slot = said.name == "blend" ? "" : said.name.substr(6);
    const bool known = slot.empty() || std::ranges::find(colors, slot) != colors.end();
    const Blend blend = known ? static_cast<Blend>(word(said)) : Blend::none;
    if (!known || (colors.empty() && blend != Blend::none)) {
      failed = true;
      return error(said.place, fmt::format("blends '{}', which is no color slot of it", slot),
                   {.expected = "one word, \"blend\": \"alpha\", or one for each color slot",
                    .hint = hintOrNearest(text::Foreign::state_key, slot, colors)});
    }
    if (!slot.empty()) colors = {slot};
    for (const std::string& color : colors) {
      std::erase_if(state.blend, [&](const auto& old) { return old.first == color; });
      state.blend.emplace_back(color, blend);
    }
  }

  void add(const NamedExpr& said) {
    if (said.name == "blend" || said.name.starts_with("blend.")) {
      addBlend(said);
    } else if (said.name == "depth_test") {
      state.depthTest = true;
      state.depthCompare = static_cast<Compare>(word(said));
    } else if (said.name == "depth_write") {
      state.depthWrite =
          evaluateCondition(context.names, said.expr, true, "the state 'depth_write'").value_or(true);
    } else if (said.name == "offset") {
      const Value value = said.expr.evaluate(context.names, context.model.diagnostics);
      if (value.type != Value::Type::none && (value.type != Value::Type::list || value.count != 2))
        error(said.expr.place(), "has an unknown value for the state 'offset'",
              {.expected = "[factor, units]", .found = toText(value)});
      state.offsetFactor = value.v[0];
      state.offsetUnits = value.v[1];
    } else {
      const int found = word(said);
      if (said.name == "cull") state.cull = static_cast<Cull>(found);
      if (said.name == "polygon") state.lines = found == 1;
      // The one triangle of a fullscreen pass has no back, and is filled.
      if (found != 0 && context.type->shader == ShaderShape::fragment)
        error(said.place, fmt::format("has the state '{}', which is for draws", said.name),
              {.hint = fmt::format("leave \"{}\" out", said.name)});
    }
  }

  // ---- what would do nothing ----

  void checkDepth() const {
    const SlotWork* depth = nullptr;
    bool writable = false;
    for (const SlotWork& work : slots) {
      if (work.entity == kNone) return;  // reported
      if (work.use.kind != Kind::depth) continue;
      depth = &work;
      writable = writable || !work.reads();
    }
    const NamedExpr *test = find("depth_test"), *write = find("depth_write"), *offset = find("offset");
    if (!depth) {
      if (const NamedExpr* said = test ? test : write ? write : offset)
        error(said->place, fmt::format("says '{}' but has no depth attachment", said->name),
              {.hint = "add \"modify\": { \"depth\": \"depth\" }, or leave it out"});
      return;
    }
    const std::string& slot = depth->slot->name;
    if (test && write && state.depthWrite && !writable)
      error(write->place, fmt::format("writes depth, and its depth slot '{}' is only read", slot),
            {.hint = fmt::format("move '{}' to \"modify\", or leave \"depth_write\" out", slot)});
    const bool writes = writable && !(write && write->expr.isConstant() && !state.depthWrite);
    if (!test || (test->expr.text() == "always" && !writes))
      error(
          depth->slot->place,
          fmt::format("has the depth slot '{}' and {}", slot,
                      test ? "neither tests nor writes it" : "no \"depth_test\""),
          {.expected = "\"state\": { \"depth_test\": … }",
           .hint =
               "write \"depth_test\": \"greater\", by which the nearer surface wins, or leave the slot out"});
  }

  void checkBlends() const {
    for (const auto& [name, blend] : state.blend) {
      const auto named = [&](const SlotWork& each) { return each.slot->name == name; };
      const auto work = std::ranges::find_if(slots, named);
      if (blend == Blend::none || work == slots.end() || work->entity == kNone) continue;
      const Format format = context.model.entities[work->entity].shape.format;
      const NamedExpr* said = find("blend." + name);
      if (isInteger(format))
        error((said ? said : find("blend"))->place,
              fmt::format("blends '{}', whose format {} does not blend", name, infoOf(format).name),
              {.hint = fmt::format("write \"blend\": {{ \"{}\": \"none\" }}", name)});
      else if (work->slot->access == Access::write && context.type->shader == ShaderShape::fragment)
        error(work->slot->place, fmt::format("blends '{}' with nothing, as it says \"write\"", name),
              {.hint = fmt::format("say \"modify\", or leave \"blend\" out of '{}'", name)});
    }
  }

  // A draw covers what its geometry covers.
  void checkCover() const {
    for (const SlotWork& work : slots) {
      if (work.entity == kNone || work.slot->access != Access::write || coversAll(context.type, work))
        continue;
      const Entity& entity = context.model.entities[work.entity];
      if (entity.shape.hasClear) continue;
      context.report(
          Code::badSlots, work.slot->place,
          fmt::format("draws a part of '{}' and says \"write\"", entity.name),
          {.hint = fmt::format("give '{}' a \"clear\" for the rest, or say \"modify\"", entity.name)});
      return;
    }
  }
};

}  // namespace

void fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::uint32_t pass, std::vector<DeferredUniform>& deferred) {
  const ShaderShape shader = context.type->shader;
  const std::size_t before = deferred.size();
  StateFiller{context, desc, slots, spec.state}.fill();
  for (const NamedExpr& define : desc.defines) addDefine(context, spec, define);
  for (const PassParameterDesc& parameter : desc.parameters)
    addParameter(context, desc, parameter, spec, deferred);
  checkDefineNames(context, desc, spec);
  if (shader == ShaderShape::compute) addThreads(context, desc, slots, spec);
  if (shader == ShaderShape::draw) addGeometry(context, desc, spec, deferred);
  if (desc.view || shader != ShaderShape::none) resolveView(context, desc, spec);
  for (std::size_t i = before; i < deferred.size(); ++i) {
    deferred[i].pass = pass;
    deferred[i].scope = &context.names.scope();
    deferred[i].indices = context.names.indices;
  }
}

}  // namespace weft::graph::expansion
