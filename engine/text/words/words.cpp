#include "engine/text/words/words.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/text/chars.h"
#include "engine/text/files/file.h"
#include "engine/text/nearest.h"

namespace weft::text {

namespace {

const nlohmann::ordered_json& foreignTable() {
  static const auto table = [] {
    std::ifstream file(dataFolder() + "/engine/text/words/foreign.json");
    auto json = nlohmann::ordered_json::parse(file, nullptr, false);
    return json.is_object() ? json : nlohmann::ordered_json::object();
  }();
  return table;
}

// By kind and their word, "pass_key/inputs". In the file, what is to be written comes first, and then all words that mean it. Of
// a key of ours that is meant, hints follow, "" where its name alone says all, and then the words.
const ForeignWord& findForeign(const std::string& word) {
  static const auto table = [] {
    std::unordered_map<std::string, ForeignWord> all;
    for (const auto& [group, rows] : foreignTable().items())
      for (const auto& [ours, words] : rows.items()) {
        const bool plain = words.is_array();
        const nlohmann::ordered_json hints = plain ? nlohmann::ordered_json{{ours, words}} : words;
        for (const auto& [hint, list] : hints.items())
          for (const auto& theirs : list)
            all.emplace(
                group + "/" + theirs.get<std::string>(),
                ForeignWord{hint.empty() ? "write \"" + ours + '"' : hint, plain ? "" : ours, hint.empty()});
      }
    return all;
  }();
  static const ForeignWord none;
  const auto found = table.find(word);
  return found == table.end() ? none : found->second;
}

// Those of a paragraph of glsl_words.txt.
std::vector<std::string_view> wordsOf(int paragraph) {
  std::string_view all = kGlslWords;
  const std::size_t gap = all.find("\n\n");
  all = paragraph == 0 ? all.substr(0, gap) : all.substr(gap);
  std::vector<std::string_view> words;
  for (all = trimmed(all); !all.empty();) words.push_back(takeWord(all));
  return words;
}

}  // namespace

const ForeignWord& findForeignWord(std::string_view kind, std::string_view word) {
  std::string wanted = kind == "shader_name" ? std::string(word) : lowered(word);  // GLSL tells cases apart
  if (kind == "value_type") wanted.resize(std::min(wanted.find('('), wanted.size()));  // "Range(0, 1)"
  if (kind == "state_word" || kind == "format") {
    for (const std::string_view prefix :
         {"gl_", "vk_format_", "vk_compare_op_", "vk_", "dxgi_format_", "d3d11_comparison_",
          "d3d12_comparison_func_", "comparison_", "compare_", "mtlcomparefunction", "comparefunction",
          "mtlpixelformat", "pixelformat.", "format_", "pf_", "three."})
      if (wanted.starts_with(prefix)) wanted.erase(0, prefix.size());
    std::erase_if(wanted, [](char c) { return c == '_' || c == '-' || c == ' '; });
  }
  return findForeign(std::string(kind) + "/" + wanted);
}

std::string hintOrNearest(std::string_view kind, std::string_view word, std::span<const std::string> known) {
  std::string theirs = hintForForeign(kind, word);
  return theirs.empty() ? nearestHint(word, known) : theirs;
}

std::string hintForSpelling(std::string_view value) {
  constexpr std::size_t kLongest = 80;  // a longer text is no slip of this kind
  static const auto kPatterns = [] {    // to translate one takes longer than to read a graph
    std::vector<std::pair<std::string, std::regex>> all;
    if (const auto patterns = foreignTable().find("value_pattern"); patterns != foreignTable().end())
      for (const auto& [hint, list] : patterns->items())
        for (const auto& pattern : list) all.emplace_back(hint, pattern.get<std::string>());
    return all;
  }();
  std::match_results<std::string_view::const_iterator> found;
  for (const auto& [hint, pattern] : kPatterns)
    if (value.size() <= kLongest && std::regex_match(value.begin(), value.end(), found, pattern))
      return found.format(hint);
  return {};
}

bool isGlslWord(std::string_view word) {
  static const std::vector<std::string_view> kWords = wordsOf(0);
  if (std::ranges::find(kWords, word) != kWords.end()) return true;
  if (word.starts_with("gl_")) return true;
  if (word.starts_with("is") || word.starts_with("ii") || word.starts_with('u')) word.remove_prefix(1);
  for (const std::string prefix : {"sampler", "image"})
    for (const char* shape : {"1D", "2D", "3D", "Cube", "Buffer"})
      if (word.starts_with(prefix + shape)) return true;
  return false;
}

std::span<const std::string_view> glslFunctions() {
  static const std::vector<std::string_view> kFunctions = wordsOf(1);
  return kFunctions;
}

bool isGlslFunction(std::string_view word) {
  return std::ranges::binary_search(glslFunctions(), word);
}

}  // namespace weft::text
