// The graph of a user shader of mpv: which pass reads and writes what; and the whole of an import of mpv. Declared in import.h.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>

#include "app/import/import.h"
#include "app/import/mpv.h"
#include "app/import/text.h"
#include "engine/base/chars.h"
#include "engine/base/json/edit.h"
#include "engine/base/nearest.h"
#include "engine/base/printable.h"
#include "engine/base/words/glsl_words.h"

namespace weft::convert {

namespace {

using base::Code;
using base::quoteJson;

// In mpv's order. The second are those that a picture in place of a video does not have.
const std::array<std::string, 7> kStages{"RGB",    "NATIVE",    "MAINPRESUB", "MAIN",
                                         "SCALED", "PREOUTPUT", "OUTPUT"};
constexpr std::array<std::string_view, 12> kOtherStages{
    "LUMA",   "CHROMA",  "ALPHA",     "XYZ",        "CHROMA_SCALED", "ALPHA_SCALED",
    "LINEAR", "SIGMOID", "PREKERNEL", "POSTKERNEL", "LUMA_SCALED",   "XYZ_SCALED"};

constexpr std::size_t kMaxOperators = 200;  // of an expression of Weft
constexpr std::size_t kMaxWords = 32;       // of an expression of mpv, as there

std::string imagePath(const MpvTexture& texture, const std::string& name) {
  return fmt::format("images/{}/{}.{}", name, texture.name, texture.image.bytes.empty() ? "exr" : "png");
}

std::string widthOf(const std::string& resource) {
  return fmt::format("size({}).x", resource);
}
std::string heightOf(const std::string& resource) {
  return fmt::format("size({}).y", resource);
}

class MpvGraphWriter {
 public:
  MpvGraphWriter(const MpvFile& file, const std::set<std::string>& used, const ConvertOptions& options,
                 base::Diagnostics& diagnostics)
      : file_(file), used_(used), options_(options), name_(options.name), diagnostics_(diagnostics) {}

  // Empty after errors.
  std::optional<std::string> run() {
    const std::size_t errors = diagnostics_.errorCount();
    addSource();
    for (const MpvParameter& parameter : file_.parameters) addParameter(parameter);
    for (const MpvTexture& texture : file_.textures) addTexture(texture);
    for (const MpvHook& hook : file_.hooks) checkStages(hook);
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    for (const std::string& stage : kStages) {
      names_[stage] = names_["HOOKED"];
      for (std::size_t i = 0; i < file_.hooks.size(); ++i)
        for (const MpvText& hook : file_.hooks[i].hooks)
          if (hook.text == stage) addPass(i, stage);
    }
    if (diagnostics_.errorCount() > errors) return std::nullopt;
    addShow();
    JsonObjectText graph;
    graph.addText("name", name_);
    graph.add("parameters", parameters_.text()).add("resources", resources_.text());
    graph.add("passes", "[" + passes_ + "]").addText("present", "shown");
    return graphText(graph);
  }

  const MpvNeeds& needs() const { return needs_; }

 private:
  struct Named {
    std::string resource, filter = " as linear";
    std::string width, height;            // expressions
    std::vector<std::string> conditions;  // of which all must hold, so that something wrote it
  };

  void fail(Code code, const base::Place& place, std::string message, std::string hint) {
    refuse(diagnostics_, code, place, std::move(message), std::move(hint));
  }

  std::string fresh(const std::string& wanted) {
    return freshName(taken_, base::isGlslWord(wanted) ? wanted + "_" : wanted);
  }

  void addStanza(const JsonObjectText& stanza) { passes_ += (passes_.empty() ? "" : ", ") + stanza.text(); }

  void addSource() {
    const std::string file = options_.images.empty() ? "" : options_.images.back().second;
    parameters_.add("picture",
                    fmt::format(R"({{"type": "file", "default": {}, "label": "Picture"}})", quoteJson(file)));
    resources_.add("picture", R"({"import": "image", "file": "$picture"})");
    // With as many bits as a PNG may have; turned over.
    resources_.add("source", R"({"texture": "rgba16", "size": "has(picture) ? size(picture) : screen"})");
    resources_.add("shown", R"({"texture": "rgba8", "size": "screen"})");
    JsonObjectText turn;
    turn.addText("name", "turn").addText("type", "fullscreen").addText("shader", name_ + "/turn.frag.glsl");
    turn.add("read", R"({"source": "picture as linear ?"})").add("write", R"({"result": "source"})");
    addStanza(turn);
    names_["HOOKED"] = {.resource = "source", .width = widthOf("source"), .height = heightOf("source")};
  }

  void addParameter(const MpvParameter& parameter) {
    const bool real = parameter.type == "float";
    if (!taken_.insert(parameter.name).second || base::isGlslWord(parameter.name))
      return fail(Code::notAName, parameter.place,
                  fmt::format("\"{}\" cannot name a parameter", parameter.name), "give it a name of its own");
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
    if (texture.dimensions != 2)
      return fail(Code::mpvNotMapped, texture.place,
                  fmt::format("the texture '{}' has not two dimensions", texture.name),
                  "give it a height of 1, or lay its slices beside each other");
    if (names_.contains(texture.name))
      return fail(Code::duplicateName, texture.place,
                  fmt::format("two textures have the name '{}'", texture.name), "rename one");
    const std::string resource = fresh(texture.name);
    resources_.add(resource,
                   fmt::format(R"({{"import": "image", "file": {}}})", quoteJson(imagePath(texture, name_))));
    names_[texture.name] = {.resource = resource,
                            .filter = fmt::format(" as {}{}", texture.linear ? "linear" : "nearest",
                                                  texture.repeat ? " wrap" : ""),
                            .width = std::to_string(texture.size[0]),
                            .height = std::to_string(texture.size[1])};
  }

  // A pass needs a stage that a picture has; of several, the others are left out aloud.
  void checkStages(const MpvHook& hook) {
    const auto isStage = [](const MpvText& text) {
      return std::ranges::find(kStages, text.text) != kStages.end();
    };
    const bool any = std::ranges::any_of(hook.hooks, isStage);
    for (const MpvText& text : hook.hooks) {
      if (isStage(text)) continue;
      const bool known = std::ranges::find(kOtherStages, text.text) != kOtherStages.end();
      base::Diagnostic d{
          .severity = any && known ? base::Severity::warning : base::Severity::error,
          .code = Code::mpvNotMapped,
          .message = fmt::format("{} '{}'", known ? "a picture has no stage" : "unknown stage", text.text),
          .place = text.place};
      d.expected = "RGB, NATIVE, MAINPRESUB, MAIN, SCALED, PREOUTPUT or OUTPUT";
      d.hint = !known ? base::nearestHint(text.text, kStages)
               : any  ? "the pass runs at its other stages"
                      : "hook MAIN where the shader works on colours, too";
      diagnostics_.add(std::move(d));
    }
  }

  const Named* find(const std::string& name) const {
    const auto found = names_.find(name);
    return found == names_.end() ? nullptr : &found->second;
  }

  // What stands for a word of an expression: a side of a texture, a number or a parameter. Empty: none of them.
  std::string valueOf(std::string_view word) const {
    const std::size_t point = word.rfind('.');
    if (base::isDigit(word[0])) {
      const bool number = std::ranges::count(word, '.') <= 1 && word.size() <= 20 && word.back() != '.' &&
                          word.find_first_not_of("0123456789.") == word.npos;
      return number ? std::string(word) : std::string();
    }
    const std::string_view end = point == word.npos ? "" : word.substr(point + 1);
    const bool width = end == "w" || end == "width";
    if (width || end == "h" || end == "height") {
      const std::string name(word.substr(0, point));
      if (name == "OUTPUT") return width ? "screen.x" : "screen.y";
      const Named* named = find(name);
      return !named ? "" : width ? named->width : named->height;
    }
    const auto known = std::ranges::find(file_.parameters, word, &MpvParameter::name);
    return known == file_.parameters.end() ? std::string() : fmt::format("${}", word);
  }

  // An expression in reverse Polish as one of Weft: "MAIN.w 2 *" becomes "(size(main).x * 2)".
  std::optional<std::string> expressionOf(const MpvText& expression) {
    const auto wrong = [&](std::size_t at, std::string message) {
      base::Place place = expression.place;
      place.column += static_cast<std::uint32_t>(at);
      fail(Code::badMpvHeader, place, std::move(message),
           "write reverse Polish of numbers, NAME.w, NAME.h, + - * / % > < = !: HOOKED.w 2 * is twice the "
           "width of what is hooked");
      return std::nullopt;
    };
    const std::string_view text = expression.text;
    std::vector<std::string> stack;
    std::size_t words = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
      if (base::isSpace(text[at])) continue;
      const std::string_view word =
          text.substr(at, std::min(text.find_first_of(" \t", at), text.size()) - at);
      if (++words > kMaxWords) return wrong(at, fmt::format("more than {} words", kMaxWords));
      if (word == "!") {
        if (stack.empty()) return wrong(at, "'!' has nothing before it");
        stack.back() = fmt::format("({} == 0)", stack.back());
      } else if (word.size() == 1 && std::string_view("+-*/%><=").find(word[0]) != std::string_view::npos) {
        if (stack.size() < 2) return wrong(at, fmt::format("'{}' needs two values before it", word));
        const std::string right = std::move(stack.back());
        stack.pop_back();
        stack.back() = fmt::format("({} {} {})", stack.back(), word == "=" ? "==" : word, right);
      } else if (std::string value = valueOf(word); !value.empty()) {
        stack.push_back(std::move(value));
      } else {
        return wrong(at, fmt::format("'{}' is no number, no parameter and no side of a texture", word));
      }
      at += word.size();
    }
    if (stack.size() != 1)
      return wrong(0, stack.empty() ? "the expression is empty" : "values are left over");
    return stack.back();
  }

  // At least as many as Weft counts in the expression.
  static std::size_t operatorsIn(std::string_view expression) {
    return static_cast<std::size_t>(std::ranges::count_if(expression, [](char c) {
      return std::string_view("+-*/%<>=!&|?:(,").find(c) != std::string_view::npos;
    }));
  }

  bool isTexture(const std::string& name) const {
    return std::ranges::find(file_.textures, name, &MpvTexture::name) != file_.textures.end();
  }

  void addPass(std::size_t index, const std::string& stage) {
    const MpvHook& hook = file_.hooks[index];
    const Named hooked = names_["HOOKED"];
    std::vector<std::string> conditions;
    const auto require = [&](const std::string& condition) {
      if (std::ranges::find(conditions, condition) == conditions.end()) conditions.push_back(condition);
    };
    JsonObjectText reads;
    for (const MpvText& bind : hook.binds) {
      const Named* named = bind.text == stage ? &hooked : find(bind.text);
      if (!named) {
        std::vector<std::string> known;
        for (const auto& [name, unused] : names_) known.push_back(name);
        return fail(Code::mpvNotMapped, bind.place,
                    fmt::format("nothing has saved a texture '{}' here", bind.text),
                    base::nearestHint(bind.text, known));
      }
      if (!used_.contains(bind.text)) continue;
      // The shader knows a texture of the file by its own name.
      const bool ofFile = isTexture(bind.text);
      reads.addText(ofFile ? bind.text : bind.text + "_raw", named->resource + named->filter);
      (ofFile ? needs_.textures : needs_.bound).insert(bind.text);
      if (bind.text != "HOOKED" && bind.text != stage)
        for (const std::string& each : named->conditions) require(each);
    }
    if (hook.when) {
      const auto when = expressionOf(*hook.when);
      if (!when) return;
      require(*when + " != 0");
    }
    std::string condition = fmt::format("{}", fmt::join(conditions, ") && ("));
    if (conditions.size() > 1) condition = "(" + condition + ")";
    if (operatorsIn(condition) > kMaxOperators)
      return fail(Code::mpvNotMapped, hook.when ? hook.when->place : hook.place,
                  "the pass depends on too many //!WHEN of passes before it",
                  fmt::format("give fewer passes a //!WHEN: at most {} operators together", kMaxOperators));
    const bool saves = hook.save && hook.save->text != "HOOKED" && hook.save->text != stage;
    if (saves && isTexture(hook.save->text))
      return fail(Code::duplicateName, hook.save->place, fmt::format("'{}' is a //!TEXTURE", hook.save->text),
                  "save under another name");
    const std::string resource = fresh(saves ? hook.save->text : stage);
    addTarget(hook, resource, hooked);
    addHook(index, stage, reads, resource, condition);
    Named result{.resource = resource,
                 .width = widthOf(resource),
                 .height = heightOf(resource),
                 .conditions = conditions};
    if (saves) {
      names_[hook.save->text] = result;
      return;
    }
    if (!condition.empty()) {  // where the pass does not run, what was there before goes on
      const std::string chosen = fresh(resource + "_or_" + hooked.resource);
      resources_.add(chosen, fmt::format("[{}, {}]", quoteJson(fmt::format("{} if {}", resource, condition)),
                                         quoteJson(hooked.resource)));
      result = {.resource = chosen, .width = widthOf(chosen), .height = heightOf(chosen)};
    }
    if (hook.offset[0] != 0 || hook.offset[1] != 0)
      for (int axis = 0; axis < 2; ++axis)
        shift_[axis] += fmt::format("{}{} / size({}).{}", shift_[axis].empty() ? "" : " + ",
                                    hook.offset[axis], result.resource, "xy"[axis]);
    names_["HOOKED"] = names_[stage] = result;
  }

  void addTarget(const MpvHook& hook, const std::string& resource, const Named& hooked) {
    static constexpr const char* kFormats[] = {"rgba16f", "r16f", "rg16f", "rgba16f", "rgba16f"};
    // Rounds as mpv does.
    const auto side = [&](const std::optional<MpvText>& own, const std::string& otherwise) {
      if (!own) return quoteJson(otherwise);
      return quoteJson(fmt::format("floor({} + 0.5)", expressionOf(*own).value_or("1")));
    };
    const std::string& width = hooked.width;
    const bool same = !hook.width && !hook.height && width.ends_with(".x");
    const std::string size =
        same ? quoteJson(width.substr(0, width.size() - 2))
             : fmt::format("[{}, {}]", side(hook.width, width), side(hook.height, hooked.height));
    resources_.add(resource, fmt::format(R"({{"texture": "{}", "size": {}}})",
                                         hook.compute ? "rgba16f" : kFormats[hook.components], size));
  }

  void addHook(std::size_t index, const std::string& stage, const JsonObjectText& reads,
               const std::string& resource, const std::string& condition) {
    const MpvHook& hook = file_.hooks[index];
    std::string name = fmt::format("pass_{}", index + 1);
    if (!passNames_.insert(name).second) name += "_" + stage;
    JsonObjectText stanza;
    stanza.addText("name", name).addText("type", hook.compute ? "compute" : "fullscreen");
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
    addStanza(stanza);
    (hook.compute ? needs_.compute : needs_.fragment) = true;
  }

  void addShow() {
    JsonObjectText show;
    show.addText("name", "show").addText("type", "fullscreen").addText("shader", name_ + "/show.frag.glsl");
    show.add("read", fmt::format(R"({{"source": {}}})", quoteJson(names_["HOOKED"].resource + " as linear")));
    show.add("write", R"({"result": "shown"})");
    const std::string shift =
        shift_[0].empty() ? "[0, 0]" : quoteJson(fmt::format("[{}, {}]", shift_[0], shift_[1]));
    show.add("parameters", fmt::format(R"({{"shift": {}}})", shift));
    addStanza(show);
  }

  const MpvFile& file_;
  const std::set<std::string>& used_;  // names that the shader mentions
  const ConvertOptions& options_;
  const std::string& name_;
  base::Diagnostics& diagnostics_;
  MpvNeeds needs_;
  JsonObjectText parameters_, resources_;
  std::string passes_, shift_[2];
  std::map<std::string, Named> names_;
  std::set<std::string, std::less<>> taken_{"picture", "source", "shown"};
  std::set<std::string> passNames_;
};

}  // namespace

std::optional<Converted> convertMpv(std::string_view text, const std::string& file,
                                    const ConvertOptions& options, base::Diagnostics& diagnostics) {
  const auto parsed = readMpvFile(text, std::make_shared<const std::string>(file), diagnostics);
  if (!parsed) return std::nullopt;
  static const std::string kPicture[] = {"picture"};
  if (!checkImageNames(options, kPicture, diagnostics)) return std::nullopt;
  const std::string translated = translateMpvText(*parsed);
  const std::set<std::string> used = namesMentioned(translated);
  MpvGraphWriter writer(*parsed, used, options, diagnostics);
  const auto graph = writer.run();
  if (!graph) return std::nullopt;
  Converted out{.graph = options.name + ".json"};
  out.texts.push_back({out.graph, *graph});
  std::ranges::move(writeMpvShaders(*parsed, writer.needs(), translated, used, options.name),
                    std::back_inserter(out.texts));
  for (const MpvTexture& texture : parsed->textures) {
    out.images.push_back(texture.image);
    out.images.back().path = imagePath(texture, options.name);
  }
  return out;
}

}  // namespace weft::convert
