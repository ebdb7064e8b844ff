#include "engine/graph/read/overlay.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "engine/graph/read/merge.h"
#include "engine/graph/read/misspelt.h"
#include "engine/graph/read/read_context.h"
#include "engine/text/files/file.h"
#include "engine/text/limits.h"

namespace weft::graph {

using text::Code;
using Type = JsonValue::Type;

namespace {

// Takes the keys of stanzas in overlays away, which mean nothing where there is nothing to lay them over.
void dropOverlayKeys(JsonValue& root, text::Diagnostics& diagnostics) {
  JsonMember* passes = memberOf(root, "passes");
  if (!passes) return;
  for (JsonValue& stanza : passes->value.items)
    std::erase_if(stanza.members, [&](const JsonMember& member) {
      if (member.key != "before" && member.key != "after" && member.key != "remove") return false;
      ReadContext said(diagnostics);
      said.pass = stanzaName(stanza);
      said.error(Code::overlayOutOfPlace, member.place,
                 fmt::format("\"{}\" in a file that extends no other", member.key))
          .hint = "write the pass at its place in the list, or say what this file \"extends\"";
      return true;
    });
}

// What "extends" names: a path, or a list of paths. Empty after a report.
std::vector<const JsonValue*> namesIn(const JsonValue& extends, text::Diagnostics& diagnostics) {
  std::vector<const JsonValue*> names;
  if (extends.is(Type::string)) names.push_back(&extends);
  for (const JsonValue& item : extends.items) names.push_back(&item);
  const auto wrong =
      std::ranges::find_if(names, [](const JsonValue* name) { return !name->is(Type::string); });
  if (!names.empty() && wrong == names.end()) return names;
  const JsonValue& found = names.empty() ? extends : **wrong;
  ReadContext(diagnostics)
      .wrongType(found, "\"extends\"", "the path of a graph, or a list of that and of overlays");
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

std::string pathBeside(const JsonValue& written) {
  const std::filesystem::path from = written.place.file ? *written.place.file : std::string();
  return (from.parent_path() / written.text).lexically_normal().string();
}

std::string identityOf(const std::string& path) {
  // What may not be read is not followed either: it is what it is called.
  if (!text::mayRead(path)) return std::filesystem::path(path).lexically_normal().string();
  std::error_code ec;
  const auto canonical = std::filesystem::weakly_canonical(path, ec);
  return ec ? path : canonical.string();
}

std::shared_ptr<const Source> SourceLoader::file(const std::string& path, const text::Place& from) {
  const std::string identity = identityOf(path);
  if (const auto known = known_.find(identity); known != known_.end()) return known->second;
  std::optional<JsonValue> root = parse(path, from, false);
  return known_[identity] = root ? complete(*std::move(root), path) : nullptr;
}

std::optional<JsonValue> SourceLoader::parse(const std::string& path, const text::Place& from, bool preset) {
  if (const auto found = given_.find(path); found != given_.end()) {
    texts_[path] = found->second;
  } else {
    std::optional<std::string> bytes = text::readTextFile(path, diagnostics_, Code::unreadableFile, from);
    if (!bytes) return std::nullopt;
    texts_[path] = std::make_shared<const std::string>(*std::move(bytes));
  }
  std::optional<JsonValue> root =
      text::parseJson(*texts_[path], std::make_shared<const std::string>(path), diagnostics_);
  if (root) mendKeys(*root, preset, diagnostics_);
  return root;
}

bool SourceLoader::mayCopy(const Source& source, const text::Place& place) {
  values_ += source.values;
  if (values_ <= text::raised(text::kMaxValues)) return true;
  if (!std::exchange(tooMany_, true))
    text::reportLimit(diagnostics_, place,
                      "the files of the graph and the copies that overlays change hold too many values",
                      text::kMaxValues, "values")
        .found = fmt::format("{} with '{}'", values_, source.path);
  return false;
}

std::shared_ptr<const Source> SourceLoader::complete(JsonValue root, const std::string& path) {
  Source source{.path = path, .identity = identityOf(path), .files = {path}};
  const JsonValue* set = root.find("set");
  const JsonValue* extends = root.find("extends");
  if (!extends && set && !root.find("passes")) {
    diagnostics_
        .error(Code::overlayOutOfPlace, set->place, fmt::format("'{}' is a preset, not a graph", path))
        .hint = fmt::format(
        "lay it over a graph: weft check GRAPH --preset {}; or say what this file \"extends\"", path);
    return nullptr;
  }
  if (!extends) {
    if (set && set->is(Type::object)) {
      for (const JsonMember& member : set->members) source.sets.push_back({member, Origin::file});
      std::erase_if(root.members, [](const JsonMember& member) { return member.key == "set"; });
    }
    dropOverlayKeys(root, diagnostics_);
    source.values = valuesOf(root);
    if (!mayCopy(source, root.place)) return nullptr;
    source.root = std::move(root);
    return std::make_shared<const Source>(std::move(source));
  }
  const std::vector<const JsonValue*> below = namesIn(*extends, diagnostics_);
  if (below.empty()) return nullptr;
  open_.emplace_back(source.identity, path);
  const std::shared_ptr<const Source> base =
      mayExtend(*below[0]) ? file(pathBeside(*below[0]), below[0]->place) : nullptr;
  bool good = base && mayCopy(*base, extends->place);
  if (good) {
    const std::string identity = source.identity;
    source = *base;
    source.path = source.top = path;
    source.identity = identity;
    source.files.insert(source.files.begin(), path);
    for (std::size_t i = 1; i < below.size(); ++i)
      good = layOver(source, pathBeside(*below[i]), below[i], false) && good;
    source.top = path;
    if (source.root.is(Type::object)) {
      source.root.place = root.place;
      std::erase_if(source.root.members, [](const JsonMember& member) {  // of the base
        return member.key == "name" || member.key == "description";
      });
      applyOverlay(*this, root, false, source, diagnostics_);
    }
    source.values = valuesOf(source.root);
  }
  open_.pop_back();
  return good ? std::make_shared<const Source>(std::move(source)) : nullptr;
}

bool SourceLoader::mayExtend(const JsonValue& written) {
  const std::string below = pathBeside(written), identity = identityOf(below);
  if (open_.size() > kMaxInRow) {
    auto& limit = diagnostics_.error(Code::limitExceeded, written.place,
                                     "overlays extend each other in too long a row");
    limit.expected = fmt::format("at most {}", kMaxInRow);
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
  return std::ranges::any_of(open_, [&](const auto& file) { return file.first == identity; });
}

std::shared_ptr<const Source> SourceLoader::withPreset(const Source& source, const std::string& path) {
  Source made = source;
  if (!layOver(made, path, nullptr, true)) return nullptr;
  made.values = valuesOf(made.root);
  return std::make_shared<const Source>(std::move(made));
}

bool SourceLoader::layOver(Source& made, const std::string& path, const JsonValue* written, bool preset) {
  const std::string own = identityOf(path);
  if (written && (broken_.contains(own) || !mayExtend(*written))) {
    broken_.insert(own);
    return false;
  }
  const std::optional<JsonValue> root = parse(path, written ? written->place : text::Place{}, true);
  const JsonValue* extends = root ? root->find("extends") : nullptr;
  bool good = root && ReadContext(diagnostics_).expect(*root, Type::object, "a preset");
  if (good && written && !extends && isWholeGraph(*root)) {
    auto& d =
        diagnostics_.error(Code::overlayOutOfPlace, written->place,
                           fmt::format("'{}' is a graph of its own, which nothing can be laid under", path));
    d.expected = fmt::format("an overlay on '{}', or a preset", made.path);
    d.hint = "a file extends one graph, the first of its list; give the others as includes";
    good = false;
  }
  open_.emplace_back(own, path);
  if (good && extends) {
    const std::vector<const JsonValue*> below = namesIn(*extends, diagnostics_);
    good = !below.empty();
    for (const JsonValue* each : below) {
      const std::string file = pathBeside(*each), identity = identityOf(file);
      const bool there = std::ranges::any_of(
          made.files, [&](const std::string& known) { return identityOf(known) == identity; });
      if (there && !isOpen(identity)) continue;  // it is below already
      good = layOver(made, file, each, preset) && good;
    }
  }
  good = good && mayCopy(made, root->place);
  if (good) {
    made.files.push_back(path);
    made.top = path;
    if (made.root.is(Type::object)) applyOverlay(*this, *root, preset, made, diagnostics_);
  } else if (written) {
    broken_.insert(own);
  }
  open_.pop_back();
  return good;
}

}  // namespace weft::graph
