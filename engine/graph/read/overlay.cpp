#include "engine/graph/read/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "engine/base/files/file_access.h"
#include "engine/base/files/text_file.h"
#include "engine/base/limits.h"
#include "engine/graph/language/enough.h"
#include "engine/graph/read/misspelt_keys.h"
#include "engine/graph/read/overlay_apply.h"

namespace weft::graph {

using base::Code;
using base::JsonMember;
using base::JsonValue;
using Type = JsonValue::Type;

namespace {

// The keys of stanzas in overlays mean nothing where there is nothing to lay them over.
void reportOverlayStanzas(const JsonValue& root, base::Diagnostics& diagnostics) {
  const JsonValue* passes = root.find("passes");
  if (!passes || !passes->is(Type::array)) return;
  for (const JsonValue& stanza : passes->items)
    for (const JsonMember& member : stanza.members)
      if (member.key == "before" || member.key == "after" || member.key == "remove") {
        if (enoughErrors(diagnostics)) return;
        auto& d = diagnostics.error(Code::overlayOutOfPlace, member.place,
                                    fmt::format("\"{}\" in a file that extends no other", member.key));
        d.pass = stanzaName(stanza);
        d.hint = "write the pass at its place in the list, or say what this file \"extends\"";
      }
}

std::size_t valuesOf(const JsonValue& value) {
  std::size_t count = 1;
  for (const JsonValue& item : value.items) count += valuesOf(item);
  for (const JsonMember& member : value.members) count += valuesOf(member.value);
  return count;
}

void eraseMember(JsonValue& object, std::string_view key) {
  std::erase_if(object.members, [&](const JsonMember& member) { return member.key == key; });
}

void eraseStanzaKeys(JsonValue& root) {
  for (JsonMember& member : root.members)
    if (member.key == "passes")
      for (JsonValue& stanza : member.value.items)
        for (const char* key : {"before", "after", "remove"}) eraseMember(stanza, key);
}

// What "extends" names: a path, or a list of paths. Empty after a report.
std::vector<const JsonValue*> namesIn(const JsonValue& extends, base::Diagnostics& diagnostics) {
  std::vector<const JsonValue*> names;
  if (extends.is(Type::string)) names.push_back(&extends);
  for (const JsonValue& item : extends.items) names.push_back(&item);
  const auto wrong =
      std::ranges::find_if(names, [](const JsonValue* name) { return !name->is(Type::string); });
  if (!names.empty() && wrong == names.end()) return names;
  const JsonValue& found = names.empty() ? extends : **wrong;
  auto& d = diagnostics.error(Code::wrongType, found.place, "\"extends\" has the wrong type");
  d.expected = "the path of a graph, from this file's folder, or a list of that and of overlays";
  d.found = describe(found);
  return {};
}

// Whether a file without "extends" has passes that none before it has: no stanza says where it stands.
bool isWholeGraph(const JsonValue& root) {
  const JsonValue* passes = root.find("passes");
  if (!passes || passes->items.empty()) return false;
  return std::ranges::all_of(passes->items, [](const JsonValue& stanza) {
    return (stanza.find("type") || stanza.find("include") || stanza.find("like")) && !stanza.find("before") &&
           !stanza.find("after");
  });
}

}  // namespace

std::string includePrefix(const JsonValue& stanza) {
  if (const JsonValue* as = stanza.find("as")) return as->text;
  const JsonValue* include = stanza.find("include");
  return include ? std::filesystem::path(include->text).stem().string() : std::string();
}

std::string pathBeside(const JsonValue& written) {
  const std::filesystem::path from = written.place.file ? *written.place.file : std::string();
  return (from.parent_path() / written.text).lexically_normal().string();
}

std::string identityOf(const std::string& path) {
  // What may not be read is not followed either: it is what it is called.
  if (!base::mayRead(path)) return std::filesystem::path(path).lexically_normal().string();
  std::error_code ec;
  const auto canonical = std::filesystem::weakly_canonical(path, ec);
  return ec ? path : canonical.string();
}

std::shared_ptr<const Source> SourceLoader::file(const std::string& path, const base::Place& from) {
  const std::string identity = identityOf(path);
  if (const auto known = known_.find(identity); known != known_.end()) return known->second;
  const std::shared_ptr<const std::string> bytes = bytesOf(path, from);
  std::shared_ptr<const Source> source = bytes ? text(*bytes, path) : nullptr;
  known_[identity] = source;
  return source;
}

std::shared_ptr<const std::string> SourceLoader::bytesOf(const std::string& path, const base::Place& from) {
  if (const auto found = given_.find(path); found != given_.end()) return texts_[path] = found->second;
  std::optional<std::string> bytes = base::readTextFile(path, diagnostics_, Code::unreadableFile, from);
  return bytes ? texts_[path] = std::make_shared<const std::string>(*std::move(bytes)) : nullptr;
}

std::shared_ptr<const Source> SourceLoader::text(std::string_view text, const std::string& path) {
  if (!texts_.contains(path)) texts_[path] = std::make_shared<const std::string>(text);
  std::optional<JsonValue> root =
      base::parseJson(text, std::make_shared<const std::string>(path), diagnostics_);
  if (!root) return nullptr;
  mendKeys(*root, false, diagnostics_);
  return complete(*std::move(root), path);
}

bool SourceLoader::mayCopy(const Source& source, const base::Place& place) {
  values_ += source.values;
  if (values_ <= base::raised(base::kMostValues)) return true;
  if (!std::exchange(tooMany_, true)) {
    auto& d =
        base::reportLimit(diagnostics_, place,
                          "the files of the graph and the copies that overlays change hold too many values",
                          base::kMostValues, "values");
    d.found = fmt::format("{} with '{}'", values_, source.path);
  }
  return false;
}

std::shared_ptr<const Source> SourceLoader::complete(JsonValue root, const std::string& path) {
  if (const JsonValue* extends = root.find("extends")) return completeOverlay(root, *extends, path);
  Source source{.path = path, .identity = identityOf(path), .files = {path}};
  const JsonValue* set = root.find("set");
  if (set && !root.find("passes")) {
    auto& d = diagnostics_.error(Code::overlayOutOfPlace, set->place,
                                 fmt::format("'{}' is a preset, not a graph", path));
    d.hint = fmt::format(
        "lay it over a graph: weft check GRAPH --preset {}; or say what this file \"extends\"", path);
    return nullptr;
  }
  if (set && set->is(Type::object)) {
    for (const base::JsonMember& member : set->members) source.sets.push_back({member, Origin::file});
    eraseMember(root, "set");
  }
  reportOverlayStanzas(root, diagnostics_);
  eraseStanzaKeys(root);
  source.values = valuesOf(root);
  if (!mayCopy(source, root.place)) return nullptr;
  source.root = std::move(root);
  return std::make_shared<const Source>(std::move(source));
}

std::shared_ptr<const Source> SourceLoader::completeOverlay(const JsonValue& root, const JsonValue& extends,
                                                            const std::string& path) {
  Source source{.path = path, .identity = identityOf(path), .files = {path}};
  const std::vector<const JsonValue*> below = namesIn(extends, diagnostics_);
  if (below.empty()) return nullptr;
  open_.emplace_back(source.identity, path);
  const std::shared_ptr<const Source> base = openBase(*below[0]);
  bool good = base && mayCopy(*base, extends.place);
  if (good) {
    source.files.insert(source.files.end(), base->files.begin(), base->files.end());
    source.root = base->root;
    source.sets = base->sets;
    source.changed = base->changed;
    source.removed = base->removed;
    source.named = base->named;
    for (std::size_t i = 1; i < below.size(); ++i) {
      const std::string over = pathBeside(*below[i]);
      good = extendBy(source, over, *below[i], false) && good;
    }
    if (source.root.is(Type::object)) {
      source.root.place = root.place;
      for (const char* own : {"name", "description"}) eraseMember(source.root, own);  // of the base
      applyOverlay(*this, root, false, source, diagnostics_);
    }
    source.values = valuesOf(source.root);
    source.top = path;
  }
  open_.pop_back();
  return good ? std::make_shared<const Source>(std::move(source)) : nullptr;
}

std::shared_ptr<const Source> SourceLoader::openBase(const JsonValue& written) {
  const std::string below = pathBeside(written);
  return mayExtend(written, below) ? file(below, written.place) : nullptr;
}

bool SourceLoader::mayExtend(const JsonValue& written, const std::string& below) {
  const std::string identity = identityOf(below);
  if (open_.size() > kMostInRow) {
    auto& limit = diagnostics_.error(Code::limitExceeded, written.place,
                                     "overlays extend each other in too long a row");
    limit.expected = fmt::format("at most {}", kMostInRow);
    limit.found = fmt::format("'{}', one more", below);
    return false;
  }
  if (!isOpen(identity)) return true;
  auto& d = diagnostics_.error(Code::extendsItself, written.place, fmt::format("'{}' extends itself", below));
  bool again = false;
  for (const auto& [openIdentity, openPath] : open_) {
    again = again || openIdentity == identity;
    if (again) d.found += openPath + " -> ";
  }
  d.found += below;
  d.hint = "one of these must not extend the next";
  return false;
}

bool SourceLoader::isOpen(const std::string& identity) const {
  return std::any_of(open_.begin(), open_.end(), [&](const auto& file) { return file.first == identity; });
}

std::shared_ptr<const Source> SourceLoader::withPreset(const Source& source, const std::string& path) {
  Source made = source;
  if (!layOver(made, path, nullptr, true)) return nullptr;
  made.values = valuesOf(made.root);
  return std::make_shared<const Source>(std::move(made));
}

bool SourceLoader::extendBy(Source& made, const std::string& path, const JsonValue& written, bool preset) {
  if (broken_.contains(identityOf(path))) return false;
  if (mayExtend(written, path) && layOver(made, path, &written, preset)) return true;
  broken_.insert(identityOf(path));
  return false;
}

bool SourceLoader::layOver(Source& made, const std::string& path, const JsonValue* written, bool preset) {
  const std::shared_ptr<const std::string> bytes = bytesOf(path, written ? written->place : base::Place{});
  if (!bytes) return false;
  std::optional<JsonValue> root =
      base::parseJson(*bytes, std::make_shared<const std::string>(path), diagnostics_);
  if (!root) return false;
  mendKeys(*root, true, diagnostics_);
  if (!root->is(Type::object)) {
    auto& d = diagnostics_.error(Code::wrongType, root->place, "a preset has the wrong type");
    d.expected = "an object";
    d.found = describe(*root);
    return false;
  }
  const JsonValue* extends = root->find("extends");
  if (written && !extends && isWholeGraph(*root)) {
    auto& d =
        diagnostics_.error(Code::overlayOutOfPlace, written->place,
                           fmt::format("'{}' is a graph of its own, which nothing can be laid under", path));
    d.expected = fmt::format("an overlay on '{}', or a preset", made.path);
    d.hint = "a file extends one graph, the first of its list; give the others as includes";
    return false;
  }
  open_.emplace_back(identityOf(path), path);
  bool good = true;
  if (extends) {
    const std::vector<const JsonValue*> below = namesIn(*extends, diagnostics_);
    good = !below.empty();
    for (const JsonValue* each : below) {
      const std::string file = pathBeside(*each), identity = identityOf(file);
      const bool there = std::ranges::any_of(
          made.files, [&](const std::string& known) { return identityOf(known) == identity; });
      if (there && !isOpen(identity)) continue;  // it is below already
      good = extendBy(made, file, *each, preset) && good;
    }
  }
  good = good && mayCopy(made, root->place);
  if (good) {
    made.files.push_back(path);
    made.top = path;
    if (made.root.is(Type::object)) applyOverlay(*this, *root, preset, made, diagnostics_);
  }
  open_.pop_back();
  return good;
}

}  // namespace weft::graph
