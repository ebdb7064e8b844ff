// Names: builds the scopes of a graph and its includes, and finds resources and variables by name.
//   $x       parameters and lets of this file, $pass.parameter, $include.x; then those of the including files, the
//            nearest first; then the only parameter of the files included below whose dotted name ends in x
//   name     resources of this file, then `include.name`; an input stands for the resource that the includer binds to
//            it, else for the one of the same name
//   @name    an import declared here or in an including file, else the import type of that name with its defaults
#pragma once

#include <span>
#include <string_view>

#include "engine/graph/expand/names/model.h"

namespace weft::graph::expansion {

// Of a graph with all that it includes; `--limit` raises them. Names: parameters, resources, values in "set", each.
constexpr std::uint64_t kMaxNames = 4096, kMaxLets = 256, kMaxAlternatives = 64;

// Fills scopes, parameters with their defaults (the reader has checked those), lets and entities; marks lets that contain
// age(); finds what alternatives refer to, and reports lists that contain themselves (W050) or lead to too many.
void buildScopes(Model& model);

// ---- resources ----

// The entity that a name stands for; an input stands for what is bound to it. kNone when there is none (which is not
// reported), or when nothing is bound to an input (which is reported once).
std::uint32_t findEntity(Model& model, Scope& scope, std::string_view name, bool import);
// The same, but reports W040 or W043, with the nearest name.
std::uint32_t findEntityOrReport(Model& model, Scope& scope, const RefDesc& ref, const NamedBy& by);
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
// All names of resources that this file may use.
std::vector<std::string> resourceNames(const Model& model, const Scope& scope);

// ---- names that are unknown: some only because something else went wrong. One mistake is reported once. ----

// The first stanza that includes a file that could not be read, or null.
const PassDesc* failedInclude(const Scope& scope);
// True when the reader reported the declaration of this name and left it out: a use of it is no second
// mistake.
bool isUnread(const Scope& from, std::string_view name);
// True when nothing is known of this variable because an include could not be read, which the reader
// reported.
bool mayBeUnread(const Scope& from, std::string_view name);
// True when `name` is dotted and this file includes nothing under its first part, which is reported once (W040); not when
// an include of the file could not be read.
bool isUnincluded(Model& model, Scope& scope, std::string_view name, const Place& place, const NamedBy& by);

// ---- variables ----

Variable findVariable(Model& model, Scope& scope, std::string_view name);
// The same without the files that are included below: a name of this file or of one that includes it.
Variable findVariableFrom(Scope& scope, std::string_view name);
// The parameters, of those whose path begins with `prefix`, that `name` may mean: the one that is called so, else all whose
// dotted name ends in it.
std::vector<std::uint32_t> parametersMeant(const Model& model, std::string_view prefix,
                                           std::string_view name);
// The parameter that a pass of the scope's own file declares; kNone when it was left out.
std::uint32_t findPassParameter(const Scope& scope, const std::string& pass, const std::string& name);

// ---- what expressions depend on ----

// Marks every parameter that `expr` depends on, directly or through lets, as structural.
void markStructural(Model& model, Scope& scope, const Expr& expr);
void markStructural(Model& model, Scope& scope, const RefDesc& ref);
// True when the expression contains age(), perhaps through a let.
bool isDynamic(Model& model, Scope& scope, const Expr& expr);
// True when the expression asks count() or has(), perhaps through a let: it may be 0 where a list is empty.
bool countsElements(Model& model, Scope& scope, const Expr& expr);
// Finds for every let whether it reads a live parameter, perhaps through another let. To be called when everything
// structural is known.
void findLiveLets(Model& model);
// True when the expression reads a live parameter, perhaps through a let; after findLiveLets().
bool isLive(Model& model, Scope& scope, const Expr& expr);
// Checks the names (variables, choices, resources) in all branches, also in those that are not taken.
// `repeat`: of the pass, whose indices are bare.
bool checkExpr(Model& model, Scope& scope, const Expr& expr, bool dynamicAllowed = false,
               std::span<const RangeDesc> repeat = {});

}  // namespace weft::graph::expansion
