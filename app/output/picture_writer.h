// The presented texture as it is into picture files: .png has 8 bits of it, .exr its values. Each picture is
// looked at for values that are no colours (NaN, infinite): it is written all the same, and reported (W207). Does
// not: name files, or see what a pass upstream made of NaN before the presented texture took it; one with 8
// bits cannot hold it.
#pragma once

#include <cstdint>
#include <string>

#include "engine/base/diagnostic.h"
#include "engine/runtime/frame/execution.h"
#include "engine/runtime/frame/renderer.h"

namespace weft::app {

class PictureWriter {
 public:
  struct Counts {
    std::uint64_t pictures = 0;  // written
    std::uint64_t broken = 0;    // of them, with values that are no colours
    std::uint64_t pixels = 0;    // that have such values, of all
  };

  // False after errors.
  bool save(runtime::Renderer& renderer, const std::string& path, base::Diagnostics& diagnostics);
  // One warning (W207) for all pictures since the last call, or none.
  void tell(base::Diagnostics& diagnostics);
  const Counts& counts() const { return counts_; }

 private:
  void look(const assets::ImageF& picture, runtime::Renderer& renderer, const std::string& path);

  struct Found {
    std::string path, resource;
    std::uint64_t nan = 0, infinite = 0, pixels = 0;  // a pixel with both counts as NaN
    int x = 0, y = 0;                                 // the first, from the upper left
  };
  Counts counts_;
  Found first_;  // picture with such pixels since the last tell()
  std::uint64_t brokenBefore_ = 0;
};

}  // namespace weft::app
