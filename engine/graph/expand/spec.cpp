// What the executor needs of a pass instance besides its uses: state, defines, uniforms, threads, draw list,
// geometry and view. Declared in passes.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

#include "engine/graph/expand/checks.h"
#include "engine/graph/expand/passes.h"
#include "engine/graph/language/expr_node.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "engine/text/words/foreign_words.h"

namespace weft::graph::expansion {

namespace {

bool givesViews(const Model& model, std::uint32_t import) {
  const ImportSpec& spec = model.graph.imports[import];
  const ImportType* type = findImportType(model.registry, spec.request.type);
  return spec.kind == ImportKind::view || (type && type->views);
}

// The import that a view names, and which layer and face of it; none means the default camera.
void resolveView(const SlotContext& context, const PassDesc& desc, PassSpec& spec) {
  Model& model = context.model;
  if (!desc.view) {
    // Declared under the name of such a type, here or in an enclosing file.
    for (const ImportType& type : model.registry.imports) {
      if (!type.everyPass) continue;
      const std::uint32_t view = findEntity(model, context.names.scope(), type.name, true);
      if (view != kNone && model.entities[view].desc && ensureShape(model, view))
        spec.view = model.entities[view].import;
    }
    return;
  }
  const RefDesc& ref = *desc.view;
  const std::uint32_t found =
      findEntityOrReport(model, context.names.scope(), ref, {context.user, "is seen from", context.pass});
  if (found == kNone || !ensureShape(model, found)) return;
  const Entity& entity = model.entities[found];
  const auto refuse = [&](Code code, const char* why, std::string expected) {
    context.report(code, ref.place, fmt::format("is seen from '{}'{}", ref.text, why),
                   {.expected = std::move(expected),
                    .hint = fmt::format("\"enabled\": \"has({})\" leaves the pass out", ref.name)});
  };
  if (entity.kind != ResourceDesc::Kind::import || !givesViews(model, entity.import)) {
    std::vector<std::string> views;
    for (const ImportType& type : model.registry.imports)
      if (type.kind == ImportKind::view || type.views) views.push_back("@" + type.name);
    return refuse(Code::notAView, ", which is no view", fmt::format("a view: {}", fmt::join(views, ", ")));
  }
  if (ref.optional || ref.condition.present() || ref.mip || ref.layer || ref.stencil || ref.history ||
      ref.wordsSize > 0 || (ref.face && ref.face->range))
    return refuse(Code::notAView, "", "a view, perhaps with [element] and one .face, without '?' and 'if'");
  if (context.versions && !entity.exists)
    return refuse(Code::emptyImport, ", which the scene does not have", "");
  if (ref.element) {
    const std::int64_t last =
        entity.count > 0 && context.ranges ? static_cast<std::int64_t>(entity.count) - 1 : 65535;
    const auto element = evaluateWhole(context.names, *ref.element, 0, 0, last, "the element of the view");
    if (!element) return;
    spec.viewLayer = static_cast<std::uint16_t>(*element);
  }
  if (ref.face) {
    const auto face = evaluateWhole(context.names, ref.face->first, 0, 0, 5, "the face of the view");
    if (!face) return;
    spec.viewFace = static_cast<std::uint16_t>(*face);
  }
  spec.view = entity.import;
}

std::string upper(std::string_view name) {
  std::string out;
  for (const char c : name)
    out += std::isalnum(static_cast<unsigned char>(c))
               ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
               : '_';
  return out;
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
std::uint32_t parameterOf(const SlotContext& context, const PassDesc& pass, const PassParameterDesc& desc) {
  if (desc.declared) return findPassParameter(context.names.scope(), pass.name, desc.name);
  const std::string* const name = onlyVariableOf(desc.value);
  const Variable variable = name ? findVariable(context.model, context.names.scope(), *name) : Variable{};
  return variable.kind == Variable::Kind::parameter ? variable.index : kNone;
}

void addUniform(const SlotContext& context, const PassDesc& pass, const PassParameterDesc& desc,
                PassSpec& spec, std::vector<DeferredUniform>& deferred) {
  Model& model = context.model;
  const std::uint32_t index = parameterOf(context, pass, desc);
  const Expr* expr = index == kNone ? &desc.value : nullptr;  // null: `index` alone
  UniformSpec uniform;
  uniform.name = desc.name;
  uniform.place = desc.place;
  bool changes = true;
  if (index != kNone) {
    Parameter& parameter = model.parameters[index];
    uniform.path = parameter.path;
    uniform.value = parameter.value;
    if (parameter.desc->define) {
      parameter.structural = true;
      return emitDefine(context, spec, upper(desc.name), parameter.value, parameter.desc->choices,
                        desc.place);
    }
  } else if (!isDynamic(model, context.names.scope(), desc.value)) {
    uniform.constant = desc.value.isConstant();
    uniform.value = desc.value.evaluate(context.names, model.diagnostics);
    changes = !uniform.constant;
    if (uniform.value.type == Value::Type::none) return;
  }
  if (uniform.value.type == Value::Type::symbol) {
    std::string meant = hintForWord(context.names, uniform.value);
    context.report(Code::wordForNumber, desc.place, fmt::format("gives its parameter '{}' a word", desc.name),
                   {.expected = "a number, true, false or a list",
                    .found = toText(uniform.value),
                    .hint = meant.empty() ? "a choice becomes a define by \"define\": true" : meant});
    return;
  }
  if (changes)
    deferred.push_back(
        {.uniform = static_cast<std::uint32_t>(spec.uniforms.size()), .expr = expr, .parameter = index});
  spec.uniforms.push_back(std::move(uniform));
}

void checkDefineNames(const SlotContext& context, const PassDesc& desc, const PassSpec& spec) {
  std::vector<std::string_view> all;
  for (const DefineSpec& define : spec.defines) all.push_back(define.name);
  std::ranges::sort(all);
  if (const auto twice = std::ranges::adjacent_find(all); twice != all.end())
    context.report(Code::nameUsedTwice, desc.namePlace, fmt::format("defines '{}' twice", *twice),
                   {.hint = "a choice also defines NAME_CHOICE, a parameter its name in capitals"});
}

// ---- compute and draw ----

// The texels of the first texture that is written, where "threads" says nothing.
void takeThreads(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
                 PassSpec& spec) {
  bool failed = context.model.incomplete;  // the slot that would say may have been left out for its mistakes
  for (const SlotWork& work : slots) {
    if (work.slot->access == Access::read) continue;
    failed = failed || work.state == SlotWork::State::failed;
    if (work.entity == kNone || work.state == SlotWork::State::failed) continue;
    const FlatResource& shape = context.model.entities[work.entity].shape;
    if (shape.kind != ResourceKind::texture) continue;
    spec.threads[0] = std::max(1u, shape.width >> work.use.mip);
    spec.threads[1] = std::max(1u, shape.height >> work.use.mip);
    spec.threads[2] =
        shape.target == Target::texture_3d ? std::max(1u, shape.depth >> work.use.mip) : work.use.layers;
    return;
  }
  if (!failed)
    context.report(Code::keyNeeded, desc.namePlace, "lacks threads",
                   {.expected = "\"threads\": a number or a list, as no texture is written"});
}

void addThreads(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
                PassSpec& spec) {
  const Expr& said = desc.threads;
  spec.threadsPlace = said.present() ? said.place() : desc.namePlace;
  if (!said.present()) return takeThreads(context, desc, slots, spec);
  const Value value = said.evaluate(context.names, context.model.diagnostics);
  if (value.type == Value::Type::none) return;
  if (!value.isNumeric() && (value.type != Value::Type::list || value.count < 2 || value.count > 3)) {
    context.report(Code::wrongValueType, said.place(), "has threads that are no count",
                   {.expected = "a number, or a list of 2 or 3", .found = toText(value)});
    return;
  }
  for (std::size_t i = 0; i < value.count; ++i) {
    const double count = value.v[i];
    // As with sizes: 0 is a mistake, but for an empty list; what is computed between 0 and 1 is 1.
    const bool none =
        count < 1 &&
        (said.isConstant() || (count <= 0 && !countsElements(context.model, context.names.scope(), said)));
    if (!(count >= 0) || none || count > 2147483647.0) {
      context.report(Code::numberOutOfRange, said.place(), "has a number of threads out of its range",
                     {.expected = "1 to 2147483647",
                      .found = toText(value),
                      .hint = said.isConstant() ? "" : "write 'max(…, 1)', or disable the pass"});
      return;
    }
    spec.threads[i] = static_cast<std::uint32_t>(std::max(1.0, std::floor(count)));
  }
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
  bool failed = false, blendTold = false;

  void error(const Place& place, std::string_view message, Says says = {}) const {
    context.report(Code::badState, place, message, std::move(says));
  }
  const NamedExpr* find(std::string_view name) const {
    const auto found = std::ranges::find(desc.state, name, &NamedExpr::name);
    return found == desc.state.end() ? nullptr : &*found;
  }

  // Index among the words of the key, or -1 after a report.
  int word(const NamedExpr& said) const {
    const std::string_view key = std::string_view(said.name).substr(0, said.name.find('.'));
    const auto& known = std::ranges::find(kStateKeys, key, &KeySpec::key)->words;
    const std::vector<std::string> words(known.begin(), known.end());
    const Value value = said.expr.evaluate(context.names, context.model.diagnostics);
    if (value.type == Value::Type::none) return -1;
    const auto found = std::ranges::find(words, value.symbol);
    if (value.type == Value::Type::symbol && found != words.end())
      return static_cast<int>(found - words.begin());
    const std::string text = toText(value);
    std::string theirs = text::hintForForeign(text::Foreign::state_word, text);
    error(said.expr.place(), fmt::format("has an unknown value for the state '{}'", said.name),
          {.expected = fmt::format("{}", fmt::join(words, ", ")),
           .found = text,
           .hint = theirs.empty() ? text::nearestHint(text::lowered(text), words) : theirs});
    return -1;
  }

  void addBlend(const NamedExpr& said) {
    std::vector<std::string> colors;
    for (const SlotWork& work : slots)
      if (work.slot->access != Access::read && (work.entity == kNone || work.use.kind == Kind::color))
        colors.push_back(work.slot->name);
    const std::string slot = said.name == "blend" ? "" : said.name.substr(6);
    if (!slot.empty() && std::ranges::find(colors, slot) == colors.end()) {
      if (std::exchange(blendTold, true)) return;
      std::string theirs = text::hintForForeign(text::Foreign::state_key, slot);
      return error(said.place, fmt::format("blends '{}', which is no color slot of it", slot),
                   {.expected = "one word, \"blend\": \"alpha\", or one for each color slot",
                    .hint = theirs.empty() ? text::nearestHint(slot, colors) : theirs});
    }
    const int found = word(said);
    if (found < 0) return;
    if (slot.empty() && colors.empty() && found != static_cast<int>(Blend::none))
      error(said.place, "blends, and has no color slot",
            {.hint = "leave \"blend\" out, or say \"modify\": { \"result\": … } with a color texture"});
    if (!slot.empty()) colors = {slot};
    for (const std::string& color : colors) {
      std::erase_if(state.blend, [&](const auto& old) { return old.first == color; });
      state.blend.emplace_back(color, static_cast<Blend>(found));
    }
  }

  void addOffset(const NamedExpr& said) {
    const Value value = said.expr.evaluate(context.names, context.model.diagnostics);
    if (value.type == Value::Type::list && value.count == 2) {
      state.offsetFactor = value.v[0];
      state.offsetUnits = value.v[1];
    } else if (value.type != Value::Type::none) {
      error(said.expr.place(), "has an unknown value for the state 'offset'",
            {.expected = "[factor, units]", .found = toText(value)});
    }
  }

  void add(const NamedExpr& said) {
    if (said.name == "blend" || said.name.starts_with("blend.")) {
      addBlend(said);
    } else if (said.name == "depth_test") {
      const int found = word(said);
      failed = found < 0;
      state.depthTest = !failed;
      if (!failed) state.depthCompare = static_cast<Compare>(found);
    } else if (said.name == "depth_write") {
      state.depthWrite =
          evaluateCondition(context.names, said.expr, true, "the state 'depth_write'").value_or(true);
    } else if (said.name == "cull") {
      if (const int found = word(said); found >= 0) state.cull = static_cast<Cull>(found);
    } else if (said.name == "polygon") {
      state.lines = word(said) == 1;
    } else if (said.name == "offset") {
      addOffset(said);
    }
  }

  // ---- what would do nothing ----

  void checkDepth() const {
    constexpr const char* kGreater =
        "write \"depth_test\": \"greater\", by which the nearer surface wins, or leave the slot out";
    const SlotWork *depth = nullptr, *writable = nullptr;
    for (const SlotWork& work : slots) {
      if (work.entity == kNone) return;  // reported
      if (work.use.kind != Kind::depth) continue;
      depth = &work;
      if (work.slot->access != Access::read) writable = &work;
    }
    if (failed) return;
    const NamedExpr *test = find("depth_test"), *write = find("depth_write"), *offset = find("offset");
    if (const NamedExpr* said = test ? test : write ? write : offset; said && !depth)
      error(said->place, fmt::format("says '{}' but has no depth attachment", said->name),
            {.hint = "add \"modify\": { \"depth\": \"depth\" }, or leave it out"});
    if (!depth) return;
    const std::string& slot = depth->slot->name;
    const Place& place = depth->slot->place;
    if (!test)
      return error(place, fmt::format("has the depth slot '{}' and no \"depth_test\"", slot),
                   {.expected = "\"state\": { \"depth_test\": … }", .hint = kGreater});
    if (write && state.depthWrite && !writable)
      error(write->place, fmt::format("writes depth, and its depth slot '{}' is only read", slot),
            {.hint = fmt::format("move '{}' to \"modify\", or leave \"depth_write\" out", slot)});
    const bool writes = writable && !(write && write->expr.isConstant() && !state.depthWrite);
    if (test->expr.text() == "always" && !writes)
      error(place, fmt::format("neither tests nor writes the depth of '{}'", slot), {.hint = kGreater});
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
              {.expected = fmt::format("\"modify\": {{ \"{}\": \"{}\" }}", name, work->slot->ref.text),
               .hint = fmt::format("say \"modify\", or leave \"blend\" out of '{}'", name)});
    }
  }

  // The one triangle of a fullscreen pass has no back, and is filled.
  void checkFaces() const {
    if (context.type->shader != ShaderShape::fragment) return;
    for (const NamedExpr& said : desc.state)
      if ((said.name == "cull" && state.cull != Cull::none) || (said.name == "polygon" && state.lines))
        error(said.place, fmt::format("has the state '{}', which is for draws", said.name),
              {.hint = fmt::format("leave \"{}\" out", said.name)});
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
          {.expected = fmt::format("\"clear\" in '{}' for the rest, or \"modify\"", entity.name),
           .hint = fmt::format("give '{}' a \"clear\", or let a fullscreen pass write it", entity.name)});
      return;
    }
  }
};

void fillState(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
               StateSpec& state) {
  StateFiller filler{context, desc, slots, state};
  for (const NamedExpr& each : desc.state) filler.add(each);
  filler.checkDepth();
  filler.checkBlends();
  filler.checkFaces();
  filler.checkCover();
}

}  // namespace

void fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::uint32_t pass, std::vector<DeferredUniform>* deferred) {
  const ShaderShape shader = context.type->shader;
  std::vector<DeferredUniform> ignored;
  std::vector<DeferredUniform>& all = deferred ? *deferred : ignored;
  const std::size_t before = all.size();
  spec.uniforms.reserve(desc.parameters.size());
  spec.defines.reserve(desc.defines.size());
  fillState(context, desc, slots, spec.state);
  for (const NamedExpr& define : desc.defines) addDefine(context, spec, define);
  for (const PassParameterDesc& parameter : desc.parameters) addUniform(context, desc, parameter, spec, all);
  checkDefineNames(context, desc, spec);
  if (shader == ShaderShape::compute) addThreads(context, desc, slots, spec);
  if (shader == ShaderShape::draw) addGeometry(context, desc, spec, all);
  if (desc.view || shader != ShaderShape::none) resolveView(context, desc, spec);
  for (std::size_t i = before; i < all.size(); ++i) {
    all[i].pass = pass;
    all[i].scope = &context.names.scope();
    all[i].indices = context.names.indices;
  }
}

}  // namespace weft::graph::expansion
