#include "engine/base/words/foreign_words.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/base/chars.h"
#include "engine/base/files/data_folder.h"

namespace weft::base {

namespace {

using Words = std::unordered_map<std::string, ForeignWord>;  // by theirs

// By kind. In the file, what is to be written comes first, and then all words that mean it. Of a key of ours that is meant,
// hints follow, "" where its name alone says all, and then the words.
const std::unordered_map<std::string, Words>& foreignTable() {
  static const auto table = [] {
    std::unordered_map<std::string, Words> kinds;
    std::ifstream file(dataFolder() + "/engine/base/words/foreign.json");
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object()) return kinds;
    for (const auto& [kind, rows] : json.items())
      for (const auto& [ours, words] : rows.items()) {
        if (words.is_array())
          for (const auto& theirs : words)
            kinds[kind].emplace(theirs.get<std::string>(), ForeignWord{ours, "", false});
        else
          for (const auto& [hint, list] : words.items())
            for (const auto& theirs : list)
              kinds[kind].emplace(
                  theirs.get<std::string>(),
                  ForeignWord{hint.empty() ? "write \"" + ours + '"' : hint, ours, hint.empty()});
      }
    return kinds;
  }();
  return table;
}

const ForeignWord& findForeign(const char* kind, const std::string& word) {
  static const ForeignWord none;
  const auto words = foreignTable().find(kind);
  if (words == foreignTable().end()) return none;
  const auto found = words->second.find(word);
  return found == words->second.end() ? none : found->second;
}

void dropPrefix(std::string& text, std::initializer_list<std::string_view> prefixes) {
  for (const std::string_view prefix : prefixes)
    if (text.starts_with(prefix)) text.erase(0, prefix.size());
}

bool isSeparator(char c) {
  return c == '_' || c == '-' || c == ' ';
}

// What Weft writes behind the bits for their word of the kind of number.
const char* numberSuffix(std::string_view word) {
  constexpr std::pair<std::string_view, const char*> kSuffixes[] = {
      {"", ""},        {"unorm", ""}, {"typeless", ""},    {"f", "f"},       {"float", "f"},
      {"sfloat", "f"}, {"half", "f"}, {"ui", "ui"},        {"uint", "ui"},   {"i", "i"},
      {"sint", "i"},   {"int", "i"},  {"snorm", "_snorm"}, {"srgb", "srgb"}, {"unormsrgb", "srgb"}};
  for (const auto& [theirs, ours] : kSuffixes)
    if (word == theirs) return ours;
  return nullptr;
}

}  // namespace

const ForeignWord& findForeignWord(Foreign where, std::string_view word) {
  static constexpr const char* kKinds[] = {
      "graph_key", "pass_key",   "texture_key", "state_key",   "state_word",      "value_key", "value_type",
      "sampling",  "expression", "value",       "import_type", "import_argument", "pass_type", "shader_name"};
  std::string wanted =
      where == Foreign::shader_name ? std::string(word) : lowered(word);  // GLSL tells cases apart
  if (where == Foreign::value_type)
    wanted.resize(std::min(wanted.find('('), wanted.size()));  // "Range(0, 1)"
  if (where == Foreign::state_word) {
    dropPrefix(wanted, {"gl_", "vk_compare_op_", "vk_", "d3d11_comparison_", "d3d12_comparison_func_",
                        "comparison_", "compare_", "mtlcomparefunction", "comparefunction"});
    std::erase_if(wanted, isSeparator);
  }
  return findForeign(kKinds[static_cast<std::size_t>(where)], wanted);
}

std::string formatMeantBy(std::string_view word) {
  std::string text = lowered(word);
  dropPrefix(text, {"dxgi_format_", "vk_format_", "gl_", "mtlpixelformat", "pixelformat.", "format_", "pf_",
                    "three."});
  if (std::string ours = findForeign("format", text).hint; !ours.empty()) return ours;
  // Channels, bits, and the kind of number: "r16g16b16a16_float", "rgba8unorm", "rgbahalf".
  std::string letters, bits;
  std::size_t at = 0;
  while (at < text.size() && std::string_view("rgbax").find(text[at]) != std::string_view::npos) {
    letters += text[at] == 'x' ? 'a' : text[at];
    const std::size_t digits = ++at;
    while (at < text.size() && isDigit(text[at])) ++at;
    const std::string own = text.substr(digits, at - digits);
    if (!bits.empty() && own != bits) return {};
    bits = own;
  }
  std::string number = text.substr(at);
  std::erase_if(number, isSeparator);
  const char* suffix = numberSuffix(number);
  if (!suffix) return {};
  if (bits.empty() && number == "half") bits = "16";
  if (bits.empty() && number == "float") bits = "32";
  if (letters == "bgra" || letters == "rgb" || letters == "bgr" || letters == "argb" || letters == "abgr")
    letters = "rgba";
  if (letters != "r" && letters != "rg" && letters != "rgba") return {};
  if (std::string_view(suffix) == "srgb") return bits == "8" ? "srgb8_a8" : "";
  if (bits == "32" && !*suffix) return letters + "32f";
  if (bits != "8" && bits != "16" && bits != "32") return {};
  return letters + bits + (bits == "8" && std::string_view(suffix) == "f" ? "" : suffix);
}

}  // namespace weft::base
