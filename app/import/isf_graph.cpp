// The graph of an ISF file: parameters, resources and passes as JSON; and the whole of an import of ISF. Declared in import.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>

#include "app/import/import.h"
#include "app/import/isf.h"
#include "app/import/text.h"
#include "engine/base/chars.h"
#include "engine/base/files/file.h"
#include "engine/base/files/file_access.h"
#include "engine/base/json/edit.h"
#include "engine/graph/language/expr.h"
#include "import_glsl.h"

namespace weft::convert {

namespace {

using base::quoteJson;
using InputType = IsfInput::Type;

constexpr std::array<std::string_view, 5> kSizeFunctions{"floor", "ceil", "min", "max", "abs"};
constexpr std::size_t kMaxText = 400;
constexpr const char* kClear = "[0, 0, 0, 0]";

// The size of an ISF pass as an expression of Weft: "floor($WIDTH/4.0)" becomes "floor(screen.x/4.0)". Names behind a
// '$' are the picture's size or inputs: `variableOf` gives the text that stands for one, or "". Empty after W222.
std::optional<std::string> convertSize(std::string_view text, const base::Place& place,
                                       const std::function<std::string(std::string_view)>& variableOf,
                                       base::Diagnostics& diagnostics) {
  std::string out, wrong = text.size() > kMaxText ? "the size is too long" : "";
  std::size_t at = 0, begin = 0;
  const auto takeWhile = [&](auto belongs) {
    const std::size_t from = at;
    while (at < text.size() && belongs(text[at])) ++at;
    return text.substr(from, at - from);
  };
  while (wrong.empty() && at < text.size()) {
    begin = at;
    const char c = text[at];
    if (base::isSpace(c)) {
      ++at;
    } else if (c == '$') {
      ++at;
      const std::string_view name = takeWhile(base::isIdentChar);
      const std::string variable = variableOf(name);
      if (variable.empty()) wrong = fmt::format("'${}' is no number that a size can use", name);
      out += variable;
    } else if (base::isDigit(c) || c == '.') {  // Weft has digits on both sides of a point
      const std::string_view number = takeWhile([](char d) { return base::isDigit(d) || d == '.'; });
      out += (c == '.' ? "0" : "") + std::string(number) + (number.back() == '.' ? "0" : "");
    } else if (base::isIdentStart(c)) {
      const std::string name = base::lowered(takeWhile(base::isIdentChar));
      if (std::ranges::find(kSizeFunctions, name) == kSizeFunctions.end())
        wrong = fmt::format("Weft has no function '{}' for sizes", name);
      out += name;
    } else if (std::string_view("+-*/%(),").find(c) != std::string_view::npos) {
      ++at;
      out += c;
      if (c == ',') out += ' ';
    } else {
      wrong = fmt::format("unexpected '{}' in a size", c);
    }
  }
  if (wrong.empty()) begin = 0;
  base::Diagnostics said;
  if (wrong.empty() && !graph::Expr::parse(out, place, said))
    wrong = said.empty() ? "the size is no expression" : said.items()[0].message;
  if (wrong.empty()) return out;
  base::Place there = place;
  if (there.column > 0) there.column += static_cast<std::uint32_t>(begin);
  refuse(diagnostics, base::Code::sizeNotMapped, there, std::move(wrong),
         "write numbers, $WIDTH, $HEIGHT, $input, + - * / % ( ), floor, ceil, min, max, abs");
  return std::nullopt;
}

std::string oneLine(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

class IsfGraphWriter {
 public:
  IsfGraphWriter(const IsfHeader& header, IsfNames& names, const IsfShader& shader,
                 const ConvertOptions& options, base::Diagnostics& diagnostics)
      : header_(header),
        names_(names),
        shader_(shader),
        options_(options),
        diagnostics_(diagnostics),
        picture_(names.fresh("picture")) {}

  std::string run() {
    for (const IsfInput& input : header_.inputs) addInput(input);
    if (shader_.usesDate) {
      parameters_.add("date", R"({"default": [2000.0, 1.0, 1.0, 0.0], "label": "Date of the first frame"})");
      uniforms_.addText("date", "$date");
    }
    for (const IsfImported& imported : header_.imported) addImported(imported);
    findTargets();
    addPasses();
    JsonObjectText graph;
    graph.addText("name", options_.name);
    std::string about = header_.description;
    std::string_view credit = header_.credit;  // most begin with "by"
    if (credit.starts_with("by ") || credit.starts_with("By ")) credit.remove_prefix(3);
    if (!credit.empty()) about += (about.empty() ? "By " : ". By ") + std::string(credit);
    if (!about.empty()) graph.addText("description", oneLine(about));
    if (!parameters_.empty()) graph.add("parameters", parameters_.text());
    if (!lets_.empty()) graph.add("let", lets_.text());
    graph.add("resources", resources_.text()).add("passes", "[" + passes_ + "]").addText("present", picture_);
    return graphText(graph);
  }

  // Whether a pass shows the last target, which is of another kind than the picture.
  bool showsLast() const { return shown_; }

 private:
  struct Target {
    IsfPass size;  // as the first pass that names it says
    bool persistent = false, floats = false, cleared = false;
    bool written = false;  // by a pass before the one that is looked at
  };

  void addInput(const IsfInput& input) {
    const std::string& name = names_.of(input.name);
    if (input.type == InputType::image) return addImage(input);
    JsonObjectText parameter;
    std::string value = "$" + name, label = input.label;
    if (input.type == InputType::boolean || input.type == InputType::event)
      parameter.add("default", !input.initial.empty() && input.initial[0] != 0 ? "true" : "false");
    else if (const std::string let = addChoices(input, parameter); !let.empty())
      value = "$" + let;
    else
      addNumbers(input, parameter);
    if (input.type == InputType::event)
      label = (label.empty() ? input.name : label) + " (an event: true for one frame)";
    if (!label.empty()) parameter.addText("label", oneLine(label));
    parameters_.add(name, parameter.text());
    uniforms_.addText(name, value);
    values_[input.name] = value;
  }

  // The default must lie in the range: ISF does not ask for it.
  void addNumbers(const IsfInput& input, JsonObjectText& parameter) {
    const bool real = input.type != InputType::integer, ranged = !input.min.empty() || !input.max.empty();
    const std::size_t count = input.type == InputType::point ? 2 : input.type == InputType::color ? 4 : 1;
    std::vector<double> initial = input.initial, low = input.min, high = input.max;
    if (!ranged && input.type == InputType::integer) low = high = input.values;
    if (!ranged && input.type == InputType::color) low = {0}, high = {1};
    if (!real && !low.empty()) low = {std::floor(std::ranges::min(low))};
    if (!real && !high.empty()) high = {std::floor(std::ranges::max(high))};
    const bool crossed = !low.empty() && !high.empty() && std::ranges::min(low) > std::ranges::max(high);
    if (initial.empty()) {
      double start = 0;
      if (!low.empty() && !crossed) start = std::max(start, std::ranges::min(low));
      if (!high.empty() && !crossed) start = std::min(start, std::ranges::max(high));
      initial.assign(count, start);
    }
    std::string text;
    for (const double x : initial) {
      text += (text.empty() ? "" : ", ") + numberText(x, real);
      if (!low.empty()) low.push_back(x);
      if (!high.empty()) high.push_back(x);
    }
    if (!real) parameter.addText("type", "int");
    if (real && count == 1) parameter.addText("type", "float");
    parameter.add("default", count == 1 ? text : "[" + text + "]");
    const double least = low.empty() ? -HUGE_VAL : std::ranges::min(low);
    const double greatest = high.empty() ? HUGE_VAL : std::ranges::max(high);
    if (!low.empty() && least < greatest) parameter.add("min", numberText(least, real));
    if (!high.empty() && least < greatest) parameter.add("max", numberText(greatest, real));
  }

  // A word for each label, and the number that it means. Returns the name of the value, or "" where the input stays a number.
  std::string addChoices(const IsfInput& input, JsonObjectText& parameter) {
    static constexpr std::string_view kReserved[] = {"x",    "y",    "z",       "w",     "mip",    "layer",
                                                     "face", "true", "stencil", "false", "screen", "device"};
    const double wanted = !input.initial.empty() ? input.initial[0]
                          : input.values.empty() ? 0
                                                 : input.values[0];
    const auto found = std::ranges::find(input.values, wanted);
    // Weft's expressions have at most 200 operators.
    const std::size_t count = input.labels.size();
    if (count < 2 || count > 60 || found == input.values.end()) return {};
    const auto initial = static_cast<std::size_t>(found - input.values.begin());
    std::set<std::string, std::less<>> seen;
    std::string list, value, chosen;
    for (std::size_t i = 0; i < count; ++i) {
      std::string word = identifierOf(input.labels[i]);
      if (std::ranges::find(kReserved, word) != std::end(kReserved)) word += '_';
      word = freshName(seen, word);  // "Soft light" and "Soft-light" are one word
      if (word.size() > 60) return {};
      if (i == initial) chosen = word;
      list += (i ? ", " : "") + quoteJson(word);
      const std::string number = numberText(input.values[i], false);
      value +=
          i + 1 == count ? number : fmt::format("${} == {} ? {} : ", names_.of(input.name), word, number);
    }
    parameter.addText("default", chosen).add("choices", "[" + list + "]");
    const std::string let = names_.fresh(names_.of(input.name) + "_value");
    lets_.addText(let, value);
    return let;
  }

  void addImage(const IsfInput& input) {
    const std::string& name = names_.of(input.name);
    std::string file;
    for (const auto& [which, path] : options_.images)
      if (which == input.name) file = path;
    JsonObjectText parameter;
    parameter.addText("type", "file").addText("default", file);
    parameter.addText("label", oneLine((input.label.empty() ? input.name : input.label) + ": a picture"));
    parameters_.add(name, parameter.text());
    addPicture(name, "$" + name);
    if (!shader_.needed.contains(input.name)) return;
    // A function takes it, so that something must be there.
    if (nothing_.empty()) {
      nothing_ = names_.fresh("no_picture");
      resources_.add(nothing_, R"({"texture": "rgba8", "size": 1, "clear": [0, 0, 0, 0]})");
    }
    const std::string chosen = names_.fresh(name + "_or_none");
    resources_.add(chosen, fmt::format("[{}, {}]", quoteJson(name), quoteJson(nothing_)));
    chosen_[input.name] = chosen;
  }

  void addImported(const IsfImported& imported) {
    const std::string beside = base::besideFile(imported.place, imported.path);
    std::error_code ignored;
    if (base::mayRead(beside) && !std::filesystem::exists(beside, ignored))
      diagnostics_
          .warning(base::Code::unreadableImage, imported.place,
                   fmt::format("cannot read '{}': no such file", beside))
          .hint = "put the picture there before the graph is rendered";
    std::string path = imported.path;
    if (!path.starts_with('/') && !options_.sourceFolder.empty()) path = options_.sourceFolder + "/" + path;
    if (path.starts_with('$')) path = "./" + path;
    addPicture(names_.of(imported.name), path);
  }

  void addPicture(const std::string& name, const std::string& file) {
    resources_.add(name, fmt::format(R"({{"import": "image", "file": {}}})", quoteJson(file)));
  }

  void findTargets() {
    for (const IsfPass& pass : header_.passes) {
      if (pass.target.empty()) continue;
      Target& target = targets_.try_emplace(pass.target, Target{.size = pass}).first->second;
      target.persistent |= pass.persistent;
      target.floats |= pass.floats;
    }
    // What nothing has written when it must be there is cleared.
    std::set<std::string_view> written;
    for (const IsfPass& pass : header_.passes) {
      for (auto& [name, target] : targets_)
        target.cleared |= shader_.needed.contains(name) && !target.persistent && !written.contains(name);
      written.insert(pass.target);
    }
    const IsfPass& last = header_.passes.back();
    for (const auto& [name, target] : targets_) {
      JsonObjectText texture;
      texture.addText("texture", target.floats ? "rgba32f" : "rgba8").add("size", sizeOf(target.size));
      if (target.cleared || !shader_.vertex.empty()) texture.add("clear", kClear);
      if (target.persistent && shader_.read.contains(name)) texture.add("history", "1");
      resources_.add(names_.of(name), texture.text());
      if (name == last.target) shown_ = target.floats || isScaled(last) || isScaled(target.size);
    }
    if (!last.target.empty() && !shown_) {
      picture_ = names_.of(last.target);
      return;
    }
    JsonObjectText texture;
    texture.addText("texture", "rgba8").addText("size", "screen");
    if (!shader_.vertex.empty()) texture.add("clear", kClear);
    resources_.add(picture_, texture.text());
  }

  static bool isScaled(const IsfPass& pass) { return !pass.width.empty() || !pass.height.empty(); }

  // What stands for the name behind a '$' in a size.
  std::string variableOf(std::string_view name) const {
    if (name == "WIDTH") return "screen.x";
    if (name == "HEIGHT") return "screen.y";
    if (const auto value = values_.find(name); value != values_.end()) {
      const InputType type = std::ranges::find(header_.inputs, name, &IsfInput::name)->type;
      return type != InputType::point && type != InputType::color ? value->second : std::string();
    }
    for (const std::string_view end : {"_WIDTH", "_HEIGHT"}) {
      if (!name.ends_with(end)) continue;
      const auto image = names_.all().find(name.substr(0, name.size() - end.size()));
      if (image != names_.all().end() && !targets_.contains(image->first) && !values_.contains(image->first))
        return fmt::format("size({}).{}", image->second, end == "_WIDTH" ? "x" : "y");
    }
    return {};
  }

  std::string sizeOf(const IsfPass& pass) {
    if (!isScaled(pass)) return "\"screen\"";
    const auto side = [&](const std::string& text, const base::Place& place, const char* otherwise) {
      if (text.empty()) return std::string(otherwise);
      const std::function<std::string(std::string_view)> variable = [&](std::string_view name) {
        return variableOf(name);
      };
      return convertSize(text, place, variable, diagnostics_).value_or(otherwise);
    };
    return fmt::format("[{}, {}]", quoteJson(side(pass.width, pass.widthPlace, "screen.x")),
                       quoteJson(side(pass.height, pass.heightPlace, "screen.y")));
  }

  std::string readsOf() const {
    JsonObjectText reads;
    const auto add = [&](const std::string& name, const std::string& from, bool optional) {
      if (shader_.read.contains(name))
        reads.addText(names_.of(name), from + " as linear" + (optional ? " ?" : ""));
    };
    for (const IsfInput& input : header_.inputs) {
      if (input.type != InputType::image) continue;
      const auto chosen = chosen_.find(input.name);
      add(input.name, chosen == chosen_.end() ? names_.of(input.name) : chosen->second,
          chosen == chosen_.end());
    }
    for (const IsfImported& imported : header_.imported) add(imported.name, names_.of(imported.name), false);
    for (const auto& [name, target] : targets_)
      if (target.written || target.cleared || target.persistent)
        add(name, names_.of(name) + (target.written || target.cleared ? "" : "@-1"), false);
    return reads.empty() ? std::string() : reads.text();
  }

  void addPasses() {
    std::set<std::string, std::less<>> used;
    std::string first;
    for (std::size_t i = 0; i < header_.passes.size(); ++i) {
      const IsfPass& pass = header_.passes[i];
      if (pass.target.empty() && i + 1 < header_.passes.size()) {
        auto& d = diagnostics_.warning(
            base::Code::isfNotMapped, pass.place,
            fmt::format("pass {} draws the picture, and the last pass draws it again", i));
        d.expected = "a TARGET in every pass but the last";
        d.hint = "the pass is left out";
        continue;
      }
      const std::string target = pass.target.empty() ? picture_ : names_.of(pass.target);
      const std::string name = freshName(used, "draw_" + target);
      JsonObjectText stanza;
      stanza.addText("name", name);
      if (!first.empty())
        stanza.addText("like", first);
      else if (shader_.vertex.empty())
        stanza.addText("type", "fullscreen").addText("shader", shader_.fragment);
      else
        stanza.addText("type", "draw")
            .addText("geometry", "quad")
            .add("instances", "1")
            .add("shader", fmt::format(R"({{"vertex": {}, "fragment": {}}})", quoteJson(shader_.vertex),
                                       quoteJson(shader_.fragment)));
      stanza.add("read", readsOf());
      stanza.add("write", fmt::format("{{{}: {}}}", quoteJson(kIsfOutput), quoteJson(target)));
      stanza.add("defines", fmt::format(R"({{"PASSINDEX": {}}})", i));
      if (first.empty() && !uniforms_.empty()) stanza.add("parameters", uniforms_.text());
      if (first.empty()) first = name;
      passes_ += (passes_.empty() ? "" : ", ") + stanza.text();
      if (!pass.target.empty()) targets_.find(pass.target)->second.written = true;
    }
    if (!shown_) return;
    JsonObjectText show;
    show.addText("name", freshName(used, "show")).addText("type", "fullscreen");
    show.addText("shader", options_.name + "/show.frag.glsl");
    show.add("read", fmt::format(R"({{"source": {}}})",
                                 quoteJson(names_.of(header_.passes.back().target) + " as linear")));
    show.add("write", fmt::format(R"({{"result": {}}})", quoteJson(picture_)));
    passes_ += ", " + show.text();
  }

  const IsfHeader& header_;
  IsfNames& names_;
  const IsfShader& shader_;
  const ConvertOptions& options_;
  base::Diagnostics& diagnostics_;
  std::string picture_, passes_, nothing_;
  JsonObjectText parameters_, lets_, resources_, uniforms_;
  std::map<std::string, Target, std::less<>> targets_;
  std::map<std::string, std::string, std::less<>> values_, chosen_;  // by input: in expressions; of images
  bool shown_ = false;
};

}  // namespace

std::optional<Converted> convertIsf(const IsfSource& source, const ConvertOptions& options,
                                    base::Diagnostics& diagnostics) {
  const std::size_t errors = diagnostics.errorCount();
  const auto header =
      readIsfHeader(source.fragment, std::make_shared<const std::string>(source.fragmentFile), diagnostics);
  if (!header) return std::nullopt;
  std::vector<std::string> images;
  for (const IsfInput& input : header->inputs)
    if (input.type == IsfInput::Type::image) images.push_back(input.name);
  if (!checkImageNames(options, images, diagnostics)) return std::nullopt;
  IsfNames names(*header);
  auto shader = translateIsfShader(source, options, *header, names, diagnostics);
  if (!shader) return std::nullopt;
  IsfGraphWriter writer(*header, names, *shader, options, diagnostics);
  Converted out{.graph = options.name + ".json"};
  out.texts.push_back({out.graph, writer.run()});
  if (diagnostics.errorCount() > errors) return std::nullopt;
  std::ranges::move(shader->texts, std::back_inserter(out.texts));
  if (writer.showsLast())
    out.texts.push_back({fmt::format("shaders/{}/show.frag.glsl", options.name), glsl::isf_show});
  return out;
}

}  // namespace weft::convert
