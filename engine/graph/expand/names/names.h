// Names of one expansion: scopes, what a name means in them, and the values, shapes and versions behind it.
//   $x       parameters and lets of this file, $pass.parameter, $include.x; then those of the including files, the
//            nearest first; then the only parameter of the files included below whose dotted name ends in x
//   name     resources of this file, then `include.name`; an input stands for the resource that the includer binds to
//            it, else for the one of the same name
//   @name    an import declared here or in an including file, else the import type of that name with its defaults
#pragma once

#include <array>
#include <span>

#include "engine/graph/expand/names/model.h"
#include "engine/graph/language/expr_node.h"

namespace weft::graph::expansion {

// Of a graph with all that it includes; `--limit` raises them. Names: parameters, resources, values in "set", each.
constexpr std::uint64_t kMaxNames = 4096, kMaxLets = 256, kMaxAlternatives = 64;
constexpr std::uint32_t kMaxSize = 16384, kMaxSize3d = 2048, kMaxMips = 32, kMaxLayers = 2048,
                        kMaxHistory = 16, kMaxArray = 256;
constexpr std::uint64_t kMaxBufferBytes = 2ull << 30;

// ---- scopes (scope.cpp) ----

// Fills scopes, parameters with their defaults (the reader has checked those), lets and entities; marks lets that contain
// age() and parameters that decide more than uniforms; finds what alternatives refer to, and reports lists that contain
// themselves (W050) or lead to too many.
void buildScopes(Model& model);

// Sets Parameter::value, Scope::disabledBy and Model::disables: "set" of files, --set and --disable (settings.cpp).
void applySettings(Model& model);
void applySetting(Model& model, const Setting& set);
void applyDisable(Model& model, const Disable& disable);

// The entity that a name stands for; an input stands for what is bound to it. kNone when there is none (which is not
// reported), or when nothing is bound to an input (which is reported once). `sample` gets what says, nearest to the name, how it
// is sampled: an input, or the resource itself; null when none does.
std::uint32_t findEntity(Model& model, Scope& scope, std::string_view name, bool import,
                         const RefDesc** sample = nullptr);
// "pass 'blur'" of the name of a pass, else `user`, such as "present".
std::string whoIs(std::string_view user, std::string_view pass);
// The same as findEntity(), but reports W040 or W043, with the nearest name. `who` and `pass`: see whoIs(); `verb`: "reads".
std::uint32_t findEntityOrReport(Model& model, Scope& scope, const RefDesc& ref, std::string_view who,
                                 std::string_view verb, std::string_view pass = {},
                                 const RefDesc** sample = nullptr);
// What the passes of a file that name no view are seen from: an import that is declared, or bound, under the name of such a type. kNone:
// the camera that is looked through.
std::uint32_t findFileView(Model& model, Scope& scope);
// The import that an include puts in the place of one that its file names or declares. kNone: it binds none of this name.
std::uint32_t findBoundImport(Model& model, const Scope& scope, std::string_view name);
// The import of a kind that is declared under a name, or bound to it, here or in an enclosing file: an entity. kNone: there is none.
std::uint32_t findDeclared(Model& model, Scope& scope, std::string_view name, ImportKind kind);
// A declaration that nothing names, while what is named more than once is not there and one slip away, is one mistake, at the
// declaration: it is reported, and found by that name, too. So is a pass whose parameters are asked for as "$pass.parameter". Files ask
// for variables of their own, of files that include them, and of those that they include. True when it was done now: then a name may
// be found after all.
bool mendDeclarations(Model& model);
// As findEntity(), for the name that a fact asks of; it may be that of a pass.
std::uint32_t findAsked(Model& model, Scope& scope, std::string_view name);
// What has(name) is about where no resource has the name: a pass of the scope's own file, or `include.pass` of one included
// below, and the scope whose file declares it. Null: there is none.
std::pair<const PassDesc*, Scope*> findAskedPass(Scope& scope, std::string_view name);
// "post" of "post.hdr".
std::string_view firstPart(std::string_view name);
// Where what stands behind an input is looked for: what the include binds to it, else what has its name in an include that is bound
// whole, else in the including file, which there is.
struct Behind {
  Scope* scope;
  std::string_view name;
  bool import = false;
  const RefDesc* bind = nullptr;
};
Behind behindInput(const Model& model, const Entity& input);
// Follows the prefixes of a dotted name into the files that are included under them; `name` gets what is left.
Scope& scopeOf(Scope& scope, std::string_view& name);
// The scope of the include that an entry of "bind" names whole, for all inputs that have its names; null for another entry.
Scope* includeBound(Scope& scope, std::string_view input, const RefDesc& ref);
// All names of resources that this file may use.
std::vector<std::string> resourceNames(const Model& model, const Scope& scope);
// True when the name may be of something that the reader reported and left out: a use of it is no second mistake.
bool isUnread(const Scope& from, std::string_view name);

Variable findVariable(const Model& model, const Scope& scope, std::string_view name);
// The parameters, of those whose path begins with `prefix`, that `name` may mean: the one that is called so, else all whose
// dotted name ends in it.
std::vector<std::uint32_t> parametersMeant(const Model& model, std::string_view prefix,
                                           std::string_view name);
// Notes what the expressions and references of all files name, whatever the conditions say now, and what of it nothing has,
// Model::asked; parameters that decide more than the values of uniforms become structural (mentions.cpp).
void noteMentions(Model& model);
// Marks every parameter that `expr` depends on, directly or through lets, as structural.
void markStructural(Model& model, Scope& scope, const Expr& expr);
// True when the expression contains age(), perhaps through a let.
bool isDynamic(Model& model, Scope& scope, const Expr& expr);
// Whether it contains a value of an import, perhaps through a let.
bool isWatched(Model& model, Scope& scope, const Expr& expr);
// Whether the expression reads a parameter that is not structural, perhaps through a let.
bool isLive(Model& model, Scope& scope, const Expr& expr);
// True when the expression asks count() or has(), perhaps through a let: it may be 0 where a list is empty.
bool countsElements(Model& model, Scope& scope, const Expr& expr);
// Checks the names (variables, choices, resources) in all branches, also in those that are not taken.
// `repeat`: of the pass, whose indices are bare.
void checkExpr(Model& model, Scope& scope, const Expr& expr, std::span<const RangeDesc> repeat = {});

// Whether something names `own`, perhaps in another instance of a file that is included more than once.
template <class Things, class Thing>
bool isNamed(const Things& all, const Thing& own) {
  return own.named ||
         std::ranges::any_of(all, [&](const Thing& each) { return each.desc == own.desc && each.named; });
}

// ---- values (names.cpp) ----

template <class T>
std::vector<std::string> namesOf(const std::vector<T>& things) {
  std::vector<std::string> names;
  for (const T& thing : things) names.push_back(thing.name);
  return names;
}

// The EvalScope of expansion: answers for names in expressions of one scope.
class Names final : public EvalScope {
 public:
  struct Index {
    std::string_view name;
    double value;
  };
  Names(Model& model, Scope& scope) : model_(model), scope_(scope) {}

  std::vector<Index> indices;  // of the pass instance
  // Live parameters and the lets over them stay leaves of what is folded, and nothing new is looked at: what
  // would need that, or fails, sets `failed`.
  bool live = false, failed = false;
  bool checking = false;  // a let with age() answers 1 instead of an error
  bool follows = false;   // values of imports answer with a value of their type instead of an error …
  bool absent = false;    // … also of an import that is not there

  std::optional<Value> variable(std::string_view name) override;
  std::optional<Value> index(std::string_view name) override;
  std::optional<Value> builtin(std::string_view name) override;
  std::optional<Value> fact(Fact fact, std::string_view resource, std::uint32_t level,
                            const Place& place) override;
  std::vector<std::string> choicesOf(std::string_view variable) override;
  std::vector<std::string> candidates(NameKind kind) override;
  std::optional<std::uint32_t> ageKey(std::string_view resource) override;
  std::optional<ExprPtr> folded(std::string_view variable, const Place& place) override;
  Value importValue(const ImportValue& asked, const Place& place) override;
  std::optional<std::uint32_t> importKey(const ImportValue& asked) override;
  bool keepsImports() const override { return live; }

  Model& model() { return model_; }
  Scope& scope() { return scope_; }

 private:
  std::optional<Value> factOfShape(Fact fact, std::uint32_t target, std::uint32_t mip, std::uint32_t level,
                                   const Place& place);

  Model& model_;
  Scope& scope_;
};

// Whether the expression is a value of an import that is a matrix, which a parameter takes column by column.
bool isMatrix(Model& model, Scope& scope, const Expr& expr);

// Evaluation with the expected type held: nullopt after a report, which calls it `what`. An absent expression yields `absent`.
std::optional<bool> evaluateCondition(Names& names, const Expr& expr, bool absent, std::string_view what);
// A whole number from `low` to `high`, floored first when `floors`.
std::optional<std::int64_t> evaluateWhole(Names& names, const Expr& expr, std::int64_t absent,
                                          std::int64_t low, std::int64_t high, std::string_view what,
                                          bool floors = false);
// A number, or a list of up to as many as there are bounds, floored, each from 1 to the bound for so many numbers. 0 is a
// mistake, but for the count of an empty list and the computed size of a buffer; what is computed between 0 and 1 is 1.
struct Counts {
  std::size_t size = 1;
  std::array<std::uint64_t, 3> each{1, 1, 1};
};
std::optional<Counts> evaluateCounts(Names& names, const Expr& expr, std::span<const std::uint64_t> bounds,
                                     std::string_view what, const char* expected);

// The same of one or two, from 1 to `most` each.
std::optional<std::array<std::uint32_t, 2>> evaluateSize(Names& names, const Expr& expr, std::uint64_t most,
                                                         std::string_view what);

// What `screen` means in a file, in pixels.
std::array<std::uint32_t, 2> screenOf(Model& model, Scope& scope);

// ---- shapes (resources.cpp): size, format, levels, layers, target, bytes and history. Lazily, as sizes refer to each other ----

// True when entity.shape is usable. Reports what is wrong the first time only.
bool ensureShape(Model& model, std::uint32_t entity);
// Gives what is bound to inputs the history that they ask for. To be called when all shapes were asked for, before passes.
void takeInputHistories(Model& model);
// The entity itself, or of a list of alternatives the first whose condition holds and which exists, whether or not it has
// a version. kNone when there is none. `mip` gets the level that its reference selects, 0 when it selects none.
std::uint32_t staticTarget(Model& model, std::uint32_t entity, std::uint32_t* mip = nullptr);
// What else an unknown import may mean: what Weft calls it, the nearest of its types, or all of them.
std::string hintForImport(const Registry& registry, std::string_view name);

// ---- versions (resources.cpp): which FlatResource an entity is at this point of the declared order. A whole rewrite makes
// another ("hdr#2"). Who wrote what is the VersionWalk's (engine/graph/versions/versions.h) ----

// The current FlatResource of an element, made when there is none yet. The shape must be ensured.
std::uint32_t currentResource(Model& model, std::uint32_t entity, std::uint32_t element);

struct VersionCheck {
  bool complete = true;       // every selected sub-resource has a version (version zero counts)
  bool real = false;          // one of them at least is above zero
  std::uint32_t missing = 0;  // the first sub-resource without one, as an index
};
VersionCheck checkVersion(const Model& model, std::uint32_t entity, std::uint32_t element,
                          const FlatUse& rect);
// Adds `use` of `pass` to the graph, of the resource that it names, and links it to what it sees.
void addUse(Model& model, std::uint32_t entity, std::uint32_t element, const FlatUse& use,
            std::uint32_t pass);
// For a whole write: another FlatResource when the current one has been written or its version zero used. One that `covers`
// less than all of it begins with its "clear".
std::uint32_t resourceToWrite(Model& model, std::uint32_t entity, std::uint32_t element, bool whole,
                              bool covers);
// Notes in Model::would what would be used at this position. Imports do not matter.
void wouldUse(Model& model, WouldUse use);
// The same for all of `entity`, or of what it lists.
void wouldUse(Model& model, std::uint32_t entity, Access access, int history);

}  // namespace weft::graph::expansion
