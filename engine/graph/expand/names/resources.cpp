#include "engine/graph/expand/names/resources.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <set>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/expand/names/apply_settings.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

// ---- imports: their arguments, and what the registry says of them ----

namespace {

bool evaluateArgument(Model& model, Names& names, const Entity& entity, const ImportArgument& argument,
                      const Expr& expr, Value& out) {
  out = expr.evaluate(names, model.diagnostics);
  if (out.type == Value::Type::none) return false;
  const auto report = [&](std::string expected, std::string hint) {
    auto& d = model.diagnostics.error(
        Code::badImportArgument, expr.place(),
        fmt::format("import '{}': argument '{}' does not fit", entity.name, argument.name));
    d.resource = entity.name;
    d.expected = std::move(expected);
    d.found = toText(out);
    d.hint = std::move(hint);
    return false;
  };
  if (argument.drawList && out.type == Value::Type::symbol) {
    const auto& lists = model.registry.drawLists;
    if (std::find(lists.begin(), lists.end(), out.symbol) == lists.end()) {
      auto& d = model.diagnostics.error(
          Code::unknownDrawList, expr.place(),
          fmt::format("import '{}' names the unknown draw list '{}'", entity.name, out.symbol));
      d.hint = base::nearestHint(out.symbol, lists);
      return false;
    }
  }
  if (!argument.choices.empty()) {
    std::string all;
    for (const std::string& choice : argument.choices) all += (all.empty() ? "" : ", ") + choice;
    if (out.type != Value::Type::symbol ||
        std::find(argument.choices.begin(), argument.choices.end(), out.symbol) == argument.choices.end())
      return report("one of " + all, base::nearestHint(out.symbol, argument.choices));
  }
  const Value& initial = argument.initial;
  if (initial.type == Value::Type::none) return true;
  const bool fits = initial.isNumeric() ? out.isNumeric()
                                        : initial.type == out.type && (initial.type != Value::Type::list ||
                                                                       initial.count == out.count);
  if (fits) return true;
  return report(initial.isNumeric()                 ? "a number"
                : initial.type == Value::Type::list ? fmt::format("a list of {}", initial.count)
                                                    : "a word",
                "");
}

}  // namespace

std::string hintForImport(std::string_view name, const std::vector<std::string>& types) {
  for (const base::Foreign kind : {base::Foreign::value, base::Foreign::import_type})
    if (std::string foreign = base::hintForForeign(kind, name); !foreign.empty()) return foreign;
  std::string hint = base::nearestHint(name, types);
  return hint.empty() ? fmt::format("imports are {}", fmt::join(types, ", ")) : hint;
}

namespace {

// Reports arguments that the type does not have.
bool checkArgumentNames(Model& model, const Entity& entity, const ImportType& type,
                        const std::vector<NamedExpr>& given) {
  bool good = true;
  std::vector<std::string> known;
  for (const ImportArgument& argument : type.arguments) known.push_back(argument.name);
  for (const NamedExpr& argument : given) {
    markStructural(model, *entity.scope, argument.expr);
    if (std::ranges::find(known, argument.name) != known.end()) continue;
    auto& d =
        model.diagnostics.error(Code::badImportArgument, argument.place,
                                fmt::format("import '{}' has no argument '{}'", type.name, argument.name));
    d.resource = entity.name;
    d.hint = base::nearestHint(argument.name, known);
    if (std::string theirs = base::hintForForeign(base::Foreign::import_argument, argument.name);
        !theirs.empty() && std::ranges::find(known, "file") != known.end())
      d.hint = std::move(theirs);
    good = false;
  }
  return good;
}

// Fills in what is asked for, with the defaults of what is not given. `good`: the names are, one misspelling is one mistake.
bool evaluateArguments(Model& model, const Entity& entity, const ImportType& type,
                       const std::vector<NamedExpr>& given, bool good, ImportRequest& request) {
  Names names(model, *entity.scope);
  for (const ImportArgument& argument : type.arguments) {
    const auto found = std::ranges::find(given, argument.name, &NamedExpr::name);
    Value value = argument.initial;
    if (found != given.end()) {
      good = evaluateArgument(model, names, entity, argument, found->expr, value) && good;
    } else if (argument.initial.type == Value::Type::none) {
      if (!good) continue;
      auto& d = model.diagnostics.error(
          Code::badImportArgument, entity.desc ? entity.desc->place : Place{},
          fmt::format("import '{}' needs the argument '{}'", type.name, argument.name));
      d.resource = entity.name;
      if (!entity.desc)
        d.hint = fmt::format("declare it: \"{}\": {{ \"import\": \"{}\", \"{}\": … }}", type.name, type.name,
                             argument.name);
      good = false;
    }
    request.arguments.emplace_back(argument.name, std::move(value));
  }
  return good;
}

void takeFacts(Model& model, Entity& entity, const ImportType& type, const ImportRequest& request,
               const ImportFacts& facts) {
  entity.exists = facts.exists;
  entity.fallback = facts.fallback;
  entity.count = facts.count;
  FlatResource& shape = entity.shape;
  shape.kind =
      type.kind == ImportKind::texture ? ResourceKind::imported_texture : ResourceKind::imported_buffer;
  shape.format = facts.format;
  shape.width = std::max(1u, facts.width);
  shape.height = std::max(1u, facts.height);
  shape.depth = std::max(1u, facts.depth);
  shape.layers = static_cast<std::uint16_t>(std::clamp(facts.layers, 1u, kMaxLayers));
  shape.mips = static_cast<std::uint16_t>(std::clamp(facts.mips, 1u, kMaxMips));
  shape.bytes = facts.bytes;
  shape.target = shape.depth > 1                     ? Target::texture_3d
                 : shape.layers > 1 || facts.layered ? Target::texture_2d_array
                                                     : Target::texture_2d;
  // The elements of an array stand side by side in FlatGraph::imports.
  entity.arrayCount = type.array;
  entity.elements.resize(std::max(1u, type.array));
  for (std::uint32_t element = 0; element < entity.elements.size(); ++element) {
    ImportRequest one = request;
    if (type.array > 0) one.arguments.emplace_back("element", Value::number(element));
    const std::uint32_t import = internImport(model, std::move(one), type.kind, entity.name);
    if (element == 0) entity.import = import;
    assert(import == entity.import + element);
    ImportSpec& spec = model.graph.imports[import];
    spec.count = facts.count;
    spec.changing = facts.changing;
    if (!spec.place.file && entity.desc) spec.place = entity.desc->place;
  }
  shape.import = entity.import;
}

}  // namespace

bool evaluateImport(Model& model, Entity& entity) {
  static const std::vector<NamedExpr> kNoArguments;
  const std::vector<NamedExpr>& given = entity.desc ? entity.desc->import.arguments : kNoArguments;
  ImportRequest request{.type = entity.desc ? entity.desc->import.type : entity.name.substr(1)};
  const ImportType* type = findImportType(model.registry, request.type);
  if (!type) {
    std::vector<std::string> types;
    for (const ImportType& known : model.registry.imports) types.push_back(known.name);
    auto& d = model.diagnostics.error(
        Code::unknownImport, entity.desc->place,
        fmt::format("resource '{}' is of the unknown import '{}'", entity.name, request.type));
    d.resource = entity.name;
    d.hint = hintForImport(request.type, types);
    return false;
  }
  bool good = checkArgumentNames(model, entity, *type, given);
  if (!evaluateArguments(model, entity, *type, given, good, request)) return false;
  const ImportFacts facts = model.registry.factsOf ? model.registry.factsOf(request) : ImportFacts{};
  for (const base::Diagnostic& problem : facts.problems) {
    base::Diagnostic& d = model.diagnostics.add(placedAtArgument(model, *entity.scope, given, problem));
    d.resource = entity.name;
    // When a file may not be read, what matters is who names it.
    if (d.code == Code::outsideConfinement && d.place.line == 0 && entity.desc) d.place = entity.desc->place;
    if (!isKnown(d.place) && entity.desc) d.place = entity.desc->place;  // of the arguments
    good = good && problem.severity != base::Severity::error;
  }
  if (good) takeFacts(model, entity, *type, request, facts);
  return good;
}

const ImportType* findImportType(const Registry& registry, std::string_view name) {
  for (const ImportType& type : registry.imports)
    if (type.name == name) return &type;
  return nullptr;
}

std::uint32_t internImport(Model& model, ImportRequest request, ImportKind kind, const std::string& name) {
  auto& imports = model.graph.imports;
  const std::uint64_t key = keyOf(request);
  const auto [known, fresh] = model.importIndex.try_emplace(key, static_cast<std::uint32_t>(imports.size()));
  if (!fresh) return known->second;
  const ImportType* type = findImportType(model.registry, request.type);
  imports.push_back({.request = std::move(request),
                     .key = key,
                     .kind = kind,
                     .name = name,
                     .columns = type ? type->columns : std::vector<TableColumn>{},
                     .standIns = {}});
  model.importResource.push_back(kNone);
  return static_cast<std::uint32_t>(imports.size() - 1);
}

// ---- textures and buffers ----

namespace {

// A clear or first value: a number or a list.
Value evaluateTexel(Names& names, const Expr& expr, const std::string& name, const char* what) {
  if (!expr.present()) return {};
  Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type == Value::Type::symbol) {
    auto& d = names.model().diagnostics.error(Code::wrongValueType, expr.place(),
                                              fmt::format("the {} value of '{}' is a word", what, name));
    d.expected = "a number or a list of numbers";
    d.found = value.symbol;
    d.hint = value.symbol == "white"         ? "write [1, 1, 1, 1]"
             : value.symbol == "transparent" ? "write 0"
                                             : "write the channels, such as [0, 0, 0, 1] for black";
    return {};
  }
  return value;
}

bool rangeError(Model& model, const Expr& expr, const std::string& what, const std::string& expected,
                double found) {
  auto& d = model.diagnostics.error(Code::numberOutOfRange, expr.place(), what + " is out of its range");
  d.expected = expected;
  d.found = numberText(found);
  return false;
}

bool contradiction(Model& model, const Entity& entity, const Place& place, std::string message,
                   std::string expected) {
  auto& d = model.diagnostics.error(Code::contradictoryTexture, place,
                                    fmt::format("texture '{}': {}", entity.name, message));
  d.resource = entity.name;
  d.expected = std::move(expected);
  return false;
}

// `side`, of a size, is less than 1 or more than `limit`.
std::string hintForSide(const Expr& size, double side, std::uint32_t limit) {
  if (size.isConstant())
    return side > 0 && side < 1 ? fmt::format("write 'screen*{}' for a part of the screen", numberText(side))
                                : std::string();
  const std::string text = size.text().size() <= 60 ? size.text() : std::string();
  const std::string given = text.empty() || text.starts_with('[') ? "…" : text;
  return side < 1
             ? fmt::format("it is computed: write 'max({}, 1)', or change what it depends on", given)
             : fmt::format("it is computed: write 'min({}, {})', or change what it depends on", given, limit);
}

bool evaluateSize(Model& model, Names& names, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  if (!desc.size.present())
    return contradiction(model, entity, desc.place, "has no size",
                         "\"size\": \"screen\", a number or a list");
  Value value = desc.size.evaluate(names, model.diagnostics);
  if (value.type == Value::Type::none) return false;
  if (value.isNumeric()) {
    value.v[1] = value.v[0];
    value.count = 2;
  } else if (value.type != Value::Type::list || value.count < 2 || value.count > 3) {
    auto& d = model.diagnostics.error(Code::wrongValueType, desc.size.place(),
                                      fmt::format("the size of '{}' is no size", entity.name));
    d.expected = "\"screen\", \"screen/2\", \"size(x)\", a number, or a list of 2 or 3 numbers";
    d.found = toText(value);
    d.hint = hintForWord(names, value);
    if (value.type == Value::Type::symbol && names.scope().resources.contains(value.symbol))
      d.hint = fmt::format("write 'size({})'", value.symbol);
    if (value.symbol == "full") d.hint = "write 'screen'";
    if (value.symbol == "half") d.hint = "write 'screen/2'";
    if (value.symbol == "quarter") d.hint = "write 'screen/4'";
    d.resource = entity.name;
    return false;
  }
  const std::uint32_t limit = value.count == 3 ? kMaxSize3d : kMaxSize;
  for (std::size_t i = 0; i < value.count; ++i) {
    // 0 is a mistake, but for an empty list; what is computed between 0 and 1 is 1.
    const bool low = value.v[i] < 0 || (value.v[i] < 1 && desc.size.isConstant()) ||
                     (value.v[i] == 0 && !countsElements(model, names.scope(), desc.size));
    if (!std::isfinite(value.v[i]) || low || value.v[i] > limit) {
      auto& d = model.diagnostics.error(Code::numberOutOfRange, desc.size.place(),
                                        fmt::format("the size of '{}' is out of its range", entity.name));
      d.resource = entity.name;
      d.expected = fmt::format("1 to {} texels a side", limit);
      d.found = numberText(value.v[i]);
      d.hint = hintForSide(desc.size, value.v[i], limit);
      return false;
    }
  }
  const auto side = [&](std::size_t i) {
    return static_cast<std::uint32_t>(std::max(1.0, std::floor(value.v[i])));
  };
  entity.shape.width = side(0);
  entity.shape.height = side(1);
  entity.shape.depth = value.count == 3 ? side(2) : 1;
  if (value.count == 3) entity.shape.target = Target::texture_3d;
  return true;
}

// The target from "view", the size, "layers" and "samples"; entity.shape.layers holds the layers as written.
bool decideTarget(Model& model, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  FlatResource& shape = entity.shape;
  const bool volume = shape.target == Target::texture_3d, layered = desc.layers.present();
  if (!desc.view.empty() && volume != (desc.view == "3d"))
    return contradiction(model, entity, desc.viewPlace,
                         fmt::format("view '{}' with a size of {} numbers", desc.view, volume ? 3 : 2),
                         "3 numbers for a 3d texture, 2 for the others");
  if (volume && layered)
    return contradiction(model, entity, desc.layers.place(), "a 3d texture has no layers",
                         "a size of 3 numbers, or layers");
  const bool cube = desc.view == "cube" || desc.view == "cube_array";
  if (cube && shape.width != shape.height)
    return contradiction(model, entity, desc.size.place(),
                         fmt::format("a cube of {}x{} texels", shape.width, shape.height),
                         "faces as wide as high");
  if (desc.view == "cube" && shape.layers > 1)
    return contradiction(model, entity, desc.layers.place(),
                         fmt::format("a cube with {} layers", shape.layers), "\"view\": \"cube_array\"");
  if (shape.samples > 1) {
    if (volume || layered || cube || desc.view == "2d_array")
      return contradiction(model, entity, desc.samples.place(),
                           "several samples in a texture that is not plain 2d", "no layers, cube or 3d");
    if (desc.fullMips || shape.mips > 1)
      return contradiction(model, entity, desc.samples.place(), "several samples and several levels",
                           "\"mips\": 1");
    shape.target = Target::texture_2d_multisample;
  }
  if (cube) {
    shape.target = desc.view == "cube" ? Target::texture_cube : Target::texture_cube_array;
    if (shape.layers * 6u > kMaxLayers)
      return rangeError(model, desc.layers, fmt::format("the layers of '{}'", entity.name),
                        fmt::format("0 to {} cubes", kMaxLayers / 6), shape.layers);
    shape.layers = static_cast<std::uint16_t>(shape.layers * 6);
  } else if (layered || desc.view == "2d_array") {
    shape.target = Target::texture_2d_array;
  }
  return true;
}

bool evaluateTexture(Model& model, Names& names, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  FlatResource& shape = entity.shape;
  bool good = true;
  if (const auto format = findFormat(desc.format)) {
    shape.format = *format;
  } else {
    auto& d = model.diagnostics.error(
        Code::unknownFormat, desc.formatPlace,
        fmt::format("texture '{}' has the unknown format '{}'", entity.name, desc.format));
    d.resource = entity.name;
    const std::string meant = base::formatMeantBy(desc.format);
    d.hint =
        findFormat(meant) ? fmt::format("write '{}'", meant) : base::nearestHint(desc.format, formatNames());
    if (d.hint.empty())
      d.hint = "channels, bits and kind: r8, rg16f, rgba16f, rgba32ui, srgb8_a8, depth32f, …";
    // What is meant, so that nothing else is reported because of it.
    const auto nearest =
        findFormat(findFormat(meant) ? meant : base::nearestName(desc.format, formatNames()));
    if (nearest)
      shape.format = *nearest;
    else
      good = false;
  }
  good = evaluateSize(model, names, entity) && good;
  const auto mips = evaluateWhole(names, desc.mips, 1, 1, kMaxMips, "the number of mips", true);
  const auto layers = evaluateWhole(names, desc.layers, 1, 0, kMaxLayers, "the number of layers", true);
  const auto samples = evaluateWhole(names, desc.samples, 1, 1, 32, "the number of samples");
  if (!mips || !layers || !samples) return false;
  if ((*samples & (*samples - 1)) != 0) {
    rangeError(model, desc.samples, fmt::format("the number of samples of '{}'", entity.name),
               "1, 2, 4, 8, 16 or 32", static_cast<double>(*samples));
    return false;
  }
  if (!good) return false;
  shape.samples = static_cast<std::uint8_t>(*samples);
  shape.layers = static_cast<std::uint16_t>(std::max<std::int64_t>(1, *layers));
  std::uint16_t full = 1;
  for (std::uint32_t side = std::max({shape.width, shape.height, shape.depth}); side > 1; side /= 2) ++full;
  shape.mips = desc.fullMips ? full : static_cast<std::uint16_t>(std::min<std::int64_t>(*mips, full));
  entity.writtenMips = desc.fullMips ? full : static_cast<std::uint16_t>(*mips);
  if (!decideTarget(model, entity)) return false;
  for (std::uint16_t level = 0; level < shape.mips; ++level)
    shape.bytes += static_cast<std::uint64_t>(std::max(1u, shape.width >> level)) *
                   std::max(1u, shape.height >> level) * std::max(1u, shape.depth >> level) * shape.layers *
                   shape.samples * infoOf(shape.format).bytes;
  return true;
}

bool evaluateBuffer(Model& model, Names& names, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  entity.shape.kind = ResourceKind::buffer;
  const std::optional<double> bytes = evaluateNumber(names, desc.bytes, 0, "the size of a buffer");
  if (!bytes) return false;
  const bool low = *bytes < 0 || (*bytes < 1 && desc.bytes.isConstant());
  if (low || *bytes > static_cast<double>(kMaxBufferBytes)) {
    rangeError(model, desc.bytes, fmt::format("the size of buffer '{}'", entity.name),
               fmt::format("1 to {} bytes", kMaxBufferBytes), *bytes);
    return false;
  }
  entity.shape.bytes = static_cast<std::uint64_t>(std::max(1.0, std::floor(*bytes)));
  return true;
}

// What `desc`, of the resource itself or of an input that stands for it, says of the time before the first publication.
void takeFirst(Model& model, Entity& entity, const ResourceDesc& desc, Scope& scope) {
  Names names(model, scope);
  if (desc.firstRef) {
    markStructural(model, scope, *desc.firstRef);
    entity.firstRef = &*desc.firstRef;
    entity.firstScope = &scope;
  } else {
    entity.first = evaluateTexel(names, desc.first, entity.name, "first");
  }
}

bool evaluateDeclared(Model& model, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  Names names(model, *entity.scope);
  for (const Expr* expr :
       {&desc.size, &desc.mips, &desc.layers, &desc.array, &desc.samples, &desc.bytes, &desc.history})
    markStructural(model, *entity.scope, *expr);
  for (const Expr* expr : {&desc.clear, &desc.first}) markStructural(model, *entity.scope, *expr);
  const bool shaped = entity.kind == ResourceDesc::Kind::texture ? evaluateTexture(model, names, entity)
                                                                 : evaluateBuffer(model, names, entity);
  const auto array = evaluateWhole(names, desc.array, 0, 1, kMaxArray, "the array size");
  const auto depth = evaluateWhole(names, desc.history, 0, 0, kMaxHistory, "the history");
  const std::size_t before = model.diagnostics.errorCount();
  entity.clear = evaluateTexel(names, desc.clear, entity.name, "clear");
  takeFirst(model, entity, desc, *entity.scope);
  if (!shaped || !array || !depth || model.diagnostics.errorCount() > before) return false;
  entity.arrayCount = static_cast<std::uint32_t>(*array);
  entity.depth = static_cast<std::uint32_t>(*depth);
  entity.shape.hasClear = entity.clear.type != Value::Type::none;
  entity.elements.resize(std::max(1u, entity.arrayCount));
  return true;
}

}  // namespace

bool ensureShape(Model& model, std::uint32_t index) {
  Entity& entity = model.entities[index];
  if (entity.state == Progress::done) return true;
  if (entity.state == Progress::failed) return false;
  std::string label = "'" + entity.name + "'";
  if (entity.state == Progress::active) {
    auto& d =
        reportCycle(model, entity.desc ? entity.desc->place : Place{},
                    fmt::format("the size of {} depends on itself: {}", label, cyclePath(model, label)));
    d.resource = entity.name;
    entity.state = Progress::failed;
    return false;
  }
  const Descent descent(model, entity.desc ? entity.desc->place : Place{}, entity.name);
  if (!descent.good()) {
    entity.state = Progress::failed;
    return false;
  }
  entity.state = Progress::active;
  model.evaluating.push_back(std::move(label));
  const bool good = entity.kind == ResourceDesc::Kind::import ? evaluateImport(model, entity)
                                                              : evaluateDeclared(model, entity);
  model.evaluating.pop_back();
  // A cycle met on the way has failed it already.
  entity.state = good && entity.state == Progress::active ? Progress::done : Progress::failed;
  return entity.state == Progress::done;
}

namespace {

// `input` wants `depth` publications of what is bound to it; of a list, of each that it may mean. `seen`: each counts once.
void deepen(Model& model, std::uint32_t target, std::uint32_t input, std::uint32_t depth,
            std::set<std::uint32_t>& seen) {
  if (!seen.insert(target).second) return;
  Entity& entity = model.entities[target];
  if (entity.kind == ResourceDesc::Kind::alternatives) {
    for (std::size_t i = 0; i < entity.candidates.size(); ++i)
      if (entity.candidates[i] != kNone && entity.desc->alternatives[i].history == 0)
        deepen(model, entity.candidates[i], input, depth, seen);
    return;
  }
  const bool own = entity.kind == ResourceDesc::Kind::texture || entity.kind == ResourceDesc::Kind::buffer;
  if (!own || !ensureShape(model, target)) return;
  entity.depth = std::max(entity.depth, depth);
  entity.inputs.push_back(input);
  const Entity& wish = model.entities[input];
  if (entity.first.type == Value::Type::none && !entity.firstRef)
    takeFirst(model, entity, *wish.desc, *wish.scope);
}

}  // namespace

void takeInputHistories(Model& model) {
  for (std::uint32_t i = 0; i < model.entities.size(); ++i) {
    Entity& entity = model.entities[i];
    if (entity.kind != ResourceDesc::Kind::input || !entity.desc->history.present() || entity.bound == kNone)
      continue;
    Names names(model, *entity.scope);
    markStructural(model, *entity.scope, entity.desc->history);
    markStructural(model, *entity.scope, entity.desc->first);
    const auto depth = evaluateWhole(names, entity.desc->history, 0, 0, kMaxHistory, "the history");
    entity.badHistory = !depth;
    std::set<std::uint32_t> seen;
    if (depth && *depth > 0) deepen(model, entity.bound, i, static_cast<std::uint32_t>(*depth), seen);
  }
}

std::uint32_t staticTarget(Model& model, std::uint32_t index, std::uint32_t* mip) {
  Entity& entity = model.entities[index];
  if (entity.kind == ResourceDesc::Kind::import)
    return ensureShape(model, index) && entity.exists ? index : kNone;
  if (entity.kind != ResourceDesc::Kind::alternatives) return index;
  if (entity.listState == Progress::active) return kNone;  // its own condition asks for its size
  const Descent descent(model, entity.desc->place, entity.name);
  if (!descent.good()) return kNone;
  const Progress before = std::exchange(entity.listState, Progress::active);
  std::uint32_t result = kNone;
  Names names(model, *entity.scope);
  for (std::size_t i = 0; i < entity.candidates.size() && result == kNone; ++i) {
    if (entity.candidates[i] == kNone) continue;
    const RefDesc& ref = entity.desc->alternatives[i];
    const auto holds = evaluateCondition(names, ref.condition, true, "the condition of an alternative");
    if (!holds || !*holds) continue;
    result = staticTarget(model, entity.candidates[i], mip);
    if (result != kNone && mip && ref.mip && ref.mip->first.present())
      *mip = static_cast<std::uint32_t>(
          evaluateWhole(names, ref.mip->first, 0, 0, kMaxMips, "a level").value_or(0));
  }
  entity.listState = before;
  return result;
}

}  // namespace weft::graph::expansion
