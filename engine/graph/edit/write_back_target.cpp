#include "engine/graph/edit/write_back_target.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

#include "engine/base/json/edit.h"
#include "engine/graph/language/suffix.h"

namespace weft::graph {

namespace {

using base::JsonEdit;
using base::JsonValue;

// The files from the graph's own down to the one that declares something: prefix of names and description.
using Chain = std::vector<std::pair<std::string, const GraphDesc*>>;

// Calls visit(chain, pass) for every pass and include of the graph and of what it includes.
template <class Visit>
void eachPass(Chain& chain, const Visit& visit) {
  const auto [prefix, desc] = chain.back();
  for (const PassDesc& pass : desc->passes) {
    visit(chain, pass);
    if (pass.include && pass.include->graph) {
      chain.emplace_back(prefix + pass.include->as + ".", pass.include->graph.get());
      eachPass(chain, visit);
      chain.pop_back();
    }
  }
}

struct DeclaredParameter {
  Chain chain;
  const ParameterDesc* desc = nullptr;
};

void findIn(Chain& chain, const std::string& path, DeclaredParameter& found) {
  const auto [prefix, desc] = chain.back();
  for (const ParameterDesc& parameter : desc->parameters)
    if (prefix + parameter.name == path) found = {chain, &parameter};
  for (const PassDesc& pass : desc->passes) {
    for (const PassParameterDesc& parameter : pass.parameters)
      if (parameter.declared && prefix + pass.name + "." + parameter.name == path)
        found = {chain, &*parameter.declared};
    if (pass.include && pass.include->graph && path.starts_with(prefix + pass.include->as + ".")) {
      chain.emplace_back(prefix + pass.include->as + ".", pass.include->graph.get());
      findIn(chain, path, found);
      chain.pop_back();
    }
  }
}

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
  return value.type == Value::Type::symbol ? base::quoteJson(value.symbol) : toText(value);
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
  return edit.withMember(root, "set", fmt::format("{{ {}: {} }}", base::quoteJson(name), valueText(value)),
                         after);
}

// The file that changes belong into when the graph is laid over others: the last preset, or the graph's own
// when it extends another; else nothing.
std::optional<std::string> overlayOf(const GraphDesc& desc, std::span<const std::string> presets,
                                     const FileTexts& texts) {
  if (!presets.empty()) return presets.back();
  const auto own = texts.find(desc.path);
  const bool extends = own != texts.end() && JsonEdit(*own->second).root().find("extends");
  return extends ? std::optional(desc.path) : std::nullopt;
}

// The key of a pass or include behind which "enabled" is looked for.
const char* lastOfHead(const JsonValue& stanza) {
  for (const char* key : {"shader", "type", "like", "as"})
    if (stanza.find(key)) return key;
  return "include";
}

class Edits {
 public:
  explicit Edits(const FileTexts& texts) : texts_(texts) {}
  template <class Change>
  void add(const std::string& path, const Change& change) {
    const auto text = texts_.find(path);
    if (text == texts_.end()) return;
    if (auto edited = change(*text->second)) made.push_back({path, *std::move(edited)});
  }
  std::vector<TextEdit> made;

 private:
  const FileTexts& texts_;
};

}  // namespace

std::vector<TextEdit> editsOfParameter(const GraphDesc& desc, std::span<const std::string> presets,
                                       const FileTexts& texts, const ParameterSpec& wanted,
                                       std::span<const std::string> paths) {
  Chain chain = {{"", &desc}};
  DeclaredParameter found;
  findIn(chain, wanted.path, found);
  if (!found.desc) return {};
  Edits edits(texts);
  // The outermost file has the last word, and in it the last entry.
  const SetDesc* deciding = nullptr;
  for (const auto& [prefix, file] : found.chain) {
    std::vector<std::string> names;
    for (const std::string& path : paths)
      if (path.starts_with(prefix)) names.push_back(path.substr(prefix.size()));
    for (auto set = file->sets.rbegin(); set != file->sets.rend() && !deciding; ++set)
      if (const auto means = suffixMatches(names, set->name);
          means.size() == 1 && prefix + names[means[0]] == wanted.path)
        deciding = &*set;
  }
  // A path is written from the folder of the file it stands in.
  const auto valueIn = [&](const std::string& path) {
    Value value = wanted.value;
    if (found.desc->type != ParameterDesc::Type::file || value.symbol.empty()) return value;
    if (std::filesystem::path(value.symbol).is_absolute()) return value;
    std::error_code ignored;
    const auto whole = [&](const std::filesystem::path& at) {
      return std::filesystem::absolute(at, ignored).lexically_normal();
    };
    value.symbol = whole(value.symbol).lexically_relative(whole(path).parent_path()).string();
    return value;
  };
  const auto put = [&](const Place& place) {
    if (!place.file) return;
    edits.add(*place.file,
              [&](const std::string& text) { return putValue(text, place, valueIn(*place.file)); });
  };
  const auto putSet = [&](const std::string& path) {
    const std::string name = shortest(wanted.path, paths);
    edits.add(path, [&](const std::string& text) { return putInSet(text, name, valueIn(path)); });
  };
  if (deciding) put(deciding->valuePlace);
  if (const auto overlay = overlayOf(desc, presets, texts)) putSet(*overlay);
  put(found.desc->initialPlace);
  putSet(desc.path);
  return std::move(edits.made);
}

std::vector<std::string> declaredPasses(const GraphDesc& desc) {
  std::vector<std::string> names;
  Chain chain = {{"", &desc}};
  eachPass(chain,
           [&](const Chain& at, const PassDesc& pass) { names.push_back(at.back().first + pass.name); });
  return names;
}

std::vector<TextEdit> editsOfPass(const GraphDesc& desc, std::span<const std::string> presets,
                                  const FileTexts& texts, const std::string& name) {
  Edits edits(texts);
  if (const auto overlay = overlayOf(desc, presets, texts))
    edits.add(*overlay, [&](const std::string& text) -> std::optional<std::string> {
      const JsonEdit edit(text);
      if (!edit) return std::nullopt;
      const std::string stanza = fmt::format("{{ \"name\": {}, \"enabled\": false }}", base::quoteJson(name));
      if (const JsonValue* passes = edit.root().find("passes")) return edit.withItem(*passes, stanza);
      return edit.withMember(edit.root(), "passes", "[" + stanza + "]");
    });
  const PassDesc* pass = nullptr;
  Chain chain = {{"", &desc}};
  eachPass(chain, [&](const Chain& at, const PassDesc& each) {
    if (at.back().first + each.name == name) pass = &each;
  });
  if (pass && pass->place.file)
    edits.add(*pass->place.file, [&](const std::string& text) -> std::optional<std::string> {
      const JsonEdit edit(text);
      if (!edit) return std::nullopt;
      const JsonValue& stanza = edit.valueAt(pass->place);
      const JsonValue* enabled = stanza.find("enabled");
      if (!enabled) return edit.withMember(stanza, "enabled", "false", lastOfHead(stanza));
      if (!enabled->is(JsonValue::Type::string)) return edit.withValue(*enabled, "false");
      // The condition stays readable, and comes back when "&& false" is removed.
      const bool loose = enabled->text.find_first_of("?|") != std::string::npos;
      const std::string kept = loose ? "(" + enabled->text + ")" : enabled->text;
      return edit.withValue(*enabled, base::quoteJson(kept + " && false"));
    });
  return std::move(edits.made);
}

}  // namespace weft::graph
