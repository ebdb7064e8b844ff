#include "engine/graph/expand/names/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/graph/language/keys.h"
#include "engine/graph/subresource.h"
#include "engine/text/json/report.h"
#include "engine/text/limits.h"
#include "engine/text/nearest.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

bool isOver(const Model& model) {
  return model.stopped || enoughErrors(model.diagnostics);
}

void stopAt(Model& model, const Where& place, std::string message, std::uint64_t bound, const char* counts) {
  if (!std::exchange(model.stopped, true))
    text::reportLimit(model.diagnostics, place, std::move(message), bound, counts);
}

Evaluation::Evaluation(Model& model, Progress& state, std::string label, const Place& place, std::size_t most)
    : model_(model), good_(false) {
  auto& stack = model.evaluating;
  if (state == Progress::active) {
    std::string path;
    for (const std::string& each : stack)
      if (each == label || !path.empty()) path += each + " -> ";
    report(model, say::dependsOnItself, place, label, path);
  } else if (stack.size() >= most) {
    if (!std::exchange(model.stopped, true)) report(model, say::definitionsTooDeep, place, label, kMax);
  } else {
    good_ = true;
    stack.push_back(std::move(label));
  }
  state = good_ ? Progress::active : Progress::failed;
}

Evaluation::~Evaluation() {
  if (good_) model_.evaluating.pop_back();
}

namespace {

// What follows imports is not kept: it is a mistake where `user` does not follow them.
std::optional<Value> letValue(Names& user, Let& let) {
  Model& model = user.model();
  if (let.state == Progress::done) return let.value;
  if (let.state == Progress::failed) return Value{};
  const Evaluation evaluation(model, let.state, "$" + let.path, let.desc->place);
  if (!evaluation.good()) return Value{};
  Names names(model, *let.scope);
  names.follows = user.follows;
  names.absent = user.absent;
  let.value = let.desc->expr.evaluate(names, model.diagnostics);
  let.state = let.value.type == Value::Type::none ? Progress::failed
              : let.watched                       ? Progress::fresh
                                                  : Progress::done;
  return let.value;
}

}  // namespace

std::optional<Value> Names::variable(std::string_view name) {
  const Variable found = findVariable(model_, scope_, name);
  if (found.kind == Variable::Kind::none) {
    if (model_.toInclude || isUnread(scope_, name)) return Value{};
    return mendDeclarations(model_) ? variable(name) : std::nullopt;
  }
  if (found.kind == Variable::Kind::parameter) return model_.parameters[found.index].value;
  if (found.kind == Variable::Kind::ambiguous) {
    std::vector<std::string> all;
    for (const std::uint32_t index : parametersMeant(model_, scope_.prefix, name))
      all.push_back("$" + model_.parameters[index].path.substr(scope_.prefix.size()));
    report(model_, say::ambiguousVariable, scope_.desc->place, name, fmt::join(all, ", "));
    return Value{};
  }
  Let& let = model_.lets[found.index];
  if (checking && (let.dynamic || let.watched)) return Value::number(1);
  if (!let.dynamic || let.state == Progress::active) return letValue(*this, let);
  if (!model_.stopped) report(model_, say::ageNeededBeforeFrame, let.desc->place, let.path);
  return Value{};
}

std::optional<Value> Names::index(std::string_view name) {
  for (const Index& index : indices)
    if (index.name == name) return Value::number(index.value);
  return std::nullopt;
}

std::optional<Value> Names::builtin(std::string_view name) {
  if (name == "screen") {
    const auto [width, height] = screenOf(model_, scope_);
    return Value{Value::Type::list, 2, {1.0 * width, 1.0 * height, 0, 0}, {}};
  }
  if (name == "device.software") return Value::boolean(model_.settings.software);
  if (name == "device.window") return Value::boolean(model_.settings.window);
  return std::nullopt;
}

namespace {

// Whether nothing disables the pass or an include around it by name, nor its stanza by a plain `"enabled": false`, which is what the viewer
// writes. An expression is not asked: it could ask back.
bool isLeft(const Scope& from, const Model& model, const PassDesc& pass, const Scope& in) {
  const auto isOff = [](const PassDesc& stanza) {
    return stanza.enabled.isConstant() && stanza.enabled.text() == "false";
  };
  for (const Scope* at = &in; at != &from; at = at->parent)
    if (!at->disabledBy.empty() || isOff(*at->stanza)) return false;
  const auto rules = model.disables.find(in.prefix + pass.name);
  return !isOff(pass) &&
         (rules == model.disables.end() ||
          std::ranges::none_of(rules->second, [](const DisableRule& rule) { return rule.instance.empty(); }));
}

}  // namespace

std::optional<Value> Names::fact(Fact fact, std::string_view resource, std::uint32_t level,
                                 const Place& place) {
  const std::uint32_t index = findAsked(model_, scope_, resource);
  if (index == kNone) {
    if (fact == Fact::has)
      if (const auto [pass, in] = findAskedPass(scope_, resource); pass)
        return Value::boolean(isLeft(scope_, model_, *pass, *in));
    if (mendDeclarations(model_)) return this->fact(fact, resource, level, place);
    // Its declaration, or the input that has nothing behind it, was reported where it stands.
    const bool reported = isUnread(scope_, resource) || scope_.resources.contains(resource);
    return reported ? std::optional(Value{}) : std::nullopt;
  }
  if (fact == Fact::age && ageKey(resource)) return std::nullopt;  // known when the frame runs
  Entity& entity = model_.entities[index];
  if (live && entity.kind != ResourceDesc::Kind::alternatives && entity.state != Progress::done) {
    failed = true;
    return Value{};
  }
  std::uint32_t mip = 0;
  // An import answers for itself even when it has nothing: count() of no lights is 0.
  const bool isImport = entity.kind == ResourceDesc::Kind::import;
  const std::uint32_t target = isImport && fact != Fact::has ? index : staticTarget(model_, index, &mip);
  if (fact == Fact::has) return Value::boolean(target != kNone);
  if (target != kNone) return factOfShape(fact, target, mip, level, place);
  // What an alternative misses was reported where it stands, or may be in an include that could not be read.
  const bool reported =
      entity.scope->broken || std::ranges::find(entity.candidates, kNone) != entity.candidates.end();
  if (!model_.stopped && !reported) report(model_, say::noAlternativeHolds, place, entity.name, nameOf(fact));
  return Value{};
}

std::optional<Value> Names::factOfShape(Fact fact, std::uint32_t target, std::uint32_t mip,
                                        std::uint32_t level, const Place& place) {
  if (!ensureShape(model_, target)) return Value{};
  const Entity& entity = model_.entities[target];
  const FlatResource& shape = entity.shape;
  if (level > 0 && mip + level >= std::max(entity.writtenMips, shape.mips)) {
    report(model_, say::sizeOfMissingLevel, place, mip + level, entity.name,
           std::max(entity.writtenMips, shape.mips) - 1);
    return Value{};
  }
  if (fact == Fact::count && entity.kind == ResourceDesc::Kind::import) return Value::number(entity.count);
  if (fact == Fact::count && entity.arrayCount > 0) return Value::number(entity.arrayCount);
  if (fact == Fact::format && !isBuffer(shape)) return Value::text(infoOf(shape.format).name);
  if (fact == Fact::mips && !isBuffer(shape)) return Value::number(shape.mips);
  if (fact == Fact::size && isBuffer(shape)) return Value::number(static_cast<double>(shape.bytes));
  if (fact == Fact::size) {
    Value size{.type = Value::Type::list, .count = std::uint8_t{2}};
    if (shape.target == Target::texture_3d) size.count = 3;
    std::ranges::copy_n(sizeAt(shape, mip + level).begin(), size.count, size.v.begin());
    return size;
  }
  report(model_, say::hasNoSuchFact, place, entity.name,
         fact == Fact::count ? "an import or an array for count()"
                             : fmt::format("a texture for {}()", nameOf(fact)));
  return Value{};
}

std::vector<std::string> Names::choicesOf(std::string_view variable) {
  Scope* scope = &scope_;
  for (std::size_t hops = 0; hops <= model_.lets.size();
       ++hops) {  // a let may only rename a choice parameter
    const Variable found = findVariable(model_, *scope, variable);
    if (found.kind == Variable::Kind::parameter) return model_.parameters[found.index].desc->choices;
    const Let* const let = found.kind == Variable::Kind::let ? &model_.lets[found.index] : nullptr;
    const std::string* const only = let ? let->desc->expr.onlyVariable() : nullptr;
    if (!only) return {};
    variable = *only;
    scope = let->scope;
  }
  return {};
}

std::vector<std::string> Names::candidates(NameKind kind) {
  if (kind == NameKind::builtin) return {"screen", "device.software", "device.window"};
  std::vector<std::string> names;
  if (kind == NameKind::fact_argument) {
    names = resourceNames(model_, scope_);
    for (const ImportType& type : model_.registry.imports) names.push_back(type.name);
    for (const auto& [pass, stanza] : scope_.passes) names.emplace_back(pass);  // has()
    return names;
  }
  for (Scope* scope = &scope_; scope; scope = scope->parent)
    for (const auto& [name, variable] : scope->variables) names.emplace_back(name);
  for (const Parameter& parameter : model_.parameters)
    if (parameter.path.starts_with(scope_.prefix)) names.push_back(parameter.desc->name);
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::optional<std::uint32_t> Names::ageKey(std::string_view resource) {
  std::uint32_t index = findAsked(model_, scope_, resource);
  if (index != kNone) index = staticTarget(model_, index);
  if (index == kNone || !ensureShape(model_, index)) return std::nullopt;
  return currentResource(model_, index, 0);
}

std::optional<ExprPtr> Names::folded(std::string_view variable, const Place& place) {
  const Variable found = findVariable(model_, scope_, variable);
  if (live && found.kind == Variable::Kind::parameter && !model_.parameters[found.index].structural)
    return Expr::parameter(found.index, place).tree();
  if (found.kind != Variable::Kind::let) return std::nullopt;
  Let& let = model_.lets[found.index];
  if (!let.dynamic && !(live && let.live)) return std::nullopt;
  std::optional<Expr>& kept = live ? let.liveFolded : let.folded;
  if (!kept || let.watched) {
    Progress own = Progress::fresh;
    Progress& state = live ? own : let.state;
    const Evaluation evaluation(model_, state, "$" + let.path, let.desc->place);
    if (live || !evaluation.good()) kept = Expr();  // met again in a circle, it fails
    if (evaluation.good()) {
      text::Diagnostics ignored;  // a branch that is not taken now
      Names names(model_, *let.scope);
      names.live = live;
      names.follows = follows;
      names.absent = absent;
      Expr tree = let.desc->expr.fold(names, live ? ignored : model_.diagnostics);
      if (!names.failed) kept = std::move(tree);
      state = Progress::fresh;
    }
  }
  failed = failed || (live && !kept->present());
  return kept->tree();
}

namespace {

struct FoundValue {
  std::uint32_t entity = kNone, column = 0;
  const ImportType* type = nullptr;  // null: nothing has the name, or its declaration has a mistake
  const TableColumn* told = nullptr;
};

FoundValue findValue(Model& model, Scope& scope, const ImportValue& asked) {
  FoundValue found{.entity = findEntity(model, scope, asked.import, true)};
  if (found.entity == kNone || !ensureShape(model, found.entity)) return found;
  const std::uint32_t import = model.entities[found.entity].import;
  found.type = findNamed(model.registry.imports, model.graph.imports[import].request.type);
  found.told = findNamed(found.type->columns, asked.value);
  if (found.told) found.column = static_cast<std::uint32_t>(found.told - found.type->columns.data());
  return found;
}

// Some value of a type of columns; none for a whole matrix.
Value shapeOf(const TableColumn& column, std::uint8_t part) {
  if (column.type == "mat4" && part == kWholeValue) return {};
  const bool list = column.type.starts_with("vec") || column.type == "mat4";
  if (!list) return Value::number(kTrialAge);
  Value value{Value::Type::list, static_cast<std::uint8_t>(column.type.back() - '0'), {}, {}};
  value.v.fill(kTrialAge);
  return value;
}

}  // namespace

Value Names::importValue(const ImportValue& asked, const Place& place) {
  if (!follows) return report(model_, say::knownWhileRunning, place, asked.import, asked.value), Value{};
  const FoundValue found = findValue(model_, scope_, asked);
  if (found.entity == kNone) {
    const RefDesc ref{.place = place, .name = std::string(asked.import.substr(1)), .import = true};
    findEntityOrReport(model_, scope_, ref, "a parameter", "asks");
    return {};
  }
  if (!found.type) return {};
  if (!found.told) {
    const std::vector<std::string> known = namesOf(found.type->columns);
    report(model_, say::hasNoValue, place, asked.import, asked.value,
           known.empty() ? "an import with values, such as '@camera'"
                         : fmt::format("{}", fmt::join(known, ", ")),
           text::nearestHint(std::string(asked.value), known));
    return {};
  }
  const Entity& entity = model_.entities[found.entity];
  if (!entity.exists && !absent)
    return report(model_, say::importNotThere, place, asked.import, asked.value), Value{};
  if (entity.count > 0 && asked.row >= entity.count && !absent)
    return report(model_, say::hasNoRow, place, asked.import, asked.row, entity.count - 1), Value{};
  Value value = shapeOf(*found.told, asked.part);
  if (value.type == Value::Type::none) report(model_, say::isMatrix, place, asked.import, asked.value);
  return value;
}

std::optional<std::uint32_t> Names::importKey(const ImportValue& asked) {
  if (!live) return std::nullopt;
  const FoundValue found = findValue(model_, scope_, asked);
  const std::uint32_t import = found.told ? model_.entities[found.entity].import : kNone;
  const Value shape = found.told ? shapeOf(*found.told, asked.part) : Value{};
  if (shape.type == Value::Type::none) return std::nullopt;
  auto& watched = model_.graph.watched;
  const auto known = std::ranges::find_if(watched, [&](const WatchedValue& each) {
    return each.import == import && each.row == asked.row && each.column == found.column &&
           each.part == asked.part;
  });
  const auto index = static_cast<std::uint32_t>(known - watched.begin());
  if (known == watched.end()) watched.push_back({import, asked.row, found.column, asked.part, shape});
  return static_cast<std::uint32_t>(model_.parameters.size()) + index;
}

bool isMatrix(Model& model, Scope& scope, const Expr& expr) {
  if (!expr.watched() || expr.root()->op != ExprOp::fact || expr.root()->fact != Fact::value) return false;
  const FoundValue found = findValue(model, scope, {expr.root()->name, expr.root()->value.symbol});
  return found.told && found.told->type == "mat4";
}

namespace {

// nullopt after a report, and without a value.
template <class... Args>
std::nullopt_t refuse(text::Saying<Args...> what, Names& names, const Expr& expr, const Value& found,
                      Args&&... args) {
  auto& d = names.model().diagnostics.error<Args...>(what, expr.place(), std::forward<Args>(args)...);
  d.found = toText(found);
  if (d.hint.empty()) d.hint = hintForWord(names, found);
  return std::nullopt;
}

}  // namespace

std::optional<bool> evaluateCondition(Names& names, const Expr& expr, bool absent, std::string_view what) {
  if (!expr.present()) return absent;
  const Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type == Value::Type::none) return std::nullopt;
  if (value.isNumeric()) return value.truth();
  return refuse(say::noCondition, names, expr, value, what);
}

std::optional<std::int64_t> evaluateWhole(Names& names, const Expr& expr, std::int64_t absent,
                                          std::int64_t low, std::int64_t high, std::string_view what,
                                          bool floors) {
  if (!expr.present()) return absent;
  const Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type == Value::Type::none) return std::nullopt;
  const double number = floors ? std::floor(value.v[0]) : value.v[0];
  const bool whole = value.isNumeric() && std::isfinite(number) && number == std::floor(number);
  if (whole && number >= static_cast<double>(low) && number <= static_cast<double>(high))
    return static_cast<std::int64_t>(number);
  return whole ? refuse(say::wholeOutOfRange, names, expr, value, what, low, high)
               : refuse(say::notWhole, names, expr, value, what, low, high);
}

std::optional<Counts> evaluateCounts(Names& names, const Expr& expr, std::span<const std::uint64_t> bounds,
                                     std::string_view what, const char* expected) {
  const Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type == Value::Type::none) return std::nullopt;
  const bool list = value.type == Value::Type::list;
  if (!value.isNumeric() && (!list || value.count < 2 || value.count > bounds.size()))
    return refuse(
        say::noSize, names, expr, value, what, expected,
        names.scope().resources.contains(value.symbol) ? fmt::format("write 'size({})'", value.symbol) : "");
  Counts counts{.size = list ? value.count : 1u};
  const std::uint64_t bound = bounds[counts.size - 1];
  for (std::size_t i = 0; i < counts.size; ++i) {
    const double count = value.v[i];
    const bool low =
        count < 0 || (expr.isConstant() ? count < 1
                                        : count == 0 && bounds.size() > 1 &&
                                              !countsElements(names.model(), names.scope(), expr));
    if (!std::isfinite(count) || low || count > static_cast<double>(bound))
      return refuse(
          say::sizeOutOfRange, names, expr, value, what, bound,
          expr.isConstant() ? "" : fmt::format("it is computed: write 'max(…, 1)' or 'min(…, {})'", bound));
    counts.each[i] = static_cast<std::uint64_t>(std::max(1.0, std::floor(count)));
  }
  return counts;
}

std::optional<std::array<std::uint32_t, 2>> evaluateSize(Names& names, const Expr& expr, std::uint64_t most,
                                                         std::string_view what) {
  const std::uint64_t bounds[] = {most, most};
  const auto counts =
      evaluateCounts(names, expr, bounds, what, "a number, or a list of 2, such as \"screen/2\"");
  if (!counts) return std::nullopt;
  return std::array{static_cast<std::uint32_t>(counts->each[0]),
                    static_cast<std::uint32_t>(counts->each[counts->size - 1])};
}

std::array<std::uint32_t, 2> screenOf(Model& model, Scope& scope) {
  if (!scope.parent) return {model.settings.screenWidth, model.settings.screenHeight};
  const IncludeDesc& include = *scope.stanza->include;
  if (!include.screen.present()) return screenOf(model, *scope.parent);
  if (scope.screenState == Progress::done || scope.screenState == Progress::failed) return scope.screen;
  const std::string screen = fmt::format("the screen of '{}'", include.as);
  const Evaluation evaluation(model, scope.screenState, screen, include.screen.place());
  if (!evaluation.good()) return scope.screen;
  Names names(model, *scope.parent);
  const auto size = evaluateSize(names, include.screen, kMaxSize, screen);
  if (size) scope.screen = *size;
  scope.screenState = size ? Progress::done : Progress::failed;
  return scope.screen;
}

}  // namespace weft::graph::expansion
