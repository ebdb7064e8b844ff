// An EvalScope over plain maps, for tests of expressions.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/graph/language/expr.h"

namespace weft::graph {

struct MapScope : EvalScope {
  std::map<std::string, Value, std::less<>> variables, indices, builtins;
  std::map<std::pair<Fact, std::string>, Value> facts;
  std::map<std::string, std::vector<std::string>, std::less<>> choices;
  std::map<std::string, std::uint32_t, std::less<>> ageKeys;
  std::map<std::string, Expr, std::less<>> foldedLets;
  int factsAsked = 0;

  static std::optional<Value> find(const std::map<std::string, Value, std::less<>>& map,
                                   std::string_view name) {
    const auto found = map.find(name);
    return found == map.end() ? std::nullopt : std::optional<Value>(found->second);
  }
  std::optional<Value> variable(std::string_view name) override { return find(variables, name); }
  std::optional<Value> index(std::string_view name) override { return find(indices, name); }
  std::optional<Value> builtin(std::string_view name) override { return find(builtins, name); }
  std::optional<Value> fact(Fact fact, std::string_view resource, std::uint32_t level,
                            const text::Place&) override {
    ++factsAsked;
    const auto found = facts.find({fact, std::string(resource)});
    if (found == facts.end()) return std::nullopt;
    Value value = found->second;
    for (double& side : value.v) side = side / (1u << level);
    return value;
  }
  std::vector<std::string> choicesOf(std::string_view name) override {
    const auto found = choices.find(name);
    return found == choices.end() ? std::vector<std::string>() : found->second;
  }
  std::vector<std::string> candidates(NameKind kind) override {
    std::vector<std::string> out;
    if (kind == NameKind::variable)
      for (const auto& [name, value] : variables) out.push_back(name);
    if (kind == NameKind::builtin)
      for (const auto& [name, value] : builtins) out.push_back(name);
    if (kind == NameKind::fact_argument)
      for (const auto& [key, value] : facts) out.push_back(key.second);
    return out;
  }
  std::optional<std::shared_ptr<const ExprNode>> folded(std::string_view name, const text::Place&) override {
    const auto found = foldedLets.find(name);
    return found == foldedLets.end() ? std::nullopt : std::optional(found->second.tree());
  }
  std::optional<std::uint32_t> ageKey(std::string_view resource) override {
    const auto found = ageKeys.find(resource);
    return found == ageKeys.end() ? std::nullopt : std::optional<std::uint32_t>(found->second);
  }
};

}  // namespace weft::graph
