// The EvalScope of expansion: answers for names, which scope.h finds, while expressions of one scope are evaluated; and
// evaluation with an expected type.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Answers for names in expressions of one scope.
class Names final : public EvalScope {
 public:
  struct Index {
    std::string_view name;
    double value;
  };
  Names(Model& model, Scope& scope, bool dynamicAllowed = false)
      : model_(model), scope_(scope), dynamicAllowed_(dynamicAllowed) {}

  std::vector<Index> indices;  // of the pass instance
  // Live parameters and the lets over them stay leaves of what is folded, and nothing new is looked at: what
  // would need that, or fails, sets `failed`.
  bool live = false, failed = false;

  std::optional<Value> variable(std::string_view name) override;
  std::optional<Value> index(std::string_view name) override;
  std::optional<Value> builtin(std::string_view name) override;
  std::optional<Value> fact(Fact fact, std::string_view resource, const Place& place) override;
  std::vector<std::string> choicesOf(std::string_view variable) override;
  std::vector<std::string> candidates(NameKind kind) override;
  std::optional<std::uint32_t> ageKey(std::string_view resource) override;
  const Expr* folded(std::string_view variable) override;
  std::optional<std::uint32_t> parameterKey(std::string_view variable) override;

  Model& model() { return model_; }
  Scope& scope() { return scope_; }

 private:
  const Expr* foldedLive(Let& let);
  std::optional<Value> factOfShape(Fact fact, std::uint32_t target, std::uint32_t mip, const Place& place);
  // What a fact asks of: an entity, or kNone.
  std::uint32_t find(std::string_view resource);

  Model& model_;
  Scope& scope_;
  bool dynamicAllowed_;  // a let with age() answers 1 instead of an error (checks of uniforms)
};

// Evaluation with the expected type held: nullopt after a report, which calls it `what`. An absent expression yields `absent`.
std::optional<bool> evaluateCondition(Names& names, const Expr& expr, bool absent, const char* what);
std::optional<double> evaluateNumber(Names& names, const Expr& expr, double absent, const char* what);
// A whole number from `low` to `high`, floored first when `floors`.
std::optional<std::int64_t> evaluateWhole(Names& names, const Expr& expr, std::int64_t absent,
                                          std::int64_t low, std::int64_t high, const char* what,
                                          bool floors = false);

}  // namespace weft::graph::expansion
