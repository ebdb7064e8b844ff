// The command import: a pipeline of another program as a graph with its shaders.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "app/commands/commands.h"
#include "app/import/import.h"
#include "app/output/output_files.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/assets/images/image.h"
#include "engine/graph/language/names.h"
#include "engine/text/files/file.h"
#include "engine/text/files/file_access.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;
using text::Code;
using text::Diagnostics;

struct ImportOptions {
  std::string file;                 // of another program
  std::string folder;               // where the graph goes
  std::string name;                 // of the graph; empty: that of the file
  std::vector<std::string> images;  // NAME=FILE of pictures that the file reads
  bool overwrite = false;
};

// `path` as seen from `folder`, neither of which need exist.
std::string seenFrom(const std::string& folder, const std::string& path) {
  std::error_code ec;
  const fs::path from = fs::weakly_canonical(folder, ec), to = fs::weakly_canonical(path, ec);
  const fs::path relative = to.lexically_relative(from);
  return relative.empty() ? to.generic_string() : relative.generic_string();
}

// Writes all files, up to the first that cannot be written.
bool writeAll(const ImportOptions& options, const importing::Converted& made, Diagnostics& diagnostics) {
  const auto pathOf = [&](const auto& file) { return (fs::path(options.folder) / file.path).string(); };
  std::vector<std::string> paths;
  for (const auto& text : made.texts) paths.push_back(pathOf(text));
  for (const auto& image : made.images) paths.push_back(pathOf(image));
  const auto writeImage = [&](const importing::ConvertedImage& image) {
    return image.bytes.empty()
               ? assets::saveExr(pathOf(image), {image.width, image.height, 4, image.floats}, diagnostics)
               : assets::savePng8(pathOf(image), image.width, image.height, 4, image.bytes, diagnostics);
  };
  return (options.overwrite || checkFree(paths, diagnostics)) && checkMadeFiles(paths, diagnostics) &&
         std::ranges::all_of(paths,
                             [&](const std::string& path) { return makeFolderOf(path, diagnostics); }) &&
         std::ranges::all_of(
             made.texts,
             [&](const auto& text) { return text::writeFile(pathOf(text), text.text, diagnostics); }) &&
         std::ranges::all_of(made.images, writeImage);
}

int runImport(ImportOptions& options) {
  Diagnostics diagnostics;
  if (!options.name.empty() && (!graph::isIdent(options.name) || options.name.size() > 60)) {
    auto& d = diagnostics.error(Code::notAName, text::placeOfOption("--name"),
                                fmt::format("\"{}\" cannot name a graph", options.name));
    d.expected = "at most 60 letters, digits and '_', not beginning with a digit";
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
  if (made && writeAll(options, *made, diagnostics))
    print(text::printable((fs::path(options.folder) / made->graph).string()) + "\n");
  return report(diagnostics);
}

}  // namespace

void addImport(CommandLine& line) {
  const auto [command, options] = line.add(
      "import", "make a graph and its shaders of an ISF file (.fs) or a user shader of mpv (.glsl, .hook)",
      runImport);
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
