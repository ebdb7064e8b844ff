#include "engine/assets/models/fbx/fbx.h"

#include <fmt/format.h>

#include <filesystem>

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
  const auto goOn = [&] { return files.goOn(LoadStage::decoding, 0); };
  const std::string program = readerProgram();
  if (program.empty()) {
    files.diagnostics().error(Code::unreadableModel, files.place(), "weft-fbx is not there",
                              {.expected = WEFT_FBX_INSTALLED});
    return {};
  }
  text::ApartEnd end =
      text::runApart({program, std::to_string(seconds), std::to_string(memory)}, bytes, seconds, goOn);
  if (!goOn()) return {};
  const char what = end.said.empty() ? '\0' : end.said.back();
  if (what == kMadeWithoutLights)
    files.diagnostics().warning(
        Code::modelPartLeftOut, files.place(),
        "the lights of the model were left out: the format says no unit of their brightness",
        {.hint = "give the scene file a 'sun' and 'lamps'"});
  if (what == kMade || what == kMadeWithoutLights) return std::move(end.made);
  text::Diagnostic& d = files.diagnostics().error(
      Code::unreadableModel, files.place(),
      fmt::format("cannot read model '{}': {}", files.path(),
                  what == kUnreadable ? end.made : "its reader did not survive it"));
  d.expected = "a sound FBX file of version 7.1 or later";
  d.hint = "export it again, as .glb if you can";
  if (what == kUnreadable) return {};
  d.expected += fmt::format(", read in {} s of processor time and {} MiB", seconds, memory >> 20);
  d.found = fmt::format("{}, after {:.1f} s of processor time and with {} MiB",
                        what == kTooLarge ? "no memory left" : end.how, end.seconds, end.mebibytes);
  d.hint += ", or raise the limits with --limit 2";
  return {};
}

}  // namespace weft::assets
