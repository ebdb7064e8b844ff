// The commands that write files of text: format, new, and import of another program's pipeline.
#include <fmt/ranges.h>

#include "app/commands/commands.h"
#include "app_sentences.h"
#include "engine/assets/images/image.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/read.h"
#include "engine/text/json/dom.h"
#include "engine/text/json/edit.h"
#include "importers/import.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;

// `path` as a file in `folder` names it. Neither need exist.
std::string seenFrom(const std::string& folder, const std::string& path) {
  std::error_code failed;
  const fs::path beside = fs::relative(path, folder, failed);
  return (failed || beside.empty() ? fs::absolute(path) : beside).generic_string();
}

// ---- format ----

void formatFile(const std::string& path, bool checkOnly, text::Diagnostics& diagnostics) {
  const auto text = text::readTextFile(path, diagnostics);
  const text::FileName file = path;
  const std::size_t before = diagnostics.errorCount();
  if (text) text::parseJson(*text, file, diagnostics);
  if (!text || diagnostics.errorCount() > before) return;
  const std::string laid = importing::layoutGraph(*text);
  if (laid == *text) return;
  if (checkOnly) {
    const auto same = std::ranges::mismatch(*text, laid).in1;
    const auto line = static_cast<std::uint32_t>(1 + std::count(text->begin(), same, '\n'));
    diagnostics.error(say::laidOutDifferently, {file, line, 1}, path);
  } else if (text::writeFile(path, laid, diagnostics)) {
    print(text::printable(path) + "\n");
  }
}

struct FormatOptions {
  std::vector<std::string> files;
  bool checkOnly = false;
};

int runFormat(FormatOptions& options) {
  text::Diagnostics diagnostics;
  for (const std::string& file : options.files) formatFile(file, options.checkOnly, diagnostics);
  return report(diagnostics);
}

// ---- new ----

// Where the new pass goes: behind the last stanza, and the texture that is shown.
using Anchor = std::pair<std::string, std::string>;
std::optional<Anchor> findAnchor(const std::string& graphFile, const std::string& name,
                                 text::Diagnostics& diagnostics) {
  const auto desc = graph::readGraph(graphFile, diagnostics);
  if (!desc || diagnostics.hasErrors()) return std::nullopt;
  const text::Place place = {graphFile, 1, 1};
  for (const graph::PassDesc& pass : desc->passes)
    if (pass.name == name) {
      diagnostics.error(say::passThereAlready, pass.namePlace, name);
      return std::nullopt;
    }
  const auto& present = desc->present;
  const bool whole =
      present && !present->mip && !present->layer && !present->face && !present->element && !present->import;
  if (whole && !desc->passes.empty()) return Anchor{desc->passes.back().name, present->name};
  diagnostics.error(say::presentsNoWholeTexture, present ? present->place : place,
                    present ? present->text : "");
  return std::nullopt;
}

struct NewOptions {
  std::string what, name, graph, folder;
};

int runNew(NewOptions& options) {
  text::Diagnostics diagnostics;
  const std::string& name = options.name;
  const bool pass = options.what == "pass";
  if (options.graph.empty()) options.graph = dataFolder() + "/graphs/glow.json";
  if (!graph::isIdent(name) || name[0] == '_' || name.size() > 64 || graph::isReservedWord(name)) {
    diagnostics.error(say::cannotName, text::placeOfOption(fmt::format("new {} {}", options.what, name)),
                      name, options.what, fmt::join(graph::kReservedWords, ", "));
    return report(diagnostics);
  }
  const auto anchor = pass ? findAnchor(options.graph, name, diagnostics) : Anchor{};
  if (!anchor) return report(diagnostics);
  const fs::path folder = options.folder.empty() ? "." : options.folder;
  const std::string graphFile = (folder / (name + ".json")).lexically_normal().string();
  const std::string shaderFile =
      (folder / "shaders" / name / (name + ".frag.glsl")).lexically_normal().string();
  const OutputFile outputs[] = {{"-o", graphFile, OutputFile::Over::nothing},
                                {"-o", shaderFile, OutputFile::Over::nothing}};
  if (!checkDistinct(outputs, diagnostics)) return report(diagnostics);
  const auto write = [&](const std::string& path, const std::optional<std::string>& text) {
    return text && makeFolderOf(path, diagnostics) && text::writeFile(path, *text, diagnostics);
  };
  if (write(graphFile, filledIn(pass ? "commands/new_pass.json" : "commands/new_graph.json",
                                {{"%NAME%", name},
                                 {"%AFTER%", anchor->first},
                                 {"%TEXTURE%", anchor->second},
                                 {"\"%BASE%\"", text::quoteJson(seenFrom(folder.string(), options.graph))}},
                                diagnostics)) &&
      write(shaderFile, filledIn("commands/new_pass.frag.glsl", {{"%NAME%", name}}, diagnostics))) {
    const std::string graph = text::printable(graphFile);
    print(fmt::format("{}\n{}\nweft render {} -o {}.png\n", graph, text::printable(shaderFile), graph, name));
  } else {
    std::error_code ignored;
    for (const OutputFile& output : outputs) fs::remove(output.pattern, ignored);
  }
  return report(diagnostics);
}

// ---- import ----

struct ImportOptions {
  std::string file;                 // of another program
  std::string folder;               // where the graph goes
  std::string name;                 // of the graph; empty: that of the file
  std::vector<std::string> images;  // NAME=FILE of pictures that the file reads
  bool overwrite = false;
};

// Writes all files, or none; files that were there before are replaced one by one.
bool writeAll(const ImportOptions& options, const importing::Converted& made,
              text::Diagnostics& diagnostics) {
  const auto pathOf = [&](const auto& file) { return (fs::path(options.folder) / file.path).string(); };
  const auto over = options.overwrite ? OutputFile::Over::file : OutputFile::Over::nothing;
  std::vector<OutputFile> outputs;
  for (const auto& text : made.texts) outputs.push_back({"-o", pathOf(text), over, options.folder});
  for (const auto& image : made.images) outputs.push_back({"-o", pathOf(image), over, options.folder});
  const auto writeText = [&](const auto& text) {
    return makeFolderOf(pathOf(text), diagnostics) && text::writeFile(pathOf(text), text.text, diagnostics);
  };
  const auto writeImage = [&](const auto& image) {
    return makeFolderOf(pathOf(image), diagnostics) &&
           (image.bytes.empty()
                ? assets::saveExr(pathOf(image), {image.width, image.height, 4, image.floats}, diagnostics)
                : assets::savePng8(pathOf(image), image.width, image.height, 4, image.bytes, diagnostics));
  };
  if (!checkDistinct(outputs, diagnostics)) return false;
  const bool good =
      std::ranges::all_of(made.texts, writeText) && std::ranges::all_of(made.images, writeImage);
  std::error_code ignored;
  for (const OutputFile& output : outputs)
    if (!good && !options.overwrite) fs::remove(output.pattern, ignored);
  return good;
}

int runImport(ImportOptions& options) {
  text::Diagnostics diagnostics;
  if (!options.name.empty() && (!graph::isIdent(options.name) || options.name.size() > 60)) {
    diagnostics.error(say::cannotNameGraph, text::placeOfOption("--name"), options.name);
    return report(diagnostics);
  }
  // The .vs beside the file is part of what the command line names, unless it is a link to elsewhere or no file at all.
  const std::string vertex = importing::vertexFileOf(options.file);
  std::error_code ignored;
  if (fs::is_regular_file(fs::symlink_status(vertex, ignored))) text::chooseFile(vertex);
  importing::ConvertOptions wanted{.name = options.name};
  const std::string parent = fs::path(options.file).parent_path().string();
  wanted.sourceFolder = seenFrom(options.folder, parent.empty() ? "." : parent);
  for (const std::string& image : options.images) {
    const std::size_t at = image.find('=');
    wanted.images.emplace_back(image.substr(0, at), seenFrom(options.folder, image.substr(at + 1)));
  }
  const auto made = importing::convertFile(options.file, wanted, diagnostics);
  if (made && writeAll(options, *made, diagnostics)) {
    const std::string graph = (fs::path(options.folder) / made->graph).string();
    print(text::printable(graph) + "\n");
    diagnostics.append(checkGraph(graph));
  }
  return report(diagnostics);
}

}  // namespace

void addFormat(CommandLine& line) {
  const auto [command, options] =
      line.add("format", "format graph files, overlays and presets in place; comments are kept", runFormat);
  addPath(command, "file", options.files, "JSON files")->required();
  command.add_flag("--check", options.checkOnly, "write nothing; exit 1 where lines differ");
}

void addNew(CommandLine& line) {
  const auto [command, options] =
      line.add("new", "write a graph or a pass, and its shader, commented", runNew);
  addChoice(command, "what", options.what, "what to write: graph or pass", {"graph", "pass"})->required();
  command.add_option("name", options.name, "its name: letters, digits and _")->required();
  addPath(command, "--graph", options.graph, "graph that a pass extends (default: graphs/glow.json)");
  command.parse_complete_callback([&options = options] {
    if (options.what == "graph" && !options.graph.empty())
      throw CLI::ValidationError("--graph", "is for 'new pass': a new graph extends no other");
  });
  addPath(command, "-o,--output", options.folder, "folder to write into (default: here)", "FOLDER");
  command.footer("Example: weft new graph tint -o out/tint");
}

void addImport(CommandLine& line) {
  const auto [command, options] =
      line.add("import", "make a graph of an ISF file (.fs) or a shader of mpv (.glsl, .hook)", runImport);
  addPath(command, "file", options.file, "the file; a .vs beside a .fs is read, too")->required();
  addPath(command, "-o,--output", options.folder, "folder to write into; made where it is missing", "FOLDER")
      ->required();
  command.add_option("--image", options.images, "a picture for an input of the file; repeatable")
      ->check(CLI::Validator(checkSet, "NAME=FILE"));
  command.add_option("--name", options.name, "name of the graph (default: that of the file)");
  command.add_flag("--overwrite", options.overwrite, "replace files that are there");
  command.footer("Example: weft import glow.fs -o glow --image inputImage=photo.png");
}

}  // namespace weft::app
