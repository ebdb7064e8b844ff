// A user shader of mpv (//!HOOK …) as a graph: its passes run on a picture instead of a video (docs/importing.md). The
// stages RGB, NATIVE, MAINPRESUB, MAIN, SCALED, PREOUTPUT and OUTPUT are that picture, one after the other; stages of
// planes and of light that mpv's scaler makes are W226. mpv counts rows from the top: the graph turns the picture
// over at the start and back at the end. Does not: read or write files.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/base/diagnostic.h"
#include "engine/convert/text/converted.h"

namespace weft::convert {

// Whether a line begins with a header of mpv.
bool looksLikeMpv(std::string_view text);

std::optional<Converted> convertMpv(std::string_view text, const std::string& file,
                                    const ConvertOptions& options, base::Diagnostics& diagnostics);

}  // namespace weft::convert
