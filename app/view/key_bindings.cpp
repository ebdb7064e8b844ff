#include "app/view/key_bindings.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <fmt/format.h>

#include <algorithm>

#include "app_sentences.h"
#include "engine/text/chars.h"
#include "engine/text/json/fields.h"
#include "engine/text/nearest.h"

namespace weft::app {

namespace {

constexpr std::pair<const char*, int> kNames[] = {
    {"Space", GLFW_KEY_SPACE},   {"Home", GLFW_KEY_HOME},      {"End", GLFW_KEY_END},
    {"PgUp", GLFW_KEY_PAGE_UP},  {"PgDn", GLFW_KEY_PAGE_DOWN}, {"Esc", GLFW_KEY_ESCAPE},
    {"Tab", GLFW_KEY_TAB},       {"Enter", GLFW_KEY_ENTER},    {"Backspace", GLFW_KEY_BACKSPACE},
    {"Insert", GLFW_KEY_INSERT}, {"Delete", GLFW_KEY_DELETE},  {"Left", GLFW_KEY_LEFT},
    {"Right", GLFW_KEY_RIGHT},   {"Up", GLFW_KEY_UP},          {"Down", GLFW_KEY_DOWN}};
constexpr const char* kVerbs[] = {"do", "toggle", "step", "show", "open"};
const std::vector<std::string> kAs = {"values", "scale", "direction", "motion", "distance"},
                               kChannels = {"RGB", "R", "G", "B", "A"};

// The key of "Shift F12"; 0: there is none of this name.
std::pair<int, WithKey> keyOf(std::string_view text) {
  const WithKey with = text.starts_with("Shift ")  ? WithKey::shift
                       : text.starts_with("Ctrl ") ? WithKey::control
                                                   : WithKey::nothing;
  if (with != WithKey::nothing) text.remove_prefix(text.find(' ') + 1);
  if (text.size() == 1 && text[0] > ' ' && text[0] <= '~' && !(text[0] >= 'a' && text[0] <= 'z'))
    return {text[0], with};
  for (const auto& [name, key] : kNames)
    if (text == name) return {key, with};
  for (int i = 1; i <= 25; ++i)
    if (text == fmt::format("F{}", i)) return {GLFW_KEY_F1 + i - 1, with};
  return {0, with};
}

}  // namespace

KeyTable::KeyTable() {
  text::Diagnostics none;
  add(kKeys, {}, none);
  weft_ = rows_;
}

void KeyTable::add(std::string_view json, text::FileName file, text::Diagnostics& diagnostics) {
  const auto root = text::parseJson(json, file, diagnostics);
  if (!root || !text::expectType(*root, "the table of keys", text::JsonValue::Type::object, diagnostics))
    return;
  for (const text::JsonMember& member : root->members)
    if (member.key != "$schema") addRow(member, diagnostics);
}

void KeyTable::addRow(const text::JsonMember& member, text::Diagnostics& diagnostics) {
  using Type = text::JsonValue::Type;
  const text::JsonValue& value = member.value;
  const std::string what = fmt::format("key '{}'", member.key);
  const bool weft = weft_.empty();
  std::vector<std::string> actions;
  for (const KeyBinding& each : weft_)
    if (each.verb == "do") actions.push_back(each.name);
  const std::size_t before = diagnostics.errorCount();
  KeyBinding row{.keys = member.key};
  std::tie(row.key, row.with) = keyOf(member.key);
  // The index of a word.
  const auto take = [&](const text::JsonValue* at, std::span<const std::string> known) -> std::size_t {
    if (!at || !text::expectType(*at, what, Type::string, diagnostics)) return 0;
    const auto found = std::ranges::find(known, at->text);
    if (found == known.end())
      diagnostics.error(say::nothingForAKey, at->textPlace(), what, at->text,
                        text::nearestHint(at->text, known));
    return static_cast<std::size_t>(found - known.begin());
  };
  if (value.is(Type::string)) {
    row.verb = "do";
    row.name = value.text;
    take(&value, actions);
  } else if (!value.is(Type::null)) {
    text::JsonFields fields(value, what, text::Code::outOfRange, diagnostics);
    for (const char* verb : kVerbs) {
      const auto name = fields.text(verb);
      if (!name) continue;
      if (!row.verb.empty())
        diagnostics.error(say::keyDoesTwo, fields.find(verb)->place, what, row.verb, verb);
      row.verb = verb;
      row.name = *name;
    }
    if (row.verb == "do" && !weft) take(fields.find("do"), actions);
    row.by = fields.number("by").value_or(1);
    row.as = take(fields.find("as"), kAs);
    row.channel = take(fields.find("channel"), kChannels);
    row.low = fields.number("low");
    row.high = fields.number("high");
    row.help = fields.text("help").value_or("");
    fields.finish();
    if (row.verb.empty() && !weft && diagnostics.errorCount() == before) fields.require({"do"});
  }
  if (row.key == 0 && !weft) diagnostics.error(say::noSuchKey, member.place.after(1), what);
  if (diagnostics.errorCount() > before) return;
  if (row.help.empty() && !row.verb.empty())
    row.help = weft               ? rows_.back().help
               : row.verb == "do" ? std::ranges::find(weft_, row.name, &KeyBinding::name)->help
                                  : row.verb + " " + row.name;
  const auto old = std::ranges::find_if(
      rows_, [&](const KeyBinding& each) { return row.key && each.key == row.key && each.with == row.with; });
  if (old == rows_.end() && !value.is(Type::null))
    rows_.push_back(std::move(row));
  else if (old != rows_.end() && value.is(Type::null))
    rows_.erase(old);
  else if (old != rows_.end())
    *old = std::move(row);
}

const KeyBinding* KeyTable::find(int key, WithKey with) const {
  const KeyBinding* alone = nullptr;
  for (const KeyBinding& row : rows_) {
    if (row.key != key || row.verb.empty()) continue;
    if (row.with == with) return &row;
    if (row.with == WithKey::nothing && with == WithKey::shift) alone = &row;
  }
  return alone;
}

std::vector<std::pair<std::string, std::string>> KeyTable::help() const {
  std::vector<std::pair<std::string, std::string>> out;
  for (std::size_t first = 0, end = 0; first < rows_.size(); first = end) {
    while (end < rows_.size() && rows_[end].help == rows_[first].help) ++end;
    std::string keys = rows_[first].keys;
    for (std::size_t i = end - first > 3 ? end - 1 : first + 1; i < end; ++i)
      keys += (end - first > 3 ? " ... " : " ") + rows_[i].keys;
    out.emplace_back(std::move(keys), rows_[first].help);
  }
  return out;
}

}  // namespace weft::app
