#include "engine/convert/mpv/graph.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "engine/base/json/edit.h"
#include "engine/base/nearest.h"
#include "engine/base/printable.h"
#include "engine/base/words/glsl_words.h"
#include "engine/convert/mpv/rpn.h"
#include "engine/convert/mpv/texture_data.h"
#include "engine/convert/text/json_text.h"

namespace weft::convert {

namespace {

using base::quoteJson;

// In mpv's order. The second is what a picture in place of a video has.
constexpr std::array<std::string_view, 7> kStages{"RGB",    "NATIVE",    "MAINPRESUB", "MAIN",
                                                  "SCALED", "PREOUTPUT", "OUTPUT"};
constexpr std::array<std::string_view, 12> kOtherStages{
    "LUMA",   "CHROMA",  "ALPHA",     "XYZ",        "CHROMA_SCALED", "ALPHA_SCALED",
    "LINEAR", "SIGMOID", "PREKERNEL", "POSTKERNEL", "LUMA_SCALED",   "XYZ_SCALED"};

constexpr std::size_t kMostOperators = 200;

class MpvGraphWriter {
 public:
  MpvGraphWriter(const MpvFile& file, const std::set<std::string>& used, std::string name,
                 const ConvertOptions& options, base::Diagnostics& diagnostics)
      : file_(file), used_(used), name_(std::move(name)), options_(options), diagnostics_(diagnostics) {}

  std::optional<MpvGraph> run() {
    const std::size_t errors = diagnostics_.errorCount();
    addSource();
    for (const MpvParameter& parameter : file_.parameters) addParameter(parameter);
    for (const MpvTexture& texture : file_.textures) addTexture(texture);
    checkStages();
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    for (const std::string_view stage : kStages) {
      names_[std::string(stage)] = names_["HOOKED"];
      for (std::size_t i = 0; i < file_.hooks.size(); ++i)
        for (const MpvText& hook : file_.hooks[i].hooks)
          if (hook.text == stage) addPass(i, std::string(stage));
    }
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    addShow();
    JsonObjectText graph;
    graph.addText("name", name_);
    graph.add("parameters", parameters_.text()).add("resources", resources_.text());
    graph.add("passes", "[" + passes_ + "]").addText("present", "shown");
    out_.text = graphText(graph);
    return std::move(out_);
  }

 private:
  struct Named {
    std::string resource, filter = " as linear";
    std::string width, height;            // expressions
    std::vector<std::string> conditions;  // of which all must hold, so that something wrote it
  };

  std::string fresh(std::string wanted) {
    if (base::isGlslWord(wanted)) wanted += '_';
    std::string name = wanted;
    for (int i = 2; !taken_.insert(name).second; ++i)
      name = fmt::format("{}{}{}", wanted, wanted.ends_with('_') ? "" : "_", i);
    return name;
  }

  void addPassText(const JsonObjectText& stanza) { passes_ += (passes_.empty() ? "" : ", ") + stanza.text(); }

  void addSource() {
    std::string file;
    for (const auto& [which, path] : options_.images) file = path;
    parameters_.add("picture",
                    fmt::format(R"({{"type": "file", "default": {}, "label": "Picture"}})", quoteJson(file)));
    resources_.add("picture", R"({"import": "image", "file": "$picture"})");
    // With as many bits as a PNG may have; turned over.
    resources_.add("source", R"({"texture": "rgba16", "size": "has(picture) ? size(picture) : screen"})");
    resources_.add("shown", R"({"texture": "rgba8", "size": "screen"})");
    JsonObjectText turn;
    turn.addText("name", "turn").addText("type", "fullscreen").addText("shader", name_ + "/turn.frag.glsl");
    turn.add("read", R"({"source": "picture as linear ?"})").add("write", R"({"result": "source"})");
    addPassText(turn);
    names_["HOOKED"] = {.resource = "source", .width = "size(source).x", .height = "size(source).y"};
  }

  void addParameter(const MpvParameter& parameter) {
    const bool real = parameter.type == "float";
    if (!taken_.insert(parameter.name).second || base::isGlslWord(parameter.name)) {
      diagnostics_
          .error(base::Code::notAName, parameter.place,
                 fmt::format("\"{}\" cannot name a parameter", parameter.name))
          .hint = "give it a name of its own";
      return;
    }
    JsonObjectText text;
    text.addText("type", real ? "float" : "int").add("default", numberText(parameter.initial, real));
    const double low = std::min(parameter.min.value_or(parameter.initial), parameter.initial);
    const double high = std::max(parameter.max.value_or(parameter.initial), parameter.initial);
    if (parameter.min && low < high) text.add("min", numberText(low, real));
    if (parameter.max && low < high) text.add("max", numberText(high, real));
    if (!parameter.description.empty()) text.addText("label", base::printable(parameter.description));
    parameters_.add(parameter.name, text.text());
  }

  void addTexture(const MpvTexture& texture) {
    if (texture.dimensions != 2) {
      auto& d = diagnostics_.error(base::Code::mpvNotMapped, texture.place,
                                   fmt::format("the texture '{}' has not two dimensions", texture.name));
      d.expected = "//!SIZE with a width and a height";
      d.found = fmt::format("{} dimensions", texture.dimensions);
      d.hint = "give it a height of 1, or lay its slices beside each other";
      return;
    }
    if (names_.contains(texture.name)) {
      diagnostics_
          .error(base::Code::duplicateName, texture.place,
                 fmt::format("two textures have the name '{}'", texture.name))
          .hint = "rename one";
      return;
    }
    const std::string resource = fresh(texture.name);
    resources_.add(resource, fmt::format(R"({{"import": "image", "file": {}}})",
                                         quoteJson(imagePathOf(texture, "images/" + name_))));
    std::string filter = texture.linear ? " as linear" : " as nearest";
    if (texture.repeat) filter += " wrap";
    names_[texture.name] = {.resource = resource,
                            .filter = filter,
                            .width = fmt::format("{}", texture.size[0]),
                            .height = fmt::format("{}", texture.size[1])};
  }

  // A pass needs a stage that a picture has; of several, the others are left out aloud.
  void checkStages() {
    for (const MpvHook& hook : file_.hooks) {
      const auto isStage = [](const MpvText& text) {
        return std::ranges::find(kStages, std::string_view(text.text)) != kStages.end();
      };
      const bool any = std::ranges::any_of(hook.hooks, isStage);
      for (const MpvText& text : hook.hooks) {
        if (isStage(text)) continue;
        const bool known = std::ranges::find(kOtherStages, std::string_view(text.text)) != kOtherStages.end();
        base::Diagnostic d{
            .severity = any && known ? base::Severity::warning : base::Severity::error,
            .code = base::Code::mpvNotMapped,
            .message = fmt::format("{} '{}'", known ? "a picture has no stage" : "unknown stage", text.text),
            .place = text.place};
        d.expected = "RGB, NATIVE, MAINPRESUB, MAIN, SCALED, PREOUTPUT or OUTPUT";
        std::vector<std::string> stages(kStages.begin(), kStages.end());
        d.hint = !known ? base::nearestHint(text.text, stages)
                 : any  ? "the pass runs at its other stages"
                        : "hook MAIN where the shader works on colours, too";
        diagnostics_.add(std::move(d));
      }
    }
  }

  const Named* find(const std::string& name) const {
    const auto found = names_.find(name);
    return found == names_.end() ? nullptr : &found->second;
  }

  std::optional<std::string> expressionOf(const MpvText& text) {
    return convertRpn(text,
                      {.sideOf = [&](std::string_view name, bool width) -> std::string {
                         if (name == "OUTPUT") return width ? "screen.x" : "screen.y";
                         const Named* named = find(std::string(name));
                         return !named ? "" : width ? named->width : named->height;
                       },
                       .parameterOf = [&](std::string_view name) -> std::string {
                         const bool known = std::ranges::any_of(
                             file_.parameters, [&](const MpvParameter& p) { return p.name == name; });
                         return known ? "$" + std::string(name) : std::string();
                       }},
                      diagnostics_);
  }

  static void require(std::vector<std::string>& all, const std::string& condition) {
    if (std::ranges::find(all, condition) == all.end()) all.push_back(condition);
  }
  static std::string joined(const std::vector<std::string>& all) {
    return all.size() == 1 ? all[0] : all.empty() ? "" : fmt::format("({})", fmt::join(all, ") && ("));
  }
  // At least as many as Weft counts in the expression.
  static std::size_t operatorsIn(std::string_view expression) {
    return static_cast<std::size_t>(std::ranges::count_if(expression, [](char c) {
      return std::string_view("+-*/%<>=!&|?:(,").find(c) != std::string_view::npos;
    }));
  }

  void addPass(std::size_t index, const std::string& stage) {
    const MpvHook& hook = file_.hooks[index];
    const Named hooked = names_["HOOKED"];
    std::vector<std::string> conditions;
    JsonObjectText reads;
    for (const MpvText& bind : hook.binds) {
      const Named* named = bind.text == stage ? &hooked : find(bind.text);
      if (!named) {
        auto& d = diagnostics_.error(base::Code::mpvNotMapped, bind.place,
                                     fmt::format("nothing has saved a texture '{}' here", bind.text));
        d.expected = "HOOKED, a stage that has run, a //!SAVE of a pass before, or a //!TEXTURE";
        std::vector<std::string> known;
        for (const auto& [name, unused] : names_) known.push_back(name);
        d.hint = base::nearestHint(bind.text, known);
        return;
      }
      if (!used_.contains(bind.text)) continue;
      // The shader knows a texture of the file by its own name.
      const bool ofFile =
          std::ranges::any_of(file_.textures, [&](const MpvTexture& t) { return t.name == bind.text; });
      reads.addText(ofFile ? bind.text : bind.text + "_raw", named->resource + named->filter);
      (ofFile ? out_.textures : out_.bound).insert(bind.text);
      if (bind.text != "HOOKED" && bind.text != stage)
        for (const std::string& each : named->conditions) require(conditions, each);
    }
    if (hook.when) {
      const auto when = expressionOf(*hook.when);
      if (!when) return;
      require(conditions, fmt::format("{} != 0", *when));
    }
    const std::string condition = joined(conditions);
    if (operatorsIn(condition) > kMostOperators) {
      auto& d = diagnostics_.error(base::Code::mpvNotMapped, hook.when ? hook.when->place : hook.place,
                                   "the pass depends on too many //!WHEN of passes before it");
      d.expected = fmt::format("conditions of at most {} operators together", kMostOperators);
      d.found = fmt::format("{} in {} conditions", operatorsIn(condition), conditions.size());
      d.hint = "give fewer passes a //!WHEN";
      return;
    }
    std::string width = hooked.width, height = hooked.height;
    if (hook.width) width = expressionOf(*hook.width).value_or("1");
    if (hook.height) height = expressionOf(*hook.height).value_or("1");
    const bool saves = hook.save && hook.save->text != "HOOKED" && hook.save->text != stage;
    if (saves &&
        std::ranges::any_of(file_.textures, [&](const MpvTexture& t) { return t.name == hook.save->text; })) {
      diagnostics_
          .error(base::Code::duplicateName, hook.save->place,
                 fmt::format("'{}' is a //!TEXTURE", hook.save->text))
          .hint = "save under another name";
      return;
    }
    const std::string resource = addResult(hook, saves ? hook.save->text : stage, width, height);
    Named result{.resource = resource,
                 .width = fmt::format("size({}).x", resource),
                 .height = fmt::format("size({}).y", resource),
                 .conditions = conditions};
    addStanza(index, stage, reads, resource, condition);
    if (saves) {
      names_[hook.save->text] = result;
      return;
    }
    if (!condition.empty()) {  // where the pass does not run, what was there before goes on
      const std::string chosen = fresh(resource + "_or_" + hooked.resource);
      resources_.add(chosen, fmt::format("[{}, {}]", quoteJson(fmt::format("{} if {}", resource, condition)),
                                         quoteJson(hooked.resource)));
      result = {.resource = chosen,
                .width = fmt::format("size({}).x", chosen),
                .height = fmt::format("size({}).y", chosen)};
    }
    if (hook.offset[0] != 0 || hook.offset[1] != 0)
      for (int axis = 0; axis < 2; ++axis)
        shift_[axis] += fmt::format("{}{} / size({}).{}", shift_[axis].empty() ? "" : " + ",
                                    hook.offset[axis], result.resource, "xy"[axis]);
    names_["HOOKED"] = names_[stage] = result;
  }

  std::string addResult(const MpvHook& hook, const std::string& wanted, const std::string& width,
                        const std::string& height) {
    const std::string resource = fresh(wanted);
    static constexpr const char* kFormats[] = {"rgba16f", "r16f", "rg16f", "rgba16f", "rgba16f"};
    // Rounds as mpv does.
    const auto side = [&](const std::optional<MpvText>& own, const std::string& expression) {
      return quoteJson(own ? fmt::format("floor({} + 0.5)", expression) : expression);
    };
    const bool same = !hook.width && !hook.height && width.ends_with(".x");
    const std::string size =
        same ? quoteJson(width.substr(0, width.size() - 2))
             : fmt::format("[{}, {}]", side(hook.width, width), side(hook.height, height));
    resources_.add(resource, fmt::format(R"({{"texture": "{}", "size": {}}})",
                                         hook.compute ? "rgba16f" : kFormats[hook.components], size));
    return resource;
  }

  void addStanza(std::size_t index, const std::string& stage, const JsonObjectText& reads,
                 const std::string& resource, const std::string& condition) {
    const MpvHook& hook = file_.hooks[index];
    JsonObjectText stanza;
    stanza.addText("name", passNames_.insert(fmt::format("pass_{}", index + 1)).second
                               ? fmt::format("pass_{}", index + 1)
                               : fmt::format("pass_{}_{}", index + 1, stage));
    stanza.addText("type", hook.compute ? "compute" : "fullscreen");
    stanza.addText("shader", fmt::format("{0}/{0}.{1}.glsl", name_, hook.compute ? "comp" : "frag"));
    if (!condition.empty()) stanza.addText("enabled", condition);
    if (!reads.empty()) stanza.add("read", reads.text());
    stanza.add("write",
               fmt::format(R"({{"{}": {}}})", hook.compute ? "out_image" : "result", quoteJson(resource)));
    std::string defines = fmt::format(R"("PASS": {})", index);
    if (hook.compute) {
      defines += fmt::format(R"(, "THREADS_X": {}, "THREADS_Y": {})", hook.threads[0], hook.threads[1]);
      stanza.add("threads",
                 fmt::format(R"(["ceil(size({0}).x / {1}) * {2}", "ceil(size({0}).y / {3}) * {4}"])",
                             resource, hook.block[0], hook.threads[0], hook.block[1], hook.threads[1]));
    }
    stanza.add("defines", "{" + defines + "}");
    JsonObjectText uniforms;
    for (const MpvParameter& parameter : file_.parameters)
      if (used_.contains(parameter.name)) uniforms.addText(parameter.name, "$" + parameter.name);
    if (used_.contains(kMpvSizes[0])) uniforms.addText(kMpvSizes[0], "size(source)");
    if (used_.contains(kMpvSizes[1])) uniforms.addText(kMpvSizes[1], "screen");
    if (!uniforms.empty()) stanza.add("parameters", uniforms.text());
    addPassText(stanza);
    (hook.compute ? out_.compute : out_.fragment) = true;
  }

  void addShow() {
    JsonObjectText show;
    show.addText("name", "show").addText("type", "fullscreen").addText("shader", name_ + "/show.frag.glsl");
    show.add("read", fmt::format(R"({{"source": {}}})", quoteJson(names_["HOOKED"].resource + " as linear")));
    show.add("write", R"({"result": "shown"})");
    const bool shifted = !shift_[0].empty();
    show.add("parameters",
             fmt::format(R"({{"shift": {}}})",
                         shifted ? quoteJson(fmt::format("[{}, {}]", shift_[0], shift_[1])) : "[0, 0]"));
    addPassText(show);
  }

  const MpvFile& file_;
  const std::set<std::string>& used_;
  const std::string name_;
  const ConvertOptions& options_;
  base::Diagnostics& diagnostics_;
  MpvGraph out_;
  JsonObjectText parameters_, resources_;
  std::string passes_, shift_[2];
  std::map<std::string, Named> names_;
  std::set<std::string> taken_{"picture", "source", "shown"}, passNames_;
};

}  // namespace

std::optional<MpvGraph> writeMpvGraph(const MpvFile& file, const std::set<std::string>& used,
                                      const std::string& name, const ConvertOptions& options,
                                      base::Diagnostics& diagnostics) {
  return MpvGraphWriter(file, used, name, options, diagnostics).run();
}

}  // namespace weft::convert
