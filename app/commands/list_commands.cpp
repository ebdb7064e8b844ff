// The commands that list what can be chosen: params, presets.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/base/files/text_file.h"
#include "engine/base/json/dom.h"
#include "engine/base/printable.h"
#include "engine/graph/read/read.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;
using Type = graph::ParameterDesc::Type;

const char* nameOf(Type type) {
  switch (type) {
    case Type::boolean:
      return "bool";
    case Type::integer:
      return "int";
    case Type::number:
      return "float";
    case Type::vec2:
      return "vec2";
    case Type::vec3:
      return "vec3";
    case Type::vec4:
      return "vec4";
    case Type::choice:
      return "choice";
    case Type::file:
      return "file";
  }
  return "";
}

std::string rangeOf(const graph::ParameterDesc& desc) {
  if (!desc.choices.empty()) return fmt::format("{}", fmt::join(desc.choices, " | "));
  if (desc.min && desc.max) return fmt::format("{} to {}", *desc.min, *desc.max);
  if (desc.min) return fmt::format("from {}", *desc.min);
  return desc.max ? fmt::format("up to {}", *desc.max) : "";
}

Json toJson(const graph::Value& value) {
  switch (value.type) {
    case graph::Value::Type::boolean:
      return value.truth();
    case graph::Value::Type::number:
      return value.v[0];
    case graph::Value::Type::list:
      return std::vector<double>(value.v.begin(), value.v.begin() + value.count);
    default:
      return value.symbol;
  }
}

Json toJson(const graph::ParameterSpec& parameter) {
  const graph::ParameterDesc& desc = parameter.desc;
  Json out{{"name", parameter.path},
           {"type", nameOf(desc.type)},
           {"default", toJson(desc.initial)},
           {"value", toJson(parameter.value)},
           {"from", graph::wordFor(parameter.origin)}};
  if (desc.min) out["min"] = *desc.min;
  if (desc.max) out["max"] = *desc.max;
  if (desc.step) out["step"] = *desc.step;
  if (!desc.choices.empty()) out["choices"] = desc.choices;
  if (!desc.label.empty()) out["label"] = desc.label;
  if (!desc.doc.empty()) out["doc"] = desc.doc;
  return out;
}

// Columns as wide as their widest cell, the last as it is.
void printTable(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t i = 0; i + 1 < row.size(); ++i)
      widths[i] = std::max(widths[i], base::printable(row[i]).size());
  }
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += fmt::format("{:<{}}  ", base::printable(row[i]), widths[i]);
    line.erase(line.find_last_not_of(' ') + 1);
    print(line + "\n");
  }
}

struct Preset {
  std::string name, title, description;  // of the file, "name" and "description" in it
};

// The presets of all folders; of two with one name, the one that --preset finds.
std::vector<Preset> knownPresets(const std::string& own, base::Diagnostics& diagnostics) {
  std::vector<Preset> presets;
  std::set<std::string> seen;  // also of files that cannot be read: --preset takes those, too
  for (const std::string& folder : presetFolders(own)) {
    std::error_code ec;
    for (auto entry = std::filesystem::directory_iterator(folder, ec);
         !ec && entry != std::filesystem::directory_iterator(); entry.increment(ec)) {
      const std::string path = entry->path().string(), name = entry->path().stem().string();
      if (entry->path().extension() != ".json" || !seen.insert(name).second) continue;
      const auto text = base::readTextFile(path, diagnostics);
      const auto root = text ? base::parseJson(*text, std::make_shared<const std::string>(path), diagnostics)
                             : std::nullopt;
      if (!root) continue;
      Preset preset{.name = name, .title = {}, .description = {}};
      if (const auto* title = root->find("name")) preset.title = title->text;
      if (const auto* description = root->find("description")) preset.description = description->text;
      presets.push_back(std::move(preset));
    }
  }
  std::ranges::sort(presets, {}, &Preset::name);
  return presets;
}

}  // namespace

int runParams(const Options& options) {
  base::Diagnostics diagnostics;
  const auto world = loadWorld(options, diagnostics);
  const auto plan = makePlan(options, world ? world->facts() : factsWithoutWorld(), true, diagnostics);
  if (plan && options.format == "json") {
    Json all = Json::array();
    for (const graph::ParameterSpec& parameter : plan->graph->parameters) all.push_back(toJson(parameter));
    print(dumpJson(all) + "\n");
  } else if (plan) {
    std::vector<std::vector<std::string>> rows{{"NAME", "TYPE", "VALUE", "FROM", "RANGE", "LABEL"}};
    for (const graph::ParameterSpec& parameter : plan->graph->parameters)
      rows.push_back({parameter.path, nameOf(parameter.desc.type), graph::toText(parameter.value),
                      graph::wordFor(parameter.origin), rangeOf(parameter.desc), parameter.desc.label});
    printTable(rows);
  }
  return report(diagnostics);
}

int runPresets(const Options& options) {
  base::Diagnostics diagnostics;
  const std::vector<Preset> presets = knownPresets(options.presetFolder, diagnostics);
  if (options.format == "json") {
    Json all = Json::array();
    for (const Preset& preset : presets)
      all.push_back({{"name", preset.name}, {"title", preset.title}, {"description", preset.description}});
    print(dumpJson(all) + "\n");
  } else {
    std::vector<std::vector<std::string>> rows;
    for (const Preset& preset : presets) rows.push_back({preset.name, preset.description});
    printTable(rows);
  }
  return report(diagnostics);
}

}  // namespace weft::app
