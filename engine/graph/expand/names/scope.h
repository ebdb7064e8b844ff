// Names: builds the scopes of a graph and its includes, finds resources and variables by name, and answers
// for names while expressions are evaluated.
//   $x       own parameters and lets; $pass.parameter; $include.x; then enclosing files, the nearest first;
//   then the
//            only parameter of any file included below this one whose dotted name ends in it
//   name     own resources, then `include.name`; an input stands for what the includer binds or calls the
//   same
//   @name    an import declared here or in an enclosing file, else the import type of that name with its
//   defaults
// Does not evaluate shapes (expand_resources) nor know versions.
#pragma once

#include <string_view>

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Fills scopes, parameters with their defaults (the reader has checked those), lets and entities.
void buildScopes(Model& model);
// Its steps after the scopes: marks lets that contain age(), perhaps through another; finds what alternatives refer to,
// and reports lists that contain themselves (W050) or lead to lists in too long a row.
void findDynamicLets(Model& model);
void linkAlternatives(Model& model);

// The entity a name stands for, with inputs followed; kNone when there is none (nothing is reported) or when
// an input has nothing behind it (reported once).
std::uint32_t findEntity(Model& model, Scope& scope, std::string_view name, bool import);
// The same, and reports W040 or W043 with the nearest name at `place`. `slot`: the one it is for, if any.
std::uint32_t findEntityOrReport(Model& model, Scope& scope, std::string_view name, bool import,
                                 const Place& place, std::string_view user, const std::string& pass = {},
                                 std::string_view slot = {});
// `user` of a name in size(name) and the like.
constexpr const char* kAsksOf = "an expression asks of the";
// False when so many names were gathered for suggestions that further messages go without.
bool maySuggest(Model& model, std::size_t names);
// The import type's entity with default arguments; kNone when there is no such type.
std::uint32_t implicitImport(Model& model, std::string_view type);

struct Variable {
  enum class Kind : std::uint8_t { none, parameter, let, ambiguous };
  Kind kind = Kind::none;
  std::uint32_t index = 0;
};
Variable findVariable(Model& model, Scope& scope, std::string_view name);

// Every parameter that `expr` depends on, through lets, is marked as structural.
void markStructural(Model& model, Scope& scope, const Expr& expr);
void markStructural(Model& model, Scope& scope, const RefDesc& ref);
// True when the expression contains age(), perhaps through a let.
bool isDynamic(Model& model, Scope& scope, const Expr& expr);
// For every let, whether it reads a live parameter, perhaps through another let. Only when everything structural is
// known.
void findLiveLets(Model& model);
// True when the expression reads a live parameter, perhaps through a let; after findLiveLets().
bool isLive(Model& model, Scope& scope, const Expr& expr);
// Names in branches that are not taken: variables, choices and resources.
bool checkExpr(Model& model, Scope& scope, const Expr& expr, bool dynamicAllowed = false);

// The nearest names for hints.
std::vector<std::string> resourceNames(Model& model, const Scope& scope);

}  // namespace weft::graph::expansion
