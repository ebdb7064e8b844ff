#include "engine/gl/messages/log.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "engine/gl/messages/words.h"

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

// What stands between the parentheses of "vec4 texture(sampler2D, vec2)", apart.
std::vector<std::string_view> argumentsOf(std::string_view call) {
  std::vector<std::string_view> arguments;
  const std::size_t open = call.find('('), close = call.rfind(')');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open) return arguments;
  for (std::string_view rest = call.substr(open + 1, close - open - 1); !rest.empty();) {
    const std::size_t comma = rest.find(',');
    arguments.push_back(trim(rest.substr(0, comma)));
    rest = comma == std::string_view::npos ? std::string_view() : rest.substr(comma + 1);
  }
  return arguments;
}

// The forms of a function that are most like the call, at most three: a list of 28 helps nobody.
std::string nearestForms(std::string_view call, const std::vector<std::string>& forms) {
  const std::vector<std::string_view> given = argumentsOf(call);
  const auto likeness = [&](const std::string& form) {
    const std::vector<std::string_view> wanted = argumentsOf(form);
    int alike = wanted.size() == given.size() ? 2 : 0;
    for (std::size_t i = 0; i < std::min(given.size(), wanted.size()); ++i)
      alike += wanted[i] == given[i] ? (i == 0 ? 4 : 1) : 0;
    return alike;
  };
  std::vector<std::string> sorted = forms;
  std::ranges::stable_sort(sorted, std::ranges::greater(), likeness);
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, sorted.size()); ++i) text += (i ? "; " : "") + sorted[i];
  if (sorted.size() > kShown) text += fmt::format("; or one of {} others", sorted.size() - kShown);
  return text;
}

// Headings and rules of NVIDIA's logs.
bool isOrnament(std::string_view text) {
  return text.empty() || text.find_first_not_of('-') == std::string_view::npos || text == "Vertex info" ||
         text == "Fragment info" || text == "Compute info" || text == "Link info";
}

}  // namespace

std::size_t mapLog(std::string_view log, const glsl::ShaderSource& source, base::Code code,
                   base::Diagnostics& diagnostics, std::span<const glsl::Define> defines) {
  static const auto prefix = std::make_shared<const std::string>("<defines>");
  std::vector<LogMessage> messages;
  LogMessage message;
  base::Diagnostic& pending = message.diagnostic;
  // Mesa gives each overload that does not fit a line of its own, at the place of the call: they are counted,
  // not reported.
  constexpr std::string_view kCandidates = "; candidates are:";
  std::vector<std::string> candidates;
  std::uint32_t callLine = 0, callColumn = 0;
  const auto flush = [&] {
    if (!candidates.empty()) {
      pending.message.resize(pending.message.size() - kCandidates.size());
      pending.expected = nearestForms(pending.message, candidates);
      candidates.clear();
    }
    if (!pending.message.empty()) messages.push_back(message);
    message = {};
  };
  while (!log.empty()) {
    const std::size_t end = log.find('\n');
    const std::string_view raw = trim(log.substr(0, end));
    log = end == std::string_view::npos ? std::string_view() : log.substr(end + 1);
    if (isOrnament(raw)) continue;
    const std::optional<LogLine> line = parseLine(raw);
    if (!line && !pending.message.empty()) {
      pending.message += fmt::format(" {}", raw);
      continue;
    }
    if (line && line->placed && line->line == callLine && line->column == callColumn &&
        pending.message.ends_with(kCandidates)) {
      candidates.emplace_back(trim(line->text));
      continue;
    }
    flush();
    callLine = line ? line->line : 0;
    callColumn = line ? line->column : 0;
    pending.code = code;
    pending.severity = line ? line->severity : base::Severity::error;
    pending.message = std::string(line ? line->text : raw);
    if (line && line->placed && line->line >= glsl::kTextLine) {
      message.textLine = line->line - glsl::kTextLine + 1;
      pending.place =
          source.placeOf(message.textLine, trueColumn(lineOf(source.text, message.textLine), line->column));
    } else if (line && line->placed) {
      pending.place = {prefix, line->line, line->column};
    } else {
      pending.place = {source.file, 0, 0};
    }
  }
  flush();
  dropConsequences(messages, source);
  for (LogMessage& known : messages) {
    explainMessage(known, source, defines);
    diagnostics.add(std::move(known.diagnostic));
  }
  return messages.size();
}

}  // namespace weft::gl
