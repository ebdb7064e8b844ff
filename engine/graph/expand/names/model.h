// The working tables of one expansion: scopes of included files, their parameters and lets, and entities (declared resources
// and imports). They are plain data, live while expandGraph runs and point into the GraphDesc.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "engine/graph/desc.h"
#include "engine/graph/expand/names/settings.h"
#include "engine/graph/flat_graph.h"
#include "engine/graph/registry.h"
#include "engine/graph/subresource.h"
#include "engine/graph/versions/versions.h"
#include "engine/text/diagnostic.h"

namespace weft::graph::expansion {

using text::Code;

// By names that stand in the GraphDesc, or in another table of the Model, and do not move.
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

struct Parameter : ParameterState {
  const ParameterDesc* desc = nullptr;
  const Scope* scope = nullptr;
  bool named = false;  // some expression reads it, or a pass declares it
};

struct Let {
  const NamedExpr* desc = nullptr;
  Scope* scope = nullptr;
  std::string path;
  Progress state = Progress::fresh;
  Value value;                     // when done
  bool dynamic = false;            // contains age(), perhaps through another let
  bool watched = false;            // contains a value of an import, perhaps through another let
  std::optional<Expr> folded;      // of a dynamic one, after all passes are known
  bool live = false;               // watched, or reads a live parameter, perhaps through another let
  std::optional<Expr> liveFolded;  // of a live let, and of a dynamic one when there are live ones
  bool structural = false;
  bool named = false;  // some expression reads it
};

// The versions of one array element of a texture or buffer while passes are walked in declared order.
struct Element {
  std::uint32_t resource = kNone;  // the current FlatResource; Model::versions knows who wrote it
  std::uint32_t count = 0;         // FlatResources made so far
  bool zeroUsed = false;           // version zero was read or modified
};

struct Entity {
  ResourceDesc::Kind kind = ResourceDesc::Kind::texture;
  const ResourceDesc* desc = nullptr;  // null: one of Model::imports
  Scope* scope = nullptr;              // where it is declared
  std::string name;                    // "ibl.brdf", "@environment"
  // Of what it is by its kind: the shape, what is bound to the input, or what the list names.
  Progress state = Progress::fresh;
  FlatResource shape;  // texture and buffer: of every FlatResource of it. import: what the registry says.
  Value clear, first;
  std::uint32_t arrayCount = 0;         // 0: not an array
  std::uint16_t writtenMips = 1;        // as the file says, before the clamp to the size
  std::uint32_t depth = 0;              // of the history
  std::vector<std::uint32_t> inputs{};  // that stand for it and ask for a history
  const RefDesc* firstRef = nullptr;    // what is read in place of `first`, in the names of firstScope
  Scope* firstScope = nullptr;
  FlatUse firstUse{.resource = kNone};  // of it, once some pass reads it
  std::uint32_t import = kNone;         // index into FlatGraph::imports
  bool exists = true;                   // imports only
  bool fallback = false;                // imports only: a plain read may do without
  double count = 0;                     // imports only
  std::uint32_t bound = kNone;          // input: what it stands for
  const RefDesc* sample = nullptr;      // how it is sampled; of an input also what is bound to it may say so
  std::uint32_t emptied = kNone;        // into Model::emptied: one that would write it
  std::vector<std::uint32_t> candidates;  // alternatives: parallel to desc->alternatives; kNone: unknown
  std::vector<const RefDesc*> samples{};  // parallel: how each is sampled
  std::vector<Element> elements;
  std::uint32_t firstRead = kNone;  // the first position at which some slot names it
  // Some reference or expression names it, whatever the conditions say now; by @-n.
  bool named = false, lookedBackAt = false;
  // A texture or buffer of the graph.
  bool isOwn() const { return kind == ResourceDesc::Kind::texture || kind == ResourceDesc::Kind::buffer; }
};

// One file instance.
struct Scope {
  const GraphDesc* desc = nullptr;
  Scope* parent = nullptr;
  const PassDesc* stanza = nullptr;     // the include in the parent
  std::string prefix;                   // "" or "post."
  KnownNames<std::uint32_t> resources;  // entities
  // Parameters, lets, and parameters of passes, "composite.fog"; those of the files that are included below, "post.exposure".
  KnownNames<Variable> variables;
  // Of the files below by the end of their names, as far as somebody asked.
  mutable std::map<std::string, Variable, std::less<>> meant;
  KnownNames<Scope*> includes;
  KnownNames<const PassDesc*> passes;
  // Imports with their defaults, by type: of the root all, else of those whose defaults see from the file's camera. Entities.
  KnownNames<std::uint32_t> imports;
  Progress screenState = Progress::fresh;
  std::array<std::uint32_t, 2> screen{1, 1};  // of an include that says it, when done
  std::string disabledBy;                     // "--disable post"; empty: not disabled
  bool broken = false;  // an include below it could not be read: names it does not know may be from there
};

// What --disable matched.
struct DisableRule {
  std::string why;       // "--disable fxaa"
  std::string instance;  // full instance name, or empty: all repeats
};

// What is used of a texture, buffer or import: elements of an array, and a rectangle of each.
struct Part {
  std::uint32_t entity = kNone, firstElement = 0, elementCount = 1;
  FlatUse use;  // everything but the resource
  bool overlaps(const Part& other) const {
    return entity == other.entity && firstElement < other.firstElement + other.elementCount &&
           other.firstElement < firstElement + elementCount && overlap(use, other.use);
  }
};

// A write of a pass, enabled or not, in declared order: for messages that say which pass would have written something.
struct WriteRecord : Part {
  std::uint32_t position = 0;
  std::uint32_t pass = kNone;      // of FlatGraph::passes when enabled
  std::uint32_t disabled = kNone;  // of FlatGraph::disabled otherwise
  bool whole = false;
  bool passesOn = false;  // the pass reads or modifies the same: it needs another to have written it before
};

// A read or write that is not in the graph. It would be there if a pass or a condition that is switched off now were not, or
// if there were something to read.
struct WouldUse : Part {
  enum class Why : std::uint8_t {
    off,    // of a disabled pass, or its condition is false
    empty,  // an optional slot or an alternative that nothing wrote so far
    zero    // it reads what "clear" says: nothing wrote it so far
  };
  Why why = Why::off;
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
  std::string unbound{};  // the input to which nothing is bound, where that is why
};

struct Model {
  const GraphDesc& desc;
  const Registry& registry;
  const Settings& settings;
  text::Diagnostics& diagnostics;
  FlatGraph graph{};
  VersionWalk versions{graph};
  // None of these moves.
  std::deque<Scope> scopes{};  // scopes[0] is the root
  std::deque<Parameter> parameters{};
  std::deque<Let> lets{};
  std::deque<Entity> entities{};
  std::size_t sets = 0;                                       // values in "set", of all files
  std::vector<std::uint32_t> importResource{};                // per import: its FlatResource or kNone
  KnownNames<std::vector<std::uint32_t>> parametersByLeaf{};  // all of one name, in any file, in their order
  std::unordered_map<std::string, std::vector<DisableRule>> disables{};  // by declared name
  std::vector<WriteRecord> writes{};
  std::vector<WouldUse> would{};  // by position
  std::vector<MissingRead> missing{};
  std::vector<EmptyRepeat> emptied{};
  std::vector<std::array<std::uint32_t, 3>> historyUses{};  // use, entity, element: of the last resource
  std::vector<std::uint32_t> positionOf{};                  // per pass of the FlatGraph
  struct ElementOf {
    std::uint32_t entity, element;
  };
  std::vector<ElementOf> elementOf{};  // per FlatResource
  // What names of `name.…` begin with where the file includes nothing under it: one report is enough.
  std::set<std::pair<const Scope*, std::string>> unincluded{};
  std::deque<Expr> matrixColumns{};  // of parameters that are a matrix of an import
  // What the files ask for and nothing has, once for each use: resources in the scope that should have them, variables and passes of
  // "$pass.parameter" in the scope that asks. Of a dotted name the first part.
  struct Asked {
    enum class Kind : std::uint8_t { resource, variable, pass };
    Kind kind;
    Scope* scope;
    std::string_view name;
  };
  std::vector<Asked> asked{};
  std::deque<std::string> misspelt{};  // names that files use of what is declared under a misspelt one
  bool mended = false;                 // mendDeclarations() was called
  bool incomplete = false;             // the reader left something out for its mistakes
  // What passes with mistakes would write: entities; kNone when nobody knows. Whoever misses it makes no second mistake.
  std::set<std::uint32_t> leftOut{};
  bool toInclude = false;                 // the file that was opened has inputs: its own names are not all
  std::uint32_t position = 0;             // of the instance being expanded
  std::uint32_t slot = kNone;             // of it, while it is resolved
  std::vector<std::string> evaluating{};  // what is being evaluated now, for the path of a cycle
  bool stopped = false;                   // a bound was exceeded and reported: nothing more is expanded
};

bool isOver(const Model& model);  // nothing more is worth expanding
// W201: more than a bound allows, of `counts`. Ends the expansion.
void stopAt(Model& model, const Where& place, std::string message, std::uint64_t bound, const char* counts);

// Reports an error; returns false, so that a check can end with it.
template <class... Args>
bool report(Model& model, text::Saying<Args...> what, const Where& place, Args&&... args) {
  model.diagnostics.error<Args...>(what, place, std::forward<Args>(args)...);
  return false;
}
// The same where the sentence was checked before.
template <class... Own, class... Args>
bool reportChecked(Model& model, text::SentenceFor<Own...> what, const Where& place, const Args&... args) {
  model.diagnostics.add(text::Severity::error,
                        text::diagnosticOf(what.sentence, fmt::make_format_args(args...)), place);
  return false;
}
template <class... Args>
void warn(Model& model, text::Saying<Args...> what, const Where& place, Args&&... args) {
  model.diagnostics.warning<Args...>(what, place, std::forward<Args>(args)...);
}

// Lives while a definition (a let, a size, what an input stands for, a list of alternatives) is evaluated for another.
// `state` is that of the definition. It is not good when the definition is being evaluated already (W050: "a -> b -> a"), or
// when too many wait for each other, which would end the stack (W201). Then the state is `failed`.
class Evaluation {
 public:
  static constexpr std::uint32_t kMax = 32;
  Evaluation(Model& model, Progress& state, std::string label, const Place& place, std::size_t most = kMax);
  ~Evaluation();
  Evaluation(const Evaluation&) = delete;
  Evaluation& operator=(const Evaluation&) = delete;
  bool good() const { return good_; }

 private:
  Model& model_;
  bool good_;
};

// Whether a reference names a whole resource of this frame, perhaps by a condition.
inline bool isWhole(const RefDesc& ref) {
  return !ref.selects() && ref.history == 0 && ref.wordsSize == 0 && !ref.optional;
}

}  // namespace weft::graph::expansion
