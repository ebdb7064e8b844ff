#include "engine/graph/expand/names/unread.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "engine/base/nearest.h"
#include "engine/graph/expand/names/resources.h"
#include "engine/graph/expand/names/scope.h"
#include "engine/graph/expand/names/versions.h"

namespace weft::graph::expansion {

namespace {

constexpr std::size_t kPassesTold = 5;
constexpr std::string_view kPictures[] = {".png", ".jpg", ".jpeg", ".exr"};  // "lit.hdr" is a resource
const std::vector<std::string> kSelectors{"mip", "layer", "face", "stencil"};

std::string_view firstPart(std::string_view name) {
  return name.substr(0, name.find('.'));
}

std::string hintFor(const Model& model, const Unincluded& group) {
  const Scope& scope = *group.scope;
  if (group.uses.size() == 1)
    if (const std::string near = base::nearestName(group.uses[0].resource, resourceNames(model, scope));
        !near.empty())
      return fmt::format("did you mean '{}'?", near);
  // A whole name in its own file.
  const std::string& resource = group.uses[0].resource;
  if (resource.starts_with(scope.prefix) && scope.resources.contains(resource.substr(scope.prefix.size())))
    return fmt::format("write '{}', as the file of the pass calls it", resource.substr(scope.prefix.size()));
  for (const Scope* outer = scope.parent; outer; outer = outer->parent)
    if (outer->includes.contains(group.name))
      return fmt::format(
          "the including file includes '{}': declare here what you need of it as an input, and \"bind\" it "
          "there",
          group.name);
  std::vector<std::string> includes;
  for (const auto& [name, child] : scope.includes) includes.emplace_back(name);
  if (const std::string near = base::nearestName(group.name, includes); !near.empty())
    return fmt::format("did you mean '{}'?", near);
  return fmt::format(
      "include a file of that name, {{ \"include\": \"{0}.json\" }}, or another one with \"as\": \"{0}\"",
      group.name);
}

}  // namespace

const PassDesc* failedInclude(const Scope& scope) {
  for (const PassDesc& pass : scope.desc->passes)
    if (pass.include && !pass.include->graph) return &pass;
  return nullptr;
}

bool isUnread(const Scope& from, std::string_view name) {
  const std::string_view leaf = name.substr(name.rfind('.') + 1);
  const auto holds = [&](const Scope& scope) {
    const auto& unread = scope.desc->unread;
    return std::find(unread.begin(), unread.end(), leaf) != unread.end();
  };
  for (const Scope* scope = &from; scope; scope = scope->parent)
    if (holds(*scope)) return true;
  if (name.find('.') == std::string_view::npos) return false;
  // A name into an include that could not be read, or that left the resource out.
  const auto child = from.includes.find(name.substr(0, name.find('.')));
  if (child != from.includes.end()) return isUnread(*child->second, name.substr(name.find('.') + 1));
  const std::string_view first = firstPart(name);
  for (const PassDesc& pass : from.desc->passes)  // the path may be what is misspelt, and so the name
    if (pass.include && !pass.include->graph && (pass.include->as == first || from.resources.contains(first)))
      return true;
  return false;
}

bool mayBeUnread(const Scope& from, std::string_view name) {
  if (from.broken) return true;
  for (const Scope* scope = &from; scope; scope = scope->parent)
    if (isUnread(*scope, name)) return true;
  return false;
}

bool isPicturePath(std::string_view name) {
  return std::ranges::any_of(kPictures, [&](std::string_view ending) { return name.ends_with(ending); });
}

namespace {

// The resource of this name in a file that is included below, as the scope calls it: "post.ldr". "" when there is none.
std::string resourceBelow(const Model& model, const Scope& scope, std::string_view name) {
  std::string shortest;
  for (const Scope& each : model.scopes) {
    if (&each == &scope || !each.prefix.starts_with(scope.prefix) || !each.resources.contains(name)) continue;
    const std::string found = each.prefix.substr(scope.prefix.size()) + std::string(name);
    if (shortest.empty() || found.size() < shortest.size()) shortest = found;
  }
  return shortest;
}

// Of "trail.previous" and the like, where `name` is a resource and `part` is nothing of it.
std::string hintForPart(std::string_view name, std::string_view part, std::string otherwise) {
  if (const std::string near = base::nearestName(part, kSelectors); !near.empty())
    return fmt::format("did you mean '{}.{}{}'?", name, near, near == "stencil" ? "" : "[…]");
  for (const char* level : {"lod", "level", "mipLevel", "mip_level"})
    if (part == level) return fmt::format("a level is '{}.mip[…]'", name);
  for (const char* before : {"previous", "prev", "last", "history", "old", "before"})
    if (part == before) return fmt::format("what it was in the frame before is '{}@-1'", name);
  return otherwise;
}

}  // namespace

std::string hintForResource(const Model& model, const Scope& scope, std::string_view name, const NamedBy& by,
                            const Place& place) {
  const std::string_view slot = by.slot == "view" ? std::string_view() : by.slot;
  if (isPicturePath(name)) {
    const std::string_view file = name.substr(name.rfind('/') + 1);
    return fmt::format(
        "a picture is a resource: {{ \"{0}\": {{ \"import\": \"image\", \"file\": \"{1}\" }} }}, and \"{0}\" "
        "here",
        file.substr(0, file.find('.')), name);
  }
  if (const PassDesc* pass = by.orPass ? nullptr : findPass(scope, name)) {
    std::string made;
    for (const SlotDesc& each : pass->slots)
      if (each.access != Access::read)
        made += fmt::format("{}'{}'", made.empty() ? "" : " or ", each.ref.name);
    if (!made.empty()) return fmt::format("'{}' is a pass: name what it writes, {}", name, made);
  }
  std::vector<std::string> names = resourceNames(model, scope);
  if (by.orPass)
    for (const PassDesc& each : scope.desc->passes)
      if (!each.include) names.push_back(each.name);
  std::string hint = base::nearestHint(name, names);
  if (const std::size_t dot = name.find('.');
      dot != std::string_view::npos && scope.resources.contains(name.substr(0, dot)))
    hint = hintForPart(name.substr(0, dot), name.substr(dot + 1), std::move(hint));
  if (const std::string below = resourceBelow(model, scope, name); !below.empty())
    hint = fmt::format("did you mean '{}'?", below);
  if (!slot.empty() && scope.resources.contains(slot) && !hint.starts_with("did you mean"))
    hint = fmt::format("a slot comes first, then its resource: \"{}\": \"{}\"", name, slot);
  if (findImportType(model.registry, name)) hint = fmt::format("did you mean the import '@{}'?", name);
  for (Scope* outer = scope.parent; outer; outer = outer->parent)
    if (outer->resources.contains(name)) {
      // The pass of an overlay stands in the file of the pass beside it.
      const bool laidOver = place.file && *place.file != scope.desc->path;
      hint = laidOver ? fmt::format("declare it as '{0}{1}': the pass stands in the file of '{2}'",
                                    scope.prefix, name, scope.prefix.substr(0, scope.prefix.size() - 1))
                      : fmt::format(
                            "the including file has it: declare it here as an input, \"{}\": {{ \"input\": "
                            "\"texture\" }}",
                            name);
      break;
    }
  return hint;
}

bool isUnincluded(Model& model, Scope& scope, std::string_view name, const Place& place, const NamedBy& by) {
  const std::string_view first = firstPart(name);
  if (first.size() == name.size() || scope.includes.contains(first) || scope.resources.contains(first) ||
      scope.passes.contains(first))
    return false;
  model.incomplete = true;
  auto group = std::ranges::find_if(model.unincluded, [&](const Unincluded& known) {
    return known.scope == &scope && known.name == first;
  });
  if (group == model.unincluded.end()) {
    model.unincluded.push_back({&scope, std::string(first), {}});
    group = model.unincluded.end() - 1;
  }
  // The instances of a repeat come here one after another.
  if (std::ranges::none_of(group->uses,
                           [&](const Unincluded::Use& use) { return base::isSamePlace(use.place, place); }))
    group->uses.push_back({place, fmt::format("{} {} the unknown resource '{}'", by.user, by.verb, name),
                           std::string(name), std::string(by.pass)});
  return true;
}

void leaveOutWrite(Model& model, Scope& scope, const RefDesc& ref) {
  const std::uint32_t found = findEntity(model, scope, ref.name, ref.import);
  using Kind = ResourceDesc::Kind;
  const Kind kind = found == kNone ? Kind::import : model.entities[found].kind;
  if (kind == Kind::import || kind == Kind::alternatives)
    model.incomplete = true;  // nobody knows which one is meant
  else
    model.entities[found].incomplete = true;
}

void noteEmptyRepeat(Model& model, Scope& scope, const PassDesc& desc, const RangeDesc& range,
                     EmptyRepeat empty) {
  empty.mistake =
      empty.mistake && isEmptyByMistake(model, scope, desc, range, empty.first, empty.last, empty.step);
  const bool first = model.emptied.empty() || model.emptied.back().pass != empty.pass;  // range of the pass
  for (const SlotDesc& slot : desc.slots) {
    const std::uint32_t found = findEntity(model, scope, slot.ref.name, slot.ref.import);
    if (found == kNone) continue;
    if (first) wouldUse(model, found, slot.access, slot.ref.history);
    if (slot.access != Access::read && model.entities[found].emptied == kNone)
      model.entities[found].emptied = static_cast<std::uint32_t>(model.emptied.size());
  }
  ++model.position;
  model.emptied.push_back(std::move(empty));
}

void reportUnincluded(Model& model) {
  for (const Unincluded& group : model.unincluded) {
    const Unincluded::Use& first = group.uses[0];
    const std::size_t count = group.uses.size();
    if (const PassDesc* failed = failedInclude(*group.scope)) {
      base::Diagnostic& d = model.diagnostics.add(
          {.severity = base::Severity::note,
           .code = Code::unknownResource,
           .message = fmt::format("{} to '{}.…' {} not checked: nothing is included as '{}'",
                                  count == 1 ? "one reference" : fmt::format("{} references", count),
                                  group.name, count == 1 ? "was" : "were", group.name),
           .place = first.place});
      d.hint = fmt::format("first mend the include of '{}' at {}:{}", failed->include->file,
                           failed->place.line, failed->place.column);
      continue;
    }
    base::Diagnostic& d =
        model.diagnostics.error(Code::unknownResource, first.place,
                                fmt::format("{}: nothing is included as '{}'", first.text, group.name));
    d.resource = first.resource;
    d.pass = first.pass;
    if (count > 1) {
      std::vector<std::string> passes;
      for (const Unincluded::Use& use : group.uses)
        if (!use.pass.empty() && std::ranges::find(passes, use.pass) == passes.end())
          passes.push_back(use.pass);
      const std::size_t more = passes.size() > kPassesTold ? passes.size() - kPassesTold : 0;
      passes.resize(passes.size() - more);
      d.found = fmt::format("{} references to '{}.…'{}{}{}", count, group.name, passes.empty() ? "" : ", in ",
                            fmt::join(passes, ", "), more ? fmt::format(" and {} more", more) : "");
    }
    d.hint = hintFor(model, group);
  }
}

}  // namespace weft::graph::expansion
