#include "engine/gl/messages/words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/characters.h"
#include "engine/base/chars.h"
#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/base/words/glsl_words.h"
#include "engine/gl/messages/conditionals.h"
#include "engine/gl/messages/fixes.h"
#include "engine/gl/messages/vocabulary.h"

namespace weft::gl {

namespace {

bool isNumber(char c) {
  return base::isDigit(c) || c == '.';
}

std::string_view withoutEnds(std::string_view text) {
  while (!text.empty() && base::isSpace(text.front())) text.remove_prefix(1);
  while (!text.empty() && base::isSpace(text.back())) text.remove_suffix(1);
  return text;
}

bool isKnownWord(std::string_view word) {
  return std::ranges::find(kWords, word) != std::end(kWords);
}

bool isPunctuation(std::string_view token) {
  return token.size() >= 3 && token.front() == '\'' && token.back() == '\'';
}

// "ELSE" to "'else'", "';'" to itself; nothing for a token that nobody knows.
std::string wordFor(std::string_view token) {
  for (const auto& [name, word] : kTokens)
    if (name == token) return std::string(word);
  if (isPunctuation(token)) return std::string(token);
  std::string lower(token.substr(0, token.size() - (token.ends_with("_TOK") ? 4 : 0)));
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return isKnownWord(lower) ? fmt::format("'{}'", lower) : std::string();
}

// The token that stands in a line from `column` (from 1) on; empty when it cannot be the one that is meant:
// in a line with macros the driver counts what they stand for.
std::string_view tokenAt(std::string_view line, std::uint32_t column, std::string_view token) {
  if (column == 0 || column > line.size()) return {};
  const std::string_view rest = line.substr(column - 1);
  if (isPunctuation(token)) {
    const std::string_view sign = token.substr(1, token.size() - 2);
    return rest.starts_with(sign) ? sign : std::string_view();
  }
  const bool number = token.ends_with("CONSTANT") && token != "BOOLCONSTANT";
  const bool invalid = token == "invalid token" || token == "ERROR_TOK";
  if (invalid)
    return base::isIdentChar(rest[0]) || base::isSpace(rest[0]) ? std::string_view() : rest.substr(0, 1);
  if (number != isNumber(rest[0]) || !(base::isIdentChar(rest[0]) || number)) return {};
  std::size_t end = 1;
  while (end < rest.size() && (base::isIdentChar(rest[end]) || (number && rest[end] == '.'))) ++end;
  return rest.substr(0, end);
}

// The word that ends right before `column`, blanks apart.
std::string_view wordBefore(std::string_view line, std::uint32_t column) {
  std::string_view before = withoutEnds(line.substr(0, column - 1));
  std::size_t at = before.size();
  while (at > 0 && base::isIdentChar(before[at - 1])) --at;
  return before.substr(at);
}

std::string nearestOf(std::string_view name, bool function, const glsl::ShaderSource& source) {
  std::vector<std::string> names(source.declared.begin(), source.declared.end());
  std::erase(names, name);
  if (std::string near = base::nearestName(name, names); !near.empty()) return near;
  names.assign(std::begin(kWords), std::end(kWords));
  if (function) names.assign(base::glslFunctions().begin(), base::glslFunctions().end());
  std::erase(names, name);
  // Names of variables and functions of its own are not told apart from other words of the text.
  for (const std::string& word : source.identifiers)
    if (word != name) names.push_back(word);
  return base::nearestName(name, names);
}

// What stands between two texts.
std::optional<std::string_view> between(std::string_view text, std::string_view before,
                                        std::string_view after) {
  if (!text.starts_with(before) || !text.ends_with(after) || text.size() < before.size() + after.size())
    return std::nullopt;
  return text.substr(before.size(), text.size() - before.size() - after.size());
}

// The name in Mesa's "`name' undeclared", NVIDIA's and AMD's words for it.
std::optional<std::string_view> undeclaredIn(std::string_view message) {
  for (const auto& [before, after] : std::initializer_list<std::pair<const char*, const char*>>{
           {"`", "' undeclared"}, {"undefined variable \"", "\""}, {"'", "' : undeclared identifier"}})
    if (const auto name = between(message, before, after);
        name && std::ranges::all_of(*name, base::isIdentChar))
      return name;
  return std::nullopt;
}

struct SyntaxError {
  std::string_view token;  // as the grammar calls it
  std::string_view text;   // of the token, when the driver says it
  std::vector<std::string_view> expected;
  bool expects(std::string_view what) const { return std::ranges::find(expected, what) != expected.end(); }
};

std::optional<SyntaxError> syntaxErrorIn(std::string_view message) {
  constexpr std::string_view kUnexpected = "syntax error, unexpected ", kExpecting = ", expecting ",
                             kOr = " or ", kAtToken = " at token \"";
  SyntaxError error;
  if (message.starts_with("'' :")) message = withoutEnds(message.substr(4));  // glslang
  if (!message.starts_with(kUnexpected)) return std::nullopt;
  message.remove_prefix(kUnexpected.size());
  if (const std::size_t token = message.rfind(kAtToken);
      token != std::string_view::npos && message.ends_with('"')) {  // NVIDIA
    error.text = message.substr(token + kAtToken.size());
    error.text.remove_suffix(1);
    message = message.substr(0, token);
  }
  const std::size_t at = message.find(kExpecting);
  error.token = message.substr(0, at);
  if (at == std::string_view::npos) return error;
  for (std::string_view rest = message.substr(at + kExpecting.size()); !rest.empty();) {
    const std::size_t end = rest.find(kOr);
    error.expected.push_back(rest.substr(0, end));
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + kOr.size());
  }
  return error;
}

// The last line before `textLine` that is more than blanks and a comment, or 0.
std::uint32_t codeBefore(const glsl::ShaderSource& source, std::uint32_t textLine) {
  while (textLine > 1) {
    const std::string_view line = withoutEnds(lineOf(source.text, --textLine));
    if (!line.empty() && !line.starts_with("//")) return line.starts_with("#") ? 0 : textLine;
  }
  return 0;
}

std::string fixFor(const SyntaxError& error, const LogMessage& message, const glsl::ShaderSource& source) {
  const base::Where& place = message.diagnostic.place;
  if (error.token == "end of file" || error.token == "$end") return "a '{' is never closed";
  if (error.expects("end of file") || error.expects("$end"))
    return error.token.starts_with('\'') ? fmt::format("one {} too many", error.token)
                                         : "it stands outside of all functions: one '}' above it is too many";
  if (place.column == 0 || message.textLine == 0) return {};
  const std::string_view line = lineOf(source.text, message.textLine);
  const std::string_view before = wordBefore(line, place.column);
  if (const std::string meant = base::hintForForeign(base::Foreign::shader_name, before);
      meant.find("GLSL says") != std::string::npos)
    return fmt::format("'{}' is no type: {}", before, meant);
  if (error.token == "NEW_IDENTIFIER")
    if (const std::string meant =
            base::hintForForeign(base::Foreign::shader_name, tokenAt(line, place.column, error.token));
        meant.find("GLSL says") != std::string::npos)
      return meant;
  // A type or a qualifier that is none: the name behind it is what does not fit.
  if (!before.empty() && !std::isdigit(static_cast<unsigned char>(before[0])) && !isKnownWord(before) &&
      (error.token == "NEW_IDENTIFIER" || error.token == "BASIC_TYPE_TOK")) {
    const std::vector<std::string> words(std::begin(kWords), std::end(kWords));
    const std::string hint = base::nearestName(before, words).empty() ? "" : base::nearestHint(before, words);
    if (!hint.empty()) return fmt::format("'{}' is no type: {}", before, hint);
    if (error.token == "NEW_IDENTIFIER")
      return fmt::format("declare '{}', or end the statement before it with ';'", before);
  }
  if (error.token == "BASIC_TYPE_TOK" && isKnownWord(before)) return "choose a name that is no word of GLSL";
  if (error.token == "invalid token" || error.token == "ERROR_TOK") return "take it away";
  if (error.token == "'('" || error.token == "'<'") return {};
  if (error.expects("';'")) {
    if (error.token == "')'") return "one ')' too many";
    const bool first = withoutEnds(line.substr(0, place.column - 1)).empty();
    const std::uint32_t above = first ? codeBefore(source, message.textLine) : 0;
    if (!above) return first ? "" : "put ';' before it";
    const base::Place end = source.placeOf(above);
    const bool same = end.file && place.file && *end.file == *place.file;
    return same ? fmt::format("put ';' at the end of line {}", end.line)
                : fmt::format("put ';' at the end of {}:{}", *end.file, end.line);
  }
  if (error.expects("','") && !error.token.starts_with('\'')) return "put ',' before it";
  for (const char* bracket : {"')'", "']'"})
    if (error.expects(bracket)) return fmt::format("put {} before it", bracket);
  return {};
}

bool explainSyntax(LogMessage& message, const glsl::ShaderSource& source) {
  base::Diagnostic& d = message.diagnostic;
  const std::string raw = d.message;
  const std::optional<SyntaxError> error = syntaxErrorIn(raw);
  if (!error) return false;
  const std::string word = wordFor(error->token);
  std::vector<std::string> expected;
  for (const std::string_view token : error->expected) expected.push_back(wordFor(token));
  if (word.empty() || std::ranges::find(expected, std::string()) != expected.end()) return false;
  const std::string_view there =
      !error->text.empty() ? error->text
      : message.textLine   ? tokenAt(lineOf(source.text, message.textLine), d.place.column, error->token)
                           : std::string_view();
  if (there.empty() || word == fmt::format("'{}'", there))
    d.message = fmt::format("syntax error at {}", word);
  else
    d.message = word == "a name" ? fmt::format("syntax error at '{}'", there)
                                 : fmt::format("syntax error at '{}', {}", there, word);
  d.expected = fmt::format("{}", fmt::join(expected, " or "));
  d.hint = fixFor(*error, message, source);
  return true;
}

// A quote or a space of another kind ends the text for a compiler, which then misses a '}'.
bool explainStray(LogMessage& message, const glsl::ShaderSource& source) {
  if (!message.textLine || !message.diagnostic.message.starts_with("syntax error")) return false;
  std::string_view line = lineOf(source.text, message.textLine);
  line = line.substr(0, line.find("//"));
  const auto stray = std::ranges::find_if(line, [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
  if (stray == line.end()) return false;
  const auto at = static_cast<std::size_t>(stray - line.begin());
  base::StrayCharacter said = base::describeStray(line.substr(at));
  message.diagnostic.place = source.placeOf(message.textLine, static_cast<std::uint32_t>(at + 1));
  message.diagnostic.message = std::move(said.message);
  message.diagnostic.hint =
      said.hint.empty() ? "outside of comments GLSL is plain ASCII" : std::move(said.hint);
  return true;
}

// An #if without its #endif: the last one that is open where the text ends.
bool explainUnterminated(LogMessage& message, const glsl::ShaderSource& source) {
  base::Diagnostic& d = message.diagnostic;
  if (!d.message.starts_with("Unterminated #if") && d.message.find("missing #endif") == std::string::npos)
    return false;
  const std::optional<Conditional> open = unterminatedConditional(source.text);
  if (!open) return false;
  d.place = source.placeOf(open->textLine, 1);
  d.message = "the conditional that opens here is never closed";
  d.hint = "write '#endif' behind what it guards";
  return true;
}

constexpr std::string_view kReservedUse = "illegal use of reserved word `";

void explainNames(base::Diagnostic& d, const glsl::ShaderSource& source,
                  std::span<const glsl::Define> defines) {
  const auto meant = [&](std::string_view name, bool function) {
    if (!function && source.declared.contains(name))
      if (const std::string conditional = conditionalAround(name, source.text); !conditional.empty()) {
        d.hint = fmt::format("its declaration stands under `{}`, which does not hold here", conditional);
        return;
      }
    d.hint = base::hintForForeign(base::Foreign::shader_name, name);
    if (!d.hint.empty()) return;
    if (const auto block = source.parts.blockOf.find(name);
        !function && block != source.parts.blockOf.end()) {
      const std::string& instance = source.parts.instanceOf.find(block->second)->second;
      d.message = fmt::format("'{}' is not declared by itself: its block '{}' has the instance name '{}'",
                              name, block->second, instance);
      d.hint = fmt::format("write '{}.{}', or take '{}' away behind the block", instance, name, instance);
      return;
    }
    if (!function && isGiven(name, defines)) {
      d.hint = fmt::format(
          "the pass has '{}' as a slot or a parameter: declare it, or give it there the name that it has "
          "here",
          name);
      return;
    }
    if (const std::string near = nearestOf(name, function, source); !near.empty())
      d.hint = fmt::format("did you mean '{}'?", near);
  };
  const std::string raw = d.message;
  if (const auto name = undeclaredIn(raw)) {
    d.message = fmt::format("'{}' is not declared", *name);
    meant(*name, false);
  } else if (const auto function = between(raw, "no function with name '", "'")) {
    d.message = fmt::format("there is no function '{}'", *function);
    meant(*function, true);
  } else if (const auto reserved = between(raw, kReservedUse, "'")) {
    d.message = fmt::format("'{}' is a reserved word of GLSL", *reserved);
    d.hint = base::hintForForeign(base::Foreign::shader_name, *reserved);
    if (d.hint.empty()) d.hint = fmt::format("choose another name, such as 'my_{}'", *reserved);
  } else if (const auto swizzle = between(raw, "invalid swizzle / mask `", "'")) {
    d.message = fmt::format("the value has no '.{}'", *swizzle);
  } else if (raw.ends_with("shader lacks `main'")) {
    d.hint = source.text.find("mainImage") != std::string::npos
                 ? "call it: void main() { mainImage(result, gl_FragCoord.xy); }, with 'out vec4 result;'"
                 : "each shader file has one void main()";
  } else if (const auto input =
                 between(raw, "fragment shader input `", "' has no matching output in the previous stage")) {
    d.message = fmt::format("no shader before the fragment shader writes its input '{}'", *input);
    d.hint = fmt::format(
        "a fullscreen pass has one input, 'in vec2 uv;', from 0 to 1; in other passes the vertex "
        "shader declares and writes 'out … {};'",
        *input);
  } else if (raw.find("unrecognized layout identifier") != std::string::npos) {
    if (raw.find("push_constant") != std::string::npos)
      d.hint = "OpenGL has no push constants: parameters stand in `layout(std140) uniform Parameters { … };`";
    else if (raw.find("`set'") != std::string::npos || raw.find("'set'") != std::string::npos)
      d.hint = "OpenGL has no descriptor sets: take 'set' and 'binding' away, names bind";
  } else if (std::string fix = fixForAssignment(raw); !fix.empty()) {
    d.hint = std::move(fix);
  } else if (raw.starts_with("compute shader must contain a fixed or a variable local group size")) {
    d.message = "the compute shader does not say how large a group is";
    d.expected = "layout(local_size_x = 8, local_size_y = 8) in;";
  }
}

// Said of what an error beside it has made unknown.
bool isConsequence(const std::string& text) {
  for (const char* about : {"type mismatch", "operands to arithmetic operators must be numeric",
                            "could not implicitly convert return value to"})
    if (text.starts_with(about)) return true;
  return text.ends_with("from a non-numeric data type");
}

// About an operand that another error is about.
bool namesErrorType(const std::string& text) {
  return text.ends_with("type error") || text.find("type error ") != std::string::npos ||
         text.find("(error,") != std::string::npos || text.find("(error)") != std::string::npos ||
         text.find(", error,") != std::string::npos || text.find(", error)") != std::string::npos;
}

// "`c' used uninitialized", where an error stands on a line with `c`: it kept it from being set.
bool isKeptFromSetting(const LogMessage& message, const std::vector<std::uint32_t>& errors,
                       const glsl::ShaderSource& source) {
  const auto name = between(message.diagnostic.message, "`", "' used uninitialized");
  return name && std::ranges::any_of(errors, [&](std::uint32_t line) {
           return line != 0 && mentionsWord(lineOf(source.text, line), *name);
         });
}

// The word at the place of the message, when a define of the graph stands in its place.
const glsl::Define* hidingDefine(const LogMessage& message, const glsl::ShaderSource& source,
                                 std::span<const glsl::Define> defines) {
  const std::uint32_t column = message.diagnostic.place.column;
  const std::string_view line = message.textLine ? lineOf(source.text, message.textLine) : std::string_view();
  if (column == 0 || column > line.size() || !message.diagnostic.message.starts_with("syntax error"))
    return nullptr;
  std::size_t first = column - 1, end = column - 1;
  while (first > 0 && base::isIdentChar(line[first - 1])) --first;
  while (end < line.size() && base::isIdentChar(line[end])) ++end;
  const auto found = std::ranges::find(defines, line.substr(first, end - first), &glsl::Define::name);
  return found == defines.end() ? nullptr : &*found;
}

}  // namespace

std::string_view lineOf(std::string_view text, std::uint32_t number) {
  for (; number > 1; --number) {
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + 1);
  }
  return text.substr(0, text.find('\n'));
}

void dropConsequences(std::vector<LogMessage>& messages, const glsl::ShaderSource& source) {
  std::vector<std::uint32_t> causes, reserved;  // lines
  for (const LogMessage& message : messages) {
    const base::Diagnostic& d = message.diagnostic;
    if (d.severity == base::Severity::error && !isConsequence(d.message) && !namesErrorType(d.message))
      causes.push_back(message.textLine);
    if (d.message.starts_with(kReservedUse)) reserved.push_back(message.textLine);
  }
  std::erase_if(messages, [&](const LogMessage& message) {
    const std::string& text = message.diagnostic.message;
    if (isKeptFromSetting(message, causes, source)) return true;
    const bool beside = std::ranges::find(causes, message.textLine) != causes.end();
    const bool behind =
        text.starts_with("syntax error") && std::ranges::find(reserved, message.textLine) != reserved.end();
    return behind || (namesErrorType(text) && !causes.empty()) || (isConsequence(text) && beside);
  });
}

void explainMessage(LogMessage& message, const glsl::ShaderSource& source,
                    std::span<const glsl::Define> defines) {
  base::Diagnostic& d = message.diagnostic;
  if (const glsl::Define* define = hidingDefine(message, source, defines)) {
    d.message = fmt::format("'{}' is a name of the shader, and the graph defines it as {}", define->name,
                            define->value);
    d.expected = "a name under \"defines\" that nothing in the shader has";
    d.hint = fmt::format("rename the define, such as '{}_MODE'", define->name);
    return;
  }
  if (!explainStray(message, source) && !explainUnterminated(message, source) &&
      !explainSyntax(message, source))
    explainNames(d, source, defines);
  std::ranges::replace(d.message, '`', '\'');
  for (const auto& [side, words] : std::initializer_list<std::pair<std::string_view, const char*>>{
           {"LHS of ", "left side of "}, {"RHS of ", "right side of "}})
    if (d.message.starts_with(side)) d.message.replace(0, side.size(), words);
}

}  // namespace weft::gl
