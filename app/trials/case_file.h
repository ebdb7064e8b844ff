// Cases of `weft test`: *.cases.json files (docs/testing_pictures.md). Reports everything wrong in one at once, with places.
#pragma once

#include <map>

#include "app/session/options.h"
#include "engine/text/diagnostic.h"

namespace weft::app {

// All of them must hold.
struct Tolerance {
  double flip = 0.002;     // mean FLIP error
  double flipPeak = 0.25;  // largest FLIP error
  double step = 255;       // largest difference of a channel, of 255
  double fraction = 1;     // share of the pixels that differ at all
};

struct TestCase {
  std::string name;
  std::string folder;  // of the case file, with a slash behind it, or ""
  text::Place place;
  Options options;    // graph, scene, settings, size; paths as seen from here
  bool plan = false;  // compares the plan as text, not pictures
  std::vector<std::uint32_t> frames = {0};
  Tolerance tolerance;
  std::string mask;                                  // a picture: what is black in it does not count
  std::map<std::string, text::Place> settingPlaces;  // by the option for it: "--set bloom=false"

  // Beside the case file.
  std::string goldenOf(std::uint32_t frame) const;
  std::string planGolden() const { return folder + name + ".txt"; }
  std::string recordFile() const { return folder + name + ".passes"; }
  // All that --accept writes.
  std::vector<std::string> acceptedFiles() const;
};

// The cases of the *.cases.json of a folder and those below it, by name; or of the one file that `path` is. `base` has what holds for all
// of them (backend, caches).
std::vector<TestCase> readCases(const std::string& path, const Options& base, text::Diagnostics& diagnostics);

// Diagnostics of a run of the case, with places in the case file where they are about its settings.
void appendWithPlaces(const TestCase& test, const text::Diagnostics& said, text::Diagnostics& diagnostics);

}  // namespace weft::app
