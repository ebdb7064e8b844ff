// The command import: a pipeline of another program as a graph with its shaders.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>

#include "app/commands/commands.h"
#include "app/output/standard_streams.h"
#include "app/session/session.h"
#include "engine/assets/images/image.h"
#include "engine/base/chars.h"
#include "engine/base/files/file.h"
#include "engine/base/files/file_access.h"
#include "engine/base/printable.h"
#include "engine/convert/convert.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;
using base::Code;
using base::Diagnostics;

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

// Nothing is written unless everything can be.
bool mayWrite(const Options& options, const convert::Converted& made, Diagnostics& diagnostics) {
  std::vector<std::string> paths;
  for (const convert::ConvertedText& text : made.texts) paths.push_back(text.path);
  for (const convert::ConvertedImage& image : made.images) paths.push_back(image.path);
  std::error_code ec;
  for (const std::string& path : paths) {
    const fs::path whole = fs::path(options.folder) / path;
    if (!options.overwrite && fs::exists(whole, ec))
      refuse(diagnostics, whole.string(), "the file is there already",
             "choose another folder or --name, or replace it with --overwrite");
  }
  if (diagnostics.hasErrors()) return false;
  for (const std::string& path : paths) {
    const fs::path folder = (fs::path(options.folder) / path).parent_path();
    fs::create_directories(folder, ec);
    if (ec || !fs::is_directory(folder)) {
      refuse(diagnostics, folder.string(), "the folder cannot be made", "name a folder that may be written");
      return false;
    }
  }
  return true;
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

}  // namespace

int runImport(const Options& options) {
  Diagnostics diagnostics;
  if (!options.newName.empty() && !isName(options.newName)) {
    auto& d =
        diagnostics.error(Code::notAName, {std::make_shared<const std::string>("command line: --name"), 0, 0},
                          fmt::format("\"{}\" cannot name a graph", options.newName));
    d.expected = "at most 60 letters, digits and '_', not beginning with a digit";
    return report(diagnostics);
  }
  chooseVertexFile(options.foreignFile);
  convert::ConvertOptions wanted{.name = options.newName};
  const std::string parent = fs::path(options.foreignFile).parent_path().string();
  wanted.sourceFolder = seenFrom(options.folder, parent.empty() ? "." : parent);
  for (const std::string& image : options.images) {
    const std::size_t at = image.find('=');
    wanted.images.emplace_back(image.substr(0, at), seenFrom(options.folder, image.substr(at + 1)));
  }
  const auto made = convert::convertFile(options.foreignFile, wanted, diagnostics);
  if (made && mayWrite(options, *made, diagnostics)) {
    const auto pathOf = [&](const std::string& path) { return (fs::path(options.folder) / path).string(); };
    bool good = true;
    for (const convert::ConvertedText& text : made->texts)
      good = good && base::writeFile(pathOf(text.path), text.text, diagnostics);
    for (const convert::ConvertedImage& image : made->images)
      good = good && writeImage(pathOf(image.path), image, diagnostics);
    if (good) print(base::printable(pathOf(made->graph)) + "\n");
  }
  return report(diagnostics);
}

}  // namespace weft::app
