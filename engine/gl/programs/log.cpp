// Logs of shader compilers and linkers as diagnostics with true places. Declared in program.h.
#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "engine/gl/programs/program.h"
#include "engine/glsl/interface.h"
#include "engine/glsl/tokens.h"
#include "engine/text/chars.h"
#include "engine/text/nearest.h"
#include "engine/text/words/words.h"

namespace weft::gl {

namespace {

// A message of a log, with its line in ShaderSource::text, from 1; 0: it is nowhere in it.
struct LogMessage {
  text::Diagnostic diagnostic;
  std::uint32_t textLine = 0;
  bool isError() const { return diagnostic.severity == text::Severity::error; }
};

// What stands before the text of a message: "0:12(5): error: ", "0(12) : error C1234: ", "ERROR: 0:12: " or "error: ".
struct LogPrefix {
  std::size_t length = 0;
  std::uint32_t line = 0, column = 0;
  text::Severity severity = text::Severity::error;
};

LogPrefix prefixOf(std::string_view raw) {
  static const std::regex kForm(R"((?:ERROR: |WARNING: )?(?:\d+[:(](\d+)\)?(?:\((\d+)\))? ?: )?)"
                                R"((?:(?:preprocessor |fatal )?(?:error|warning|note)(?: C\d+)?: )?)");
  const std::string head(raw.substr(0, 80));  // the work for long lines is bounded
  std::smatch match;
  std::regex_search(head, match, kForm, std::regex_constants::match_continuous);
  const std::string before = text::lowered(match.str());
  const auto number = [&](std::size_t group) {
    return text::numberIn<std::uint32_t>(match.str(group)).value_or(0);
  };
  return {before.size(), number(1), number(2),
          before.find("warning") != std::string::npos ? text::Severity::warning
          : before.find("note") != std::string::npos  ? text::Severity::note
                                                      : text::Severity::error};
}

// workarounds.md: columns-after-preprocessing. The column in `line` of what stands in `column` once every run
// of blanks is one; 0 when there is no such column (a macro was expanded).
std::uint32_t trueColumn(std::string_view line, std::uint32_t column) {
  std::uint32_t collapsed = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const auto blank = [&](std::size_t at) { return line[at] == ' ' || line[at] == '\t'; };
    if (i > 0 && blank(i) && blank(i - 1)) continue;
    if (++collapsed == column) {
      while (i + 1 < line.size() && blank(i) && blank(i + 1)) ++i;
      return static_cast<std::uint32_t>(i + 1);
    }
  }
  return 0;
}

std::string_view lineOf(std::string_view text, std::uint32_t number) {
  for (; number > 1; --number) text::takeLine(text);
  return text::takeLine(text);
}

bool isName(std::string_view text) {
  return !text.empty() && text::isIdentStart(text[0]) && std::ranges::all_of(text, text::isIdentChar);
}

// The name that a message quotes, as in "`name' undeclared" or "undefined variable "name"", or "".
std::string_view quotedName(std::string_view message) {
  constexpr std::string_view kQuotes = "`'\"";
  for (std::size_t at = message.find_first_of(kQuotes); at != std::string_view::npos;) {
    const std::size_t end = message.find_first_of(kQuotes, at + 1);
    if (end == std::string_view::npos) break;
    if (const std::string_view name = message.substr(at + 1, end - at - 1); isName(name)) return name;
    at = end;
  }
  return {};
}

std::string nearestTo(std::string_view name, const glsl::Interface& interface) {
  std::vector<std::string> names;
  for (const glsl::Declaration& each : interface.declarations)
    if (each.name != name) names.emplace_back(each.name);
  if (std::string near = text::nearestName(name, names); !near.empty()) return near;
  names.assign(text::glslFunctions().begin(), text::glslFunctions().end());
  std::erase(names, name);
  return text::nearestName(name, names);
}

// What to write for a name that is not declared: the word of GLSL for one of another language, how a member of a block is
// reached, where a branch that is not taken declares it, or the nearest name.
std::string hintForName(std::string_view name, const glsl::ShaderSource& source,
                        std::span<const glsl::Define> defines) {
  const glsl::Declaration* here = source.interfaceWith(defines).find(name);
  if (here && here->role == glsl::Role::member && !here->instance.empty())
    return fmt::format("write '{}.{}': its block has an instance name", here->instance, name);
  if (here && here->role != glsl::Role::variable) return {};
  if (std::string theirs = text::hintForForeign("shader_name", name); !theirs.empty()) return theirs;
  if (text::isGlslWord(name) || text::isGlslFunction(name)) return {};
  const glsl::Interface& everywhere = source.ofAllBranches();
  if (const glsl::Declaration* other = everywhere.find(name); other && other->role != glsl::Role::variable) {
    const text::Place at = source.placeOf(other->at.line);
    return fmt::format("it is declared in {}:{}, in a branch of an #if that is not taken here", *at.file,
                       at.line);
  }
  const std::string near = nearestTo(name, everywhere);
  return near.empty() ? "" : fmt::format("did you mean '{}'?", near);
}

void advise(LogMessage& message, const glsl::ShaderSource& source, std::span<const glsl::Define> defines) {
  text::Diagnostic& d = message.diagnostic;
  if (const std::string_view name = quotedName(d.message); !name.empty()) {
    const bool links = d.code == text::Code::programDoesNotLink;
    const glsl::Declaration* in =
        links ? source.interfaceWith(defines).find(name, glsl::Role::input) : nullptr;
    d.hint = in ? fmt::format("declare `out {} {}{};` in the stage before it", in->type, name, in->array)
                : hintForName(name, source, defines);
  } else if (message.textLine) {  // of the word at the place, and of the one before it
    std::string_view before;
    for (const glsl::Token& token : glsl::splitTokens(lineOf(source.text, message.textLine))) {
      const bool here = token.column <= d.place.column && d.place.column < token.column + token.text.size();
      const auto define = std::ranges::find(defines, token.text, &glsl::Define::name);
      if (here && define != defines.end())
        d.hint = fmt::format("the graph defines '{}' as {}: rename the define", define->name, define->value);
      for (const std::string_view each : {before, token.text})
        if (here && d.hint.empty()) d.hint = text::hintForForeign("shader_name", each);
      before = token.text;
    }
  }
  std::ranges::replace(d.message, '`', '\'');
  // "…; candidates are:", which stand on lines of their own.
  if (d.message.ends_with(':')) d.message.resize(std::min(d.message.rfind(';'), d.message.size() - 1));
}

// The place of the first function or input that a message without a place quotes, as those of recursion and of linking do.
text::Place placeOfQuoted(const std::string& message, const glsl::ShaderSource& source,
                          std::span<const glsl::Define> defines) {
  const std::string_view quoted =
      std::string_view(message).substr(std::min(message.find_first_of("`'"), message.size()));
  for (const glsl::Token& token : glsl::splitTokens(quoted))
    for (const glsl::Role role : {glsl::Role::function, glsl::Role::input})
      if (const glsl::Declaration* found = source.interfaceWith(defines).find(token.text, role))
        return source.placeOf(found->at.line, found->at.column);
  return {source.file, 0, 0};
}

}  // namespace

std::size_t mapLog(std::string_view log, const glsl::ShaderSource& source, text::Code code,
                   text::Diagnostics& diagnostics, std::span<const glsl::Define> defines) {
  static const text::FileName kDefines = "<defines>";
  std::vector<LogMessage> messages;
  while (!log.empty()) {
    const std::string_view raw = text::trimmed(text::takeLine(log));
    const LogPrefix at = prefixOf(raw);
    if (at.length == 0) {  // it goes on, or has a heading
      if (!messages.empty()) messages.back().diagnostic.message += fmt::format(" {}", raw);
      continue;
    }
    LogMessage& message = messages.emplace_back();
    text::Diagnostic& d = message.diagnostic;
    d.code = code;
    d.severity = at.severity;
    d.message = std::string(raw.substr(at.length));
    if (at.line >= glsl::kTextLine) {
      message.textLine = at.line - glsl::kTextLine + 1;
      d.place =
          source.placeOf(message.textLine, trueColumn(lineOf(source.text, message.textLine), at.column));
    } else if (at.line > 0) {
      d.place = {kDefines, at.line, at.column};
    } else {
      d.place = placeOfQuoted(d.message, source, defines);
    }
  }
  for (LogMessage& message : messages) advise(message, source, defines);
  // Of the errors of one line the others follow from one: from that which a hint can be given for, or the first.
  const bool failed = std::ranges::any_of(messages, &LogMessage::isError);
  std::size_t added = 0;
  for (const LogMessage& message : messages) {
    const LogMessage* kept = nullptr;
    for (const LogMessage& other : messages)
      if (other.isError() && other.textLine == message.textLine &&
          (!kept || (kept->diagnostic.hint.empty() && !other.diagnostic.hint.empty())))
        kept = &other;
    const bool isInDefines = message.textLine == 0 && message.diagnostic.place.file == kDefines;
    if (failed && (!message.isError() || (kept != &message && !isInDefines))) continue;
    diagnostics.add(message.diagnostic);
    ++added;
  }
  return added;
}

}  // namespace weft::gl
