// Shapes of textures, buffers and imports, and their versions. Declared in names.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>

#include "engine/graph/expand/names/names.h"
#include "engine/graph/subresource.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

// ---- imports: their arguments, and what the registry says of them ----

std::string hintForImport(const Registry& registry, std::string_view name) {
  for (const char* kind : {"value", "import_type"})
    if (std::string foreign = text::hintForForeign(kind, name); !foreign.empty()) return foreign;
  const std::vector<std::string> types = namesOf(registry.imports);
  std::string hint = text::nearestHint(name, types);
  return hint.empty() ? fmt::format("imports are {}", fmt::join(types, ", ")) : hint;
}

namespace {

bool checkArgument(Model& model, const Entity& entity, const ImportArgument& argument, const NamedExpr& given,
                   const Value& value) {
  const Value& initial = argument.initial;
  const auto& words = argument.drawList ? model.registry.drawLists : argument.choices;
  const bool numeric = initial.isNumeric(), word = value.type == Value::Type::symbol;
  const bool fits = argument.view    ? value.type == initial.type && value.symbol.empty()
                    : !words.empty() ? word && std::ranges::find(words, value.symbol) != words.end()
                    : numeric        ? value.isNumeric()
                    : initial.type == Value::Type::none
                        ? true
                        : initial.type == value.type && initial.count == value.count;
  if (fits) return true;
  const std::string expected = argument.view    ? "a view that the graph declares"
                               : !words.empty() ? fmt::format("one of {}", fmt::join(words, ", "))
                               : numeric        ? "a number"
                                                : fmt::format("a value like {}", toText(initial));
  using Misfit = text::SentenceFor<std::string, std::string, std::string, std::string, std::string>;
  return reportChecked(
      model, word && argument.drawList ? Misfit(say::argumentOfUnknownList) : say::argumentDoesNotFit,
      given.expr.place(), entity.name, argument.name, expected, toText(value),
      text::nearestHint(value.symbol, words));
}

// The import that the word of an argument names.
std::uint32_t findNamed(Model& model, Scope& scope, const ImportArgument& argument, const Value& value) {
  if (argument.view && value.symbol.empty()) return findFileView(model, scope);
  if (!argument.view && !argument.drawList) return kNone;
  return findDeclared(model, scope, value.symbol, argument.view ? ImportKind::view : ImportKind::list);
}

// Fills in what is asked for, with the defaults of what is not given. False after a report.
bool evaluateArguments(Model& model, const Entity& entity, const ImportType& type,
                       const std::vector<NamedExpr>& given, ImportRequest& request) {
  Names names(model, *entity.scope);
  bool good = true;
  // What an include binds to it says what the file leaves out.
  const std::uint32_t bound = entity.desc ? findBoundImport(model, *entity.scope, entity.desc->name) : kNone;
  const bool shaped = bound != kNone && ensureShape(model, bound);
  const ImportRequest* base = shaped ? &model.graph.imports[model.entities[bound].import].request : nullptr;
  if (base && base->type != type.name) base = nullptr;  // reported
  for (const NamedExpr& argument : given)
    if (!findNamed(type.arguments, argument.name))
      good = report(model, say::unknownArgument, argument.place, type.name, argument.name,
                    text::nearestHint(argument.name, namesOf(type.arguments)), entity.name);
  for (const ImportArgument& argument : type.arguments) {
    const NamedExpr* const says = findNamed(given, argument.name);
    Value value = base ? base->at(argument.name) : argument.initial;
    if (says) value = says->expr.evaluate(names, model.diagnostics);
    const ImportRequest* named = !says && base ? base->named(argument.name) : nullptr;
    if (const std::uint32_t other = named ? kNone : findNamed(model, *entity.scope, argument, value);
        other != kNone) {
      good = ensureShape(model, other) && good;
      if (good) named = &model.graph.imports[model.entities[other].import].request;
    } else if (says) {
      good = value.type != Value::Type::none && checkArgument(model, entity, argument, *says, value) && good;
    } else if (value.type == Value::Type::none && good) {
      good = report(model, say::missingArgument, entity.desc ? entity.desc->place : Place{}, type.name,
                    argument.name);
    }
    if (named) request.of.emplace_back(argument.name, *named);
    request.arguments.emplace_back(argument.name, std::move(value));
  }
  return good;
}

// The index of an import in FlatGraph::imports; equal requests share one.
std::uint32_t internImport(Model& model, ImportRequest request, const ImportType& type, const Entity& entity,
                           const ImportFacts& facts) {
  auto& imports = model.graph.imports;
  const std::uint64_t key = keyOf(request);
  const auto known = std::ranges::find(imports, key, &ImportSpec::key);
  const auto index = static_cast<std::uint32_t>(known - imports.begin());
  if (known == imports.end()) {
    imports.push_back({.request = std::move(request),
                       .key = key,
                       .kind = type.kind,
                       .name = entity.name,
                       .columns = type.kind == ImportKind::buffer ? type.columns : std::vector<TableColumn>(),
                       .standIns = {}});
    model.importResource.push_back(kNone);
  }
  ImportSpec& spec = imports[index];
  spec.count = facts.count;
  spec.changing = facts.changing;
  if (!facts.exists) spec.fallback = facts.fallback;
  if (!spec.place.file && entity.desc) spec.place = entity.desc->place;
  return index;
}

void takeFacts(Model& model, Entity& entity, const ImportType& type, const ImportRequest& request,
               const ImportFacts& facts) {
  entity.exists = facts.exists;
  entity.fallback = !facts.fallback.empty();
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
    const std::uint32_t import = internImport(model, std::move(one), type, entity, facts);
    if (element == 0) entity.import = import;
    assert(import == entity.import + element);
  }
  shape.import = entity.import;
}

// Where somebody wrote the name of the file that a problem of an import is about: the "set" of a preset, the command line, the
// default of a parameter, or the argument itself. The problem's own place when it has a line, or nobody wrote it.
Where placeAtArgument(Model& model, Scope& scope, const std::vector<NamedExpr>& arguments,
                      const text::Diagnostic& problem) {
  if (!problem.place.file || problem.place.line != 0) return problem.place;
  for (const NamedExpr& argument : arguments) {
    Names names(model, scope);
    text::Diagnostics said;  // by whoever evaluated it for the import
    const Value value = argument.expr.evaluate(names, said);
    const bool named = value.type == Value::Type::symbol && value.symbol == *problem.place.file;
    Where place = named ? Where(argument.expr.place()) : Where();
    for (const std::string& name : argument.expr.variables())
      if (const Variable variable = findVariable(model, scope, name);
          variable.kind == Variable::Kind::parameter) {
        const Parameter& parameter = model.parameters[variable.index];
        const bool file =
            parameter.desc->type == ParameterDesc::Type::file;  // perhaps of a sequence with that picture
        if (parameter.value == value && (named || file) && isKnown(parameter.valuePlace))
          place = parameter.valuePlace;
      }
    if (isKnown(place)) return place;
  }
  return problem.place;
}

bool evaluateImport(Model& model, Entity& entity) {
  static const std::vector<NamedExpr> kNoArguments;
  const std::vector<NamedExpr>& given = entity.desc ? entity.desc->import.arguments : kNoArguments;
  ImportRequest request{.type = entity.desc ? entity.desc->import.type
                                            : entity.name.substr(entity.scope->prefix.size() + 1)};
  const ImportType* type = findNamed(model.registry.imports, request.type);
  if (!type)
    return report(model, say::resourceOfUnknownImport, entity.desc->place, entity.name, request.type,
                  hintForImport(model.registry, request.type));
  if (!evaluateArguments(model, entity, *type, given, request)) return false;
  bool good = true;
  const ImportFacts facts = model.registry.factsOf ? model.registry.factsOf(request) : ImportFacts{};
  for (const text::Diagnostic& problem : facts.problems) {
    text::Diagnostic& d = model.diagnostics.add(problem);
    d.place = placeAtArgument(model, *entity.scope, given, problem);
    d.resource = entity.name;
    // Of the arguments; or a file that may not be read, where what matters is who names it.
    const bool confined = d.code == Code::outsideConfinement && d.place.line == 0;
    if (entity.desc && (confined || !isKnown(d.place))) d.place = entity.desc->place;
    good = good && problem.severity != text::Severity::error;
  }
  if (good) takeFacts(model, entity, *type, request, facts);
  return good;
}

// ---- textures and buffers ----

// A clear or first value: a number or a list.
Value evaluateTexel(Names& names, const Expr& expr, const std::string& name, const char* what) {
  if (!expr.present()) return {};
  Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type != Value::Type::symbol) return value;
  report(names.model(), say::texelIsWord, expr.place(), what, name, value.symbol);
  return {};
}

bool evaluateSize(Names& names, Entity& entity) {
  constexpr std::uint64_t kBounds[] = {kMaxSize, kMaxSize, kMaxSize3d};
  const auto size =
      evaluateCounts(names, entity.desc->size, kBounds, fmt::format("the size of '{}'", entity.name),
                     "\"screen\", \"screen/2\", \"size(x)\", a number, or a list of 2 or 3 numbers");
  if (!size) return false;
  entity.shape.width = static_cast<std::uint32_t>(size->each[0]);
  entity.shape.height = static_cast<std::uint32_t>(size->each[size->size > 1 ? 1 : 0]);
  entity.shape.depth = static_cast<std::uint32_t>(size->each[2]);
  if (size->size == 3) entity.shape.target = Target::texture_3d;
  return true;
}

// The target from "view", the size, "layers" and "samples"; entity.shape.layers holds the layers as written.
bool decideTarget(Model& model, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  FlatResource& shape = entity.shape;
  const bool volume = shape.target == Target::texture_3d, layered = desc.layers.present();
  const bool cube = desc.view == "cube" || desc.view == "cube_array", several = shape.samples > 1;
  // What cannot be together; the first is told.
  const struct {
    bool broken;
    const Place& place;
    text::SentenceFor<std::string> what;
  } rules[] = {{!desc.view.empty() && volume != (desc.view == "3d"), desc.viewPlace, say::viewMisfitsSize},
               {volume && layered, desc.layers.place(), say::layersOfVolume},
               {cube && shape.width != shape.height, desc.size.place(), say::oblongCube},
               {desc.view == "cube" && shape.layers > 1, desc.layers.place(), say::layersOfCube},
               {several && (volume || layered || cube || desc.view == "2d_array"), desc.samples.place(),
                say::samplesNotFlat},
               {several && (desc.fullMips || shape.mips > 1), desc.samples.place(), say::samplesAndLevels},
               {(shape.samples & (shape.samples - 1)) != 0, desc.samples.place(), say::samplesOutOfRange},
               {cube && shape.layers * 6u > kMaxLayers, desc.layers.place(), say::tooManyCubes}};
  for (const auto& [broken, place, what] : rules)
    if (broken) return reportChecked(model, what, place, entity.name);
  if (several) shape.target = Target::texture_2d_multisample;
  if (cube) {
    shape.target = desc.view == "cube" ? Target::texture_cube : Target::texture_cube_array;
    shape.layers = static_cast<std::uint16_t>(shape.layers * 6);
  } else if (layered || desc.view == "2d_array") {
    shape.target = Target::texture_2d_array;
  }
  return true;
}

bool evaluateFormat(Model& model, Names& names, Entity& entity) {
  const Expr& said = entity.desc->format;
  const Value value = said.evaluate(names, model.diagnostics);
  if (value.type == Value::Type::none) return false;
  const std::string name = toText(value);
  const auto format = findFormat(name);
  if (format) entity.shape.format = *format;
  const std::string meant = format ? "" : text::hintForForeign("format", name);
  return format || report(model, say::unknownFormat, said.place(), entity.name, name,
                          findFormat(meant) ? fmt::format("write '{}'", meant)
                                            : text::nearestHint(name, formatNames()));
}

bool evaluateTexture(Model& model, Names& names, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  FlatResource& shape = entity.shape;
  bool good = evaluateFormat(model, names, entity);
  good = evaluateSize(names, entity) && good;
  const auto mips = evaluateWhole(names, desc.mips, 1, 1, kMaxMips, "the number of mips", true);
  const auto layers = evaluateWhole(names, desc.layers, 1, 0, kMaxLayers, "the number of layers", true);
  const auto samples = evaluateWhole(names, desc.samples, 1, 1, 32, "the number of samples");
  if (!mips || !layers || !samples) return false;
  if (!good) return false;
  shape.samples = static_cast<std::uint8_t>(*samples);
  shape.layers = static_cast<std::uint16_t>(std::max<std::int64_t>(1, *layers));
  std::uint16_t full = 1;
  for (std::uint32_t side = std::max({shape.width, shape.height, shape.depth}); side > 1; side /= 2) ++full;
  entity.writtenMips = desc.fullMips ? full : static_cast<std::uint16_t>(*mips);
  shape.mips = std::min(entity.writtenMips, full);
  if (!decideTarget(model, entity)) return false;
  for (std::uint16_t level = 0; level < shape.mips; ++level) {
    const auto [width, height, depth] = sizeAt(shape, level);
    shape.bytes +=
        std::uint64_t{width} * height * depth * shape.layers * shape.samples * infoOf(shape.format).bytes;
  }
  return true;
}

bool evaluateBuffer(Names& names, Entity& entity) {
  entity.shape.kind = ResourceKind::buffer;
  const auto bytes = evaluateCounts(names, entity.desc->bytes, {&kMaxBufferBytes, 1},
                                    fmt::format("the size of '{}'", entity.name), "a number of bytes");
  if (bytes) entity.shape.bytes = bytes->each[0];
  return bytes.has_value();
}

// What `desc`, of the resource itself or of an input that stands for it, says of the time before the first publication.
void takeFirst(Model& model, Entity& entity, const ResourceDesc& desc, Scope& scope) {
  Names names(model, scope);
  if (desc.firstRef) {
    entity.firstRef = &*desc.firstRef;
    entity.firstScope = &scope;
  } else {
    entity.first = evaluateTexel(names, desc.first, entity.name, "first");
  }
}

bool evaluateDeclared(Model& model, Entity& entity) {
  const ResourceDesc& desc = *entity.desc;
  Names names(model, *entity.scope);
  const bool shaped = entity.kind == ResourceDesc::Kind::texture ? evaluateTexture(model, names, entity)
                                                                 : evaluateBuffer(names, entity);
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
  const Evaluation evaluation(model, entity.state, "'" + entity.name + "'",
                              entity.desc ? entity.desc->place : Place{});
  if (!evaluation.good()) return false;
  const bool good = entity.kind == ResourceDesc::Kind::import ? evaluateImport(model, entity)
                                                              : evaluateDeclared(model, entity);
  // A cycle met on the way has failed it already.
  entity.state = good && entity.state == Progress::active ? Progress::done : Progress::failed;
  return entity.state == Progress::done;
}

namespace {

// `input` wants `depth` publications of what is bound to it; of a list, of each that it may mean.
void deepen(Model& model, std::uint32_t target, std::uint32_t input, std::uint32_t depth) {
  Entity& entity = model.entities[target];
  for (std::size_t i = 0; i < entity.candidates.size(); ++i)
    if (entity.candidates[i] != kNone && entity.desc->alternatives[i].history == 0)
      deepen(model, entity.candidates[i], input, depth);
  if (!entity.isOwn() || std::ranges::find(entity.inputs, input) != entity.inputs.end() ||
      !ensureShape(model, target))
    return;
  entity.depth = std::max(entity.depth, depth);
  entity.inputs.push_back(input);
  const Entity& wish = model.entities[input];
  if (entity.first.type == Value::Type::none && !entity.firstRef)
    takeFirst(model, entity, *wish.desc, *wish.scope);
}

}  // namespace

void takeInputHistories(Model& model) {
  for (std::uint32_t i = 0; i < model.entities.size(); ++i) {
    const Entity& entity = model.entities[i];
    if (entity.kind != ResourceDesc::Kind::input || !entity.desc->history.present() || entity.bound == kNone)
      continue;
    Names names(model, *entity.scope);
    const auto depth = evaluateWhole(names, entity.desc->history, 0, 0, kMaxHistory, "the history");
    const auto wanted =
        static_cast<std::uint32_t>(depth.value_or(kMaxHistory));  // long enough after a report
    if (wanted > 0) deepen(model, entity.bound, i, wanted);
  }
}

std::uint32_t staticTarget(Model& model, std::uint32_t index, std::uint32_t* mip) {
  Entity& entity = model.entities[index];
  if (entity.kind == ResourceDesc::Kind::import)
    return ensureShape(model, index) && entity.exists ? index : kNone;
  if (entity.kind != ResourceDesc::Kind::alternatives) return index;
  const Progress before = entity.state;
  if (before == Progress::active) return kNone;  // its own condition asks for its size
  const Evaluation evaluation(model, entity.state, "'" + entity.name + "'", entity.desc->place);
  if (!evaluation.good()) return kNone;
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
  entity.state = before;
  return result;
}

// ---- versions ----

namespace {

std::uint32_t addResource(Model& model, std::uint32_t index, std::uint32_t element, bool covers = true) {
  Entity& entity = model.entities[index];
  Element& e = entity.elements[element];
  const auto resource = static_cast<std::uint32_t>(model.graph.resources.size());
  ++e.count;
  model.graph.resources.push_back(entity.shape);
  model.elementOf.push_back({index, element});
  model.graph.resourceNames.push_back(entity.name +
                                      (entity.arrayCount > 0 ? fmt::format("[{}]", element) : "") +
                                      (e.count > 1 ? fmt::format("#{}", e.count) : ""));
  model.graph.resourcePlaces.push_back(entity.desc ? entity.desc->place : Place{});
  // Only the first FlatResource has a version zero; the others begin with a write, which mostly covers them.
  if (e.count > 1 && covers) model.graph.resources.back().hasClear = false;
  if (model.graph.resources.back().hasClear) model.graph.clears.push_back({resource, entity.clear});
  e.resource = resource;
  return resource;
}

}  // namespace

std::uint32_t currentResource(Model& model, std::uint32_t index, std::uint32_t element) {
  Entity& entity = model.entities[index];
  if (entity.kind == ResourceDesc::Kind::import) {
    const std::uint32_t import = entity.import + element;
    if (model.importResource[import] == kNone) {
      const std::uint32_t resource = addResource(model, index, element);
      model.graph.resources[resource].import = import;
      model.importResource[import] = resource;
    }
    return model.importResource[import];
  }
  const std::uint32_t current = entity.elements[element].resource;
  return current != kNone ? current : addResource(model, index, element);
}

VersionCheck checkVersion(const Model& model, std::uint32_t index, std::uint32_t element,
                          const FlatUse& rect) {
  const Entity& entity = model.entities[index];
  if (entity.kind == ResourceDesc::Kind::import) return {entity.exists || entity.fallback, entity.exists, 0};
  VersionCheck check;
  const auto see = [&](std::uint32_t writer, std::uint32_t first) {
    if (writer != kNone) {
      check.real = true;
    } else if (!entity.shape.hasClear) {
      check.complete = false;
      check.missing = first;
    }
    return check.complete;
  };
  FlatUse use = rect;
  use.resource = entity.elements[element].resource;
  if (use.resource != kNone)
    model.versions.forEachRun(
        use, [&](std::uint32_t writer, std::uint32_t first, std::uint32_t) { return see(writer, first); });
  else
    forEachSubresource(use, entity.shape, [&](std::uint32_t first) {
      see(kNone, first);
      return false;
    });
  return check;
}

void addUse(Model& model, std::uint32_t index, std::uint32_t element, const FlatUse& use,
            std::uint32_t pass) {
  Entity& entity = model.entities[index];
  VersionLinks& links = model.graph.links;
  const auto at = static_cast<std::uint32_t>(model.graph.uses.size());
  model.graph.uses.push_back(use);
  const bool sees = use.history == 0 && use.access != Access::write;
  if (use.history > 0) model.historyUses.push_back({at, index, element});
  if (sees) model.graph.uses[at].resource = currentResource(model, index, element);
  model.versions.see(at, pass);
  if (!sees || entity.kind == ResourceDesc::Kind::import) return;
  links.forEachRun(links.seen[at], [&](std::uint32_t writer, std::uint32_t) {
    if (writer == kNone) entity.elements[element].zeroUsed = true;
  });
}

std::uint32_t resourceToWrite(Model& model, std::uint32_t index, std::uint32_t element, bool whole,
                              bool covers) {
  Element& e = model.entities[index].elements[element];
  const bool used = e.zeroUsed || (e.resource != kNone && model.versions.isWritten(e.resource));
  if (!whole || !used) return currentResource(model, index, element);
  const std::uint32_t last = e.resource, next = addResource(model, index, element, covers);
  e.zeroUsed = false;
  if (last != kNone) model.versions.replace(last, next);
  return next;
}

void wouldUse(Model& model, WouldUse use) {
  if (model.entities[use.entity].kind == ResourceDesc::Kind::import) return;
  use.position = model.position;
  use.slot = model.slot;
  model.would.push_back(use);
}

void wouldUse(Model& model, std::uint32_t index, Access access, int history) {
  const Entity& entity = model.entities[index];
  for (std::size_t i = 0; i < entity.candidates.size(); ++i)
    if (entity.candidates[i] != kNone)
      wouldUse(model, entity.candidates[i], access, history + entity.desc->alternatives[i].history);
  if (!entity.isOwn() || entity.state != Progress::done) return;
  FlatUse whole = wholeUse(0, entity.shape, Kind::copy, access);
  whole.history = static_cast<std::uint8_t>(history);
  wouldUse(model, {{index, 0, std::max(1u, entity.arrayCount), whole}});
}

}  // namespace weft::graph::expansion
