// The working tables of one expansion: scopes of included files, their parameters and lets, and entities (declared
// resources and imports). They are plain data, live while expandGraph runs and point into the GraphDesc; each file of
// engine/graph/expand does one job on them. Does not: outlive expandGraph.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/graph/desc.h"
#include "engine/graph/expand/names/settings.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/registry.h"
#include "engine/graph/versions/version_walk.h"

namespace weft::graph::expansion {

using base::Code;

struct NameHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view name) const { return std::hash<std::string_view>{}(name); }
};
template <class T>
using NameMap = std::unordered_map<std::string, T, NameHash, std::equal_to<>>;
// The same for names that stand in the GraphDesc, or in another table of the Model, and do not move.
template <class T>
using KnownNames = std::unordered_map<std::string_view, T>;

// What $name means.
struct Variable {
  enum class Kind : std::uint8_t { none, parameter, let, ambiguous };
  Kind kind = Kind::none;
  std::uint32_t index = 0;  // into Model::parameters or Model::lets
};

// For lazy evaluation: a definition that is needed while it is `active` depends on itself.
enum class Progress : std::uint8_t { fresh, active, done, failed };

struct Scope;

struct Parameter {
  const ParameterDesc* desc = nullptr;
  std::string path;  // "post.exposure", "post.dof.aperture"
  Value value;
  bool structural = false;
  Where valuePlace{};  // where `value` was written: a default, a "set", the command line
  Origin origin = Origin::declaration;
  std::uint32_t nextOfLeaf = kNone;  // the next parameter of the same name, in any file
};

// The parameters of one name: the first, linked by Parameter::nextOfLeaf in their order.
struct Leaves {
  std::uint32_t first = kNone, last = kNone, count = 0;
};

struct Let {
  const NamedExpr* desc = nullptr;
  Scope* scope = nullptr;
  std::string path;
  Progress state = Progress::fresh;
  Value value;                 // when done
  bool dynamic = false;        // contains age(), perhaps through another let
  std::optional<Expr> folded;  // of a dynamic one, after all passes are known
  bool live = false;           // reads a live parameter, perhaps through another let; after findLiveLets()
  std::optional<Expr> liveFolded;  // of a live let, and of a dynamic one when there are live ones
  bool structural = false;
};

// The versions of one texture or buffer (one array element of it) while passes are walked in declared order.
struct Element {
  std::uint32_t resource = kNone;  // the current FlatResource; Model::versions knows who wrote it
  std::uint32_t count = 0;         // FlatResources made so far
  bool zeroUsed = false;           // version zero was read or modified
};

struct Entity {
  ResourceDesc::Kind kind = ResourceDesc::Kind::texture;
  const ResourceDesc* desc = nullptr;  // null: an import named only by @x
  Scope* scope = nullptr;              // where it is declared
  std::string name;                    // "ibl.brdf", "@environment"
  // texture and buffer: the shape of every FlatResource of it. import: what the registry says.
  Progress state = Progress::fresh;
  FlatResource shape;
  Value clear, first;
  std::uint32_t arrayCount = 0;         // 0: not an array
  std::uint16_t writtenMips = 1;        // as the file says, before the clamp to the size
  std::uint32_t depth = 0;              // of the history
  std::vector<std::uint32_t> inputs{};  // that stand for it and ask for a history
  bool badHistory = false;              // input: how long a history it asks for was reported
  const RefDesc* firstRef = nullptr;    // what is read in place of `first`, in the names of firstScope
  Scope* firstScope = nullptr;
  FlatUse firstUse{.resource = kNone};  // of it, once some pass reads it
  std::uint32_t import = kNone;         // index into FlatGraph::imports
  bool exists = true;                   // imports only
  bool fallback = false;                // imports only: a plain read may do without
  double count = 0;                     // imports only
  // input: what it stands for
  Progress bindState = Progress::fresh;
  std::uint32_t bound = kNone;
  Progress listState = Progress::fresh;  // alternatives: cycle check
  std::uint32_t emptied = kNone;         // into Model::emptied: one that would write it
  bool incomplete = false;               // a pass that would write it was left out for its mistakes
  std::vector<std::uint32_t>
      candidates;  // alternatives: entities, parallel to desc->alternatives; kNone: unknown
  std::vector<Element> elements;
  bool read = false;  // some slot names it, at this position first
  std::uint32_t firstRead = kNone;
};

// One file instance.
struct Scope {
  const GraphDesc* desc = nullptr;
  Scope* parent = nullptr;
  const PassDesc* stanza = nullptr;     // the include in the parent
  std::string prefix;                   // "" or "post."
  std::string group;                    // full name of the group that the include puts its passes into, or ""
  KnownNames<std::uint32_t> resources;  // entities
  KnownNames<Variable> variables;       // parameters, lets, and parameters of passes: "composite.fog"
  KnownNames<Variable> below;           // found in the files that are included below, so far
  KnownNames<Scope*> includes;
  KnownNames<const PassDesc*> passes;
  std::string disabledBy;  // "--disable post"; empty: not disabled
  bool broken = false;     // an include below it could not be read: names it does not know may be from there
};

// References `name.…` in a file that includes nothing under that name. All of them are one mistake.
struct Unincluded {
  struct Use {
    Place place;
    std::string text;  // "pass 'skybox' reads the unknown resource 'ibl.brdf'"
    std::string resource, pass;
  };
  Scope* scope = nullptr;
  std::string name;
  std::vector<Use> uses;  // of different places
};

// What --disable matched.
struct DisableRule {
  std::string why;       // "--disable fxaa"
  std::string declared;  // full declared name of a pass
  std::string instance;  // full instance name, or empty: all repeats
};

// A write of a pass, enabled or not, in declared order: for messages that say which pass would have written something.
struct WriteRecord {
  std::uint32_t entity = kNone, firstElement = 0, elementCount = 1;
  FlatUse rect;
  std::uint32_t position = 0;
  std::uint32_t pass = kNone;      // of FlatGraph::passes when enabled
  std::uint32_t disabled = kNone;  // of FlatGraph::disabled otherwise
  bool whole = false;
  bool passesOn = false;  // the pass reads or modifies the same: it needs another to have written it before
};

// A read or write that is not in the graph. It would be there if a pass or a condition that is switched off now were not, or
// if there were something to read.
struct WouldUse {
  enum class Why : std::uint8_t {
    off,    // of a disabled pass, or its condition is false
    empty,  // an optional slot or an alternative that nothing wrote so far
    zero    // it reads what "clear" says: nothing wrote it so far
  };
  Why why = Why::off;
  std::uint32_t entity = kNone;  // kNone: whatever the pass does, it counts
  std::uint32_t firstElement = 0, elementCount = 1;
  FlatUse rect;
  std::uint32_t position = kNone;  // of the instance, in declared order; kNone: after all passes
  std::uint32_t slot = kNone;      // of the pass, when it is enabled
};

// A pass whose "repeat" leaves nothing of it.
struct EmptyRepeat {
  std::string pass, index;
  std::int64_t first = 0, last = 0, step = 1;
  Place place;
  bool mistake = false;  // whoever needs it
};

// A slot that found no version. Only when it is known which passes live, it is known whether that is an error or a warning.
struct MissingRead {
  enum class Cause : std::uint8_t { version, condition, import };
  struct Wanted {
    std::uint32_t entity = kNone, element = 0, subresource = 0;
    FlatUse rect;
  };
  Cause cause = Cause::version;
  std::uint32_t pass = kNone;  // kNone: present or an output
  std::uint32_t position = kNone;
  std::string slot;
  RefDesc ref;
  bool first = false;  // `ref` is the "first" of what the slot reads
  Access access = Access::read;
  std::vector<Wanted> wanted;
};

struct Model {
  const GraphDesc& desc;
  const Registry& registry;
  const Settings& settings;
  base::Diagnostics& diagnostics;
  FlatGraph graph{};
  VersionWalk versions{graph};
  // None of these moves: buildScopes() counts what there will be, and makes room for it.
  std::vector<Scope> scopes{};  // scopes[0] is the root
  std::vector<Parameter> parameters{};
  std::vector<Let> lets{};
  std::vector<Entity> entities{};
  NameMap<std::uint32_t> implicitImports{};                        // "environment" of @environment
  std::vector<std::uint32_t> importResource{};                     // per import: its FlatResource or kNone
  std::unordered_map<std::uint64_t, std::uint32_t> importIndex{};  // by keyOf(request)
  KnownNames<Leaves> parametersByLeaf{};
  std::unordered_map<std::string, std::vector<DisableRule>> disables{};  // by declared name
  std::vector<WriteRecord> writes{};
  std::vector<WouldUse> would{};  // by position
  std::vector<MissingRead> missing{};
  std::vector<EmptyRepeat> emptied{};
  struct HistoryUse {
    std::uint32_t use, entity, element;
  };
  std::vector<HistoryUse> historyUses{};    // their resource is the last one, known at the end
  std::vector<std::uint32_t> positionOf{};  // per pass of the FlatGraph
  struct ElementOf {
    std::uint32_t entity, element;
  };
  std::vector<ElementOf> elementOf{};                             // per FlatResource
  std::vector<Unincluded> unincluded{};                           // reported at the end
  std::set<std::pair<const Scope*, std::string>> unknownFacts{};  // what expressions ask of, and was reported
  // Some write is missing because of a mistake, and nobody knows of what: missing versions are not reported. Where it is
  // known, Entity::incomplete says so.
  bool incomplete = false;
  bool toInclude =
      false;  // the file that was opened has inputs: it is to be included, and its own names are not all
  std::uint32_t position = 0;             // of the instance being expanded
  std::uint32_t slot = kNone;             // of it, while it is resolved
  std::vector<std::string> evaluating{};  // what is being evaluated now, for the path of a cycle
  std::uint32_t depth = 0;                // definitions that are being evaluated, each for the one before
  bool stopped = false;                   // a bound was exceeded and reported: nothing more is expanded
};

// True when nothing more is worth expanding.
bool isOver(const Model& model);
// W201: more than a bound allows, of `counts`. Ends the expansion.
void stopAt(Model& model, const Where& place, std::string message, std::uint64_t bound, const char* counts);

// Lives while one definition (a let, a size, what an input stands for, a list of alternatives) is evaluated for another. This
// recurses, so it is not good when there are too many; that is reported with `label`, unless `quiet`, and ends the expansion.
class Descent {
 public:
  static constexpr std::uint32_t kMost = 32;
  Descent(Model& model, const Place& place, std::string_view label, bool quiet = false);
  ~Descent() { --depth_; }
  Descent(const Descent&) = delete;
  Descent& operator=(const Descent&) = delete;
  bool good() const { return depth_ <= kMost; }

 private:
  std::uint32_t& depth_;
};

// Who names something, for the message when it is not there: "pass 'blur' reads the unknown resource 'hdr'".
struct NamedBy {
  std::string_view user;       // "pass 'blur'"
  const char* verb = "names";  // "reads"
  std::string_view pass = {};  // "blur"
  std::string_view slot = {};
  bool orPass = false;  // the name may be one of a pass
};

// "a -> b -> a" from the stack of what is being evaluated, closed by `again`.
std::string cyclePath(const Model& model, const std::string& again);

// W050 with the message and what to do about it.
base::Diagnostic& reportCycle(Model& model, const Place& place, std::string message);

// A number to people: shortest text.
std::string numberText(double x);

}  // namespace weft::graph::expansion
