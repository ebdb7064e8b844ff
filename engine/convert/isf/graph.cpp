#include "engine/convert/isf/graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "engine/base/files/file.h"
#include "engine/base/files/file_access.h"
#include "engine/base/json/edit.h"
#include "engine/convert/isf/size_expression.h"
#include "engine/convert/text/glsl_text.h"
#include "engine/convert/text/json_text.h"

namespace weft::convert {

namespace {

using InputType = IsfInput::Type;

std::string oneLine(std::string text) {
  for (char& c : text)
    if (c == '\n' || c == '\r' || c == '\t') c = ' ';
  return text;
}

class IsfGraphWriter {
 public:
  IsfGraphWriter(const IsfHeader& header, IsfNames& names, const IsfShader& shader,
                 const ConvertOptions& options, const base::Place& file, base::Diagnostics& diagnostics)
      : header_(header),
        names_(names),
        shader_(shader),
        options_(options),
        file_(file),
        diagnostics_(diagnostics),
        picture_(names.fresh("picture")) {}

  std::optional<std::string> run() {
    const std::size_t errors = diagnostics_.errorCount();
    for (const IsfInput& input : header_.inputs) addInput(input);
    if (shader_.usesDate) {
      parameters_.add("date", R"({"default": [2000.0, 1.0, 1.0, 0.0], "label": "Date of the first frame"})");
      uniforms_.addText("date", "$date");
    }
    for (const IsfImported& imported : header_.imported) addImported(imported);
    findTargets();
    addPasses();
    if (diagnostics_.errorCount() > errors) return std::nullopt;
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
    std::string value = "$" + name;
    if (input.type == InputType::boolean || input.type == InputType::event) {
      parameter.add("default", !input.initial.empty() && input.initial[0] != 0 ? "true" : "false");
    } else if (input.type == InputType::integer && !input.labels.empty() && addChoices(input, parameter)) {
      value = "$" + choiceValues_.at(input.name);
    } else {
      addNumbers(input, parameter);
    }
    const std::string label =
        input.type == InputType::event
            ? (input.label.empty() ? input.name : input.label) + " (an event: true for one frame)"
            : input.label;
    if (!label.empty()) parameter.addText("label", oneLine(label));
    parameters_.add(name, parameter.text());
    uniforms_.addText(name, value);
    values_[input.name] = value;
  }

  // The default must lie in the range: ISF does not ask for it.
  void addNumbers(const IsfInput& input, JsonObjectText& parameter) {
    const bool real = input.type != InputType::integer;
    const std::size_t count = input.type == InputType::point ? 2 : input.type == InputType::color ? 4 : 1;
    std::vector<double> initial = input.initial;
    if (initial.empty()) initial.assign(count, 0.0);
    double low = -3e38, high = 3e38;
    for (const double x : input.min) low = low < -2e38 ? x : std::min(low, x);
    for (const double x : input.max) high = high > 2e38 ? x : std::max(high, x);
    if (input.type == InputType::integer && !input.values.empty() && input.min.empty() && input.max.empty()) {
      low = *std::ranges::min_element(input.values);
      high = *std::ranges::max_element(input.values);
    }
    if (input.type == InputType::color && input.min.empty() && input.max.empty()) low = 0, high = 1;
    if (!real) {
      parameter.addText("type", "int");
      if (std::abs(low) < 2e9) low = std::floor(low);
      if (std::abs(high) < 2e9) high = std::floor(high);
    }
    if (input.initial.empty() && low <= high)
      std::ranges::for_each(initial, [&](double& x) { x = std::clamp(x, low, high); });
    for (const double x : initial) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
    if (real && count == 1) parameter.addText("type", "float");
    parameter.add("default", numbersText(initial, real));
    if (low > -2e38 && low < high) parameter.add("min", numberText(low, real));
    if (high < 2e38 && low < high) parameter.add("max", numberText(high, real));
  }

  // A word for each label, and the number that it stands for.
  bool addChoices(const IsfInput& input, JsonObjectText& parameter) {
    std::set<std::string> seen;
    std::vector<std::string> words;
    for (const std::string& label : input.labels) {
      std::string word = identifierOf(label);
      static constexpr std::string_view kShort = "xyzw";
      if (word.size() == 1 && kShort.find(word) != kShort.npos) word += '_';
      if (word == "mip" || word == "layer" || word == "face" || word == "stencil" || word == "true" ||
          word == "false" || word == "screen" || word == "device")
        word += '_';
      // Labels such as "Soft light" and "Soft-light" are one word: the second gets a number.
      const std::string first = word;
      for (int number = 2; !seen.insert(word).second; ++number) word = fmt::format("{}_{}", first, number);
      if (word.size() > 60) return false;
      words.push_back(std::move(word));
    }
    const double wanted = input.initial.empty() ? input.values[0] : input.initial[0];
    const auto found = std::ranges::find(input.values, wanted);
    if (found == input.values.end() || words.size() < 2) return false;
    std::string list, value;
    for (std::size_t i = 0; i < words.size(); ++i) {
      list += (i ? ", " : "") + base::quoteJson(words[i]);
      const std::string number = numberText(input.values[i], false);
      value += i + 1 == words.size()
                   ? number
                   : fmt::format("${} == {} ? {} : ", names_.of(input.name), words[i], number);
    }
    // Weft's expressions have at most 200 operators.
    if (words.size() > 60) return false;
    parameter.addText("default", words[static_cast<std::size_t>(found - input.values.begin())]);
    parameter.add("choices", "[" + list + "]");
    const std::string let = names_.fresh(names_.of(input.name) + "_value");
    choiceValues_[input.name] = let;
    lets_.addText(let, value);
    return true;
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
    resources_.add(chosen, fmt::format("[{}, {}]", base::quoteJson(name), base::quoteJson(nothing_)));
    chosen_[input.name] = chosen;
  }

  void addImported(const IsfImported& imported) {
    std::string path = imported.path;
    warnIfMissing(imported);
    if (!path.starts_with('/') && !options_.sourceFolder.empty()) path = options_.sourceFolder + "/" + path;
    if (path.starts_with('$')) path = "./" + path;
    addPicture(names_.of(imported.name), path);
  }

  void warnIfMissing(const IsfImported& imported) {
    const std::string beside = base::besideFile(imported.place, imported.path);
    std::error_code ignored;
    if (!base::mayRead(beside) || std::filesystem::exists(beside, ignored)) return;
    diagnostics_
        .warning(base::Code::unreadableImage, imported.place,
                 fmt::format("cannot read '{}': no such file", beside))
        .hint = "put the picture there before the graph is rendered";
  }

  void addPicture(const std::string& name, const std::string& file) {
    resources_.add(name, fmt::format(R"({{"import": "image", "file": {}}})", base::quoteJson(file)));
  }

  void findTargets() {
    for (const IsfPass& pass : header_.passes) {
      if (pass.target.empty()) continue;
      Target& target = targets_.try_emplace(pass.target, Target{.size = pass}).first->second;
      target.persistent |= pass.persistent;
      target.floats |= pass.floats;
    }
    // What nothing has written when it must be there is cleared.
    std::set<std::string> written;
    for (const IsfPass& pass : header_.passes) {
      for (auto& [name, target] : targets_)
        if (shader_.needed.contains(name) && !target.persistent && !written.contains(name))
          target.cleared = true;
      written.insert(pass.target);
    }
    const IsfPass& last = header_.passes.back();
    const bool plain = !last.target.empty() && last.width.empty() && last.height.empty() &&
                       !targets_.at(last.target).floats && !isScaled(last.target);
    shown_ = !last.target.empty() && !plain;
    for (const auto& [name, target] : targets_) addTarget(name, target);
    if (last.target.empty() || shown_)
      resources_.add(picture_, fmt::format(R"({{"texture": "rgba8", "size": "screen"{}}})",
                                           shader_.vertex.empty() ? "" : R"(, "clear": [0, 0, 0, 0])"));
    else
      picture_ = names_.of(last.target);
  }

  bool isScaled(const std::string& target) const {
    const IsfPass& size = targets_.at(target).size;
    return !size.width.empty() || !size.height.empty();
  }

  void addTarget(const std::string& name, const Target& target) {
    JsonObjectText texture;
    texture.addText("texture", target.floats ? "rgba32f" : "rgba8");
    texture.add("size", sizeOf(target.size));
    if (target.cleared || !shader_.vertex.empty()) texture.add("clear", "[0, 0, 0, 0]");
    if (target.persistent && shader_.read.contains(name)) texture.add("history", "1");
    resources_.add(names_.of(name), texture.text());
  }

  std::string sizeOf(const IsfPass& pass) {
    if (pass.width.empty() && pass.height.empty()) return "\"screen\"";
    const auto variable = [&](std::string_view name) -> std::string {
      if (name == "WIDTH") return "screen.x";
      if (name == "HEIGHT") return "screen.y";
      const auto value = values_.find(name);
      if (value != values_.end()) {
        const auto input = std::ranges::find(header_.inputs, name, &IsfInput::name);
        const bool number = input->type != InputType::point && input->type != InputType::color;
        return number ? value->second : std::string();
      }
      for (const std::string_view end : {"_WIDTH", "_HEIGHT"})
        if (name.ends_with(end)) {
          const auto image = names_.all().find(name.substr(0, name.size() - end.size()));
          if (image != names_.all().end() && !targets_.contains(image->first) &&
              !values_.contains(image->first))
            return fmt::format("size({}).{}", image->second, end == "_WIDTH" ? "x" : "y");
        }
      return {};
    };
    const auto side = [&](const std::string& text, const base::Place& place, const char* otherwise) {
      if (text.empty()) return std::string(otherwise);
      return convertIsfSize(text, place, variable, diagnostics_).value_or(otherwise);
    };
    return fmt::format("[{}, {}]", base::quoteJson(side(pass.width, pass.widthPlace, "screen.x")),
                       base::quoteJson(side(pass.height, pass.heightPlace, "screen.y")));
  }

  std::string readsOf() const {
    JsonObjectText reads;
    const auto add = [&](const std::string& name, const std::string& from, bool optional) {
      if (shader_.read.contains(name))
        reads.addText(names_.of(name), from + " as linear" + (optional ? " ?" : ""));
    };
    for (const IsfInput& input : header_.inputs)
      if (input.type == InputType::image)
        chosen_.contains(input.name) ? add(input.name, chosen_.at(input.name), false)
                                     : add(input.name, names_.of(input.name), true);
    for (const IsfImported& imported : header_.imported) add(imported.name, names_.of(imported.name), false);
    for (const auto& [name, target] : targets_) {
      if (target.written || target.cleared)
        add(name, names_.of(name), false);
      else if (target.persistent)
        add(name, names_.of(name) + "@-1", false);
    }
    return reads.empty() ? std::string() : reads.text();
  }

  void addPasses() {
    const std::size_t count = header_.passes.size();
    const bool many = count > 1;
    std::string first;
    for (std::size_t i = 0; i < count; ++i) {
      const IsfPass& pass = header_.passes[i];
      if (pass.target.empty() && i + 1 < count) {
        auto& d = diagnostics_.warning(
            base::Code::isfNotMapped, pass.place.file ? pass.place : file_,
            fmt::format("pass {} draws the picture, and the last pass draws it again", i));
        d.expected = "a TARGET in every pass but the last";
        d.hint = "the pass is left out";
        continue;
      }
      const std::string target = pass.target.empty() ? picture_ : names_.of(pass.target);
      JsonObjectText stanza;
      stanza.addText("name", passName("draw_" + target));
      if (first.empty()) {
        if (shader_.vertex.empty())
          stanza.addText("type", "fullscreen").addText("shader", shader_.fragment);
        else
          stanza.addText("type", "draw")
              .addText("geometry", "quad")
              .add("instances", "1")
              .add("shader", fmt::format(R"({{"vertex": {}, "fragment": {}}})",
                                         base::quoteJson(shader_.vertex), base::quoteJson(shader_.fragment)));
      } else {
        stanza.addText("like", first);
      }
      stanza.add("read", readsOf());
      stanza.add("write", fmt::format("{{{}: {}}}", base::quoteJson(kIsfOutput), base::quoteJson(target)));
      stanza.add("defines", fmt::format(R"({{"PASSINDEX": {}}})", i));
      if (first.empty()) {
        if (!uniforms_.empty()) stanza.add("parameters", uniforms_.text());
        if (many) first = lastName_;
      }
      passes_ += (passes_.empty() ? "" : ", ") + stanza.text();
      if (!pass.target.empty()) targets_.at(pass.target).written = true;
    }
    if (shown_) {
      JsonObjectText show;
      show.addText("name", passName("show")).addText("type", "fullscreen");
      show.addText("shader", options_.name + "/show.frag.glsl");
      show.add("read", fmt::format(R"({{"source": {}}})",
                                   base::quoteJson(names_.of(header_.passes.back().target) + " as linear")));
      show.add("write", fmt::format(R"({{"result": {}}})", base::quoteJson(picture_)));
      passes_ += ", " + show.text();
    }
  }

  std::string passName(const std::string& wanted) {
    std::string name = wanted;
    while (!passNames_.insert(name).second) name += '_';
    return lastName_ = name;
  }

  const IsfHeader& header_;
  IsfNames& names_;
  const IsfShader& shader_;
  const ConvertOptions& options_;
  const base::Place file_;
  base::Diagnostics& diagnostics_;
  std::string picture_;
  JsonObjectText parameters_, lets_, resources_, uniforms_;
  std::string passes_, lastName_;
  std::set<std::string> passNames_;
  std::map<std::string, Target, std::less<>> targets_;
  std::map<std::string, std::string, std::less<>> values_;    // of inputs, in expressions
  std::map<std::string, std::string> choiceValues_, chosen_;  // by input
  std::string nothing_;
  bool shown_ = false;  // the last pass draws a target of another kind than the picture
};

}  // namespace

std::optional<std::string> writeIsfGraph(const IsfHeader& header, IsfNames& names, const IsfShader& shader,
                                         const ConvertOptions& options, const base::Place& file,
                                         base::Diagnostics& diagnostics) {
  return IsfGraphWriter(header, names, shader, options, file, diagnostics).run();
}

}  // namespace weft::convert
