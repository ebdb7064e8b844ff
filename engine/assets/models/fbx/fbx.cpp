#include "engine/assets/models/fbx/fbx.h"

#include <fmt/format.h>

#include <filesystem>

#include "assets_sentences.h"
#include "engine/text/apart.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Code;

namespace {

// Of this build, or installed: beside the program that runs, or where it was to be when it was built. "" when it is not there.
std::string readerProgram() {
  std::error_code ec;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", ec);
  for (const std::string& path : {(own.parent_path().parent_path() / WEFT_FBX_BESIDE).string(),
                                  std::string(WEFT_FBX_BUILT), std::string(WEFT_FBX_INSTALLED)})
    if (text::isThere(path)) return path;
  return {};
}

}  // namespace

std::optional<std::string> glbOfFbx(const std::string& bytes, ModelFiles& files) {
  if (!bytes.starts_with("Kaydara FBX Binary") && !files.isTextInLimit(bytes)) return {};
  const std::uint64_t seconds = text::raised(4 + (bytes.size() >> 20)),
                      memory = text::raised((640ull << 20) + 64 * std::uint64_t{bytes.size()});
  const std::string program = readerProgram();
  if (program.empty()) {
    files.diagnostics().error(say::fbxReaderNotThere, files.place(), WEFT_FBX_INSTALLED);
    return {};
  }
  text::ApartEnd end = text::runApart({program, std::to_string(seconds), std::to_string(memory)}, bytes,
                                      seconds, files.stop());
  const char what = end.said.empty() ? '\0' : end.said.back();
  if (what == kMade) return std::move(end.made);
  if (what == kUnreadable)
    files.diagnostics().error(say::fbxNotRead, files.place(), files.path(), end.made);
  else
    files.diagnostics().error(say::fbxReaderDied, files.place(), files.path(), seconds, memory >> 20,
                              what == kTooLarge ? "no memory left" : end.how, end.seconds, end.mebibytes);
  return {};
}

}  // namespace weft::assets
