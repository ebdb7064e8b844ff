#include "engine/convert/isf/names.h"

#include <algorithm>
#include <array>

#include "engine/base/words/glsl_words.h"
#include "engine/convert/text/glsl_text.h"

namespace weft::convert {

namespace {

// Words of graph files, and what the translated shader declares by itself.
constexpr std::array<std::string_view, 25> kKept{
    "mip",       "layer",  "face",       "stencil",          "x",     "y",        "z",
    "w",         "View",   "time",       "delta_time",       "frame", "uv",       "TIME",
    "TIMEDELTA", "DATE",   "FRAMEINDEX", "RENDERSIZE",       "date",  "viewport", "PASSINDEX",
    "main",      "screen", "Parameters", "isf_FragNormCoord"};

}  // namespace

IsfNames::IsfNames(const IsfHeader& header) {
  const auto add = [&](const std::string& name) {
    if (names_.contains(name)) return;
    const bool kept =
        std::ranges::find(kKept, std::string_view(name)) != kKept.end() || base::isGlslWord(name);
    names_[name] = fresh(kept ? name + "_" : name);
  };
  for (const IsfInput& input : header.inputs) add(input.name);
  for (const IsfImported& imported : header.imported) add(imported.name);
  for (const IsfPass& pass : header.passes)
    if (!pass.target.empty()) add(pass.target);
}

std::string IsfNames::fresh(std::string_view wanted) {
  std::string one;  // GLSL keeps names with two underscores in a row
  for (const char c : wanted)
    if (c != '_' || !one.ends_with('_')) one += c;
  std::string name = one;
  for (int i = 2; !used_.insert(name).second; ++i)
    name = one + (one.ends_with('_') ? "" : "_") + (i == 2 && !one.ends_with('_') ? "" : std::to_string(i));
  return name;
}

}  // namespace weft::convert
