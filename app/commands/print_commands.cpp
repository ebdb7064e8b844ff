// The commands that print what a plan knows (plan, explain, params) and what a graph may name (presets, types, schema).
#include <fmt/ranges.h>

#include <cctype>
#include <fstream>

#include "app/commands/commands.h"
#include "engine/graph/language/keys.h"
#include "engine/graph/print/print.h"
#include "engine/text/chars.h"
#include "engine/text/json/dom.h"
#include "engine/text/json/edit.h"
#include "engine/text/nearest.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

struct PlanOptions : Options {
  std::string format = "text";
  bool explain = false;
};

std::string viewOf(const graph::Plan& plan, const PlanOptions& options) {
  if (options.format == "dot") return graph::dumpDot(plan);
  if (options.format == "json") return graph::dumpJson(plan, options.explain);
  return graph::dumpText(plan, options.explain);
}

int runPlan(PlanOptions& options) {
  text::Diagnostics diagnostics;
  if (const auto plan = planOf(options, diagnostics)) print(viewOf(*plan, options));
  return report(diagnostics);
}

// The section of docs/errors.md of a code such as "W053"; "" where there is none. `codes`: all that it has.
std::string sectionOfCode(const std::string& code, std::vector<std::string>& codes) {
  std::ifstream page(dataFolder() + "/docs/errors.md");
  std::string section;
  for (std::string line; std::getline(page, line);) {
    if (line.starts_with("## W")) codes.push_back(line.substr(3, line.find(':') - 3));
    if (line.starts_with("## ") && !section.empty()) break;
    if (line.starts_with("## " + code + ":"))
      section = line.substr(3) + "\n";
    else if (!section.empty() && !line.starts_with("```"))
      section += line + "\n";
  }
  while (section.ends_with("\n\n")) section.pop_back();
  return section;
}

struct ExplainOptions : Options {
  std::string name;
};

int runExplain(ExplainOptions& options) {
  if (options.name.empty()) {
    std::string code = options.graph;
    std::ranges::transform(code, code.begin(), [](unsigned char c) { return std::toupper(c); });
    std::vector<std::string> codes;
    if (const std::string section = sectionOfCode(code, codes); !section.empty()) return print(section), 0;
    const std::string near = text::nearestName(code, codes);
    printError(near.empty() ? "explain: give a graph and a name, or a code such as W053\n"
                            : fmt::format("explain: there is no code {}; did you mean {}?\n",
                                          text::printable(code), near));
    return 2;
  }
  text::Diagnostics diagnostics;
  if (const auto plan = planOf(options, diagnostics))
    if (const auto text = graph::describe(*plan, options.name, diagnostics)) print(*text);
  return report(diagnostics);
}

// ---- params, presets ----

std::string nameOf(graph::ParameterDesc::Type type) {
  return std::string(graph::kParameterTypes[static_cast<std::size_t>(type)]);
}

std::string rangeOf(const graph::ParameterDesc& desc) {
  if (!desc.choices.empty()) return fmt::format("{}", fmt::join(desc.choices, " | "));
  if (desc.min && desc.max) return fmt::format("{} to {}", *desc.min, *desc.max);
  if (desc.min) return fmt::format("from {}", *desc.min);
  return desc.max ? fmt::format("up to {}", *desc.max) : "";
}

Json toJson(const graph::ParameterSpec& parameter) {
  const graph::ParameterDesc& desc = parameter.desc;
  Json out{{"name", parameter.path},
           {"type", nameOf(desc.type)},
           {"default", graph::jsonOf(desc.initial)},
           {"value", graph::jsonOf(parameter.value)},
           {"from", graph::wordFor(parameter.origin)}};
  if (desc.min) out["min"] = *desc.min;
  if (desc.max) out["max"] = *desc.max;
  if (desc.step) out["step"] = *desc.step;
  if (!desc.choices.empty()) out["choices"] = desc.choices;
  if (!desc.label.empty()) out["label"] = desc.label;
  if (!desc.doc.empty()) out["doc"] = desc.doc;
  return out;
}

// The presets of all folders, as JSON objects of name, title and description, the last two "name" (or the file's) and
// "description" of the file; of two with one name, the one that --preset finds.
std::vector<Json> knownPresets(const std::string& own, text::Diagnostics& diagnostics) {
  std::vector<Json> presets;
  std::set<std::string> seen;  // also of files that cannot be read: --preset takes those, too
  for (const std::string& folder : presetFolders(own)) {
    std::error_code ec;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ec)) {
      const std::string path = entry.path().string(), name = entry.path().stem().string();
      if (entry.path().extension() != ".json" || !seen.insert(name).second) continue;
      const auto text = text::readTextFile(path, diagnostics);
      const auto root = text ? text::parseJson(*text, path, diagnostics) : std::nullopt;
      const auto textOf = [&](const char* key) { return root->find(key) ? root->find(key)->text : ""; };
      if (!root) continue;
      const std::string title = textOf("name");
      presets.push_back(
          {{"name", name}, {"title", title.empty() ? name : title}, {"description", textOf("description")}});
    }
  }
  std::ranges::sort(presets, {}, [](const Json& preset) { return preset["name"].get<std::string>(); });
  return presets;
}

struct ListOptions : Options {
  bool json = false;
};

int runParams(ListOptions& options) {
  text::Diagnostics diagnostics;
  const auto plan = planOf(options, diagnostics);
  if (plan && options.json) {
    Json all = Json::array();
    for (const graph::ParameterSpec& parameter : plan->graph->parameters) all.push_back(toJson(parameter));
    print(text::dumpJson(all) + "\n");
  } else if (plan) {
    std::vector<std::vector<std::string>> rows{{"NAME", "TYPE", "VALUE", "FROM", "RANGE", "LABEL"}};
    for (const graph::ParameterSpec& parameter : plan->graph->parameters)
      rows.push_back({parameter.path, nameOf(parameter.desc.type), graph::toText(parameter.value),
                      graph::wordFor(parameter.origin), rangeOf(parameter.desc), parameter.desc.label});
    printTable(rows);
  }
  return report(diagnostics);
}

int runPresets(ListOptions& options) {
  text::Diagnostics diagnostics;
  const std::vector<Json> presets = knownPresets(options.presetFolder, diagnostics);
  if (options.json) {
    print(text::dumpJson(presets) + "\n");
  } else {
    std::vector<std::vector<std::string>> rows;
    for (const Json& preset : presets) rows.push_back({preset["name"], preset["description"]});
    printTable(rows);
  }
  return report(diagnostics);
}

void printIndented(const std::string& text) {
  for (const std::string& line : text::linesOf(text)) print("  " + line + "\n");
}

// What a graph may name, from the registry itself.
int runTypes(Options&) {
  const graph::Registry registry = runtime::makeRegistry({}, {});
  print("pass types\n");
  for (const graph::PassType& type : registry.passTypes) {
    print(fmt::format("  {}\n    {}\n", type.name, type.doc));
    if (!type.keys.empty()) print(fmt::format("    keys: {}\n", fmt::join(type.keys, ", ")));
    for (const graph::FixedSlot& slot : type.fixedSlots)
      print(fmt::format("    slot {}: {}\n", slot.name, slot.doc));
  }
  print("\nimports\n");
  for (const graph::ImportType& type : registry.imports) printIndented(graph::textOf(type));
  print("\nformats\n");
  printIndented(graph::formatTable());
  return 0;
}

}  // namespace

void addPlan(CommandLine& line) {
  const auto [plan, options] = line.add("plan", "print the plan: order, barriers, storage, bytes", runPlan);
  options.addGraph(plan);
  addChoice(plan, "--format", options.format, "dot: for Graphviz", {"text", "json", "dot"});
  plan.add_flag("--explain", options.explain, "say why: passes, barrier bits, shared storage");
}

void addExplain(CommandLine& line) {
  const auto [command, options] =
      line.add("explain", "what is known of a pass, resource or parameter; or what a code such as W053 means",
               runExplain);
  options.addGraph(command);
  command.add_option("name", options.name, "any unique suffix of its name");
}

void addParams(CommandLine& line) {
  const auto [command, options] = line.add("params", "list the parameters of a graph", runParams);
  options.addGraph(command);
  command.add_flag("--json", options.json, "as JSON");
}

void addPresets(CommandLine& line) {
  const auto [command, options] =
      line.add("presets", "list the presets that --preset finds by name", runPresets);
  command.add_flag("--json", options.json, "as JSON");
  options.addPresetFolder(command);
}

void addSchema(CommandLine& line) {
  line.add<Options>("schema", "print the JSON Schema of graph files",
                    [](Options&) { return print(graph::kGraphSchema), 0; });
}

void addTypes(CommandLine& line) {
  line.add("types", "print the pass types, imports and formats", runTypes);
}

}  // namespace weft::app
