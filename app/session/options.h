// The command line as plain data. Parsing, help and the messages for wrong arguments are CLI11's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/graph/expand/expand.h"
#include "engine/graph/pick/pick.h"
#include "engine/imports/world.h"

namespace weft::app {

constexpr const char* kVersion = "0.1.0";

// A texture of the graph that is written to a file.
struct PickedOutput {
  graph::Pick pick;
  std::string file;  // or a pattern, as -o
};

// Of the commands that try variations of a graph: test, diff, bisect, ablate, fuzz, new.
struct TrialOptions {
  std::string folder;                                    // test: cases; new: where to write
  bool accept = false;                                   // test: write goldens
  std::vector<std::string> only;                         // test: names of cases
  std::string report;                                    // test: page of failures
  bool render = false;                                   // diff: compare the pictures, too
  std::vector<graph::Setting> otherSets;                 // bisect: of the second graph alone
  std::vector<std::string> otherDisables, otherPresets;  // bisect
  bool isOther = false;                                  // bisect: these are the options of the second graph
  std::uint32_t runs = 12;                               // fuzz: random orders
  std::optional<std::uint32_t> seed;                     // fuzz: this order alone; 0 is the declared one
  std::string order, share = "both", poison = "both";    // fuzz
  std::uint32_t repeats = 3;                             // ablate: frames of which the fastest counts
};

struct Options {
  std::string command;  // "render", "view", "check", "dot", "plan", "params", "presets", "bench", …
  std::string graph;    // path of the graph file
  std::string scene, environment;            // empty: the bundled spheres, no environment
  std::string camera, materials;             // empty: the scene's first camera, the materials it names
  std::string output;                        // -o; empty: of render, only `picked`
  std::vector<PickedOutput> picked{};        // render: -o NAME=FILE, --present
  std::vector<std::string> patterns;         // dump: of names of resources
  std::uint32_t width = 1280, height = 720;  // --size
  std::uint32_t firstFrame = 0, lastFrame = 0;
  double fps = 60;
  std::string mouse;         // --mouse, as it was written; empty: none
  imports::Pointer pointer;  // of every frame: what it says
  std::vector<std::string> disables;
  std::vector<std::string> presets;  // overlay files
  std::string presetFolder;          // looked in first for the names of presets; empty: none
  std::vector<graph::Setting> sets;
  std::string backend = "auto";
  std::string cacheFolder;  // program binaries; empty: the user's cache folder, "none": none
  bool stats = false, profile = false, quiet = false;
  bool shaders = true;              // check: compile every shader too
  bool matrix = false;              // check: try every variation
  bool allVariants = false;         // check: compile what the variations reach
  bool watch = false;               // check: again after every save
  std::string name;                 // explain: of a pass, a resource or a parameter
  std::string otherGraph;           // diff: the second graph
  std::string format = "text";      // check, diff, plan, params, presets: text, json or (check) sarif
  std::vector<std::string> files;   // format
  std::string foreignFile;          // import: of another program
  std::string folder;               // import: where the graph goes
  std::string newName;              // import: of the graph; empty: that of the file
  std::vector<std::string> images;  // import: NAME=FILE of pictures that the file reads
  bool overwrite = false;           // import: files that are there
  bool stdio = true;                // lsp: what editors ask for, and the only way there is
  bool checkOnly = false;           // format: say what differs, write nothing
  bool explain = false;             // plan: say why
  std::string frameGraph;           // bench --frame
  std::string editGraph;            // bench --edit
  std::uint32_t maxFrames = 0;      // view: stop after this many frames; 0: until closed
  std::string screenshot;           // view: written at the end
  bool waitForAssets = false;       // view: before the first frame; without a window always
  std::vector<std::string> panels;  // view: shown or hidden at the start
  bool ui = true;                   // view: panels over the picture
  bool vsync = true, idle = false;  // view
  double renderScale = 1,
         uiScale = 0;   // view: pixels of the scene per pixel of the window; 0: as the screen says
  bool events = false;  // view: says what happens, for scripts
  TrialOptions trial;
  std::string record;  // view: pattern of a recording from the first frame on; empty: none
};

// Empty, with `exitCode` set, when the program should end (help, a wrong argument); the text is printed by then.
std::optional<Options> parseOptions(int argc, char** argv, int& exitCode);

}  // namespace weft::app
