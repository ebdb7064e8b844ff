#include "engine/graph/expand/names/resources.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/expand/names/limits.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

namespace {

// A clear or first value: a number or a list.
Value evaluateTexel(Names& names, const Expr& expr, const Called& what) {
  if (!expr.present()) return {};
  Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type == Value::Type::symbol) {
    auto& d = names.model().diagnostics.error(Code::wrongValueType, expr.place(), what.text() + " is a word");
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
    good = false;
  }
  good = evaluateSize(model, names, entity) && good;
  const auto mips =
      evaluateWhole(names, desc.mips, 1, 1, kMaxMips, {"the number of mips of '{}'", entity.name}, true);
  const auto layers = evaluateWhole(names, desc.layers, 1, 0, kMaxLayers,
                                    {"the number of layers of '{}'", entity.name}, true);
  const auto samples =
      evaluateWhole(names, desc.samples, 1, 1, 32, {"the number of samples of '{}'", entity.name});
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
  const Called what("the size of buffer '{}'", entity.name);
  const std::optional<double> bytes = evaluateNumber(names, desc.bytes, 0, what);
  if (!bytes) return false;
  const bool low = *bytes < 0 || (*bytes < 1 && desc.bytes.isConstant());
  if (low || *bytes > static_cast<double>(kMaxBufferBytes)) {
    rangeError(model, desc.bytes, what.text(), fmt::format("1 to {} bytes", kMaxBufferBytes), *bytes);
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
    entity.first = evaluateTexel(names, desc.first, {"the first value of '{}'", entity.name});
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
  const auto array =
      evaluateWhole(names, desc.array, 0, 1, kMaxArray, {"the array size of '{}'", entity.name});
  const auto depth =
      evaluateWhole(names, desc.history, 0, 0, kMaxHistory, {"the history of '{}'", entity.name});
  const std::size_t before = model.diagnostics.errorCount();
  entity.clear = evaluateTexel(names, desc.clear, {"the clear value of '{}'", entity.name});
  takeFirst(model, entity, desc, *entity.scope);
  if (!shaped || !array || !depth || model.diagnostics.errorCount() > before) return false;
  entity.arrayCount = static_cast<std::uint32_t>(*array);
  entity.depth = static_cast<std::uint32_t>(*depth);
  entity.shape.hasClear = entity.clear.type != Value::Type::none;
  entity.elements.resize(std::max(1u, entity.arrayCount));
  return true;
}

}  // namespace

namespace {

// The greatest height of the expressions that say what the entity is.
int heightOf(const Entity& entity) {
  if (!entity.desc) return 0;
  int height = 0;
  const ResourceDesc& d = *entity.desc;
  for (const Expr* expr :
       {&d.size, &d.mips, &d.layers, &d.array, &d.samples, &d.bytes, &d.history, &d.clear, &d.first})
    height = std::max(height, expr->height());
  for (const NamedExpr& argument : d.import.arguments) height = std::max(height, argument.expr.height());
  return height;
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
  const Descent descent(model, heightOf(entity), entity.desc ? entity.desc->place : Place{}, entity.name);
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
    const auto depth =
        evaluateWhole(names, entity.desc->history, 0, 0, kMaxHistory, {"the history of '{}'", entity.name});
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
  const Descent descent(model, 0, entity.desc->place, entity.name, false);
  if (!descent.good()) return kNone;
  const Progress before = std::exchange(entity.listState, Progress::active);
  std::uint32_t result = kNone;
  Names names(model, *entity.scope);
  for (std::size_t i = 0; i < entity.candidates.size() && result == kNone; ++i) {
    if (entity.candidates[i] == kNone) continue;
    const RefDesc& ref = entity.desc->alternatives[i];
    if (!lookAt(model, costOf(ref), ref.place)) break;
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
