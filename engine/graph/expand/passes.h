// From stanzas to passes of the FlatGraph: the walk over all passes in declared order (passes.cpp), the slots of an instance
// (slots.cpp), what is checked of uses and passes (checks.cpp), of stanzas, and what the executor needs besides (spec.cpp).
// Missing versions are only recorded; judge.h decides which are errors.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/graph/expand/names/names.h"

namespace weft::graph::expansion {

// Of a graph, each instance of a repeat counted; `--limit` raises them.
constexpr std::uint64_t kMaxPasses = 4096;
// Slots, parameters and defines of a pass; of all passes, and the versions that they read.
constexpr std::uint64_t kMaxSlotsOfPass = 1024;
constexpr std::uint64_t kMaxSlots = std::uint64_t{1} << 18;

// A uniform or "instances" that contains age() or live parameters: it is folded when all versions are known.
struct DeferredUniform {
  std::uint32_t pass = 0;
  std::uint32_t uniform = kNone;  // kNone: "instances"
  const Expr* expr = nullptr;
  Scope* scope = nullptr;  // in which, with the indices, the expression is evaluated
  std::vector<Names::Index> indices{};
};

// Fills passes, uses, slots, specs and disabled.
void expandPasses(Model& model, std::vector<DeferredUniform>& deferred);

// ---- slots ----

// Selectors with numbers in place of expressions; an end left open is filled in when the shape is known.
struct Selection {
  struct Span {
    std::int64_t first = 0, last = 0;
    bool openLast = false;
    Place place;
  };
  enum Part : std::uint8_t { level, layer, face, element };
  std::array<std::optional<Span>, 4> parts;  // by Part
  bool stencil = false;
};

// One concrete thing a reference may mean.
struct Leaf {
  std::uint32_t entity = kNone;
  Selection selection;
  std::optional<Kind> kind;
  const RefDesc* sampling = nullptr;  // what says, nearest to the use, how it is sampled
  int history = 0;                    // n of @-n, of the reference and of the alternatives on the way
  bool conditional = false;           // it stands in a list, with a condition
  bool off = false;                   // that, or one on the way, is false
};

// A slot of one pass instance.
struct SlotWork : Part {
  enum class State : std::uint8_t {
    connected,
    absent,   // optional without a version
    missing,  // required, but nothing is there: a MissingRead was recorded or will be
    empty,    // levels that the clamp to the size took away, or `1..` of one level: the pass is left out
    failed    // reported
  };
  const SlotDesc* slot = nullptr;
  State state = State::failed;
  bool array = false;                 // the whole of an array
  bool whole = false;                 // no selector: all sub-resources
  const RefDesc* sampling = nullptr;  // where `sampler` is said
  Sampler sampler;
  BorderColor border{};
  // The index of the slot, a history, in whose place it is read as long as there is no publication.
  std::size_t firstOf = ~std::size_t{0};

  bool isConnected() const { return state == State::connected; }
  bool reads() const { return slot->access == Access::read; }
};

struct SlotContext {
  Model& model;
  Names& names;             // of the pass instance
  const PassType* type;     // null: present, outputs, resets
  std::string_view user;    // "output 'x'"; of a pass "", which its name says
  const std::string& pass;  // "glow_down[3]"
  bool versions = true;     // false: a disabled pass; the first candidate is validated
  bool ranges = true;       // false: sub-resource ranges are not held against sizes
  bool quiet = false;       // report() says nothing

  // Reports a mistake of the pass: "pass 'glow_down[3]' MESSAGE". Returns false.
  template <class... Args>
  bool report(text::Saying<Args...> what, const Place& place, Args&&... args) const {
    return !quiet && report(text::diagnosticOf(what.sentence, fmt::make_format_args(args...)), place);
  }
  // The same where the sentence was checked before.
  template <class... Own, class... Args>
  bool reportChecked(text::SentenceFor<Own...> what, const Place& place, const Args&... args) const {
    return !quiet && report(text::diagnosticOf(what.sentence, fmt::make_format_args(args...)), place);
  }
  bool report(text::Diagnostic said, const Place& place) const;
};

// Resolves one slot: from a reference as written to the texture, buffer or import it means and the sub-resources it selects,
// with alternatives chosen by condition and version. Reads and modifies look for versions; a required slot without one is
// recorded in model.missing (with `pass` as its pass) and comes back as `missing`.
SlotWork resolveSlot(const SlotContext& context, const SlotDesc& slot, std::uint32_t pass);
// For `work`, a slot that reads @-n, where "first" of the resource names a texture or buffer: the same part of that, read in the
// same way, as long as the publication is not there. Not `connected` when "first" is a value, when its "?" left nothing, and
// after a report. `slot` is filled in.
SlotWork resolveFirst(const SlotContext& context, const SlotWork& work, std::uint32_t pass, SlotDesc& slot);

// ---- checks: they report mistakes and change nothing ----

// What is checked once per stanza: type, keys, slots of fixed types, draw list, geometry, cadence, expressions in branches not
// taken. (That slots, parameters and defines share one namespace is the reader's.)
bool checkStanza(const SlotContext& context, const PassDesc& desc);
bool isInteger(Format format);
// Not an attachment of a draw, of which only what its geometry covers is drawn, or of a pass with a viewport.
bool coversAll(const PassType* type, const PassDesc& desc, const SlotWork& work);
// The kind of a use whose reference names none.
Kind defaultKind(const PassType* type, Access access, const FlatResource& shape);
// Checks one use: its kind must fit the resource, the access, the pass type and the format; sampler words must fit.
bool checkUse(const SlotContext& context, const RefDesc& ref, Access access, const SlotWork& work);
// Checks that the resource remembers as much as `ref` asks for, x@-`history`.
bool checkHistory(const SlotContext& context, const RefDesc& ref, int history, const Entity& entity);
// Checks all uses of one pass: attachments must have one size, layer count and sample count; nothing may be written
// twice; nothing may be both read and written, except by feedback.
bool checkPassUses(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots);
// An `always` pass must not modify what a slower one made: it would add to it again in every frame. `firstUse` is the
// first of the slot's uses in the graph.
void checkAccumulation(const SlotContext& context, const SlotWork& work, std::uint32_t firstUse);

// ---- what the executor needs besides: state, defines, uniforms, threads, draw list, geometry and view ----

void fillState(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
               StateSpec& state);
// Fills everything of `spec`, of `pass`, but names, slots and the values of uniforms whose expression contains age().
// `deferred` gets those that may change without another plan.
void fillSpec(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              PassSpec& spec, std::uint32_t pass, std::vector<DeferredUniform>& deferred);

}  // namespace weft::graph::expansion
