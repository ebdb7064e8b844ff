#include "engine/gl/programs/log.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "engine/base/characters.h"
#include "engine/base/chars.h"
#include "engine/base/nearest.h"
#include "engine/base/words/foreign_words.h"
#include "engine/base/words/glsl_words.h"
#include "engine/glsl/interface.h"
#include "engine/glsl/tokens.h"

namespace weft::gl {

namespace {

// One message of a log: "file:line(column)" as numbers, severity and text.
struct LogLine {
  bool placed = false;
  std::uint32_t file = 0, line = 0, column = 0;
  base::Severity severity = base::Severity::error;
  std::string_view text;
};

std::string_view trim(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() &&
         (text.back() == ' ' || text.back() == '\t' || text.back() == '\r' || text.back() == '\0'))
    text.remove_suffix(1);
  return text;
}

bool takeNumber(std::string_view& text, std::uint32_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

bool take(std::string_view& text, std::string_view token) {
  if (!text.starts_with(token)) return false;
  text.remove_prefix(token.size());
  return true;
}

// "error: text", "preprocessor warning: text", "error C1234: text", "ERROR: text"; false when no severity
// stands there.
bool takeSeverity(std::string_view& text, base::Severity& severity) {
  std::string_view rest = trim(text);
  take(rest, "preprocessor ");
  if (take(rest, "error") || take(rest, "ERROR") || take(rest, "fatal error")) {
    severity = base::Severity::error;
  } else if (take(rest, "warning") || take(rest, "WARNING")) {
    severity = base::Severity::warning;
  } else if (take(rest, "note")) {
    severity = base::Severity::note;
  } else {
    return false;
  }
  const std::size_t colon = rest.find(':');
  if (colon == std::string_view::npos || colon > 8) return false;
  const std::string_view number = trim(rest.substr(0, colon));
  if (!number.empty() && number.front() != 'C') return false;
  text = trim(rest.substr(colon + 1));
  return true;
}

std::optional<LogLine> parseLine(std::string_view raw) {
  LogLine line;
  std::string_view rest = raw;
  // Mesa: 0:12(5): error: text
  if (takeNumber(rest, line.file) && take(rest, ":") && takeNumber(rest, line.line) && take(rest, "(") &&
      takeNumber(rest, line.column) && take(rest, "):") && takeSeverity(rest, line.severity)) {
    line.placed = true;
    line.text = rest;
    return line;
  }
  // NVIDIA: 0(12) : error C1234: text
  line = {};
  rest = raw;
  if (takeNumber(rest, line.file) && take(rest, "(") && takeNumber(rest, line.line) && take(rest, ")")) {
    rest = trim(rest);
    if (take(rest, ":") && takeSeverity(rest, line.severity)) {
      line.placed = true;
      line.text = rest;
      return line;
    }
  }
  // ERROR: 0:12: text, or a severity without a place
  line = {};
  rest = raw;
  if (takeSeverity(rest, line.severity)) {
    std::string_view after = rest;
    if (takeNumber(after, line.file) && take(after, ":") && takeNumber(after, line.line) &&
        take(after, ":")) {
      line.placed = true;
      line.text = trim(after);
    } else {
      line.file = line.line = 0;
      line.text = rest;
    }
    return line;
  }
  return std::nullopt;
}

// workarounds.h: columns-after-preprocessing. The column in `line` of what stands in `column` once every run
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

// Headings and rules of NVIDIA's logs.
bool isOrnament(std::string_view text) {
  return text.empty() || text.find_first_not_of('-') == std::string_view::npos || text == "Vertex info" ||
         text == "Fragment info" || text == "Compute info" || text == "Link info";
}

// A message with its line in source.text, from 1; 0: it is nowhere in it.
struct LogMessage {
  base::Diagnostic diagnostic;
  std::uint32_t textLine = 0;
};

std::string_view lineOf(std::string_view text, std::uint32_t number) {
  for (; number > 1; --number) text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  return text.substr(0, text.find('\n'));
}

bool isName(std::string_view text) {
  return !text.empty() && base::isIdentStart(text[0]) && std::ranges::all_of(text, base::isIdentChar);
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

// The word at `column` (from 1) of a line, and the one before it.
std::pair<std::string_view, std::string_view> wordsAt(std::string_view line, std::uint32_t column) {
  std::string_view before;
  for (const glsl::Token& token : glsl::splitTokens(line)) {
    const std::size_t end = token.column + token.text.size();
    if (token.column <= column && column < end) return {token.text, before};
    before = token.text;
  }
  return {};
}

std::string nearestTo(std::string_view name, const glsl::Interface& interface) {
  std::vector<std::string> names;
  for (const glsl::Declaration& each : interface.declarations)
    if (each.name != name) names.emplace_back(each.name);
  if (std::string near = base::nearestName(name, names); !near.empty()) return near;
  names.assign(base::glslFunctions().begin(), base::glslFunctions().end());
  std::erase(names, name);
  return base::nearestName(name, names);
}

// What to write for a name that is not declared: the word of GLSL for one of another language, how a member of a block is
// reached, where a branch that is not taken declares it, or the nearest name.
std::string hintForName(std::string_view name, const glsl::ShaderSource& source,
                        std::span<const glsl::Define> defines) {
  const glsl::Declaration* here = source.interfaceWith(defines).find(name);
  if (here && here->role == glsl::Role::member && !here->instance.empty())
    return fmt::format("write '{}.{}': its block has an instance name", here->instance, name);
  if (here && here->role != glsl::Role::variable) return {};
  if (std::string theirs = base::hintForForeign(base::Foreign::shader_name, name); !theirs.empty())
    return theirs;
  if (base::isGlslWord(name) || base::isGlslFunction(name)) return {};
  const glsl::Interface& everywhere = source.ofAllBranches();
  if (const glsl::Declaration* other = everywhere.find(name); other && other->role != glsl::Role::variable) {
    const base::Place at = source.placeOf(other->at.line);
    return fmt::format("it is declared in {}:{}, in a branch of an #if that is not taken here", *at.file,
                       at.line);
  }
  const std::string near = nearestTo(name, everywhere);
  return near.empty() ? "" : fmt::format("did you mean '{}'?", near);
}

void advise(LogMessage& message, const glsl::ShaderSource& source, std::span<const glsl::Define> defines) {
  base::Diagnostic& d = message.diagnostic;
  if (const std::string_view name = quotedName(d.message); !name.empty()) {
    d.hint = hintForName(name, source, defines);
  } else if (message.textLine) {
    const std::string_view line = lineOf(source.text, message.textLine);
    const auto [word, before] = wordsAt(line, d.place.column);
    const auto define = std::ranges::find(defines, word, &glsl::Define::name);
    const auto stray =
        std::ranges::find_if(line.substr(0, line.find("//")), [](char c) { return (c & 0x80) != 0; });
    if (!word.empty() && define != defines.end())
      d.hint = fmt::format("the graph defines '{}' as {}: rename the define", define->name, define->value);
    else if (const auto at = static_cast<std::size_t>(stray - line.begin());
             at < line.find("//") && at < line.size())
      d.hint = base::describeStray(line.substr(at));
    else
      for (const std::string_view each : {before, word})
        if (d.hint.empty() && isName(each)) d.hint = base::hintForForeign(base::Foreign::shader_name, each);
  }
  std::ranges::replace(d.message, '`', '\'');
  // "…; candidates are:", which stand on lines of their own.
  if (d.message.ends_with(':')) d.message.resize(std::min(d.message.rfind(';'), d.message.size() - 1));
}

}  // namespace

std::size_t mapLog(std::string_view log, const glsl::ShaderSource& source, base::Code code,
                   base::Diagnostics& diagnostics, std::span<const glsl::Define> defines) {
  static const auto prefix = std::make_shared<const std::string>("<defines>");
  std::vector<LogMessage> messages;
  while (!log.empty()) {
    const std::size_t end = log.find('\n');
    const std::string_view raw = trim(log.substr(0, end));
    log = end == std::string_view::npos ? std::string_view() : log.substr(end + 1);
    if (isOrnament(raw)) continue;
    const std::optional<LogLine> line = parseLine(raw);
    if (!line && !messages.empty()) {
      messages.back().diagnostic.message += fmt::format(" {}", raw);
      continue;
    }
    LogMessage& message = messages.emplace_back();
    base::Diagnostic& d = message.diagnostic;
    d.code = code;
    d.severity = line ? line->severity : base::Severity::error;
    d.message = std::string(line ? line->text : raw);
    if (line && line->placed && line->line >= glsl::kTextLine) {
      message.textLine = line->line - glsl::kTextLine + 1;
      d.place =
          source.placeOf(message.textLine, trueColumn(lineOf(source.text, message.textLine), line->column));
    } else if (line && line->placed) {
      d.place = {prefix, line->line, line->column};
    } else {
      d.place = {source.file, 0, 0};
    }
  }
  for (LogMessage& message : messages) advise(message, source, defines);
  // Of the errors of one line the others follow from one: from that which a hint can be given for, or the first.
  const auto isError = [](const LogMessage& message) {
    return message.diagnostic.severity == base::Severity::error;
  };
  const bool failed = std::ranges::any_of(messages, isError);
  std::size_t added = 0;
  for (const LogMessage& message : messages) {
    const auto isCause = [&](const LogMessage& other) {
      return other.textLine == message.textLine && isError(other) && !other.diagnostic.hint.empty();
    };
    const auto isBeside = [&](const LogMessage& other) {
      return other.textLine == message.textLine && isError(other);
    };
    const auto cause = std::ranges::find_if(messages, isCause);
    const LogMessage* kept = cause != messages.end() ? &*cause : &*std::ranges::find_if(messages, isBeside);
    if (failed && (!isError(message) || (message.textLine != 0 && kept != &message))) continue;
    diagnostics.add(message.diagnostic);
    ++added;
  }
  return added;
}

}  // namespace weft::gl
