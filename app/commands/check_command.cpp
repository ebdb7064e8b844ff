// weft check: everything wrong with a graph, as text, JSON or SARIF. Declared in commands.h.
#include <fmt/ranges.h>
#include <poll.h>

#include <cctype>

#include "app/commands/commands.h"
#include "app/commands/device_needs.h"
#include "app_sentences.h"
#include "engine/glsl/interface.h"
#include "engine/glsl/tokens.h"
#include "engine/graph/edit/edit.h"
#include "engine/graph/read/read.h"
#include "engine/graph/survey/matrix.h"
#include "engine/passes/pass_type.h"
#include "engine/runtime/prepare/program_request.h"
#include "engine/text/files/file_watcher.h"
#include "engine/text/json/edit.h"
#include "engine/text/json/report.h"

namespace weft::app {

namespace {

using Json = nlohmann::ordered_json;

// ---- a shader by itself ----

namespace fs = std::filesystem;
using glsl::Declaration;
using glsl::Role;

// The folder that a graph calls `shaders`, or that of the file, and the file as seen from there.
std::pair<fs::path, std::string> rootOf(const std::string& path) {
  const fs::path file = fs::path(path).lexically_normal();
  fs::path root = file.parent_path();
  for (fs::path folder = root; folder.has_filename(); folder = folder.parent_path())
    if (folder.filename() == "shaders") root = folder;
  return {root.empty() ? "." : root, file.lexically_relative(root).generic_string()};
}

// Zeros for a member of that type.
Json zeroOf(const Declaration& member) {
  if (member.type == "bool") return false;
  const std::size_t vec = member.type.find("vec");
  if (vec == std::string_view::npos || vec > 1 || !member.array.empty()) return 0;
  return Json(std::vector<int>(static_cast<std::size_t>(member.type.back() - '0'), 0));
}

// What a shader by itself would need of a pass: a stanza of its slots, parameters and defines, made of what it declares.
struct ShaderStanza {
  nlohmann::ordered_json pass;  // names of slots stand for resources, too
  gl::ProgramRequest request;   // the variant in which every slot and parameter is there
};

// `last`: what the shader puts out is written to textures. `optional`: it is there in some variants alone.
void addDeclared(const Declaration& declared, bool compute, bool last, bool optional, ShaderStanza& made) {
  const std::string name(declared.name);
  const char* const access = !declared.writes ? "read" : declared.reads ? "modify" : "write";
  // Both stages may declare it.
  const auto slot = [&](const char* key, const char* kind = "") {
    Json& slots = made.pass[key];
    const Json text = name + kind + (optional ? " ?" : "");
    if (std::find(slots.begin(), slots.end(), text) != slots.end()) return;
    slots.push_back(text);
    made.request.defines.push_back({glsl::presenceDefineOf(name), "1"});
  };
  const Role role = declared.role;
  if (role == Role::sampler) slot("read");
  if (role == Role::image) slot(access, compute && declared.writes ? "" : " as image");
  if (role == Role::storage_block) slot(access);
  if (role == Role::uniform_block && name != "Parameters" && name != "View" && name != "Slice")
    slot("read", " as uniform");
  if (role == Role::output && last && !compute) {
    made.request.outputs.push_back(name);
    slot("write");
  }
  if (role == Role::member && declared.owner == "Parameters" &&
      made.pass["parameters"].emplace(name, zeroOf(declared)).second)
    made.request.defines.push_back({glsl::presenceDefineOf(name), "1"});
}

void addStage(const glsl::ShaderSource& source, bool compute, bool last, ShaderStanza& made) {
  const glsl::Interface& shader = source.ofAllBranches();
  for (const Declaration& declared : shader.declarations)
    if (declared.role == Role::output || shader.isLive(declared))
      addDeclared(declared, compute, last, !source.interfaceWith({}).find(declared.name), made);
  const glsl::Conditions& conditions = source.conditions();
  // `compiled`: nothing compiles without.
  const auto define = [&](std::string_view word, int value, bool compiled) {
    const bool own = conditions.made.contains(word) || word.starts_with("HAS_") || word.starts_with("GL_") ||
                     word.starts_with("__");
    if (!own && made.pass["defines"].emplace(word, value).second && compiled)
      made.request.defines.push_back({std::string(word), std::to_string(value)});
  };
  const std::set used(conditions.used.begin(), conditions.used.end());
  for (const std::string_view word : used)  // that are written as macros are: LAMP_TILE
    if (word.size() > 1 && std::isupper(static_cast<unsigned char>(word[0])) && !shader.find(word) &&
        std::ranges::none_of(word, [](unsigned char c) { return std::islower(c); }))
      define(word, 4, true);  // often a count
  for (const auto* words : {&conditions.valued, &conditions.tested})
    for (const glsl::Token& word : *words) define(word.text, 1, shader.live.contains(word.text));
}

// Of the file `path`, and of the other stage of a draw beside it. Nothing after errors.
std::optional<ShaderStanza> stanzaFor(const std::string& path, glsl::SourceLoader& sources,
                                      text::Diagnostics& diagnostics) {
  const auto [root, file] = rootOf(path);
  const bool compute = file.ends_with(".comp.glsl"), vertex = file.ends_with(".vert.glsl");
  if (!compute && !vertex && !file.ends_with(".frag.glsl")) {
    diagnostics.error(say::noShaderStage, {path, 1, 1}, path);
    return std::nullopt;
  }
  ShaderStanza made;
  std::vector<std::string> roots = runtime::shaderRootsOf({}, dataFolder());
  roots.insert(roots.begin(), root.string());
  sources.setRoots(std::move(roots));
  const std::string stem = file.substr(0, file.size() - std::string_view(".frag.glsl").size());
  const std::string name = fs::path(stem).filename().string();
  const bool pair = vertex || (!compute && sources.locate(stem + ".vert.glsl"));
  made.pass = {{"name", name},
               {"type", compute ? "compute"
                        : pair  ? "draw"
                                : "fullscreen"},
               {"shader", pair ? stem : file}};
  made.request.label = name;
  auto& stages = made.request.stages;
  if (pair) stages.push_back({GL_VERTEX_SHADER, stem + ".vert.glsl", ""});
  const GLenum last = compute ? GL_COMPUTE_SHADER : GL_FRAGMENT_SHADER;
  stages.push_back({last, vertex ? stem + ".frag.glsl" : file, ""});
  bool uvAlone = true;  // what the vertex shader of a fullscreen pass puts out
  for (const auto& stage : stages) {
    const auto source = sources.load(stage.file, diagnostics, {path, 1, 1});
    if (!source) return std::nullopt;
    addStage(*source, compute, &stage == &stages.back(), made);
    for (const Declaration& each : source->ofAllBranches().declarations)
      uvAlone = uvAlone && (each.role != Role::input || each.name == "uv");
  }
  if (!compute && !pair && uvAlone) {
    stages.insert(stages.begin(), {GL_VERTEX_SHADER, "fullscreen.vert.glsl", runtime::kFullscreenVertex});
  } else if (!compute && !pair) {
    made.pass["type"] = "draw";
    made.pass["shader"] = {{"vertex", stem + ".vert.glsl"}, {"fragment", file}};
  }
  return made;
}

// ---- a graph ----

struct CheckOptions : Options {
  std::string format = "text";
  bool shaders = true;       // compile every shader, too
  bool matrix = false;       // try every variation
  bool allVariants = false;  // compile what the variations reach
  bool watch = false;        // again after every save
  bool strict = false;       // warnings fail, too
  std::string device;        // "minimum": tell what it needs of any
};

// What tells the variants of a plan's passes apart.
std::string keyOf(const gl::ProgramRequest& request) {
  std::string key = request.pass;
  for (const gl::ProgramRequest::Stage& stage : request.stages) key += "|" + stage.file;
  for (const glsl::Define& define : request.defines) key += "|" + define.name + "=" + define.value;
  for (const std::string& output : request.outputs) key += "|" + output;
  return key;
}

// Checks the shaders of plans, each variant once: compiled, or with --no-shaders by what they declare.
class ShaderCheck {
 public:
  explicit ShaderCheck(const CheckOptions& options) : options_(options) {}

  // All variants of the live passes. `with`: how the plan differs from the graph as it is, for messages; or "".
  void check(const graph::Plan& plan, const std::string& with, text::Diagnostics& diagnostics) {
    if (options_.shaders && !open(diagnostics)) return;
    glsl::SourceLoader& sources = session_ ? session_->renderer.device().sources : sources_;
    sources.setRoots(runtime::shaderRootsOf(plan.graph->files, dataFolder()));
    text::Diagnostics said;
    for (const graph::Step& step : plan.steps) {
      if (text::enoughErrors(said)) break;
      const graph::PassSpec& spec = plan.graph->specs[step.pass];
      passes.insert(spec.name.substr(0, spec.name.find('[')));
      const graph::PassType type = types_.find(spec.type)->reflect();
      if (type.shader == graph::ShaderShape::none) continue;
      const auto request = runtime::programRequestOf(*plan.graph, plan, step.pass, type);
      if (!variants.insert(keyOf(request)).second) continue;
      checkVariant(plan, step.pass, request, said);
    }
    // A warning about a shader's text is the same in all its variants.
    for (text::Diagnostic each : said.items()) {
      if (each.severity == text::Severity::warning && !told_.insert(text::format(each)).second) continue;
      if (!with.empty()) each.message += fmt::format(" (with {})", with);
      diagnostics.add(std::move(each));
    }
    files.insert(sources.touched().begin(), sources.touched().end());
  }

  // Reads the shader files of a graph that is wrong: a misspelt path is told together with its own mistakes.
  void checkFiles(const graph::GraphDesc& desc, text::Diagnostics& diagnostics) {
    sources_.setRoots(runtime::shaderRootsOf(desc.files, dataFolder()));
    graph::eachPass(desc, [&](const std::string&, const graph::PassDesc& pass) {
      const passes::PassType* type = pass.shader.empty() ? nullptr : types_.find(pass.type);
      if (!type) return;
      std::vector<std::string> stages{pass.shader, pass.vertexShader};
      if (type->reflect().shader == graph::ShaderShape::draw && pass.vertexShader.empty())
        stages = {pass.shader + ".vert.glsl", pass.shader + ".frag.glsl"};
      if (pass.shader.ends_with(".glsl") && stages[0] != pass.shader) return;  // of one stage (W067)
      for (const std::string& file : stages)
        if (!file.empty()) sources_.load(file, diagnostics, pass.shaderPlace);
    });
    files.insert(sources_.touched().begin(), sources_.touched().end());
  }

  // Checks a shader that no graph names; compiled where there is OpenGL.
  std::optional<ShaderStanza> checkAlone(const std::string& path, text::Diagnostics& diagnostics) {
    text::Diagnostics noDevice;
    if (options_.shaders && !open(noDevice)) unread.append(noDevice);
    glsl::SourceLoader& sources = session_ ? session_->renderer.device().sources : sources_;
    auto made = stanzaFor(path, sources, diagnostics);
    if (made && session_) session_->renderer.device().programs.get(made->request, diagnostics);
    files.insert(sources.touched().begin(), sources.touched().end());
    return made;
  }

  std::set<std::string> files;     // that were read or looked for
  std::set<std::string> variants;  // by what they are made of
  std::set<std::string> passes;    // of live passes, without the index of a repeat
  DeviceNeeds needs;
  text::Diagnostics unread;  // why shaders were not looked at: they, or an include, are missing

 private:
  bool open(text::Diagnostics& diagnostics) {
    if (failed_ || session_) return !failed_;
    session_ = openDevice(options_, diagnostics);
    failed_ = !session_;
    return !failed_;
  }

  void checkVariant(const graph::Plan& plan, std::uint32_t pass, const gl::ProgramRequest& request,
                    text::Diagnostics& said) {
    if (session_) {
      const auto variant = session_->renderer.device().programs.get(request, said);
      if (!variant) return;
      needs.add(request.pass, variant->stages, variant->defines, variant->program.reflection());
      const runtime::LinkedProgram linked{variant->program.reflection(), session_->context->device()};
      if (runtime::checkProgram(plan, pass, variant->stages, variant->defines, &linked, said))
        runtime::warnOfConditions(plan.graph->specs[pass], variant->stages, variant->defines, said);
      return;
    }
    checkDeclared(plan, pass, request, sources_, loaded_, unread, said);
  }

  const CheckOptions& options_;
  passes::PassRegistry types_ = passes::PassRegistry::builtin();
  std::unique_ptr<DeviceSession> session_;
  bool failed_ = false;
  glsl::SourceLoader sources_{std::vector<std::string>()};  // where nothing is compiled
  std::set<std::string> told_;                              // messages
  LoadedSources loaded_;                                    // those of `sources_`
};

struct Checked {
  text::Diagnostics diagnostics{};
  std::shared_ptr<const graph::Plan> plan{};  // null after errors of the graph
  std::optional<graph::Matrix> matrix{};
  std::optional<ShaderStanza> stanza{};  // of a shader by itself
  ShaderCheck shaders;
};

Checked checkOnce(const CheckOptions& options) {
  Checked checked{.shaders = ShaderCheck(options)};
  text::Diagnostics& diagnostics = checked.diagnostics;
  if (options.graph.ends_with(".glsl")) {
    checked.stanza = checked.shaders.checkAlone(options.graph, diagnostics);
    return checked;
  }
  const auto world = loadWorld(options, diagnostics);
  const runtime::WorldFacts facts = world ? world->facts() : factsWithoutWorld();
  checked.plan = makePlan(options, facts, true, diagnostics);
  if (checked.plan) checked.shaders.check(*checked.plan, "", diagnostics);
  const bool vary = checked.plan && !diagnostics.hasErrors() && (options.matrix || options.allVariants);
  text::Diagnostics again;
  // Beyond a limit nothing that follows can be trusted, and there may be very much of it.
  const bool over = diagnostics.contains(text::Code::limitExceeded);
  const auto desc = vary || !(checked.plan || over)
                        ? graph::readGraph(options.graph, again, {.presets = options.presets})
                        : nullptr;
  if (desc && !checked.plan && options.shaders) checked.shaders.checkFiles(*desc, diagnostics);
  if (vary) {
    graph::MatrixOptions wanted{.pairs = options.matrix};
    if (options.allVariants)
      wanted.visit = [&](const graph::Variation& variation, std::shared_ptr<const graph::FlatGraph> flat) {
        const bool changed = !variation.disables.empty() || !variation.parameter.empty();
        checked.shaders.check(graph::compile(std::move(flat)), changed ? variation.text() : "", diagnostics);
      };
    checked.matrix =
        graph::tryMatrix(*desc, runtime::makeRegistry({}, facts), settingsOf(options, true, true), wanted);
  }
  // Passes whose shaders no plan has: what switches them on is the size of a picture, or several parameters at once.
  std::set<std::string> off;
  const auto lookFor = [&](const std::string& name) {
    if (!checked.shaders.passes.contains(name)) off.insert(name);
  };
  if (checked.plan && !options.allVariants)
    for (const graph::DisabledPass& each : checked.plan->graph->disabled)
      lookFor(each.name.substr(0, each.name.find('[')));
  if (vary && options.allVariants && !diagnostics.hasErrors())
    graph::eachPass(*desc, [&](const std::string& name, const graph::PassDesc& pass) {
      if (!pass.include && !pass.shader.empty() && pass.repeat.empty()) lookFor(name);
    });
  if (!off.empty())
    checked.shaders.unread.warning(
        say::passesAreOff, {options.graph}, text::counted(off.size(), "pass"), off.size() == 1 ? "is" : "are",
        options.allVariants ? " with this scene" : ", some of which --all switches on", fmt::join(off, ", "));
  if (vary && options.matrix)
    for (const auto* told : {&checked.matrix->broken, &checked.matrix->lost})
      for (const graph::RefusedVariation& variation : *told)
        for (text::Diagnostic each : variation.said.items()) {
          each.message += fmt::format(" (with {})", variation.variation.text());
          diagnostics.add(std::move(each));
        }
  std::set<std::string>& files = checked.shaders.files;
  if (checked.plan)
    files.insert(checked.plan->graph->files.begin(), checked.plan->graph->files.end());
  else if (desc)
    files.insert(desc->files.begin(), desc->files.end());
  else
    files.insert(options.graph);
  diagnostics.sortByPlace();
  return checked;
}

// ---- told as text ----

std::string matrixText(const CheckOptions& options, const Checked& checked) {
  const graph::Matrix& matrix = *checked.matrix;
  std::string text;
  if (options.matrix) {
    text = fmt::format("matrix: {} and {} disabled, {} set\n", text::counted(matrix.passes, "pass"),
                       text::counted(matrix.pairs, "pair"), text::counted(matrix.values, "value"));
    for (const graph::RefusedVariation& needed : matrix.needed)
      text += fmt::format("  needed: {}: {}\n",
                          text::printable(fmt::format("{}", fmt::join(needed.variation.disables, " or "))),
                          text::printable(needed.said.items()[0].message));
    text += matrix.broken.empty()
                ? "  nothing else is refused\n"
                : fmt::format("  {} of these are refused without saying so\n", matrix.broken.size());
  }
  if (options.allVariants && options.shaders)
    text += fmt::format("shaders: {} compiled\n", text::counted(checked.shaders.variants.size(), "variant"));
  return text;
}

// 1 after an error, with --strict also after a warning.
int codeOf(const CheckOptions& options, const text::Diagnostics& said) {
  const bool warned = options.strict && std::ranges::any_of(said.items(), [](const text::Diagnostic& d) {
                        return d.severity == text::Severity::warning;
                      });
  return said.hasErrors() || warned ? 1 : 0;
}

int tellText(const CheckOptions& options, Checked& checked) {
  report(checked.diagnostics);
  const int code = codeOf(options, checked.diagnostics);
  if (checked.matrix) print(matrixText(options, checked));
  if (!options.device.empty() && checked.plan) print(checked.shaders.needs.text());
  if (checked.stanza)
    print(text::layoutJson(text::dumpJson(checked.stanza->pass) + "\n"));
  else if (code == 0)
    print(fmt::format("{}: {}, {} run, {} {} {} of {} declared bytes\n", text::printable(options.graph),
                      text::counted(checked.plan->graph->passes.size(), "pass"), checked.plan->steps.size(),
                      text::counted(checked.plan->storages.size(), "texture"),
                      checked.plan->storages.size() == 1 ? "takes" : "share", checked.plan->bytesAllocated,
                      checked.plan->bytesDeclared));
  // A graph may be elsewhere than its shaders: no mistake, but then nobody has looked at them.
  for (const text::Diagnostic& each : checked.shaders.unread.items())
    if (code == 0) print(fmt::format("  not looked at: {}\n", text::printable(each.message)));
  return code;
}

// ---- told as data ----

Json refusedJson(const std::vector<graph::RefusedVariation>& refused) {
  Json all = Json::array();
  for (const graph::RefusedVariation& each : refused)
    all.push_back({{"with", each.variation.text()},
                   {"diagnostics", text::loadJson(text::diagnosticsJson(each.said, -1))}});
  return all;
}

Json documentOf(const CheckOptions& options, const Checked& checked) {
  Json out{{"graph", options.graph},
           {"errors", checked.diagnostics.errorCount()},
           {"diagnostics", text::loadJson(text::diagnosticsJson(checked.diagnostics, -1))}};
  if (checked.plan)
    out["plan"] = {{"passes", checked.plan->graph->passes.size()},
                   {"run", checked.plan->steps.size()},
                   {"textures", checked.plan->storages.size()},
                   {"bytes_declared", checked.plan->bytesDeclared},
                   {"bytes_allocated", checked.plan->bytesAllocated}};
  if (checked.stanza) out["stanza"] = checked.stanza->pass;
  for (const text::Diagnostic& each : checked.shaders.unread.items())
    out["not_looked_at"].push_back(each.message);
  if (options.shaders) out["shader_variants"] = checked.shaders.variants.size();
  if (!options.device.empty())
    for (const DeviceNeed& need : checked.shaders.needs.all())
      out["device"].push_back({{"what", need.what},
                               {"guaranteed", need.guaranteed},
                               {"needed", need.needed},
                               {"pass", need.pass}});
  if (checked.matrix && options.matrix)
    out["matrix"] = {{"passes", checked.matrix->passes},
                     {"pairs", checked.matrix->pairs},
                     {"values", checked.matrix->values},
                     {"needed", refusedJson(checked.matrix->needed)},
                     {"broken", refusedJson(checked.matrix->broken)},
                     {"lost", refusedJson(checked.matrix->lost)}};
  return out;
}

int tell(const CheckOptions& options, Checked& checked) {
  if (options.format == "text") return tellText(options, checked);
  if (options.format == "sarif")
    print(text::diagnosticsSarif(checked.diagnostics, kVersion) + "\n");
  else  // to be watched: a line for each time
    print(text::dumpJson(documentOf(options, checked), options.watch ? -1 : 2) + "\n");
  return codeOf(options, checked.diagnostics);
}

// Returns when some of the files changed and then nothing did for a moment: a save may be several writes.
std::vector<std::string> waitForChange(text::FileWatcher& watcher) {
  constexpr int kQuiet = 50;                          // milliseconds
  std::vector<std::string> changed = watcher.poll();  // what happened before the last watch(), too
  while (true) {
    pollfd waiting{watcher.descriptor(), POLLIN, 0};
    poll(&waiting, 1, changed.empty() ? -1 : kQuiet);
    const std::vector<std::string> more = watcher.poll();
    if (more.empty() && !changed.empty()) return changed;
    changed.insert(changed.end(), more.begin(), more.end());
  }
}

int runCheck(CheckOptions& options) {
  if (!options.device.empty() && options.format == "sarif") {
    printError("check: --device gives a table, which SARIF has no place for: use --format text or json\n");
    return 2;
  }
  text::FileWatcher watcher;
  if (options.watch) watcher.watch({options.graph});  // what it includes is known after the first check
  while (true) {
    Checked checked = checkOnce(options);
    if (options.watch) {
      watcher.watch({checked.shaders.files.begin(), checked.shaders.files.end()});
      checked.diagnostics.append(watcher.takeNotices());
    }
    const int code = tell(options, checked);
    if (!options.watch) return code;
    const bool text = options.format == "text";
    if (text) print(fmt::format("watching {}\n", text::counted(checked.shaders.files.size(), "file")));
    flushPrinted();
    const std::vector<std::string> changed = waitForChange(watcher);
    if (text) print(fmt::format("\nchanged: {}\n", text::printable(changed[0])));
  }
}

}  // namespace

text::Diagnostics checkGraph(const std::string& path) {
  CheckOptions options;
  options.graph = path;
  text::Diagnostics said = checkOnce(options).diagnostics;
  if (!said.contains(text::Code::noContext)) return said;
  options.shaders = false;
  return checkOnce(options).diagnostics;
}

void addCheck(CommandLine& line) {
  const auto [command, options] =
      line.add("check", "everything wrong with a graph or a shader; exit 1 when it cannot run", runCheck);
  options.addGraph(command)->description("graph file (JSON), or a shader (.glsl)");
  command.add_flag("!--no-shaders", options.shaders, "do not compile the shaders (needs no OpenGL)");
  addChoice(command, "--format", options.format, "text, json, or sarif for code hosts and editors",
            {"text", "json", "sarif"});
  command.add_flag("--matrix", options.matrix,
                   "also with each pass and pair disabled, and each value of a parameter");
  command.add_flag("--all", options.allVariants,
                   "compile every shader variant that a disable or a value reaches");
  command.add_flag("--strict", options.strict, "exit 1 after a warning, too");
  addChoice(command, "--device", options.device, "tell what the shaders need, beside what each device has",
            {"minimum"})
      ->excludes("--no-shaders");
  command.add_flag("--watch", options.watch, "check again after each change, until ended");
}

}  // namespace weft::app
