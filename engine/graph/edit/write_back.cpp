// Declared in edit.h.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "engine/graph/edit/edit.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/read.h"
#include "engine/text/files/file.h"
#include "engine/text/json/edit.h"
#include "graph_sentences.h"

namespace weft::graph {

namespace {

using text::Code;
using text::Diagnostics;

// Paths are the same when they lead to one file.
bool sameValue(const ParameterDesc& desc, const Value& x, const Value& y) {
  if (desc.type != ParameterDesc::Type::file || x.symbol.empty() || y.symbol.empty()) return x == y;
  return text::absolutePath(x.symbol) == text::absolutePath(y.symbol);
}

// Whether two graphs run alike: parameters, passes that run and those that are disabled, whatever disables them, and what they use.
bool sameGraph(const FlatGraph& a, const FlatGraph& b) {
  const auto parameter = [](const ParameterSpec& x, const ParameterSpec& y) {
    return x.path == y.path && sameValue(x.desc, x.value, y.value) && x.desc.type == y.desc.type;
  };
  const auto uniform = [](const UniformSpec& x, const UniformSpec& y) {
    return x.name == y.name && x.value == y.value;
  };
  const auto spec = [&](const PassSpec& x, const PassSpec& y) {
    return x.name == y.name && x.defines == y.defines && std::ranges::equal(x.uniforms, y.uniforms, uniform);
  };
  const auto disabled = [](const FlatGraph& graph) {
    std::set<std::string_view> all;
    for (const DisabledPass& pass : graph.disabled) all.insert(pass.name);
    return all;
  };
  return std::ranges::equal(a.parameters, b.parameters, parameter) &&
         std::ranges::equal(a.specs, b.specs, spec) && a.passNames == b.passNames &&
         disabled(a) == disabled(b) && a.resourceNames == b.resourceNames && a.resources == b.resources &&
         a.uses.size() == b.uses.size();
}

using text::JsonEdit;
using text::JsonValue;

struct TextEdit {
  std::string path, text;
};

std::string shortest(const std::string& path, std::span<const std::string> paths) {
  for (std::size_t dot = path.rfind('.'); dot != std::string::npos && dot > 0;
       dot = path.rfind('.', dot - 1)) {
    const std::string suffix = path.substr(dot + 1);
    if (suffixMatches(paths, suffix).size() == 1) return suffix;
  }
  return path;
}

// A number as it stood before stays one that reads as the same type: "2.0" does not become "3".
std::string numberText(double x, std::string_view before) {
  std::string text = fmt::format("{}", x == 0 ? 0.0 : x);
  if (before.find_first_of(".eE") != std::string_view::npos && text.find_first_of(".e") == std::string::npos)
    text += ".0";
  return text;
}

std::string valueText(const Value& value) {
  return value.type == Value::Type::symbol ? text::quoteJson(value.symbol) : toText(value);
}

// `value` in the place of what stands there; of a list only the items that differ.
std::optional<std::string> putValue(const std::string& text, const Place& place, const Value& value) {
  const JsonEdit edit(text);
  if (!edit) return std::nullopt;
  const JsonValue& at = edit.valueAt(place);
  if (value.type == Value::Type::number) return edit.withValue(at, numberText(value.v[0], edit.written(at)));
  if (value.type != Value::Type::list || at.items.size() != value.count)
    return edit.withValue(at, valueText(value));
  std::string out = text;
  for (std::size_t i = at.items.size(); i-- > 0;)  // from behind, so that the others stay in their places
    if (const JsonValue& item = at.items[i]; item.number != value.v[i])
      out.replace(item.begin, item.end - item.begin, numberText(value.v[i], edit.written(item)));
  return out;
}

std::optional<std::string> putInSet(const std::string& text, const std::string& name, const Value& value) {
  const JsonEdit edit(text);
  if (!edit) return std::nullopt;
  const JsonValue& root = edit.root();
  if (const JsonValue* set = root.find("set"))
    return set->find(name) ? std::nullopt : std::optional(edit.withMember(*set, name, valueText(value)));
  const char* after = root.find("extends") ? "extends" : root.find("name") ? "name" : "";
  return edit.withMember(root, "set", fmt::format("{{ {}: {} }}", text::quoteJson(name), valueText(value)),
                         after);
}

// The file that changes go into when the graph is laid over others: the last preset, or the graph's own when it extends another; else nothing.
std::optional<std::string> overlayOf(const GraphDesc& desc, std::span<const std::string> presets) {
  if (!presets.empty()) return presets.back();
  return !desc.top.empty() && desc.top == desc.path ? std::optional(desc.path) : std::nullopt;
}

// The key of a pass or include behind which "enabled" is looked for.
const char* lastOfHead(const JsonValue& stanza) {
  for (const char* key : {"shader", "type", "as"})
    if (stanza.find(key)) return key;
  return "include";
}

// Adds the file as `change` makes it; nothing when it does not.
template <class Change>
void addEdit(std::vector<TextEdit>& edits, const FileTexts& texts, const std::string& path,
             const Change& change) {
  const auto text = texts.find(path);
  if (text == texts.end()) return;
  if (auto edited = change(*text->second)) edits.push_back({path, *std::move(edited)});
}

// Where in the files `wanted.value` may be written for `wanted.path`, the best place first, as whole edited texts; `declared` is its
// declaration in them, `paths` are the full names of all parameters.
std::vector<TextEdit> editsOfParameter(const GraphDesc& desc, std::span<const std::string> presets,
                                       const FileTexts& texts, const ParameterSpec& wanted,
                                       const ParameterDesc& declared, std::span<const std::string> paths) {
  std::vector<TextEdit> edits;
  // A path is written from the folder of the file it stands in.
  const auto valueIn = [&](const std::string& path) {
    Value value = wanted.value;
    if (declared.type != ParameterDesc::Type::file || value.symbol.empty()) return value;
    if (std::filesystem::path(value.symbol).is_absolute()) return value;
    const std::filesystem::path whole = text::absolutePath(value.symbol);
    value.symbol =
        whole.lexically_relative(std::filesystem::path(text::absolutePath(path)).parent_path()).string();
    return value;
  };
  const auto put = [&](const Place& place) {
    if (!place.file) return;
    addEdit(edits, texts, *place.file,
            [&](const std::string& text) { return putValue(text, place, valueIn(*place.file)); });
  };
  const auto putSet = [&](const std::string& path) {
    const std::string name = shortest(wanted.path, paths);
    addEdit(edits, texts, path, [&](const std::string& text) { return putInSet(text, name, valueIn(path)); });
  };
  // The outermost file has the last word, and in it the last entry.
  eachFile(desc, [&](const std::string& prefix, const GraphDesc& file) {
    std::vector<std::string> names;
    for (const std::string& path : paths)
      if (path.starts_with(prefix)) names.push_back(path.substr(prefix.size()));
    for (auto set = file.sets.rbegin(); set != file.sets.rend(); ++set)
      if (const auto means = suffixMatches(names, set->name);
          means.size() == 1 && prefix + names[means[0]] == wanted.path)
        put(set->valuePlace);
  });
  if (const auto overlay = overlayOf(desc, presets)) putSet(*overlay);
  put(declared.initialPlace);
  putSet(desc.path);
  return edits;
}

// The same for "enabled": false of the pass or include of this declared name.
std::vector<TextEdit> editsOfPass(const GraphDesc& desc, std::span<const std::string> presets,
                                  const FileTexts& texts, const std::string& name) {
  std::vector<TextEdit> edits;
  if (const auto overlay = overlayOf(desc, presets))
    addEdit(edits, texts, *overlay, [&](const std::string& text) -> std::optional<std::string> {
      const JsonEdit edit(text);
      if (!edit) return std::nullopt;
      const std::string stanza = fmt::format("{{ \"name\": {}, \"enabled\": false }}", text::quoteJson(name));
      if (const JsonValue* passes = edit.root().find("passes")) return edit.withItem(*passes, stanza);
      return edit.withMember(edit.root(), "passes", "[" + stanza + "]");
    });
  const PassDesc* pass = nullptr;
  eachPass(desc, [&](const std::string& each, const PassDesc& found) {
    if (each == name) pass = &found;
  });
  if (pass && pass->place.file)
    addEdit(edits, texts, *pass->place.file, [&](const std::string& text) -> std::optional<std::string> {
      const JsonEdit edit(text);
      if (!edit) return std::nullopt;
      const JsonValue& stanza = edit.valueAt(pass->place);
      const JsonValue* enabled = stanza.find("enabled");
      if (!enabled) return edit.withMember(stanza, "enabled", "false", lastOfHead(stanza));
      if (!enabled->is(JsonValue::Type::string)) return edit.withValue(*enabled, "false");
      // The condition stays readable, and comes back when "&& false" is removed.
      const bool loose = enabled->text.find_first_of("?|") != std::string::npos;
      const std::string kept = loose ? "(" + enabled->text + ")" : enabled->text;
      return edit.withValue(*enabled, text::quoteJson(kept + " && false"));
    });
  return edits;
}

class Planner {
 public:
  Planner(const GraphDesc& desc, std::span<const std::string> presets, const Registry& registry,
          const Settings& settings, Diagnostics& diagnostics)
      : desc_(desc),
        presets_(presets),
        registry_(registry),
        diagnostics_(diagnostics),
        now_(&desc),
        texts_(desc.texts) {
    out_.rest = settings;
  }

  std::optional<WriteBack> run() {
    wanted_ = expand(desc_);
    if (!wanted_) return fail("the graph with these changes", "nothing: it is not valid"), std::nullopt;
    for (const ParameterSpec& parameter : wanted_->parameters) paths_.push_back(parameter.path);
    files_ = wanted_;
    for (std::size_t i = 0; i < wanted_->parameters.size(); ++i)
      if (!writeParameter(wanted_->parameters[i], i)) return std::nullopt;
    const std::vector<Disable> disables = out_.rest.disables;
    for (const Disable& disable : disables)
      if (!writePass(disable.name)) return std::nullopt;
    for (const auto& [path, text] : texts_)
      if (const auto before = desc_.texts.find(path); *before->second != *text)
        out_.files.push_back({path, *before->second, *text});
    return std::move(out_);
  }

 private:
  void fail(const std::string& what, const std::string& found, const text::Place& place = {}) {
    diagnostics_.error(say::cannotWriteBack, place, what, found);
  }

  std::shared_ptr<const FlatGraph> expand(const GraphDesc& desc) const {
    Diagnostics said;
    auto graph = expandGraph(desc, registry_, out_.rest, said);
    return said.hasErrors() ? nullptr : graph;
  }
  // Whether files give the graph that runs; it becomes files_.
  bool giveWanted(const GraphDesc& desc) {
    auto made = expand(desc);
    if (!made || !sameGraph(*made, *wanted_)) return false;
    files_ = std::move(made);
    return true;
  }

  bool writeParameter(const ParameterSpec& wanted, std::size_t index) {
    const auto means = [&](const Setting& set) {
      const auto found = suffixMatches(paths_, set.name);
      return found.size() == 1 && paths_[found[0]] == wanted.path;
    };
    if (std::erase_if(out_.rest.sets, means) == 0 || giveWanted(*now_))
      return true;  // the files say so already
    for (const TextEdit& edit :
         editsOfParameter(*now_, presets_, texts_, wanted, files_->parameters[index].desc, paths_))
      if (take(edit)) return true;
    fail(fmt::format("parameter '{}'", wanted.path), toText(wanted.value), wanted.desc.place);
    return false;
  }

  bool writePass(const std::string& name) {
    std::vector<std::string> declared;
    eachPass(*now_, [&](const std::string& each, const PassDesc&) { declared.push_back(each); });
    const std::vector<std::size_t> found = suffixMatches(declared, name);
    if (found.empty()) return true;  // an instance
    const std::string& pass = declared[found[0]];
    std::erase_if(out_.rest.disables, [&](const Disable& each) { return each.name == name; });
    if (giveWanted(*now_)) return true;
    for (const TextEdit& edit : editsOfPass(*now_, presets_, texts_, pass))
      if (take(edit)) return true;
    fail(fmt::format("\"enabled\": false of pass '{}'", pass), "no edit gives the graph that runs");
    return false;
  }

  // Keeps the edit when the files with it, and the settings that are left, give the graph that runs.
  bool take(const TextEdit& edit) {
    FileTexts texts = texts_;
    texts[edit.path] = std::make_shared<const std::string>(edit.text);
    Diagnostics said;
    auto desc = readGraph(desc_.path, said, {.presets = presets_, .given = texts});
    if (!desc || said.hasErrors() || !giveWanted(*desc)) return false;
    texts_ = std::move(texts);
    kept_ = std::move(desc);
    now_ = kept_.get();
    return true;
  }

  const GraphDesc& desc_;
  std::span<const std::string> presets_;
  const Registry& registry_;
  Diagnostics& diagnostics_;
  std::shared_ptr<const FlatGraph> wanted_, files_;  // what runs; the same of the files with the edits so far
  std::vector<std::string> paths_;
  std::shared_ptr<const GraphDesc> kept_;
  const GraphDesc* now_;  // with the edits so far
  FileTexts texts_;
  WriteBack out_;
};

}  // namespace

std::optional<WriteBack> planWriteBack(const GraphDesc& desc, std::span<const std::string> presets,
                                       const Registry& registry, const Settings& settings,
                                       text::Diagnostics& diagnostics) {
  return Planner(desc, presets, registry, settings, diagnostics).run();
}

bool saveWriteBack(const WriteBack& plan, text::Diagnostics& diagnostics) {
  bool same = true;
  for (const WriteBack::File& file : plan.files) {
    const auto now = text::readFile(file.path, diagnostics);
    if (now && *now == file.before) continue;
    same = false;
    if (!now) continue;
    diagnostics.error(say::fileChanged, {file.path, 0, 0}, file.path);
  }
  if (!same) return false;
  for (std::size_t i = 0; i < plan.files.size(); ++i) {
    if (text::writeFile(plan.files[i].path, plan.files[i].after, diagnostics)) continue;
    for (std::size_t done = 0; done < i; ++done)
      text::writeFile(plan.files[done].path, plan.files[done].before, diagnostics);
    return false;
  }
  return true;
}

}  // namespace weft::graph
