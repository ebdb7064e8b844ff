// What every pass of a frame wrote, as a text file beside a golden picture; and the first pass at which two such records
// differ. What the same pass wrote is compared on one driver alone: another rounds differently.
#pragma once

#include "app/trials/shot.h"

namespace weft::app {

// One line per pass and resource: hash, pass, resource, with tabs between.
std::string toText(const PassRecords& records);
// Empty after an error (W001, or W003 with its line).
std::optional<PassRecords> readRecords(const std::string& path, text::Diagnostics& diagnostics);

struct Divergence {
  enum class Kind { differs, missing, added };
  Kind kind = Kind::differs;
  std::uint32_t frame = 0;
  std::string pass, resource;
  std::string text() const;  // "pass 'sky' writes another 'scene' in frame 0"
};

// The first pass at which the records differ; one that is culled only where nothing else differs.
std::optional<Divergence> findDivergence(const PassRecords& before, const PassRecords& after);

}  // namespace weft::app
