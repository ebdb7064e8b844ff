#include "engine/assets/models/fbx/fbx.h"

#include <fmt/format.h>

#include "engine/text/apart.h"
#include "engine/text/files/file.h"

namespace weft::assets {

using text::Code;

std::optional<std::string> glbOfFbx(const std::string& bytes, ModelFiles& files) {
  if (!bytes.starts_with("Kaydara FBX Binary") && !files.isTextInLimit(bytes)) return {};
  const std::uint64_t seconds = text::raised(4 + (bytes.size() >> 20)),
                      memory = text::raised((640ull << 20) + 64 * std::uint64_t{bytes.size()});
  const auto goOn = [&](char) { return files.goOn(LoadStage::decoding, 0); };
  text::ApartEnd end = text::runApart({text::isThere(WEFT_FBX_BUILT) ? WEFT_FBX_BUILT : WEFT_FBX_INSTALLED,
                                       std::to_string(seconds), std::to_string(memory)},
                                      bytes, seconds, goOn);
  if (!goOn(0)) return {};
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
