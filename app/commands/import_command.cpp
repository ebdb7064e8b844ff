// The command import: a pipeline of another program as a graph with its shaders.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/import/import.h"
#include "app/output/file_batch.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/assets/images/image.h"
#include "engine/base/chars.h"
#include "engine/base/files/file_access.h"
#include "engine/base/printable.h"
#include "engine/imports/image/image_sequence.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;
using base::Code;
using base::Diagnostics;

struct ImportOptions {
  std::string file;                 // of another program
  std::string folder;               // where the graph goes
  std::string name;                 // of the graph; empty: that of the file
  std::vector<std::string> images;  // NAME=FILE of pictures that the file reads
  bool overwrite = false;
};

void refuse(Diagnostics& diagnostics, const std::string& path, std::string message, std::string hint) {
  diagnostics
      .error(Code::outputNotWritten, {std::make_shared<const std::string>(path), 0, 0}, std::move(message))
      .hint = std::move(hint);
}

// `path` as seen from `folder`, neither of which need exist.
std::string seenFrom(const std::string& folder, const std::string& path) {
  std::error_code ec;
  const fs::path from = fs::weakly_canonical(folder, ec), to = fs::weakly_canonical(path, ec);
  const fs::path relative = to.lexically_relative(from);
  return relative.empty() ? to.generic_string() : relative.generic_string();
}

bool writeImage(const std::string& path, const convert::ConvertedImage& image, Diagnostics& diagnostics) {
  if (!image.bytes.empty())
    return assets::savePng8(path, image.width, image.height, 4, image.bytes, diagnostics);
  assets::ImageF floats{.width = image.width, .height = image.height, .channels = 4, .texels = image.floats};
  return assets::saveExr(path, floats, diagnostics);
}

// Checks that no existing file would be replaced without being asked for.
bool mayWrite(const ImportOptions& options, const convert::Converted& made, Diagnostics& diagnostics) {
  std::error_code ec;
  const auto look = [&](const std::string& path) {
    const fs::path whole = fs::path(options.folder) / path;
    if (!options.overwrite && fs::exists(whole, ec))
      refuse(diagnostics, whole.string(), "the file is there already",
             "choose another folder or --name, or replace it with --overwrite");
  };
  for (const convert::ConvertedText& text : made.texts) look(text.path);
  for (const convert::ConvertedImage& image : made.images) look(image.path);
  return !diagnostics.hasErrors();
}

// Writes all files, or none after an error.
bool writeAll(const ImportOptions& options, const convert::Converted& made, Diagnostics& diagnostics) {
  FileBatch batch;
  const auto pathOf = [&](const std::string& path) { return (fs::path(options.folder) / path).string(); };
  bool good = true;
  for (const convert::ConvertedText& text : made.texts)
    good = good && batch.writeText(pathOf(text.path), text.text, diagnostics);
  for (const convert::ConvertedImage& image : made.images)
    good =
        good && batch.write(
                    pathOf(image.path),
                    [&](const std::string& path, Diagnostics& said) { return writeImage(path, image, said); },
                    diagnostics);
  return good && batch.publish(diagnostics);
}

// Checks that the picture of `--image NAME=FILE`, or the first of a sequence of pictures, can be read.
void checkPicture(const std::string& option, const std::string& file, Diagnostics& diagnostics) {
  Diagnostics said;
  if (!base::mayRead(file)) return;
  if (const auto pattern = imports::sequencePatternOf(file)) {
    const std::vector<std::uint32_t> numbers = imports::numbersOf(*pattern, said);
    if (!numbers.empty()) assets::loadStored(pattern->nameOf(numbers.front()), said);
  } else {
    assets::loadStored(file, said);
  }
  for (base::Diagnostic each : said.items()) {
    each.place = base::placeOfOption("--image " + option);
    diagnostics.add(std::move(each));
  }
}

bool isName(const std::string& name) {
  return !name.empty() && name.size() <= 60 && base::isIdentStart(name[0]) &&
         std::ranges::all_of(name, base::isIdentChar);
}

// The .vs beside the file is part of what the command line names, unless it is a link to elsewhere or no file at all.
void chooseVertexFile(const std::string& file) {
  const std::string vertex = convert::vertexFileOf(file);
  std::error_code ec, ignored;
  if (fs::is_regular_file(vertex, ignored) &&
      fs::canonical(vertex, ec).parent_path() == fs::canonical(file, ignored).parent_path() && !ec)
    base::chooseFile(vertex);
}

int runImport(ImportOptions& options) {
  Diagnostics diagnostics;
  if (!options.name.empty() && !isName(options.name)) {
    auto& d = diagnostics.error(Code::notAName, base::placeOfOption("--name"),
                                fmt::format("\"{}\" cannot name a graph", options.name));
    d.expected = "at most 60 letters, digits and '_', not beginning with a digit";
    return report(diagnostics);
  }
  chooseVertexFile(options.file);
  convert::ConvertOptions wanted{.name = options.name};
  const std::string parent = fs::path(options.file).parent_path().string();
  wanted.sourceFolder = seenFrom(options.folder, parent.empty() ? "." : parent);
  for (const std::string& image : options.images) {
    const std::size_t at = image.find('=');
    const auto isSame = [&](const auto& other) { return other.first == image.substr(0, at); };
    if (std::ranges::any_of(wanted.images, isSame))
      diagnostics
          .error(Code::duplicateName, base::placeOfOption("--image " + image),
                 fmt::format("two pictures for '{}'", image.substr(0, at)))
          .hint = "name one";
    checkPicture(image, image.substr(at + 1), diagnostics);
    wanted.images.emplace_back(image.substr(0, at), seenFrom(options.folder, image.substr(at + 1)));
  }
  const auto made = convert::convertFile(options.file, wanted, diagnostics);
  if (made && mayWrite(options, *made, diagnostics) && writeAll(options, *made, diagnostics))
    print(base::printable((fs::path(options.folder) / made->graph).string()) + "\n");
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
