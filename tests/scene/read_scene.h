// A scene file that is a text: what an editor has open under the name.
#pragma once

#include "engine/scene/files/scene_file.h"
#include "engine/text/files/file.h"

namespace weft::test {

inline std::optional<scene::Scene> readScene(std::string_view text, const std::string& name,
                                             text::Diagnostics& diagnostics) {
  text::overlayFile(name, std::string(text));
  auto made = scene::loadScene(name, diagnostics);
  text::dropOverlay(name);
  return made;
}

}  // namespace weft::test
