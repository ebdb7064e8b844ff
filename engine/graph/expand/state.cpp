// The fixed-function state of a pass: from "state" and the slots that it is for. Declared in passes.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>

#include "engine/graph/expand/passes.h"
#include "engine/graph/language/keys.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"
#include "graph_sentences.h"

namespace weft::graph::expansion {

namespace {

struct StateFiller {
  const SlotContext& context;
  const PassDesc& desc;
  const std::vector<SlotWork>& slots;
  StateSpec& state;
  bool failed = false;

  void fill() {
    for (const NamedExpr& each : desc.state)
      if (!failed) add(each);
    if (failed) return;
    settleDepth();
    checkStencil();
    checkColors();
    checkSamples();
    checkCover();
  }

  template <class... Args>
  void error(text::Saying<Args...> what, const Place& place, Args&&... args) const {
    context.report<Args...>(what, place, std::forward<Args>(args)...);
  }
  const NamedExpr* find(std::string_view name) const { return findNamed(desc.state, name); }

  // The first that is said of a key with keys of its own: "stencil".
  const NamedExpr* findWithin(const std::string& key) const {
    const auto found = std::ranges::find_if(
        desc.state, [&](const NamedExpr& each) { return each.name.starts_with(key + '.'); });
    return found == desc.state.end() ? find(key) : &*found;
  }

  void refuse(const NamedExpr& said, const Value& value, std::string expected, std::string hint = "") {
    failed = true;
    if (value.type != Value::Type::none)  // reported
      error(say::unknownStateWord, said.expr.place(), said.name, expected, toText(value), hint);
  }

  // Index among the words of the key; 0 after a report.
  int word(const NamedExpr& said) {
    const auto known = stateWords(said.name);
    const std::vector<std::string> words(known.begin(), known.end());
    const Value value = said.expr.evaluate(context.names, context.model.diagnostics);
    const auto found = std::ranges::find(words, value.symbol);
    if (value.type == Value::Type::symbol && found != words.end())
      return static_cast<int>(found - words.begin());
    const std::string text = toText(value);
    refuse(said, value, fmt::format("{}", fmt::join(words, ", ")),
           said.name.starts_with("blend.") && words.size() != kBlends.size()  // a factor, no whole blend
               ? text::nearestHint(text::lowered(text).substr(text.starts_with("GL_") ? 3 : 0), words)
               : text::hintOrNearest("state_word", text, words));
    return 0;
  }
  template <class Enum>
  void take(const NamedExpr& said, Enum& value) {
    value = static_cast<Enum>(word(said));
  }
  template <class Number>
  void takeWhole(const NamedExpr& said, Number& value, std::int64_t most) {
    const auto whole =
        evaluateWhole(context.names, said.expr, 0, 0, most, fmt::format("the state '{}'", said.name));
    failed = failed || !whole;
    value = static_cast<Number>(whole.value_or(0));
  }
  void take(const NamedExpr& said, bool& value) {
    value = evaluateCondition(context.names, said.expr, true, fmt::format("the state '{}'", said.name))
                .value_or(value);
  }
  // A list of so many numbers as `into` has.
  void takeList(const NamedExpr& said, std::span<double> into, const char* expected) {
    const Value value = said.expr.evaluate(context.names, context.model.diagnostics);
    std::copy_n(value.v.begin(), into.size(), into.begin());
    if (value.type != Value::Type::list || value.count != into.size()) refuse(said, value, expected);
  }

  // The letters of the channels that are written, or "none".
  std::uint8_t maskOf(const NamedExpr& said) {
    const Value value = said.expr.evaluate(context.names, context.model.diagnostics);
    std::uint8_t mask = 0;
    bool good = value.type == Value::Type::symbol;
    for (const char letter : value.symbol == "none" ? "" : value.symbol) {
      const auto channel = std::string_view("rgba").find(letter);
      good = good && channel != std::string_view::npos && (mask >> channel & 1) == 0;
      if (good) mask = static_cast<std::uint8_t>(mask | 1u << channel);
    }
    if (!good) refuse(said, value, "the channels that are written: \"rgb\", \"a\", …, or \"none\"");
    return mask;
  }

  // "blend" and "color_mask", of all color slots or of one, and the factors of one.
  void addColor(const NamedExpr& said) {
    std::vector<std::string> colors;
    for (const SlotWork& work : slots)
      if (!work.reads() && (work.entity == kNone || work.use.kind == Kind::color))
        colors.push_back(work.slot->name);
    const std::size_t dot = said.name.find('.'), second = said.name.find('.', dot + 1);
    const bool masks = said.name.starts_with("color_mask"), all = dot == std::string::npos,
               factor = !all && second != std::string::npos;
    const std::string slot = all ? "" : said.name.substr(dot + 1, second - dot - 1);
    const bool known = all || std::ranges::find(colors, slot) != colors.end();
    ColorState given;
    if (known && masks) given.mask = maskOf(said);
    if (known && !masks && !factor) given.blend = kBlends[static_cast<std::size_t>(word(said))];
    if (!known || (colors.empty() && given != ColorState{})) {
      failed = true;
      return error(say::noColorSlot, said.place, masks ? "masks" : "blends", slot,
                   text::hintOrNearest("state_key", slot, colors));
    }
    if (!all) colors = {slot};
    for (const std::string& color : colors) {
      auto at = std::ranges::find(state.colors, color, [](const auto& each) { return each.first; });
      if (at == state.colors.end()) at = state.colors.insert(at, {color, {}});
      if (masks)
        at->second.mask = given.mask;
      else if (factor)
        addFactor(said, said.name.substr(second + 1), at->second.blend);
      else
        at->second.blend = given.blend;
    }
  }

  // What is said of colors holds for alpha, too, unless that is said apart.
  void addFactor(const NamedExpr& said, std::string key, Blend& blend) {
    const std::string end = "_alpha", apart = said.name + end;
    const bool alpha = key.ends_with(end);
    if (alpha) key.resize(key.size() - end.size());
    BlendPart& part = alpha ? blend.alpha : blend.color;
    const auto set = [&](auto BlendPart::*member) {
      take(said, part.*member);
      if (!alpha && !find(apart)) blend.alpha.*member = part.*member;
    };
    if (key == "source") set(&BlendPart::source);
    if (key == "destination") set(&BlendPart::destination);
    if (key == "equation") set(&BlendPart::equation);
  }

  // What is said of front faces holds for back faces, too, unless that is said apart.
  void addStencil(const NamedExpr& said, const std::string& key) {
    if (!state.stencil) state.stencil.emplace();
    StencilState& stencil = *state.stencil;
    if (key == "reference") return takeWhole(said, stencil.reference, 255);
    if (key == "read_mask") return takeWhole(said, stencil.readMask, 255);
    if (key == "write_mask") return takeWhole(said, stencil.writeMask, 255);
    const bool back = key.starts_with("back.");
    const std::string own = back ? key.substr(5) : key;
    const auto set = [&](auto StencilFace::*member) {
      StencilFace& face = back ? stencil.back : stencil.front;
      take(said, face.*member);
      if (!back && !find("stencil.back." + own)) stencil.back.*member = face.*member;
    };
    if (own == "test") set(&StencilFace::test);
    if (own == "fail") set(&StencilFace::fail);
    if (own == "depth_fail") set(&StencilFace::depthFail);
    if (own == "pass") set(&StencilFace::pass);
  }

  void add(const NamedExpr& said) {
    const std::string key = said.name.substr(0, said.name.find('.'));
    if (key == "blend" || key == "color_mask") {
      addColor(said);
    } else if (key == "stencil") {
      addStencil(said, said.name.substr(key.size() + 1));
    } else if (key == "depth_test") {
      state.depthTest = true;
      take(said, state.depthCompare);
    } else if (key == "depth_write") {
      take(said, state.depthWrite);
    } else if (key == "depth_clamp") {
      take(said, state.depthClamp);
    } else if (key == "alpha_to_coverage") {
      take(said, state.alphaToCoverage);
    } else if (key == "sample_mask") {
      takeWhole(said, state.sampleMask.emplace(), 0xffffffff);
    } else if (key == "blend_color") {
      takeList(said, state.blendColor, "[red, green, blue, alpha]");
    } else if (key == "viewport") {
      addViewport(said);
    } else if (key == "offset") {
      std::array<double, 2> offset{};
      takeList(said, offset, "[factor, units]");
      state.offsetFactor = offset[0];
      state.offsetUnits = offset[1];
    } else {
      const int found = word(said);
      if (said.name == "cull") state.cull = static_cast<Cull>(found);
      if (said.name == "polygon") state.lines = found == 1;
      // The one triangle of a fullscreen pass has no back, and is filled.
      if (found != 0 && context.type->shader == ShaderShape::fragment)
        error(say::stateForDraws, said.place, said.name);
    }
  }

  void addViewport(const NamedExpr& said) {
    constexpr double kMost = 65536;
    std::array<double, 4> sides{};
    takeList(said, sides, "[x, y, width, height] in texels");
    if (failed) return;
    for (std::size_t i = 0; i < 4; ++i) {
      sides[i] = std::floor(sides[i]);
      failed = failed || sides[i] < (i < 2 ? -kMost : 1) || sides[i] > kMost;
    }
    if (failed) context.report(say::emptyViewport, said.expr.place(), kMost, fmt::join(sides, ", "));
    state.viewport.emplace();
    for (std::size_t i = 0; i < 4; ++i) (*state.viewport)[i] = static_cast<std::int32_t>(sides[i]);
  }

  // The nearer surface wins, where a pass does not say otherwise; what it writes as a whole it does not test.
  void settleDepth() {
    const SlotWork* depth = nullptr;
    bool writable = false, known = true;  // else a slot is empty, or reported
    for (const SlotWork& work : slots) {
      known = known && work.entity != kNone;
      if (work.entity == kNone || work.use.kind != Kind::depth || (work.use.planes & 1) == 0) continue;
      depth = &work;
      writable = writable || !work.reads();
    }
    const NamedExpr *test = find("depth_test"), *write = find("depth_write"), *offset = find("offset");
    if (!depth) {
      if (const NamedExpr* said = test ? test : write ? write : offset; said && known)
        error(say::lacksDepth, said->place, said->name);
      return;
    }
    if (!test && !write && findWithin("stencil")) return;  // it is attached for its stencil
    const std::string& slot = depth->slot->name;
    if (test && write && state.depthWrite && !writable) error(say::writesReadDepth, write->place, slot);
    const bool writes = writable && !(write && write->expr.isConstant() && !state.depthWrite);
    if (!test) {
      state.depthTest = true;
      state.depthCompare = depth->slot->access == Access::write ? Compare::always : Compare::greater;
    } else if (test->expr.text() == "always" && !writes) {
      error(say::idleDepth, depth->slot->place, slot);
    }
  }

  // ---- what would do nothing ----

  void checkStencil() const {
    const SlotWork* slot = nullptr;
    for (const SlotWork& work : slots) {
      if (work.entity == kNone) return;  // reported
      if (work.use.kind == Kind::depth && (work.use.planes & 2) != 0) slot = &work;
    }
    const NamedExpr* const said = findWithin("stencil");
    const auto idle = [](const StencilFace& face) { return face.test == Compare::always && !face.writes(); };
    const auto varies = [](const NamedExpr& each) { return !each.expr.variables().empty(); };
    if (said && !slot)
      error(say::lacksStencil, said->place);
    else if (said && slot->reads() && state.stencil->writes())
      error(say::writesReadStencil, said->place, slot->slot->name);
    else if (said ? idle(state.stencil->front) && idle(state.stencil->back) &&
                        std::ranges::none_of(desc.state, varies)
                  : slot && slot->use.planes == 2)
      error(say::idleStencil, said ? said->place : slot->slot->place);
  }

  void checkColors() const {
    for (const auto& [name, color] : state.colors) {
      const auto named = [&](const SlotWork& each) { return each.slot->name == name; };
      const auto work = std::ranges::find_if(slots, named);
      const bool blends = color.blend != Blend{}, masks = color.mask != 15;
      if ((!blends && !masks) || work == slots.end() || work->entity == kNone) continue;
      const Format format = context.model.entities[work->entity].shape.format;
      if (blends && isInteger(format))
        error(say::blendsIntegers, findWithin(find("blend") ? "blend" : "blend." + name)->place, name,
              infoOf(format).name);
      else if (work->slot->access == Access::write && context.type->shader == ShaderShape::fragment)
        error(say::blendsWithNothing, work->slot->place, blends ? "blends" : "masks", name,
              blends ? "blend" : "color_mask");
    }
    const auto constant = [](const NamedExpr& each) {
      return each.expr.text().find("constant_") != std::string::npos;
    };
    if (const NamedExpr* said = find("blend_color"); said && std::ranges::none_of(desc.state, constant))
      error(say::idleBlendColor, said->place);
  }

  void checkSamples() const {
    const NamedExpr *mask = find("sample_mask"), *said = mask ? mask : find("alpha_to_coverage");
    if (desc.samples.present()) return;
    std::uint32_t samples = 1;
    for (const SlotWork& work : slots) {
      if (work.entity == kNone) return;  // reported
      if (work.use.kind != Kind::color && work.use.kind != Kind::depth) continue;
      samples = std::max<std::uint32_t>(samples, context.model.entities[work.entity].shape.samples);
    }
    if (said && samples == 1 && (mask || state.alphaToCoverage))
      error(say::oneSampleOnly, said->place, said->name);
  }

  // A draw covers what its geometry covers.
  void checkCover() const {
    for (const SlotWork& work : slots) {
      if (work.entity == kNone || work.slot->access != Access::write || coversAll(context.type, desc, work))
        continue;
      const Entity& entity = context.model.entities[work.entity];
      if (entity.shape.hasClear) continue;
      context.report(say::drawsPartOnly, work.slot->place, entity.name);
      return;
    }
  }
};

}  // namespace

void fillState(const SlotContext& context, const PassDesc& desc, const std::vector<SlotWork>& slots,
               StateSpec& state) {
  StateFiller{context, desc, slots, state}.fill();
}

}  // namespace weft::graph::expansion
