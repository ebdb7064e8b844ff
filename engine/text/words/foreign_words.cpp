#include "engine/text/words/foreign_words.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/text/chars.h"
#include "engine/text/files/data_folder.h"

namespace weft::text {

namespace {

using Words = std::unordered_map<std::string, ForeignWord>;  // by theirs

// By kind. In the file, what is to be written comes first, and then all words that mean it. Of a key of ours that is meant,
// hints follow, "" where its name alone says all, and then the words.
const std::unordered_map<std::string, Words>& foreignTable() {
  static const auto table = [] {
    std::unordered_map<std::string, Words> kinds;
    std::ifstream file(dataFolder() + "/engine/text/words/foreign.json");
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
  std::erase_if(text, isSeparator);
  return findForeign("format", text).hint;
}

}  // namespace weft::text
