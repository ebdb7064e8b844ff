// What is checked once per stanza, however often it repeats. Declared in passes.h.
#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/desc_walk.h"
#include "engine/graph/expand/passes.h"
#include "engine/text/nearest.h"
#include "engine/text/words/foreign_words.h"

namespace weft::graph::expansion {

namespace {

struct Stanza {
  Model& model;
  Scope& scope;
  const PassDesc& desc;
  const PassType* type;
  const std::string& declared;

  void error(Code code, const Place& place, std::string_view message, Says says = {}) const {
    says.pass = declared;
    report(model, code, place.line ? place : desc.place, fmt::format("pass '{}' {}", declared, message),
           std::move(says));
  }
};

template <class T>
std::vector<std::string> namesOf(const std::vector<T>& things) {
  std::vector<std::string> names;
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

// A file says by its name for which stage it is written; another stage would not compile it, with riddles for messages.
const char* endingOf(ShaderShape shape) {
  return shape == ShaderShape::compute ? ".comp.glsl"
         : shape == ShaderShape::draw  ? ".vert.glsl"
                                       : ".frag.glsl";
}

void checkShaders(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  const ShaderShape shader = stanza.type->shader;
  const bool draw = shader == ShaderShape::draw, pair = !desc.vertexShader.empty();
  const char* const expected = draw ? "\"shader\": \"spheres/billboard\", without stage and ending, or { "
                                      "\"vertex\": …, \"fragment\": … }"
                               : shader == ShaderShape::compute ? "\"shader\": \"folder/name.comp.glsl\""
                                                                : "\"shader\": \"folder/name.frag.glsl\"";
  if (!pair && desc.shader.empty())
    return stanza.error(Code::keyNeeded, desc.namePlace, "lacks a shader", {.expected = expected});
  bool fits = !pair || shader != ShaderShape::compute;
  const auto check = [&](const std::string& path, ShaderShape own, bool ending) {
    for (const ShaderShape stage : {ShaderShape::compute, ShaderShape::fragment, ShaderShape::draw})
      if (path.ends_with(endingOf(stage)) && (stage != own || !ending)) fits = false;
  };
  if (pair) check(desc.vertexShader, ShaderShape::draw, true);
  check(desc.shader, pair ? ShaderShape::fragment : shader, pair || !draw);
  if (!fits)
    stanza.error(Code::keyNotTaken, desc.shaderPlace,
                 fmt::format("is a {} pass and names a shader for another stage", stanza.type->name),
                 {.expected = expected, .found = desc.shader});
}

void checkKeys(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  const ShaderShape shader = stanza.type->shader;
  const bool hasShader = shader != ShaderShape::none, draw = shader == ShaderShape::draw;
  const struct {
    const char* key;
    bool present, taken;
    Place place;
  } keys[] = {
      {"threads", desc.threads.present(), false, desc.threads.place()},
      {"instances", desc.instances.present(), false, desc.instances.place()},
      {"list", !desc.list.empty(), false, desc.listPlace},
      {"geometry", !desc.geometry.empty(), false, desc.geometryPlace},
      {"shader", !desc.shader.empty(), hasShader, desc.shaderPlace},
      {"state", !desc.state.empty(), draw || shader == ShaderShape::fragment,
       desc.state.empty() ? Place{} : desc.state[0].place},
      {"view", desc.view.has_value(), hasShader, desc.view ? desc.view->place : Place{}},
      {"parameters", !desc.parameters.empty(), hasShader,
       desc.parameters.empty() ? Place{} : desc.parameters[0].place},
      {"defines", !desc.defines.empty(), hasShader, desc.defines.empty() ? Place{} : desc.defines[0].place}};
  for (const auto& [key, present, taken, place] : keys)
    if (present && !taken && std::ranges::find(stanza.type->keys, key) == stanza.type->keys.end())
      stanza.error(Code::keyNotTaken, place,
                   fmt::format("has the key '{}', which a {} pass does not take", key, stanza.type->name),
                   {.hint = fmt::format("remove \"{}\"", key)});
  const auto modifies = [](const SlotDesc& slot) { return slot.access == Access::modify; };
  if (desc.feedback && std::ranges::none_of(desc.slots, modifies))
    stanza.error(Code::keyNotTaken, desc.namePlace, "has the key 'feedback' and modifies nothing",
                 {.hint = "leave \"feedback\" out, or say \"modify\" where the slot says \"write\""});
  if (!desc.list.empty() && desc.instances.present())
    stanza.error(Code::keyNotTaken, desc.instances.place(),
                 "has \"instances\" and a \"list\", which says how many",
                 {.hint = "leave one of the two out"});
  if (!hasShader) return;
  checkShaders(stanza);
  const auto attaches = [](const SlotDesc& slot) {
    return slot.access != Access::read && slot.ref.kind != Kind::image && slot.ref.kind != Kind::storage;
  };
  const char* const lacking =
      draw && desc.list.empty() && !desc.instances.present() ? "what to draw: \"list\" or \"instances\""
      : draw && desc.geometry.empty() ? "a geometry: \"quad\", \"icosphere(3)\", \"mesh\", …"
      : shader != ShaderShape::compute && !stanza.model.incomplete &&
              std::ranges::none_of(desc.slots, attaches)
          ? "something to draw into: a slot in \"write\" or \"modify\" that is an attachment says how large "
            "it is"
          : nullptr;
  if (lacking) stanza.error(Code::keyNeeded, desc.namePlace, "lacks a key or a slot", {.expected = lacking});
}

void checkLists(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  const auto& drawLists = stanza.model.registry.drawLists;
  const auto& geometries = stanza.model.registry.geometries;
  if (!desc.list.empty() && std::ranges::find(drawLists, desc.list) == drawLists.end())
    stanza.error(Code::unknownDrawList, desc.listPlace, fmt::format("draws the unknown list '{}'", desc.list),
                 {.hint = text::nearestHint(desc.list, drawLists)});
  if (desc.geometry.empty()) return;
  const auto geometry = std::ranges::find(geometries, desc.geometry, &GeometryType::name);
  if (geometry == geometries.end())
    stanza.error(Code::unknownGeometry, desc.geometryPlace,
                 fmt::format("draws the unknown geometry '{}'", desc.geometry),
                 {.hint = text::nearestHint(desc.geometry, namesOf(geometries))});
  else if (geometry->meshes && desc.list.empty())
    stanza.error(Code::keyNeeded, desc.geometryPlace, fmt::format("draws '{}' of no list", desc.geometry),
                 {.expected = "\"list\": the draw list whose meshes are drawn"});
  else if (desc.geometryArguments.size() > geometry->arguments.size())
    stanza.error(Code::numberOutOfRange, desc.geometryPlace,
                 fmt::format("gives '{}' too many arguments", desc.geometry),
                 {.expected = fmt::format("at most {}", geometry->arguments.size()),
                  .found = fmt::format("{}", desc.geometryArguments.size())});
}

// The slots of a pass type without a shader. What is wrong with them is one mistake.
void checkFixedSlots(const Stanza& stanza) {
  const auto& fixed = stanza.type->fixedSlots;
  const auto& slots = stanza.desc.slots;
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
  if (wrong == slots.end())
    return stanza.error(Code::badSlots, stanza.desc.namePlace, "lacks a slot", {.expected = expected});
  stanza.error(
      Code::badSlots, wrong->place,
      fmt::format("has the slot '{}', which a {} pass does not have there", wrong->name, stanza.type->name),
      {.expected = expected, .hint = text::nearestHint(wrong->name, namesOf(fixed))});
}

void checkExpressions(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  // The value of a uniform is live, and may contain age(); so may "instances".
  const auto mayChange = [&](const Expr& expr) {
    const auto isValue = [&](const PassParameterDesc& parameter) { return &parameter.value == &expr; };
    return &expr == &desc.instances || std::ranges::any_of(desc.parameters, isValue);
  };
  const auto check = [&](const Expr& expr) {
    checkExpr(stanza.model, stanza.scope, expr, mayChange(expr), desc.repeat);
  };
  visitPass(desc, check, [](const RefDesc&) {});
}

void checkCadence(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  if (desc.cadence == Cadence::always) {
    if (desc.slices.present())
      stanza.error(Code::badSlices, desc.slices.place(), "is time-sliced but runs in every frame",
                   {.hint = "slices go with \"update\": \"on_change\" or \"once\""});
    return;
  }
  const auto check = [&](const Expr& expr, std::string_view what) {
    if (isDynamic(stanza.model, stanza.scope, expr))
      stanza.error(Code::badTime, expr.place(),
                   fmt::format("sees time in {}, but does not run in every frame", what),
                   {.found = expr.text(), .hint = "use age() in passes that are \"update\": \"always\""});
  };
  for (const PassParameterDesc& parameter : desc.parameters)
    if (!parameter.declared) check(parameter.value, fmt::format("parameter '{}'", parameter.name));
  check(desc.instances, "\"instances\"");
}

}  // namespace

bool checkStanza(Model& model, Scope& scope, const PassDesc& desc, const PassType* type,
                 const std::string& declared) {
  const std::size_t before = model.diagnostics.errorCount();
  const Stanza stanza{model, scope, desc, type, declared};
  if (type) {
    checkKeys(stanza);
    checkLists(stanza);
    checkFixedSlots(stanza);
  } else {
    std::string theirs = text::hintForForeign(text::Foreign::pass_type, desc.type);
    stanza.error(
        Code::unknownPassType, desc.typePlace, fmt::format("is of the unknown type '{}'", desc.type),
        {.hint = theirs.empty() ? text::nearestHint(desc.type, namesOf(model.registry.passTypes)) : theirs});
  }
  checkExpressions(stanza);
  checkCadence(stanza);
  return model.diagnostics.errorCount() == before;
}

}  // namespace weft::graph::expansion
