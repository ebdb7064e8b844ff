// Words that authors bring from other engines, APIs and shading languages, with what Weft and GLSL call the same thing.
// For hints: nothing is accepted that is not spelled as the format says. The table is foreign.json beside
// this file, read from the data folder when the first hint is asked for; without it there are no such hints.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace weft::text {

// What is to be written instead of a word. All is empty of a word that nobody knows.
struct ForeignWord {
  std::string hint;        // "write \"size\": [width, height]"
  std::string key;         // our key for a key: "size"; "" where there is no single one
  bool isOnlyKey = false;  // it means the same as our key, under another name
};
// `kind`: a group of the table, "pass_key" or "state_word".
const ForeignWord& findForeignWord(std::string_view kind, std::string_view word);
inline std::string hintForForeign(std::string_view kind, std::string_view word) {
  return findForeignWord(kind, word).hint;
}

// The same, else the nearest of `known`.
std::string hintOrNearest(std::string_view kind, std::string_view word, std::span<const std::string> known);
// The same for a value that is spelled as elsewhere, by the regular expressions of "value_pattern", the first that fits: "50%",
// "1920x1080", "512px", a color of the web.
std::string hintForSpelling(std::string_view value);

// Words that GLSL 4.5 keeps for itself, so that what a graph names does not hide them. The table translates those of
// versions before. They are glsl_words.txt beside this file, which the build puts into the program.
extern const char* const kGlslWords;

// Whether GLSL 4.5 keeps the word: a keyword, a type, or one that is reserved. Nothing in a shader can have such a name.
bool isGlslWord(std::string_view word);

// The functions that GLSL 4.5 has by itself, sorted.
std::span<const std::string_view> glslFunctions();
// One of them: a define of that name would hide it.
bool isGlslFunction(std::string_view word);

}  // namespace weft::text
