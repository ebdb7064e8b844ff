#include "engine/graph/expand/names/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/scope.h"
#include "engine/graph/expand/names/unread.h"
#include "engine/graph/expand/names/versions.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

namespace {

std::optional<Value> letValue(Model& model, Let& let) {
  if (let.state == Progress::done) return let.value;
  if (let.state == Progress::failed) return Value{};
  std::string label = "$" + let.path;
  if (let.state == Progress::active) {
    reportCycle(model, let.desc->place,
                fmt::format("'{}' depends on itself: {}", label, cyclePath(model, label)));
    let.state = Progress::failed;
    return Value{};
  }
  const Descent descent(model, let.desc->place, label);
  if (!descent.good()) {
    let.state = Progress::failed;
    return Value{};
  }
  let.state = Progress::active;
  model.evaluating.push_back(std::move(label));
  Names names(model, *let.scope);
  let.value = let.desc->expr.evaluate(names, model.diagnostics);
  model.evaluating.pop_back();
  let.state = let.value.type == Value::Type::none ? Progress::failed : Progress::done;
  return let.value;
}

const char* wordFor(const Value& value) {
  switch (value.type) {
    case Value::Type::number:
      return "a number";
    case Value::Type::boolean:
      return "true or false";
    case Value::Type::list:
      return "a list";
    case Value::Type::symbol:
      return "a word";
    case Value::Type::none:
      break;
  }
  return "nothing";
}

}  // namespace

std::optional<Value> Names::variable(std::string_view name) {
  const Variable found = findVariable(model_, scope_, name);
  switch (found.kind) {
    case Variable::Kind::none:
      if (model_.toInclude || mayBeUnread(scope_, name)) return Value{};
      return std::nullopt;
    case Variable::Kind::parameter:
      return model_.parameters[found.index].value;
    case Variable::Kind::ambiguous: {
      std::string all;
      int many = 0;
      const std::string suffix = "." + std::string(name);
      for (const Parameter& parameter : model_.parameters) {
        if (many == 8) break;
        if (!parameter.path.starts_with(scope_.prefix) || !parameter.path.ends_with(suffix)) continue;
        all += (all.empty() ? "$" : ", $") + parameter.path.substr(scope_.prefix.size());
        ++many;
      }
      auto& d = model_.diagnostics.error(
          Code::ambiguousName, {}, fmt::format("'${}' may mean several parameters of included files", name));
      d.place = scope_.desc->place;
      d.hint = "write one of " + all;
      return Value{};
    }
    case Variable::Kind::let:
      break;
  }
  Let& let = model_.lets[found.index];
  if (let.dynamic) {
    if (dynamicAllowed_) return Value::number(1);
    if (model_.stopped) return Value{};
    if (!model_.evaluating.empty() && let.state == Progress::active) return letValue(model_, let);
    auto& d = model_.diagnostics.error(Code::badTime, let.desc->place,
                                       fmt::format("'${}' contains age() and changes from frame to frame, "
                                                   "but stands where a value must be known before",
                                                   let.path));
    d.hint = "age() may stand in parameters and \"instances\" of passes only";
    return Value{};
  }
  return letValue(model_, let);
}

std::optional<Value> Names::index(std::string_view name) {
  for (const Index& index : indices)
    if (index.name == name) return Value::number(index.value);
  return std::nullopt;
}

std::optional<Value> Names::builtin(std::string_view name) {
  if (name == "screen") {
    Value value;
    value.type = Value::Type::list;
    value.count = 2;
    value.v = {static_cast<double>(model_.settings.screenWidth),
               static_cast<double>(model_.settings.screenHeight), 0, 0};
    return value;
  }
  if (name == "device.software") return Value::boolean(model_.settings.software);
  return std::nullopt;
}

namespace {

// Whether nothing disables the pass or an include around it by name, nor its stanza by a plain `"enabled": false`, which is what the viewer
// writes. An expression is not asked: it could ask back.
bool isLeft(Names& names, const Model& model, const AskedPass& asked) {
  const auto isOn = [&](const PassDesc& stanza, const char* what) {
    return !stanza.enabled.present() || !stanza.enabled.isConstant() ||
           evaluateCondition(names, stanza.enabled, true, what).value_or(true);
  };
  for (const Scope* at = asked.scope; at != &names.scope(); at = at->parent)
    if (!at->disabledBy.empty() || !isOn(*at->stanza, "'enabled' of an include")) return false;
  if (!isOn(*asked.desc, "'enabled' of a pass")) return false;
  const auto rules = model.disables.find(asked.scope->prefix + asked.desc->name);
  return rules == model.disables.end() ||
         std::ranges::none_of(rules->second, [](const DisableRule& rule) { return rule.instance.empty(); });
}

}  // namespace

std::optional<Value> Names::fact(Fact fact, std::string_view resource, const Place& place) {
  std::uint32_t index = findEntity(model_, scope_, resource, false);
  // An input with nothing behind it is no import of its name.
  if (index == kNone && !scope_.resources.contains(resource))
    index = findEntity(model_, scope_, resource, true);
  if (index == kNone && fact == Fact::has)
    if (const AskedPass asked = findAskedPass(scope_, resource); asked.desc)
      return Value::boolean(isLeft(*this, model_, asked));
  if (index == kNone) {
    // Its declaration, or the input that has nothing behind it, was reported where it stands.
    if (isUnread(scope_, resource) || scope_.resources.contains(resource) ||
        model_.unknownFacts.contains({&scope_, std::string(resource)}))
      return Value{};
    if (isUnincluded(model_, scope_, resource, place, kAsksOf)) return Value{};
    return std::nullopt;
  }
  if (fact == Fact::age) return std::nullopt;  // known when the frame runs
  if (live && model_.entities[index].kind != ResourceDesc::Kind::alternatives &&
      model_.entities[index].state != Progress::done) {
    failed = true;
    return Value{};
  }
  const std::string asked = model_.entities[index].name;
  std::uint32_t mip = 0;
  // An import answers for itself even when it has nothing: count() of no lights is 0.
  const bool isImport = model_.entities[index].kind == ResourceDesc::Kind::import;
  const std::uint32_t target = isImport && fact != Fact::has ? index : staticTarget(model_, index, &mip);
  if (fact == Fact::has) return Value::boolean(target != kNone);
  if (target == kNone && model_.stopped) return Value{};
  if (target == kNone &&
      std::ranges::find(model_.entities[index].candidates, kNone) != model_.entities[index].candidates.end())
    return Value{};  // one of its alternatives was reported
  if (target == kNone) {
    auto& d = model_.diagnostics.error(Code::conditionLeavesSlotEmpty, place,
                                       fmt::format("no alternative of '{}' holds, so it has no size", asked));
    d.resource = asked;
    return Value{};
  }
  if (!ensureShape(model_, target)) return Value{};
  const Entity& entity = model_.entities[target];
  const FlatResource& shape = entity.shape;
  const bool texture = shape.kind == ResourceKind::texture || shape.kind == ResourceKind::imported_texture;
  const auto misfit = [&](const char* expected) {
    auto& d = model_.diagnostics.error(Code::wrongValueType, place,
                                       fmt::format("'{}' is asked for what it does not have", entity.name));
    d.expected = expected;
    d.resource = entity.name;
    return Value{};
  };
  switch (fact) {
    case Fact::mips:
      return texture ? Value::number(shape.mips) : misfit("a texture for mips()");
    case Fact::count:
      if (entity.kind == ResourceDesc::Kind::import) return Value::number(entity.count);
      return entity.arrayCount > 0 ? Value::number(entity.arrayCount)
                                   : misfit("an import or an array for count()");
    case Fact::size: {
      if (!texture) return Value::number(static_cast<double>(shape.bytes));
      Value value;
      value.type = Value::Type::list;
      value.count = shape.target == Target::texture_3d ? 3 : 2;
      value.v = {static_cast<double>(std::max(1u, shape.width >> mip)),
                 static_cast<double>(std::max(1u, shape.height >> mip)),
                 value.count == 3 ? static_cast<double>(std::max(1u, shape.depth >> mip)) : 0.0, 0};
      return value;
    }
    default:
      return std::nullopt;
  }
}

std::vector<std::string> Names::choicesOf(std::string_view variable) {
  Scope* scope = &scope_;
  std::string name(variable);
  for (int hops = 0; hops < 32; ++hops) {  // a let that only renames a choice parameter has its choices
    const Variable found = findVariable(model_, *scope, name);
    if (found.kind == Variable::Kind::parameter) return model_.parameters[found.index].desc->choices;
    if (found.kind != Variable::Kind::let) return {};
    const Let& let = model_.lets[found.index];
    const std::string* const only = onlyVariableOf(let.desc->expr);
    if (!only) return {};
    name = *only;
    scope = let.scope;
  }
  return {};
}

std::vector<std::string> Names::candidates(NameKind kind) {
  std::vector<std::string> names;
  switch (kind) {
    case NameKind::builtin:
      return {"screen", "device.software"};
    case NameKind::fact_argument:
      names = resourceNames(model_, scope_);
      for (const ImportType& type : model_.registry.imports) names.push_back(type.name);
      return names;
    case NameKind::variable:
      for (Scope* scope = &scope_; scope; scope = scope->parent) {
        for (const auto& [name, variable] : scope->variables) names.emplace_back(name);
      }
      for (const Parameter& parameter : model_.parameters)
        if (parameter.path.starts_with(scope_.prefix)) names.push_back(parameter.desc->name);
      std::sort(names.begin(), names.end());
      names.erase(std::unique(names.begin(), names.end()), names.end());
      return names;
  }
  return names;
}

std::optional<std::uint32_t> Names::ageKey(std::string_view resource) {
  std::uint32_t index = findEntity(model_, scope_, resource, false);
  if (index == kNone && !scope_.resources.contains(resource))
    index = findEntity(model_, scope_, resource, true);
  if (index != kNone) index = staticTarget(model_, index);
  if (index == kNone || !ensureShape(model_, index)) return std::nullopt;
  return currentResource(model_, index, 0);
}

const Expr* Names::folded(std::string_view variable) {
  const Variable found = findVariable(model_, scope_, variable);
  if (found.kind != Variable::Kind::let) return nullptr;
  Let& let = model_.lets[found.index];
  if (live) return foldedLive(let);
  if (!let.dynamic) return nullptr;
  const std::string label = "$" + let.path;
  if (let.state == Progress::active) {
    reportCycle(model_, let.desc->place,
                fmt::format("'{}' depends on itself: {}", label, cyclePath(model_, label)));
    let.state = Progress::failed;
    return nullptr;
  }
  if (!let.folded) {
    const Descent descent(model_, let.desc->place, label);
    if (!descent.good()) return nullptr;
    let.state = Progress::active;
    model_.evaluating.push_back(label);
    Names names(model_, *let.scope);
    let.folded = let.desc->expr.fold(names, model_.diagnostics);
    model_.evaluating.pop_back();
    let.state = Progress::fresh;
  }
  return &*let.folded;
}

const Expr* Names::foldedLive(Let& let) {
  if (!let.dynamic && !let.live) return nullptr;
  if (!let.liveFolded) {
    const Descent descent(model_, let.desc->place, let.path, true);
    let.liveFolded = Expr();    // met again in a circle, which nobody may have evaluated, it fails
    base::Diagnostics ignored;  // a branch that is not taken now
    Names names(model_, *let.scope);
    names.live = true;
    Expr folded = descent.good() ? let.desc->expr.fold(names, ignored) : Expr();
    if (!names.failed) let.liveFolded = std::move(folded);
  }
  failed = failed || !let.liveFolded->present();
  return &*let.liveFolded;
}

std::optional<std::uint32_t> Names::parameterKey(std::string_view name) {
  if (!live) return std::nullopt;
  const Variable found = findVariable(model_, scope_, name);
  const bool leaf = found.kind == Variable::Kind::parameter && !model_.parameters[found.index].structural;
  return leaf ? std::optional(found.index) : std::nullopt;
}

std::optional<bool> evaluateCondition(Names& names, const Expr& expr, bool absent, const char* what) {
  if (!expr.present()) return absent;
  const Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type == Value::Type::none) return std::nullopt;
  if (value.isNumeric()) return value.truth();
  auto& d = names.model().diagnostics.error(Code::wrongValueType, expr.place(),
                                            fmt::format("{} is no condition", what));
  d.expected = "true, false or a number";
  d.found = toText(value);
  const bool on = d.found == "on" || d.found == "yes";
  d.hint = on || d.found == "off" || d.found == "no" ? fmt::format("write {}", on ? "true" : "false")
                                                     : hintForWord(names, value);
  return std::nullopt;
}

std::optional<double> evaluateNumber(Names& names, const Expr& expr, double absent, const char* what) {
  if (!expr.present()) return absent;
  const Value value = expr.evaluate(names, names.model().diagnostics);
  if (value.type == Value::Type::none) return std::nullopt;
  if (value.isNumeric() && std::isfinite(value.v[0])) return value.v[0];
  auto& d = names.model().diagnostics.error(
      Code::wrongValueType, expr.place(),
      fmt::format("{} is {}", what, value.isNumeric() ? "not finite" : wordFor(value)));
  d.expected = "a number";
  d.found = toText(value);
  d.hint = hintForWord(names, value);
  return std::nullopt;
}

std::optional<std::int64_t> evaluateWhole(Names& names, const Expr& expr, std::int64_t absent,
                                          std::int64_t low, std::int64_t high, const char* what,
                                          bool floors) {
  if (!expr.present()) return absent;
  std::optional<double> number = evaluateNumber(names, expr, 0, what);
  if (!number) return std::nullopt;
  if (floors) number = std::floor(*number);
  if (*number >= static_cast<double>(low) && *number <= static_cast<double>(high) &&
      *number == std::floor(*number))
    return static_cast<std::int64_t>(*number);
  const bool whole = *number == std::floor(*number);
  auto& d = names.model().diagnostics.error(
      whole ? Code::numberOutOfRange : Code::wrongValueType, expr.place(),
      fmt::format("{} is {}", what, whole ? "out of its range" : "not a whole number"));
  d.expected = fmt::format("a whole number from {} to {}", low, high);
  d.found = numberText(*number);
  return std::nullopt;
}

}  // namespace weft::graph::expansion
