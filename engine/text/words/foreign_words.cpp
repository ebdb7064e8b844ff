#include "engine/text/words/foreign_words.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "engine/text/chars.h"
#include "engine/text/files/file.h"

namespace weft::text {

namespace {

// By kind and their word, "pass_key/inputs". In the file, what is to be written comes first, and then all words that mean it. Of
// a key of ours that is meant, hints follow, "" where its name alone says all, and then the words.
const ForeignWord& findForeign(const std::string& kind, const std::string& word) {
  static const auto table = [] {
    std::unordered_map<std::string, ForeignWord> all;
    std::ifstream file(dataFolder() + "/engine/text/words/foreign.json");
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (!json.is_object()) return all;
    for (const auto& [group, rows] : json.items())
      for (const auto& [ours, words] : rows.items()) {
        const bool plain = words.is_array();
        const nlohmann::json hints = plain ? nlohmann::json{{ours, words}} : words;
        for (const auto& [hint, list] : hints.items())
          for (const auto& theirs : list)
            all.emplace(
                group + "/" + theirs.get<std::string>(),
                ForeignWord{hint.empty() ? "write \"" + ours + '"' : hint, plain ? "" : ours, hint.empty()});
      }
    return all;
  }();
  static const ForeignWord none;
  const auto found = table.find(kind + "/" + word);
  return found == table.end() ? none : found->second;
}

}  // namespace

const ForeignWord& findForeignWord(Foreign where, std::string_view word) {
  static constexpr const char* kKinds[] = {"graph_key",  "pass_key",    "texture_key", "state_key",
                                           "state_word", "value_key",   "value_type",  "sampling",
                                           "expression", "value",       "import_type", "import_argument",
                                           "pass_type",  "shader_name", "format"};
  std::string wanted =
      where == Foreign::shader_name ? std::string(word) : lowered(word);  // GLSL tells cases apart
  if (where == Foreign::value_type)
    wanted.resize(std::min(wanted.find('('), wanted.size()));  // "Range(0, 1)"
  if (where == Foreign::state_word || where == Foreign::format) {
    for (const std::string_view prefix :
         {"gl_", "vk_format_", "vk_compare_op_", "vk_", "dxgi_format_", "d3d11_comparison_",
          "d3d12_comparison_func_", "comparison_", "compare_", "mtlcomparefunction", "comparefunction",
          "mtlpixelformat", "pixelformat.", "format_", "pf_", "three."})
      if (wanted.starts_with(prefix)) wanted.erase(0, prefix.size());
    std::erase_if(wanted, [](char c) { return c == '_' || c == '-' || c == ' '; });
  }
  return findForeign(kKinds[static_cast<std::size_t>(where)], wanted);
}

}  // namespace weft::text
