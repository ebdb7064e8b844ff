// Names: builds the scopes of a graph and its includes, finds resources and variables by name, and answers
// for names while expressions are evaluated.
//   $x       parameters and lets of this file, $pass.parameter, $include.x; then those of the including files, the
//            nearest first; then the only parameter of the files included below whose dotted name ends in x
//   name     resources of this file, then `include.name`; an input stands for the resource that the includer binds to
//            it, else for the one of the same name
//   @name    an import declared here or in an including file, else the import type of that name with its defaults
// Does not: evaluate shapes (resources.h), or know versions.
#pragma once

#include <span>
#include <string_view>

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Of a graph with all that it includes; `--limit` raises them. Names: parameters, resources, values in "set", each.
constexpr std::uint64_t kMostNames = 4096, kMostLets = 256, kMostAlternatives = 64;

// Fills scopes, parameters with their defaults (the reader has checked those), lets and entities.
void buildScopes(Model& model);
// The steps of buildScopes() after the scopes. The first marks lets that contain age(), perhaps through another let. The
// second finds what alternatives refer to, and reports lists that contain themselves (W050) or lead to too many.
void findDynamicLets(Model& model);
void linkAlternatives(Model& model);

// The entity that a name stands for; an input stands for what is bound to it. kNone when there is none (which is not
// reported), or when nothing is bound to an input (which is reported once).
std::uint32_t findEntity(Model& model, Scope& scope, std::string_view name, bool import);
// The same, but reports W040 or W043 at `place`, with the nearest name.
std::uint32_t findEntityOrReport(Model& model, Scope& scope, std::string_view name, bool import,
                                 const Place& place, const NamedBy& by);
// A pass of the scope's own file; null: there is none.
const PassDesc* findPass(const Scope& scope, std::string_view name);
// What has(name) is about where no resource has the name: a pass of the scope's own file, or `include.pass` of one included below.
struct AskedPass {
  const PassDesc* desc = nullptr;  // null: there is none
  const Scope* scope = nullptr;    // whose file declares it
};
AskedPass findAskedPass(const Scope& scope, std::string_view name);
// Of a name in size(name) and other facts.
constexpr NamedBy kAsksOf{"an expression", "asks of"};
// The import type's entity with default arguments; kNone when there is no such type.
std::uint32_t implicitImport(Model& model, std::string_view type);

Variable findVariable(Model& model, Scope& scope, std::string_view name);
// The same without the files that are included below: a name of this file or of one that includes it.
Variable findVariableFrom(Scope& scope, std::string_view name);

// The parameter that a pass of the scope's own file declares; null when it was left out.
Parameter* findPassParameter(Model& model, const Scope& scope, const std::string& pass,
                             const std::string& name);

// Marks every parameter that `expr` depends on, directly or through lets, as structural.
void markStructural(Model& model, Scope& scope, const Expr& expr);
void markStructural(Model& model, Scope& scope, const RefDesc& ref);
// True when the expression contains age(), perhaps through a let.
bool isDynamic(Model& model, Scope& scope, const Expr& expr);
// True when the expression asks count() or has(), perhaps through a let: it may be 0 where a list is empty.
bool countsElements(Model& model, Scope& scope, const Expr& expr);
// True when a range that is empty now can hardly be meant to be: it counts down without a negative step, or up with one, and
// neither an empty list nor levels that the size took away, nor an outer index, makes it so.
bool isEmptyByMistake(Model& model, Scope& scope, const PassDesc& desc, const RangeDesc& range,
                      std::int64_t first, std::int64_t last, std::int64_t step);
// Finds for every let whether it reads a live parameter, perhaps through another let. To be called when everything
// structural is known.
void findLiveLets(Model& model);
// True when the expression reads a live parameter, perhaps through a let; after findLiveLets().
bool isLive(Model& model, Scope& scope, const Expr& expr);
// Checks the names (variables, choices, resources) in all branches, also in those that are not taken.
// `repeat`: of the pass, whose indices are bare.
bool checkExpr(Model& model, Scope& scope, const Expr& expr, bool dynamicAllowed = false,
               std::span<const RangeDesc> repeat = {});

// The nearest names for hints.
std::vector<std::string> resourceNames(const Model& model, const Scope& scope);

}  // namespace weft::graph::expansion
