// An environment as the GPU takes it: equirectangular RGBA halves, and the way there from a file. What the
// loader thread runs, and anyone else may call. Errors and warnings are those of decodeEnvironment (image.h),
// with file and reason. Thread safe: no state is shared between calls.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"
#include "engine/assets/loading/load_observer.h"

namespace weft::assets {

// Never the same twice.
std::uint64_t newEnvironmentId();

// Row 0 is +Y; alpha is 1; every value is finite and not negative.
struct EnvironmentMap {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint16_t>
      texels{};  // width * height * 4 binary16; empty in what stands for a map that a GPU has
  std::uint64_t id = newEnvironmentId();  // of the picture: a copy, with or without texels, has the same
};

// Empty after errors, and without any when `observer` gave up.
std::optional<EnvironmentMap> loadEnvironmentMap(const std::string& path, text::Diagnostics& diagnostics,
                                                 const LoadObserver& observer = {});

// Whether a name is that of an environment, by its end: .hdr or .exr.
bool isEnvironmentName(const std::string& name);

// A picture that decodeEnvironment gives, 3 or 4 channels, rounded to halves (half.h).
EnvironmentMap toEnvironmentMap(const ImageF& image);

}  // namespace weft::assets
