#include "engine/text/json/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/text/json/edit.h"
#include "engine/text/limits.h"
#include "engine/text/printable.h"
#include "text_sentences.h"

namespace weft::text {

namespace {

using Json = nlohmann::ordered_json;

Json locationOf(const Place& place) {
  Json physical{{"artifactLocation", {{"uri", uriOf(*place.file)}}}};
  if (place.line > 0) {
    physical["region"] = {{"startLine", place.line}};
    if (place.column > 0) physical["region"]["startColumn"] = place.column;
  }
  return {{"physicalLocation", std::move(physical)}};
}

// The message and all that belongs to it: viewers show one text.
std::string wholeMessage(const Diagnostic& d) {
  std::string text = d.message;
  const auto add = [&](const char* label, const std::string& value) {
    if (!value.empty()) text += std::string("\n") + label + ": " + value;
  };
  add("expected", d.expected);
  add("found", d.found);
  add("fix", d.hint);
  return text;
}

}  // namespace

bool enoughErrors(const Diagnostics& diagnostics) {
  return diagnostics.errorCount() >= std::max<std::uint64_t>(1000, raised(kMaxMessages));
}

Diagnostics chooseMessages(const Diagnostics& all, bool notes) {
  Diagnostics sorted = all;
  sorted.sortByPlace();
  std::array<std::size_t, 3> there{}, room{};  // by severity
  for (const Diagnostic& each : sorted.items())
    if (notes || each.severity != Severity::note) ++there[static_cast<std::size_t>(each.severity)];
  std::size_t left = raised(kMaxMessages);
  for (std::size_t i = there.size(); i-- > 0;) {
    room[i] = std::min(there[i], left);
    left -= room[i];
    there[i] -= room[i];
  }
  Diagnostics chosen;
  for (const Diagnostic& each : sorted.items())
    if (std::size_t& seats = room[static_cast<std::size_t>(each.severity)]; seats > 0) {
      --seats;
      chosen.add(each);
    }
  const auto& [noteCount, warningCount, errorCount] = there;
  const bool stopped = enoughErrors(all);
  if (stopped || noteCount + warningCount + errorCount > 0) {
    const std::string raise = hintToRaise(kMaxMessages);
    chosen.note(say::messagesLeftOut, {}, counted(errorCount, "error"), counted(warningCount, "warning"),
                counted(noteCount, "note"), stopped ? "; no more were looked for" : "",
                raise.empty() ? "" : ", or " + raise);
  }
  return chosen;
}

std::string uriOf(std::string_view path) {
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) != 0 || std::string_view("-._~/").find(c) != std::string_view::npos;
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

std::string unescapeUri(std::string_view uri) {
  std::string out;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned value = 0;
    const char* const digits = uri.data() + i + 1;
    const bool escape = uri[i] == '%' && i + 2 < uri.size() &&
                        std::from_chars(digits, digits + 2, value, 16).ptr == digits + 2;
    out.push_back(escape ? static_cast<char>(value) : uri[i]);
    if (escape) i += 2;
  }
  return out;
}

std::string diagnosticsJson(const Diagnostics& diagnostics, int indent) {
  Json all = Json::array();
  for (const Diagnostic& d : diagnostics.items()) {
    Json each{{"severity", nameOf(d.severity)},
              {"code", nameOf(d.code)},
              {"title", titleOf(d.code)},
              {"message", d.message}};
    if (d.place.file) each["file"] = *d.place.file;
    if (d.place.option) each["option"] = *d.place.option;
    if (d.place.line > 0) each["line"] = d.place.line;
    if (d.place.line > 0 && d.place.column > 0) each["column"] = d.place.column;
    for (const auto& [key, value] : {std::pair<const char*, std::string>{"pointer", d.pointer},
                                     {"pass", d.pass},
                                     {"resource", d.resource},
                                     {"expected", d.expected},
                                     {"found", d.found},
                                     {"fix", d.hint}})
      if (!value.empty()) each[key] = value;
    all.push_back(std::move(each));
  }
  return dumpJson(all, indent);
}

std::string diagnosticsSarif(const Diagnostics& diagnostics, std::string_view version) {
  std::vector<Code> codes;
  for (const Diagnostic& d : diagnostics.items())
    if (std::ranges::find(codes, d.code) == codes.end()) codes.push_back(d.code);
  std::ranges::sort(codes);
  Json rules = Json::array();
  for (const Code code : codes)
    rules.push_back({{"id", nameOf(code)}, {"shortDescription", {{"text", titleOf(code)}}}});
  Json results = Json::array();
  for (const Diagnostic& d : diagnostics.items()) {
    Json result{{"ruleId", nameOf(d.code)},
                {"ruleIndex", std::ranges::find(codes, d.code) - codes.begin()},
                {"level", nameOf(d.severity)},
                {"message", {{"text", wholeMessage(d)}}}};
    // An option of the command line is no artifact.
    if (d.place.file && !d.place.file->empty())
      result["locations"] = Json::array({locationOf(d.place.inFile())});
    results.push_back(std::move(result));
  }
  const Json driver{{"name", "weft"}, {"version", version}, {"rules", std::move(rules)}};
  return dumpJson({{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                   {"version", "2.1.0"},
                   {"runs", Json::array({{{"tool", {{"driver", driver}}}, {"results", results}}})}});
}

}  // namespace weft::text
