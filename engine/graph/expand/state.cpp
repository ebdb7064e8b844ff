#include "engine/graph/expand/state.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/chars.h"
#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/graph/expand/checks.h"

namespace weft::graph::expansion {

namespace {

// `said`, in small letters, is none of the words of this state.
std::string hintForState(bool test, std::string said, const std::vector<std::string>& words) {
  const bool off = said == "off" || said == "false" || said == "disabled";
  if (test && off) return "write 'always': depth is written and not tested";
  if (test && said == "true") return "write 'greater', by which the nearer surface wins: depth is reversed";
  const std::string foreign = base::hintForForeign(base::Foreign::state_word, said);
  return foreign.empty() || off ? base::nearestHint(off ? "none" : said, words) : foreign;
}

class StateFiller {
 public:
  StateFiller(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
              StateSpec& state)
      : context_(context), desc_(desc), slots_(slots), state_(state) {}

  void run() {
    for (const NamedExpr& each : desc_.state) add(each);
    checkDepth();
    checkBlends();
    checkFaces();
    checkCover();
  }

 private:
  base::Diagnostic& error(Code code, const Place& place, std::string message) {
    base::Diagnostic& d =
        context_.model.diagnostics.error(code, place, fmt::format("{} {}", context_.user, message));
    d.pass = context_.pass;
    return d;
  }

  const NamedExpr* find(std::string_view name) const {
    const auto found = std::ranges::find(desc_.state, name, &NamedExpr::name);
    return found == desc_.state.end() ? nullptr : &*found;
  }

  // ---- the keys ----

  // Index among the words of the key, or -1 after a report.
  int word(const NamedExpr& said) {
    const std::string_view key = std::string_view(said.name).substr(0, said.name.find('.'));
    const auto& known = std::ranges::find(kStateKeys, key, &KeySpec::key)->words;
    const std::vector<std::string> words(known.begin(), known.end());
    const Value value = said.expr.evaluate(context_.names, context_.model.diagnostics);
    if (value.type == Value::Type::none) return -1;
    if (value.type == Value::Type::symbol)
      for (std::size_t i = 0; i < words.size(); ++i)
        if (words[i] == value.symbol) return static_cast<int>(i);
    std::string all;
    for (const std::string& w : words) all += (all.empty() ? "" : ", ") + w;
    auto& d = error(Code::badState, said.expr.place(),
                    fmt::format("has an unknown value for the state '{}'", said.name));
    d.expected = all;
    d.found = toText(value);
    d.hint = hintForState(said.name == "depth_test", base::lowered(d.found), words);
    return -1;
  }

  bool isColorSlot(const std::string& name) const {
    for (const SlotWork& work : slots_)
      if (work.slot->name == name && work.slot->access != Access::read)
        return work.entity == kNone || work.use.kind == Kind::color;
    return false;
  }

  void addBlend(const NamedExpr& said) {
    std::vector<std::string> colors;
    for (const SlotWork& work : slots_)
      if (isColorSlot(work.slot->name)) colors.push_back(work.slot->name);
    const std::string slot = said.name == "blend" ? "" : said.name.substr(6);
    if (!slot.empty() && !isColorSlot(slot)) {
      if (std::exchange(blendTold_, true)) return;
      auto& d =
          error(Code::badState, said.place, fmt::format("blends '{}', which is no colour slot of it", slot));
      d.expected = "one word, \"blend\": \"alpha\", or one for each colour slot";
      d.hint = base::hintForForeign(base::Foreign::state_key, slot);
      if (d.hint.empty()) d.hint = base::nearestHint(slot, colors);
      return;
    }
    const int found = word(said);
    if (found < 0) return;
    const auto blend = static_cast<Blend>(found);
    if (!slot.empty()) return setBlend(slot, blend);
    for (const std::string& color : colors) setBlend(color, blend);
    if (colors.empty() && blend != Blend::none)
      error(Code::badState, said.place, "blends, and has no colour slot").hint =
          "leave \"blend\" out, or say \"modify\": { \"result\": … } with a colour texture";
  }

  void setBlend(const std::string& slot, Blend blend) {
    for (auto& [name, old] : state_.blend)
      if (name == slot) {
        old = blend;
        return;
      }
    state_.blend.emplace_back(slot, blend);
  }

  void add(const NamedExpr& said) {
    if (said.name == "blend" || said.name.starts_with("blend.")) {
      addBlend(said);
    } else if (said.name == "depth_test") {
      if (const int found = word(said); found >= 0) {
        state_.depthTest = true;
        state_.depthCompare = static_cast<Compare>(found);
      } else {
        failed_ = true;
      }
    } else if (said.name == "depth_write") {
      state_.depthWrite =
          evaluateCondition(context_.names, said.expr, true, "the state 'depth_write'").value_or(true);
    } else if (said.name == "cull") {
      if (const int found = word(said); found >= 0) state_.cull = static_cast<Cull>(found);
    } else if (said.name == "polygon") {
      state_.lines = word(said) == 1;
    } else if (said.name == "offset") {
      const Value value = said.expr.evaluate(context_.names, context_.model.diagnostics);
      if (value.type == Value::Type::list && value.count == 2) {
        state_.offsetFactor = value.v[0];
        state_.offsetUnits = value.v[1];
      } else if (value.type != Value::Type::none) {
        auto& d = error(Code::badState, said.expr.place(), "has an unknown value for the state 'offset'");
        d.expected = "[factor, units]";
        d.found = toText(value);
      }
    } else {
      static const std::vector<std::string> kKeys = {"blend", "depth_test", "depth_write",
                                                     "cull",  "polygon",    "offset"};
      error(Code::badState, said.place, fmt::format("has the unknown state '{}'", said.name)).hint =
          base::nearestHint(said.name, kKeys);
    }
  }

  // ---- what would do nothing ----

  void checkDepth() {
    const SlotWork *depth = nullptr, *writable = nullptr;
    for (const SlotWork& work : slots_) {
      if (work.entity == kNone) return;  // reported
      if (work.use.kind != Kind::depth) continue;
      depth = &work;
      if (work.slot->access != Access::read) writable = &work;
    }
    if (!depth) {
      for (const char* key : {"depth_test", "depth_write", "offset"})
        if (const NamedExpr* said = find(key)) {
          auto& d =
              error(Code::badState, said->place,
                    fmt::format("{} but has no depth attachment",
                                said->name == "depth_test" ? "tests depth" : "says '" + said->name + "'"));
          d.hint =
              "add a slot such as \"modify\": { \"depth\": \"depth\" } or \"read\": { \"test\": \"depth as "
              "depth\" }, or leave it out";
          return;
        }
      return;
    }
    if (failed_) return;
    if (!find("depth_test")) {
      auto& d =
          error(Code::badState, depth->slot->place,
                fmt::format("has the depth slot '{}' and no \"depth_test\": depth would be neither tested "
                            "nor written",
                            depth->slot->name));
      d.resource = context_.model.entities[depth->entity].name;
      d.expected = "\"state\": { \"depth_test\": … }";
      d.hint =
          "write \"depth_test\": \"greater\", by which the nearer surface wins (depth is reversed), or "
          "\"always\" to write depth without a test";
      return;
    }
    const NamedExpr* write = find("depth_write");
    if (write && state_.depthWrite && !writable)
      error(Code::badState, write->place,
            fmt::format("writes depth, and its depth slot '{}' is only read", depth->slot->name))
          .hint = fmt::format("move '{}' from \"read\" to \"modify\", or leave \"depth_write\" out",
                              depth->slot->name);
    const bool idle = find("depth_test")->expr.text() == "always" &&
                      (!writable || (write && write->expr.isConstant() && !state_.depthWrite));
    if (idle)
      error(Code::badState, depth->slot->place,
            fmt::format("neither tests nor writes the depth of its slot '{}'", depth->slot->name))
          .hint =
          "write \"depth_test\": \"greater\", by which the nearer surface wins (depth is reversed), or "
          "leave the slot out";
  }

  void checkBlends() {
    for (const auto& [name, blend] : state_.blend) {
      if (blend == Blend::none) continue;
      const auto work = std::ranges::find(
          slots_, name, [](const SlotWork& each) -> const std::string& { return each.slot->name; });
      if (work == slots_.end() || work->entity == kNone) continue;
      const Entity& entity = context_.model.entities[work->entity];
      const NamedExpr* said = find("blend." + name);
      const Place& place = (said ? said : find("blend"))->place;
      if (isInteger(entity.shape.format)) {
        auto& d = error(Code::badState, place,
                        fmt::format("blends '{}' into '{}', whose format {} does not blend", name,
                                    entity.name, infoOf(entity.shape.format).name));
        d.resource = entity.name;
        d.hint = fmt::format("write \"blend\": {{ \"{}\": \"none\" }}, or give '{}' a format that blends",
                             name, entity.name);
      } else if (work->slot->access == Access::write && context_.type->shader == ShaderShape::fragment) {
        auto& d =
            error(Code::badState, work->slot->place,
                  fmt::format("blends '{}' into '{}' and says \"write\": nothing is there to blend with",
                              name, entity.name));
        d.resource = entity.name;
        d.expected = fmt::format("\"modify\": {{ \"{}\": \"{}\" }}", name, work->slot->ref.text);
        d.hint = fmt::format("say \"modify\", or leave \"blend\" out of '{}'", name);
      }
    }
  }

  // The one triangle of a fullscreen pass has no back, and is filled.
  void checkFaces() {
    if (context_.type->shader != ShaderShape::fragment) return;
    for (const NamedExpr& said : desc_.state)
      if ((said.name == "cull" && state_.cull != Cull::none) || (said.name == "polygon" && state_.lines))
        error(Code::badState, said.place,
              fmt::format("has the state '{}', and covers the picture with one triangle", said.name))
            .hint = fmt::format("leave \"{}\" out: it is for draws", said.name);
  }

  void checkCover() {
    for (const SlotWork& work : slots_) {
      if (work.entity == kNone || work.slot->access != Access::write || coversAll(context_.type, work))
        continue;
      const Entity& entity = context_.model.entities[work.entity];
      if (entity.shape.hasClear) continue;
      auto& d =
          error(Code::badSlots, work.slot->place,
                fmt::format("draws '{}' and says \"write\", but a draw covers what its geometry covers, and "
                            "'{}' has no \"clear\" for the rest",
                            work.slot->name, entity.name));
      d.resource = entity.name;
      d.expected =
          fmt::format("\"clear\" in '{}'; or \"modify\": {{ \"{}\": \"{}\" }}, to draw over what is there",
                      entity.name, work.slot->name, work.slot->ref.text);
      d.hint = fmt::format(
          "give '{}' a \"clear\"; to cover all of it, let a fullscreen pass write it, which may have "
          "a vertex shader of its own",
          entity.name);
      return;
    }
  }

  const SlotContext& context_;
  const PassDesc& desc_;
  const std::vector<SlotWork>& slots_;
  StateSpec& state_;
  bool failed_ = false, blendTold_ = false;
};

}  // namespace

void fillState(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
               StateSpec& state) {
  StateFiller(context, desc, slots, state).run();
}

}  // namespace weft::graph::expansion
