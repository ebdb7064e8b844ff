// One HTML page with everything in it (app/report/page.html): of a frame, of test cases that failed, or of what each pass does.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/assets/images/image.h"
#include "engine/text/diagnostic.h"

namespace weft::app {

std::string encodeBase64(std::string_view bytes);
// The address of a picture that is in the page, without alpha, as a screen shows it; "" for no picture.
std::string pictureAddress(const assets::Image8& image);

// The page that draws `report`: {"command", "states", …} of a frame, {"cases"} or {"ablation"}; app/report/page.js says what is in
// them. Nothing after W150, when a file of the page is not there.
std::optional<std::string> pageOf(const nlohmann::ordered_json& report, std::string_view title,
                                  text::Diagnostics& diagnostics);

}  // namespace weft::app
