#include "engine/graph/read/read_like.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/nearest.h"
#include "engine/graph/read/overlay_apply.h"

namespace weft::graph {

namespace {

using base::Code;
using Type = JsonValue::Type;

std::string_view nameOf(const JsonValue& stanza) {
  const JsonValue* name = stanza.find("include") ? nullptr : stanza.find("name");
  return name && name->is(Type::string) ? std::string_view(name->text) : std::string_view();
}

std::uint64_t countOf(const JsonValue& value) {
  std::uint64_t count = 1;
  for (const JsonValue& item : value.items) count += countOf(item);
  for (const JsonMember& member : value.members) count += countOf(member.value);
  return count;
}

// A parameter is declared once: who is like its pass takes the value.
void takeParametersOf(JsonValue& stanza, std::string_view name, const JsonValue& like) {
  JsonMember* parameters = memberOf(stanza, "parameters");
  if (!parameters) return;
  for (JsonMember& member : parameters->value.members) {
    if (!member.value.is(Type::object)) continue;
    JsonValue value = like;
    value.text = fmt::format("${}.{}", name, member.key);
    member.value = std::move(value);
  }
}

// With another shader, what the other names is no mistake of the other: a slot, parameter or define that does not fit is one of
// this pass, at its "like".
void placeAtLike(JsonValue& made, const JsonValue& like) {
  for (const char* group : {"read", "write", "modify", "parameters", "defines"})
    if (JsonMember* names = memberOf(made, group))
      for (JsonMember& member : names->value.members) member.place = like.place;
}

class Merger {
 public:
  Merger(ReadContext& context, const Place& own) : context_(context), own_(own) {}

  void merge(JsonValue& into, const JsonMember& over) {
    JsonMember* there = memberOf(into, over.key);
    if (over.value.is(Type::null)) {
      if (there)
        into.members.erase(into.members.begin() + (there - into.members.data()));
      else if (over.place.file == own_.file)  // an overlay's may be about what the stanza itself says
        nothingThere(into, over);
    } else if (!there) {
      into.members.push_back(over);
    } else if (over.value.is(Type::object) && there->value.is(Type::object)) {
      there->place = over.place;
      there->value.place = over.value.place;
      for (const JsonMember& member : over.value.members) merge(there->value, member);
    } else {
      *there = over;
    }
  }

 private:
  void nothingThere(const JsonValue& in, const JsonMember& over) {
    context_
        .errorAt(Code::nothingToChange, over.place,
                 fmt::format("null takes \"{}\" away, which is not there", over.key))
        .hint = hintForKey(in, over.key);
  }

  ReadContext& context_;
  const Place& own_;
};

}  // namespace

const JsonValue* LikePasses::find(const JsonValue& stanza, const JsonValue& like, std::size_t index) {
  if (!context_.expect(like, Type::string, "\"like\"")) return nullptr;
  for (; known_ < index; ++known_)
    if (const std::string_view name = nameOf(stanzas_[known_]); !name.empty())
      above_.try_emplace(name, &stanzas_[known_]);
  if (const auto found = above_.find(like.text); found != above_.end()) return found->second;
  const auto same = [&](const JsonValue& other) { return nameOf(other) == like.text; };
  auto& d = context_.error(
      Code::likeNothing, like,
      fmt::format("pass '{}' is like '{}', and no pass above it has this name", nameOf(stanza), like.text));
  d.expected = "the name of a pass above it in this file";
  if (nameOf(stanza) == like.text) {
    d.found = "its own name";
  } else if (std::any_of(stanzas_.begin() + static_cast<std::ptrdiff_t>(index), stanzas_.end(), same)) {
    d.hint = fmt::format("'{}' stands below: write its keys there, and let it be like this one", like.text);
  } else {
    std::vector<std::string> names;
    for (const auto& [name, pass] : above_) names.emplace_back(name);
    std::ranges::sort(names);
    d.hint = base::nearestHint(like.text, names);
  }
  return nullptr;
}

const JsonValue* LikePasses::at(std::size_t index) {
  const JsonValue& stanza = stanzas_[index];
  const JsonValue* like = stanza.is(Type::object) && !stanza.find("include") ? stanza.find("like") : nullptr;
  if (!like) return &stanza;
  const std::string_view name = nameOf(stanza);
  context_.pass = name;
  const JsonValue* other = find(stanza, *like, index);
  known_ = index + 1;
  const auto keep = [&](const JsonValue* made) {
    context_.pass.clear();
    if (!name.empty()) above_.try_emplace(name, made);
    return made;
  };
  if (!other) return keep(nullptr);
  values_ += countOf(*other);
  if (values_ > base::raised(base::kMostValues)) {
    auto& d = context_.error(Code::limitExceeded, *like, "passes that are like others hold too many values");
    d.expected = fmt::format("at most {} values", base::raised(base::kMostValues));
    d.hint = base::hintToRaise(base::kMostValues);
    return keep(nullptr);
  }
  JsonValue& made = made_.emplace_back(*other);
  made.place = stanza.place;
  takeParametersOf(made, like->text, *like);
  if (stanza.find("shader")) placeAtLike(made, *like);
  Merger merger(context_, stanza.place);
  for (const JsonMember& member : stanza.members) merger.merge(made, member);
  return keep(&made);
}

}  // namespace weft::graph
