#include "engine/graph/expand/stanza.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/nearest.h"
#include "engine/graph/expand/checks.h"

namespace weft::graph::expansion {

namespace {

struct Stanza {
  Model& model;
  Scope& scope;
  const PassDesc& desc;
  const PassType* type;
  const std::string& declared;

  void check(const Expr& expr, bool dynamicAllowed = false) const {
    checkExpr(model, scope, expr, dynamicAllowed, desc.repeat);
  }
  base::Diagnostic& error(Code code, const Place& place, std::string message) const {
    base::Diagnostic& d = model.diagnostics.error(code, place.line ? place : desc.place,
                                                  fmt::format("pass '{}' {}", declared, std::move(message)));
    d.pass = declared;
    return d;
  }
};

// Whether the type takes the key; every use of one it does not take is reported.
void checkKey(const Stanza& stanza, bool present, const char* key, const Place& place) {
  const auto& keys = stanza.type->keys;
  if (!present || std::find(keys.begin(), keys.end(), key) != keys.end()) return;
  auto& d =
      stanza.error(Code::keyNotTaken, place,
                   fmt::format("has the key '{}', which a {} pass does not take", key, stanza.type->name));
  d.hint = keys.empty() ? "" : base::nearestHint(key, keys);
}

// A file says by its name for which stage it is written; another stage would not compile it, with riddles for messages.
constexpr std::pair<const char*, ShaderShape> kStages[] = {{".comp.glsl", ShaderShape::compute},
                                                           {".frag.glsl", ShaderShape::fragment},
                                                           {".vert.glsl", ShaderShape::draw}};

const char* stageOf(std::string_view path) {
  for (const auto& [ending, shape] : kStages)
    if (path.ends_with(ending)) return ending;
  return nullptr;
}

// A vertex and a fragment shader, each by its path.
void checkPair(const Stanza& stanza) {
  const auto check = [&](const std::string& path, const char* key, const char* ending) {
    const char* const stage = stageOf(path);
    if (!stage || std::string_view(stage) == ending) return;
    auto& d = stanza.error(Code::keyNotTaken, stanza.desc.shaderPlace,
                           fmt::format("names '{}' as its {} shader, a shader of another stage", path, key));
    d.expected = fmt::format("a path that ends in '{}'", ending);
    d.hint = "name another shader";
  };
  check(stanza.desc.vertexShader, "vertex", kStages[2].first);
  check(stanza.desc.shader, "fragment", kStages[1].first);
}

void checkStage(const Stanza& stanza) {
  if (!stanza.desc.vertexShader.empty()) {
    if (stanza.type->shader != ShaderShape::compute) checkPair(stanza);  // a compute pass takes none
    return;
  }
  const std::string& path = stanza.desc.shader;
  const char* const stage = stageOf(path);
  const ShaderShape shader = stanza.type->shader;
  if (!stage) return;
  const ShaderShape shape = std::ranges::find(kStages, std::string_view(stage), [](const auto& each) {
                              return std::string_view(each.first);
                            })->second;
  const std::string stem = path.substr(0, path.size() - std::string_view(stage).size());
  if (shader == ShaderShape::draw && shape != ShaderShape::compute) {
    auto& d = stanza.error(Code::keyNotTaken, stanza.desc.shaderPlace,
                           fmt::format("is a {} pass, which has two shaders, and names '{}', one of them",
                                       stanza.type->name, path));
    d.expected = "a path without stage and ending, or { \"vertex\": …, \"fragment\": … }";
    d.hint = fmt::format("write '{}' for '{}.vert.glsl' and '{}.frag.glsl'", stem, stem, stem);
    return;
  }
  if (shape == shader) return;
  auto& d = stanza.error(
      Code::keyNotTaken, stanza.desc.shaderPlace,
      fmt::format("is a {} pass and names '{}', a shader of another stage", stanza.type->name, path));
  d.expected = shader == ShaderShape::draw
                   ? "a path without stage and ending, or { \"vertex\": …, \"fragment\": … }"
                   : fmt::format("a path that ends in '{}'",
                                 shader == ShaderShape::compute ? kStages[0].first : kStages[1].first);
  const auto& types = stanza.model.registry.passTypes;
  const auto other = std::ranges::find(types, shape, &PassType::shader);
  d.hint = other == types.end() ? "name another shader"
                                : fmt::format("say \"type\": \"{}\", or name another shader", other->name);
}

void checkKeys(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  checkKey(stanza, desc.threads.present(), "threads", desc.threads.place());
  checkKey(stanza, desc.instances.present(), "instances", desc.instances.place());
  checkKey(stanza, !desc.list.empty(), "list", desc.listPlace);
  checkKey(stanza, !desc.geometry.empty(), "geometry", desc.geometryPlace);
  const auto modifies = [](const SlotDesc& slot) { return slot.access == Access::modify; };
  if (desc.feedback && std::ranges::none_of(desc.slots, modifies)) {
    auto& d = stanza.error(Code::keyNotTaken, desc.namePlace, "has the key 'feedback' and modifies nothing");
    d.expected = "a slot in \"modify\" whose own texel it reads";
    d.hint = "leave \"feedback\" out, or say \"modify\" where the slot says \"write\"";
  }
  if (!desc.list.empty() && desc.instances.present())
    stanza
        .error(Code::keyNotTaken, desc.instances.place(),
               "has \"instances\" and a \"list\", which says how many")
        .hint = "leave one of the two out";
  const ShaderShape shader = stanza.type->shader;
  const auto notTaken = [&](const char* key, const Place& place) {
    stanza.error(Code::keyNotTaken, place,
                 fmt::format("has the key '{}', which a {} pass does not take", key, stanza.type->name));
  };
  if (!desc.state.empty() && shader != ShaderShape::fragment && shader != ShaderShape::draw)
    notTaken("state", desc.state[0].place);
  if (shader == ShaderShape::none) {
    if (!desc.shader.empty()) notTaken("shader", desc.shaderPlace);
    if (desc.view) notTaken("view", desc.view->place);
    if (!desc.parameters.empty()) notTaken("parameters", desc.parameters[0].place);
    if (!desc.defines.empty()) notTaken("defines", desc.defines[0].place);
    return;
  }
  const auto lacks = [&](const char* what, const char* expected) {
    stanza.error(Code::keyNeeded, desc.namePlace, fmt::format("lacks {}", what)).expected = expected;
  };
  if (!desc.vertexShader.empty() && shader != ShaderShape::draw && shader != ShaderShape::fragment) {
    auto& d =
        stanza.error(Code::keyNotTaken, desc.shaderPlace,
                     fmt::format("names a vertex shader, which a {} pass does not take", stanza.type->name));
    d.expected = fmt::format("\"shader\": \"{}\"", desc.shader);
  }
  checkStage(stanza);
  if (desc.shader.empty() && desc.vertexShader.empty())
    lacks("a shader", shader == ShaderShape::draw ? "\"shader\": \"spheres/billboard\", without stage and "
                                                    "ending, or { \"vertex\": …, \"fragment\": … }"
                                                  : "\"shader\": \"folder/name.stage.glsl\"");
  if (shader == ShaderShape::draw) {
    if (desc.list.empty() && !desc.instances.present()) lacks("what to draw", "\"list\" or \"instances\"");
    if (desc.geometry.empty()) lacks("a geometry", "\"geometry\": \"quad\", \"icosphere(3)\", \"mesh\", …");
  }
  if (shader != ShaderShape::compute && !stanza.model.incomplete &&
      std::none_of(desc.slots.begin(), desc.slots.end(), [](const SlotDesc& s) {
        return s.access != Access::read && s.ref.kind != Kind::image && s.ref.kind != Kind::storage;
      }))
    lacks("something to draw into",
          "a slot in \"write\" or \"modify\" that is an attachment: it gives the size of what is drawn, and "
          "the "
          "shader need not write it if nobody reads it");
}

void checkLists(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  const Registry& registry = stanza.model.registry;
  if (!desc.list.empty() &&
      std::find(registry.drawLists.begin(), registry.drawLists.end(), desc.list) == registry.drawLists.end())
    stanza.error(Code::unknownDrawList, desc.listPlace, fmt::format("draws the unknown list '{}'", desc.list))
        .hint = base::nearestHint(desc.list, registry.drawLists);
  if (desc.geometry.empty()) return;
  const auto geometry = std::ranges::find(registry.geometries, desc.geometry, &GeometryType::name);
  if (geometry == registry.geometries.end()) {
    std::vector<std::string> names;
    for (const GeometryType& type : registry.geometries) names.push_back(type.name);
    stanza
        .error(Code::unknownGeometry, desc.geometryPlace,
               fmt::format("draws the unknown geometry '{}'", desc.geometry))
        .hint = base::nearestHint(desc.geometry, names);
  } else if (geometry->meshes && desc.list.empty()) {
    auto& d = stanza.error(Code::keyNeeded, desc.geometryPlace,
                           fmt::format("draws '{}' of no list", desc.geometry));
    d.expected = "\"list\": the draw list whose meshes are drawn";
  } else if (desc.geometryArguments.size() > geometry->arguments.size()) {
    auto& d = stanza.error(Code::numberOutOfRange, desc.geometryPlace,
                           fmt::format("gives '{}' too many arguments", desc.geometry));
    d.expected = geometry->arguments.empty() ? "none" : fmt::format("at most {}", geometry->arguments.size());
    d.found = fmt::format("{}", desc.geometryArguments.size());
  }
}

bool names(const Stanza& stanza, const std::string& slot) {
  return std::ranges::any_of(stanza.desc.slots, [&](const SlotDesc& s) { return s.name == slot; });
}
bool isRead(Access access) {
  return access == Access::read;
}

// The slot of the type that `slot`, which is none of them, stands for: one of a like name, else the only one of its
// side that the pass lacks.
std::string fixedSlotMeantBy(const Stanza& stanza, const SlotDesc& slot) {
  std::vector<std::string> open, all;
  for (const FixedSlot& fixed : stanza.type->fixedSlots) {
    if (names(stanza, fixed.name)) continue;
    all.push_back(fixed.name);
    if (isRead(fixed.access) == isRead(slot.access)) open.push_back(fixed.name);
  }
  const std::string near = base::nearestName(slot.name, all);
  return near.empty() && open.size() == 1 ? open[0] : near;
}

void checkFixedSlots(const Stanza& stanza) {
  const auto& fixed = stanza.type->fixedSlots;
  if (fixed.empty()) return;
  std::vector<std::string> known;
  for (const FixedSlot& slot : fixed) known.push_back(slot.name);
  std::vector<std::string> meant;  // by slots of other names
  for (const SlotDesc& slot : stanza.desc.slots) {
    const auto found = std::ranges::find(fixed, slot.name, &FixedSlot::name);
    if (found == fixed.end()) {
      auto& d = stanza.error(
          Code::badSlots, slot.place,
          fmt::format("has the slot '{}', which a {} pass does not have", slot.name, stanza.type->name));
      const std::string own = fixedSlotMeantBy(stanza, slot);
      const bool taken = own.empty() || std::ranges::find(meant, own) != meant.end();
      d.hint = base::nearestHint(slot.name, known);
      if (!taken && !d.hint.starts_with("did you")) d.hint = fmt::format("call it '{}'", own);
      if (!taken) meant.push_back(own);
    } else if (isRead(slot.access) != isRead(found->access)) {
      auto& d = stanza.error(Code::badSlots, slot.place,
                             fmt::format("has the slot '{}' on the wrong side", slot.name));
      d.expected = fmt::format("'{}' in \"{}\"", slot.name, nameOf(found->access));
    }
  }
  for (const FixedSlot& slot : fixed)
    if (!names(stanza, slot.name) && std::ranges::find(meant, slot.name) == meant.end())
      stanza.error(Code::badSlots, stanza.desc.namePlace, fmt::format("lacks the slot '{}'", slot.name))
          .expected = fmt::format("\"{}\": {{ \"{}\": … }}", nameOf(slot.access), slot.name);
}

void checkReference(const Stanza& stanza, const RefDesc& ref) {
  stanza.check(ref.condition);
  if (ref.element) stanza.check(*ref.element);
  for (const std::optional<SpanDesc>* span : {&ref.mip, &ref.layer, &ref.face})
    if (*span) {
      stanza.check((*span)->first);
      stanza.check((*span)->last);
    }
  markStructural(stanza.model, stanza.scope, ref);
}

void checkExpressions(const Stanza& stanza) {
  Model& model = stanza.model;
  Scope& scope = stanza.scope;
  const PassDesc& desc = stanza.desc;
  const auto structural = [&](const Expr& expr) {
    stanza.check(expr);
    markStructural(model, scope, expr);
  };
  stanza.check(desc.enabled);
  markStructural(model, scope, desc.enabled);
  for (const RangeDesc& range : desc.repeat)
    for (const Expr* expr : {&range.first, &range.last, &range.step}) structural(*expr);
  for (const SlotDesc& slot : desc.slots) checkReference(stanza, slot.ref);
  if (desc.view) checkReference(stanza, *desc.view);
  for (const NamedExpr& define : desc.defines) {
    stanza.check(define.expr);
    markStructural(model, scope, define.expr);
  }
  for (const NamedExpr& state : desc.state) structural(state.expr);
  for (const Expr* expr : {&desc.slices, &desc.threads}) structural(*expr);
  stanza.check(desc.instances, true);
  markStructural(model, scope, desc.instances);
  for (const Expr& argument : desc.geometryArguments) structural(argument);
  for (const PassParameterDesc& parameter : desc.parameters) {
    if (!parameter.declared) stanza.check(parameter.value, true);
    if (parameter.declared && parameter.declared->define)
      if (Parameter* const own = findPassParameter(model, scope, desc.name, parameter.name))
        own->structural = true;
  }
}

void checkCadence(const Stanza& stanza) {
  const PassDesc& desc = stanza.desc;
  if (desc.cadence == Cadence::always && desc.slices.present()) {
    auto& d = stanza.error(Code::badSlices, desc.slices.place(), "is time-sliced but runs in every frame");
    d.hint = "slices go with \"update\": \"on_change\" or \"once\"";
  }
  if (desc.cadence == Cadence::always) return;
  for (const PassParameterDesc& parameter : desc.parameters)
    if (!parameter.declared && isDynamic(stanza.model, stanza.scope, parameter.value)) {
      auto& d = stanza.error(
          Code::badTime, parameter.value.place(),
          fmt::format("sees time in parameter '{}', but does not run in every frame", parameter.name));
      d.found = parameter.value.text();
      d.hint = "age() belongs into passes that are \"update\": \"always\"";
    }
  if (isDynamic(stanza.model, stanza.scope, desc.instances)) {
    auto& d = stanza.error(Code::badTime, desc.instances.place(),
                           "sees time in \"instances\", but does not run in every frame");
    d.found = desc.instances.text();
    d.hint = "age() belongs into passes that are \"update\": \"always\"";
  }
}

std::string hintForType(const std::string& type, const std::vector<std::string>& known) {
  constexpr std::pair<std::string_view, const char*> kTheirs[] = {
      {"raster", "write 'draw', or 'fullscreen' for a picture"},
      {"graphics", "write 'draw', or 'fullscreen' for a picture"},
      {"render", "write 'draw', or 'fullscreen' for a picture"},
      {"geometry", "write 'draw'"},
      {"mesh", "write 'draw'"},
      {"scene", "write 'draw'"},
      {"quad", "write 'fullscreen'"},
      {"screen", "write 'fullscreen'"},
      {"post", "write 'fullscreen'"},
      {"postprocess", "write 'fullscreen'"},
      {"post_process", "write 'fullscreen'"},
      {"postprocessing", "write 'fullscreen'"},
      {"fragment", "write 'fullscreen'"},
      {"pixel", "write 'fullscreen'"},
      {"image", "write 'fullscreen'"},
      {"shader", "write 'fullscreen'"},
      {"copy", "write 'blit'"},
      {"resolve", "write 'blit'"},
      {"transfer", "write 'blit'"},
      {"dispatch", "write 'compute'"},
      {"cs", "write 'compute'"},
      {"mips", "write 'mipmap'"},
      {"generate_mips", "write 'mipmap'"},
      {"mipmaps", "write 'mipmap'"},
      {"clear", "a texture says with what it begins: \"clear\" in \"resources\""}};
  for (const auto& [theirs, hint] : kTheirs)
    if (type == theirs && std::ranges::find(known, type) == known.end()) return hint;
  return base::nearestHint(type, known);
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
    std::vector<std::string> types;
    for (const PassType& known : model.registry.passTypes) types.push_back(known.name);
    stanza.error(Code::unknownPassType, desc.typePlace, fmt::format("is of the unknown type '{}'", desc.type))
        .hint = hintForType(desc.type, types);
  }
  checkExpressions(stanza);
  checkCadence(stanza);
  return model.diagnostics.errorCount() == before;
}

}  // namespace weft::graph::expansion
