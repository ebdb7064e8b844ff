// Pictures into files: .png has 8 bits, .exr the values. The presented picture is looked at for values that are no colors (NaN,
// infinite): it is written all the same, and reported (W207). A texture with 8 bits cannot hold them.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "app/output/video.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"
#include "engine/runtime/inspection/inspector.h"
#include "engine/text/diagnostic.h"

namespace weft::app {

// Makes the folder of the file. False after W180, as all of these.
bool savePng(const std::string& path, const assets::Image8& image, text::Diagnostics& diagnostics);
// Saves a copy of the inspector's: a picture by the kind of the name, or as the next one of the video; a buffer as its bytes.
bool saveInspected(runtime::Inspector& inspector, const std::string& path, text::Diagnostics& diagnostics,
                   Video* video = nullptr);

class PictureWriter {
 public:
  struct Counts {
    std::uint64_t pictures = 0;  // written
    std::uint64_t broken = 0;    // looked at, with values that are no colors
    std::uint64_t pixels = 0;    // that have such values, of all
  };

  bool save(runtime::Renderer& renderer, const std::string& path, text::Diagnostics& diagnostics,
            Video* video = nullptr);
  // Notes what values in the presented picture are no colors. `file`: which is said to have them.
  void look(const assets::ImageF& picture, runtime::Renderer& renderer, const std::string& file);
  // One warning (W207) for all pictures, or none.
  void tell(text::Diagnostics& diagnostics) const;
  const Counts& counts() const { return counts_; }

 private:
  struct Found {
    std::string file, resource;
    std::uint64_t nan = 0, infinite = 0, pixels = 0;  // a pixel with both counts as NaN
    int x = 0, y = 0;                                 // the first, from the upper left
  };
  Counts counts_;
  Found first_;  // picture with such pixels
};

// ---- pages: One HTML page with everything in it (app/report/page.html): of a frame, of test cases that failed, or of what each pass does. ----

std::string encodeBase64(std::string_view bytes);
// The address of a picture that is in the page, without alpha, as a screen shows it; "" for no picture.
std::string pictureAddress(const assets::Image8& image);

// The page that draws `report`: {"command", "states", …} of a frame, or {"cases"}; app/report/page.js says what is in
// them. Nothing after W150, when a file of the page is not there.
std::optional<std::string> pageOf(const nlohmann::ordered_json& report, std::string_view title,
                                  text::Diagnostics& diagnostics);

}  // namespace weft::app
