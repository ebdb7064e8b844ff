// The import `cube_lut` on the GPU: a .cube table as a texture that composite/lut.glsl knows how to read, and
// the tables that were read, by path. Does not: keep textures (Imports does) or apply the table (the shader
// does).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "engine/assets/cube_lut.h"
#include "engine/gl/objects/objects.h"

namespace weft::runtime {

// Tables by path, parsed again only when the file's time or size is another.
class LutFiles {
 public:
  // Null after errors, W1 and W154 as assets::loadCubeLut; those of a file that is as it was are said again.
  std::shared_ptr<const assets::CubeLut> get(const std::string& path, base::Diagnostics& diagnostics);
  // The paths asked for since forgetTouched(), also of files that are not there.
  const std::set<std::string>& touched() const { return touched_; }
  void forgetTouched() { touched_.clear(); }

 private:
  struct Stamp {
    bool exists = false;
    std::filesystem::file_time_type time{};
    std::uintmax_t size = 0;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  struct Entry {
    Stamp stamp;
    std::shared_ptr<const assets::CubeLut> table;
    base::Diagnostics said;
  };
  std::map<std::string, Entry> entries_;
  std::set<std::string> touched_;
};

// The size of the texture: 3D, size^3, or for three curves rows of 1024 entries. Those have two slices,
// because a 3D texture of one would be taken for a 2D one; the second is as the first.
gl::Extent lutExtent(const assets::CubeLut& lut);

// RGBA16F, red along x. Alpha carries the domain. 3D: in the eight corners that every size has, the minimum
// of red, green and blue in texels (0,0,0), (0,1,0), (0,0,1), the maximum one step along x from each. 1D:
// minimum and maximum in the first six texels, then how often 1024 goes into the number of entries, then the
// rest.
std::optional<gl::Texture> makeLutTexture(const assets::CubeLut& lut, const std::string& label,
                                          base::Diagnostics& diagnostics);

}  // namespace weft::runtime
