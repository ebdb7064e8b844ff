#include "engine/text/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/text/printable.h"

namespace weft::text {

namespace {

using Json = nlohmann::ordered_json;

const char* wordFor(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

std::string dumped(const Json& json, int indent) {
  return printableJson(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

Json locationOf(const Place& place) {
  Json physical;
  physical["artifactLocation"]["uri"] = uriOf(*place.file);
  if (place.line > 0) {
    physical["region"]["startLine"] = place.line;
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

std::string uriOf(std::string_view path) {
  std::string uri = path.starts_with('/') ? "file://" : "";
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = std::isalnum(byte) != 0 || std::string_view("-._~/").find(c) != std::string_view::npos;
    uri += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return uri;
}

std::string diagnosticsJson(const Diagnostics& diagnostics, int indent) {
  Json all = Json::array();
  for (const Diagnostic& d : diagnostics.items()) {
    Json each{{"severity", wordFor(d.severity)},
              {"code", nameOf(d.code)},
              {"title", titleOf(d.code)},
              {"message", d.message}};
    if (d.place.file) each["file"] = *d.place.file;
    if (d.place.option) each["option"] = *d.place.option;
    if (d.place.line > 0) each["line"] = d.place.line;
    if (d.place.line > 0 && d.place.column > 0) each["column"] = d.place.column;
    for (const auto& [key, value] : {std::pair<const char*, const std::string&>{"pointer", d.pointer},
                                     {"pass", d.pass},
                                     {"resource", d.resource},
                                     {"expected", d.expected},
                                     {"found", d.found},
                                     {"fix", d.hint}})
      if (!value.empty()) each[key] = value;
    all.push_back(std::move(each));
  }
  return dumped(all, indent);
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
                {"level", wordFor(d.severity)},
                {"message", {{"text", wholeMessage(d)}}}};
    // An option of the command line is no artifact.
    if (d.place.file && !d.place.file->empty())
      result["locations"] = Json::array({locationOf(d.place.inFile())});
    results.push_back(std::move(result));
  }
  Json driver{{"name", "weft"}, {"version", version}, {"rules", std::move(rules)}};
  Json run;
  run["tool"]["driver"] = std::move(driver);
  run["results"] = std::move(results);
  const Json document{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"},
                      {"version", "2.1.0"},
                      {"runs", Json::array({std::move(run)})}};
  return dumped(document, 2);
}

}  // namespace weft::text
