#include "engine/graph/expand/spec.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "engine/base/chars.h"
#include "engine/base/nearest.h"
#include "engine/graph/expand/checks.h"
#include "engine/graph/expand/state.h"
#include "engine/graph/expand/view.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

namespace {

std::string upper(std::string_view name) {
  std::string out;
  for (const char c : name)
    out += std::isalnum(static_cast<unsigned char>(c))
               ? static_cast<char>(std::toupper(static_cast<unsigned char>(c)))
               : '_';
  return out;
}

class SpecFiller {
 public:
  SpecFiller(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
             PassSpec& spec)
      : context_(context),
        model_(context.model),
        names_(context.names),
        desc_(desc),
        slots_(slots),
        spec_(spec) {}

  bool run(std::vector<DeferredValue>& deferred) {
    const std::size_t before = model_.diagnostics.errorCount();
    spec_.uniforms.reserve(desc_.parameters.size());
    spec_.defines.reserve(desc_.defines.size());
    fillState(context_, desc_, slots_, spec_.state);
    for (const NamedExpr& define : desc_.defines) addDefine(define);
    for (const PassParameterDesc& parameter : desc_.parameters) addParameter(parameter, deferred);
    checkDefineNames();
    if (context_.type->shader == ShaderShape::compute) addThreads();
    if (context_.type->shader == ShaderShape::draw) addGeometry(deferred);
    if (desc_.view || context_.type->shader != ShaderShape::none) resolveView(context_, desc_, spec_);
    return model_.diagnostics.errorCount() == before;
  }

 private:
  base::Diagnostic& error(Code code, const Place& place, std::string message) {
    base::Diagnostic& d = model_.diagnostics.error(code, place, fmt::format("{} {}", context_.user, message));
    d.pass = context_.pass;
    return d;
  }

  // ---- defines and uniforms ----

  // The only $variable an expression consists of, or none.
  Variable onlyVariable(const Expr& expr) {
    const std::string* const name = onlyVariableOf(expr);
    return name ? findVariable(model_, names_.scope(), *name) : Variable{};
  }

  void emitDefine(const std::string& name, const Value& value, const std::vector<std::string>& choices,
                  const Place& place, const std::string& from) {
    switch (value.type) {
      case Value::Type::none:
        return;
      case Value::Type::boolean:
        spec_.defines.push_back({name, value.truth() ? "1" : "0"});
        return;
      case Value::Type::number:
        spec_.defines.push_back({name, numberText(value.v[0])});
        return;
      case Value::Type::symbol: {
        const auto found = std::find(choices.begin(), choices.end(), value.symbol);
        if (found != choices.end()) {
          spec_.defines.push_back({name, fmt::format("{}", found - choices.begin())});
          for (std::size_t i = 0; i < choices.size(); ++i)
            spec_.defines.push_back({name + "_" + upper(choices[i]), fmt::format("{}", i)});
          return;
        }
        break;
      }
      case Value::Type::list:
        break;
    }
    auto& d = error(
        Code::wordForNumber, place,
        fmt::format("cannot define '{}' as {}", from, value.type == Value::Type::list ? "a list" : "a word"));
    d.expected = "true, false, a number or a choice parameter";
    d.found = toText(value);
    d.hint = hintForWord(names_, value);
  }

  void addDefine(const NamedExpr& define) {
    const std::string& name = define.name;
    const Expr& expr = define.expr;
    const std::size_t before = model_.diagnostics.errorCount();
    const Value value = expr.evaluate(names_, model_.diagnostics);
    if (model_.diagnostics.errorCount() > before) return;
    std::vector<std::string> choices;
    if (value.type == Value::Type::symbol)
      for (const std::string& variable : variablesOf(expr)) {
        choices = names_.choicesOf(variable);
        if (std::find(choices.begin(), choices.end(), value.symbol) != choices.end()) break;
      }
    emitDefine(name, value, choices, expr.place(), name);
  }

  void addParameter(const PassParameterDesc& desc, std::vector<DeferredValue>& deferred) {
    UniformSpec uniform;
    uniform.name = desc.name;
    uniform.place = desc.place;
    Parameter* parameter = nullptr;
    if (desc.declared) {
      parameter = findPassParameter(model_, names_.scope(), desc_.name, desc.name);
    } else if (const Variable variable = onlyVariable(desc.value);
               variable.kind == Variable::Kind::parameter) {
      parameter = &model_.parameters[variable.index];
    }
    if (parameter) {
      uniform.path = parameter->path;
      if (parameter->desc->define) {
        parameter->structural = true;
        emitDefine(upper(desc.name), parameter->value, parameter->desc->choices, desc.place, desc.name);
        return;
      }
      uniform.value = parameter->value;
    } else if (isDynamic(model_, names_.scope(), desc.value)) {
      deferred.push_back({static_cast<std::uint32_t>(spec_.uniforms.size()), &desc.value});
      spec_.uniforms.push_back(std::move(uniform));
      return;
    } else {
      uniform.constant = desc.value.isConstant();
      uniform.value = desc.value.evaluate(names_, model_.diagnostics);
      if (uniform.value.type == Value::Type::none) return;
    }
    if (uniform.value.type == Value::Type::symbol) {
      auto& d =
          error(Code::wordForNumber, desc.place, fmt::format("gives its parameter '{}' a word", desc.name));
      d.expected = "a number, true, false or a list";
      d.found = toText(uniform.value);
      const bool choice = parameter && parameter->desc->type == ParameterDesc::Type::choice;
      d.hint = choice ? "a choice becomes a define: put it under \"defines\", or give it \"define\": true"
                      : hintForWord(names_, uniform.value);
      if (d.hint.empty()) d.hint = "a path can be an argument of an import only";
      return;
    }
    const auto index = static_cast<std::uint32_t>(spec_.uniforms.size());
    if (parameter)
      deferred.push_back({index, nullptr, static_cast<std::uint32_t>(parameter - model_.parameters.data())});
    else if (!desc.value.isConstant())
      deferred.push_back({index, &desc.value});
    spec_.uniforms.push_back(std::move(uniform));
  }

  void checkDefineNames() {
    std::vector<std::string_view> all;
    for (const DefineSpec& define : spec_.defines) all.push_back(define.name);
    std::sort(all.begin(), all.end());
    if (const auto twice = std::adjacent_find(all.begin(), all.end()); twice != all.end())
      error(Code::nameUsedTwice, desc_.namePlace, fmt::format("defines '{}' twice", *twice)).hint =
          "a choice also defines NAME_CHOICE, a parameter its name in capitals";
  }

  // ---- compute and draw ----

  void addThreads() {
    spec_.threadsPlace = desc_.threads.present() ? desc_.threads.place() : desc_.namePlace;
    if (desc_.threads.present()) {
      const Value value = desc_.threads.evaluate(names_, model_.diagnostics);
      if (value.type == Value::Type::none) return;
      const bool list = value.type == Value::Type::list && value.count >= 2 && value.count <= 3;
      if (!list && !value.isNumeric()) {
        auto& d = error(Code::wrongValueType, desc_.threads.place(), "has threads that are no count");
        d.expected = "a number, or a list of 2 or 3";
        d.found = toText(value);
        return;
      }
      for (std::size_t i = 0; i < value.count; ++i) {
        // As with sizes: 0 is a mistake, but for an empty list; what is computed between 0 and 1 is 1.
        const bool none =
            value.v[i] < 1 && (desc_.threads.isConstant() ||
                               (value.v[i] <= 0 && !countsElements(model_, names_.scope(), desc_.threads)));
        if (!(value.v[i] >= 0) || none || value.v[i] > 2147483647.0) {
          auto& d = error(Code::numberOutOfRange, desc_.threads.place(),
                          "has a number of threads out of its range");
          d.expected = "1 to 2147483647";
          d.found = toText(value);
          if (none && !desc_.threads.isConstant())
            d.hint = "write 'max(…, 1)', or disable the pass where there is nothing to do";
          return;
        }
        spec_.threads[i] = static_cast<std::uint32_t>(std::max(1.0, std::floor(value.v[i])));
      }
      return;
    }
    for (const SlotWork& work : slots_) {
      if (work.slot->access == Access::read || work.entity == kNone || work.state == SlotWork::State::failed)
        continue;
      const FlatResource& shape = model_.entities[work.entity].shape;
      if (shape.kind != ResourceKind::texture) continue;
      spec_.threads[0] = std::max(1u, shape.width >> work.use.mip);
      spec_.threads[1] = std::max(1u, shape.height >> work.use.mip);
      spec_.threads[2] =
          shape.target == Target::texture_3d ? std::max(1u, shape.depth >> work.use.mip) : work.use.layers;
      return;
    }
    // The slot that would say may have been left out for its mistakes.
    const bool failed = std::ranges::any_of(slots_, [](const SlotWork& work) {
      return work.slot->access != Access::read && work.state == SlotWork::State::failed;
    });
    if (model_.incomplete || failed) return;
    auto& d = error(Code::keyNeeded, desc_.namePlace, "lacks threads");
    d.expected = "\"threads\": a number or a list, since no texture is written whose size could be meant";
  }

  void addGeometry(std::vector<DeferredValue>& deferred) {
    spec_.list = desc_.list;
    spec_.geometry = desc_.geometry;
    if (isDynamic(model_, names_.scope(), desc_.instances))
      deferred.push_back({kNone, &desc_.instances});
    else if (const auto instances =
                 evaluateWhole(names_, desc_.instances, 1, 0, 2147483647, "the number of instances", true))
      spec_.instances = static_cast<std::uint32_t>(*instances);
    const auto& types = model_.registry.geometries;
    const auto type = std::ranges::find(types, desc_.geometry, &GeometryType::name);
    if (type == types.end()) return;
    spec_.meshes = type->meshes;
    for (std::size_t i = 0; i < type->arguments.size(); ++i) {
      const GeometryArgument& argument = type->arguments[i];
      std::optional<std::int64_t> value = argument.initial;
      if (i < desc_.geometryArguments.size())
        value = evaluateWhole(names_, desc_.geometryArguments[i], argument.initial, argument.min,
                              argument.max, "an argument of the geometry");
      if (value) spec_.geometryArguments.push_back(static_cast<double>(*value));
    }
  }

  const SlotContext& context_;
  Model& model_;
  Names& names_;
  const PassDesc& desc_;
  const std::vector<SlotWork>& slots_;
  PassSpec& spec_;
};

}  // namespace

bool fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::vector<DeferredValue>& deferred) {
  return SpecFiller(context, desc, slots, spec).run(deferred);
}

}  // namespace weft::graph::expansion
