#include "app/lsp/workspace.h"

#include <fmt/format.h>

#include <filesystem>

#include "app/session/session.h"
#include "app_sentences.h"
#include "engine/graph/compile/compile.h"
#include "engine/graph/edit/edit.h"
#include "engine/graph/read/read.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/prepare/program_request.h"

namespace weft::app::lsp {

namespace fs = std::filesystem;

namespace {

// Graphs are checked even when the scene cannot be read, so its messages are left out.
runtime::WorldFacts factsOf(const Options& options) {
  text::Diagnostics ignored;
  const auto world = loadWorld(options, ignored);
  return world ? world->facts() : factsWithoutWorld();
}

std::vector<ShaderKey> keysOf(const graph::PassDesc& pass) {
  std::vector<ShaderKey> keys;
  const auto add = [&](const char* kind, std::string name, text::Place place) {
    ++place.column;  // behind the quote
    keys.push_back({kind, std::move(name), std::move(place)});
  };
  for (const graph::SlotDesc& each : pass.slots) add("slot", each.name, each.place);
  for (const graph::PassParameterDesc& each : pass.parameters) add("parameter", each.name, each.place);
  for (const graph::NamedExpr& each : pass.defines) add("define", each.name, each.place);
  for (const graph::NamedExpr& each : pass.state)
    for (const std::string_view key : {"blend.", "color_mask."})
      if (each.name.starts_with(key) && each.name.find('.', key.size()) == std::string::npos)
        add("slot", each.name.substr(key.size()), each.place);
  return keys;
}

}  // namespace

std::set<std::string> jsonFilesBelow(const std::string& folder) {
  constexpr int kMaxFiles = 20000;
  std::set<std::string> found;
  std::error_code ec;
  int looked = 0;
  for (auto entry =
           fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, ec);
       !ec && entry != fs::recursive_directory_iterator() && ++looked < kMaxFiles; entry.increment(ec)) {
    const std::string name = entry->path().filename().string();
    if (entry->is_directory(ec) &&
        (name.starts_with('.') || name == "build" || name == "out" || name == "node_modules"))
      entry.disable_recursion_pending();
    else if (name.ends_with(".json") && entry->is_regular_file(ec))
      found.insert(text::absolutePath(entry->path().string()));
  }
  return found;
}

Workspace::Workspace(const Options& options, const Texts& texts)
    : options_(options), texts_(texts), registry_(runtime::makeRegistry({}, factsOf(options))) {}

bool Workspace::isInFolders(const std::string& path) const {
  return std::ranges::any_of(folders_,
                             [&](const std::string& folder) { return path.starts_with(folder + "/"); });
}

// ---- which files are graphs ----

// A file with a key that only graphs, overlays and presets have, or one that had it: a mistake may hide it now.
bool Workspace::isGraph(const std::string& path) const {
  const auto text = path.ends_with(".json") && text::mayRead(path) ? texts_.of(path) : nullptr;
  if (!text || graphs_.contains(path)) return text != nullptr;
  constexpr const char* kKeys[] = {"passes", "resources", "parameters", "let",
                                   "set",    "extends",   "present",    "outputs"};
  const JsonValue& root = text->json().root;
  return textOf(root, "$schema").ends_with("graph.schema.json") ||
         std::ranges::any_of(kKeys, [&](const char* key) { return root.find(key); });
}

// Whether the file sets values and shows no picture, and so does what it extends: the graph below it is missing.
bool Workspace::isPreset(const std::string& path, int depth) const {
  const auto text = texts_.of(path);
  if (!text || depth > 64) return false;
  const JsonValue& root = text->json().root;
  const JsonValue* below = root.find("extends");
  if (!below) return root.find("set") && !root.find("present");
  if (!below->items.empty()) below = &below->items.front();
  return isPreset(pathBeside(path, below->text), depth + 1);
}

// ---- reading ----

void Workspace::look() {
  std::set<std::string> same;
  for (auto& [path, text] : seen_)
    if (const auto before = std::exchange(text, texts_.of(path)); before == text) same.insert(path);
  const auto isOld = [&](const std::string& file) { return !same.contains(text::absolutePath(file)); };
  std::erase_if(shared_,
                [&](const auto& each) { return std::ranges::any_of(each.second.graph->files, isOld); });
}

void Workspace::read(const std::string& path, Graph& graph) {
  const auto textOf = [&](const std::string& file) {
    const auto [text, fresh] = seen_.try_emplace(file);
    if (fresh) text->second = texts_.of(file);
    return text->second;
  };
  const auto isSame = [&](const auto& known) { return textOf(known.first) == known.second; };
  if (graph.read && std::ranges::all_of(graph.texts, isSame)) return;  // what could not be read is read again
  graph.readSaid.clear();
  graph.read = graph::readGraph(path, graph.readSaid, {.mostFileBytes = Text::kMaxBytes, .shared = &shared_});
  if (graph.read || !graph.desc) graph.texts.clear();
  graph.texts[path];
  if (graph.read)
    for (const std::string& file : graph.read->files) graph.texts[text::absolutePath(file)];
  for (auto& [file, text] : graph.texts) text = textOf(file);
  if (!graph.read || (graph.desc && graph.readSaid.contains(text::Code::notJson))) return;
  graph.desc = graph.read;
  graph.uses.reset();
}

void Workspace::readAll() {
  std::set<std::string> files;
  for (const std::string& folder : folders_) files.merge(jsonFilesBelow(folder));
  for (const auto& [path, open] : texts_.opened()) files.insert(path);
  std::erase_if(files, [&](const std::string& path) { return !isGraph(path); });
  std::erase_if(graphs_, [&](const auto& known) { return !files.contains(known.first); });
  std::set<std::string> included;
  for (const std::string& path : files) {
    Graph& graph = graphs_[path];
    read(path, graph);
    if (!graph.desc) continue;
    graph.shaderFolders = runtime::shaderRootsOf(graph.desc->files, dataFolder());
    graph::eachPass(*graph.desc, [&](const std::string&, const graph::PassDesc& pass) {
      if (pass.include && pass.include->graph) included.insert(text::absolutePath(pass.include->graph->path));
    });
  }
  roots_.clear();
  for (const bool checked : {true, false})
    for (const auto& [path, graph] : graphs_)
      if (graph.desc && graph.checked == checked && (checked || !included.contains(path)))
        roots_.push_back(&graph);
}

std::vector<const Graph*> Workspace::graphsOf(const std::string& path) const {
  std::vector<const Graph*> found;
  for (const auto& [root, graph] : graphs_)
    if (graph.desc && graph.texts.contains(path)) found.push_back(&graph);
  return found;
}

const std::vector<graph::NameUse>& Workspace::usesOf(const Graph& graph) const {
  if (!graph.uses) graph.uses = graph::findNameUses(*graph.desc, registry_);
  return *graph.uses;
}

std::optional<Location> Workspace::locate(const text::Place& place, std::string_view name) const {
  const std::string path = place.file && place.line > 0 ? text::absolutePath(*place.file) : "";
  const auto text = path.empty() ? nullptr : texts_.of(path);
  if (!text) return std::nullopt;
  const std::size_t at = text::offsetOf(text->bytes(), place);
  if (text->bytes().compare(at, name.size(), name) != 0) return std::nullopt;
  return Location{path, {at, at + name.size()}};
}

// ---- checking ----

void Workspace::check() {
  std::map<std::string, Graph*> open;
  for (const auto& [path, opened] : texts_.opened())
    if (isGraph(path)) read(path, *(open[path] = &graphs_[path]));
  for (auto& [path, graph] : graphs_) {
    graph.checked = open.contains(path) && std::ranges::none_of(open, [&](const auto& other) {
                      return other.second->texts.contains(path) && !graph.texts.contains(other.first);
                    });
    graph.said.clear();
    if (graph.checked)
      check(path, graph);
    else
      graph.plan = nullptr;
  }
}

void Workspace::check(const std::string& path, Graph& graph) {
  graph.current = false;
  if (graph.readSaid.hasErrors() && isPreset(path)) {
    text::parseJson(texts_.of(path)->bytes(), path, graph.said);
    return;
  }
  graph.said.append(graph.readSaid);
  if (!graph.read) return;
  graph.shaderFolders = runtime::shaderRootsOf(graph.read->files, dataFolder());
  const auto flat = graph::expandGraph(*graph.read, registry_, settingsOf(options_, true), graph.said);
  if (!flat || graph.said.hasErrors()) return;
  graph.plan = std::make_shared<const graph::Plan>(graph::compile(flat));
  graph.current = graph::checkMemory(*graph.plan, graph.said);
  glsl::SourceLoader& loader = sources(graph.shaderFolders);
  loader.forgetTouched();
  LoadedSources loaded;
  for (const graph::Step& step : graph.plan->steps) {  // its shader, by what it declares
    const graph::PassType* type = graph::findNamed(registry_.passTypes, flat->specs[step.pass].type);
    if (type->shader == graph::ShaderShape::none) continue;
    checkDeclared(*graph.plan, step.pass, runtime::programRequestOf(*flat, *graph.plan, step.pass, *type),
                  loader, loaded, graph.said, graph.said);
  }
}

std::map<std::string, text::Diagnostics> Workspace::diagnostics() const {
  std::map<std::string, text::Diagnostics> found;
  for (const auto& [root, graph] : graphs_)
    for (const text::Diagnostic& each : graph.said.items())
      found[each.place.file && each.place.line > 0 ? text::absolutePath(*each.place.file) : root].add(each);
  for (auto& [path, said] : found) said.sortByPlace();
  return found;
}

// ---- shaders ----

std::vector<std::string> Workspace::shaderFolders(const Text& text) const {
  for (const Graph* graph : roots_)
    if (!text.isJson() || graph->texts.contains(text.path())) return graph->shaderFolders;
  return runtime::shaderRootsOf(std::vector{text.path()}, dataFolder());
}

glsl::SourceLoader& Workspace::sources(const std::vector<std::string>& folders) const {
  return sources_.try_emplace(folders, folders).first->second;
}

std::vector<std::string> Workspace::shaderFiles(const std::string& shader, const std::string& vertexShader,
                                                const std::vector<std::string>& folders) const {
  std::vector<std::string> stages{vertexShader, shader};
  if (vertexShader.empty() && !shader.ends_with(".glsl"))
    stages = {shader + ".vert.glsl", shader + ".frag.glsl"};
  text::Diagnostics ignored;
  std::vector<std::string> files;
  for (const std::string& stage : stages)
    if (const auto source = shader.empty() || stage.empty() ? nullptr : sources(folders).load(stage, ignored))
      for (const auto& file : source->files) files.push_back(text::absolutePath(*file));
  return files;
}

std::vector<Program> Workspace::programsOf(const Graph& graph) const {
  std::vector<Program> found;
  graph::eachPass(*graph.desc, [&](const std::string& name, const graph::PassDesc& pass) {
    if (!pass.include) found.push_back({&graph, &pass, name, keysOf(pass)});
  });
  return found;
}

std::vector<std::string> Workspace::filesOf(const Program& program) const {
  return shaderFiles(program.pass->shader, program.pass->vertexShader, program.graph->shaderFolders);
}

std::vector<Program> Workspace::programs() const {
  std::vector<Program> found;
  for (const Graph* graph : roots_) std::ranges::move(programsOf(*graph), std::back_inserter(found));
  for (Program& program : found) program.files = filesOf(program);
  return found;
}

std::optional<Location> Workspace::findInShaders(const std::vector<std::string>& files,
                                                 std::string_view name) const {
  for (const std::string& path : files)
    if (const auto text = texts_.of(path))
      if (const glsl::Declaration* declared = text->glsl().find(name);
          declared && declared->role <= glsl::Role::member)
        if (const auto range = text->rangeOf(*declared)) return Location{path, *range};
  for (const std::string& path : files)
    if (const auto text = texts_.of(path))
      for (const GlslWord& word : text->words())
        if (word.text == name && !word.member) return Location{path, word.range};
  return std::nullopt;
}

}  // namespace weft::app::lsp
