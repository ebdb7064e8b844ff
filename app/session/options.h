// What several commands have in common on their command lines; the options of one are declared beside its code.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "engine/graph/expand/expand.h"
#include "engine/graph/pick/pick.h"
#include "engine/imports/world.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace weft::app {

constexpr const char* kVersion = "0.1.0";

struct Options {
  std::string typed;               // the command line, as a shell takes it
  std::string graph;               // path of the graph file
  std::string scene, environment;  // empty: the bundled spheres, no environment
  std::string camera, materials;   // empty: the scene's first camera, the materials it names
  std::uint32_t width = 1280, height = 720;
  std::uint32_t lastFrame = 0;  // to look at
  double fps = 60;
  imports::Pointer pointer;  // of every frame: what it says
  std::vector<graph::Disable> disables;
  std::vector<graph::Setting> sets;
  std::vector<std::string> presets;  // overlay files
  std::string presetFolder;          // looked in first for the names of presets; empty: none
  std::vector<graph::Pick> kept;     // textures that the graph is to keep for a look
  std::string backend = "auto";
  std::string cacheFolder;            // program binaries; empty: the user's cache folder, "none": none
  bool window = false, vsync = true;  // of the context
  bool stats = false, profile = false;
  bool quiet = false;  // no progress, no notes, no list of files

  // The graph, its settings and its surroundings. Returns the option of the graph's file.
  CLI::Option* addGraph(CLI::App& command);
  void addWorld(CLI::App& command);  // scene, camera, materials, environment, size
  void addSize(CLI::App& command);
  void addPresetFolder(CLI::App& command);
  CLI::Option* addFrame(CLI::App& command, const char* name = "--frame");  // one frame to look at
  void addFps(CLI::App& command, const char* doc = "frames per second of the clock");
  void addDrawing(CLI::App& command);  // the clock, the mouse, and the backend
  void addBackend(CLI::App& command);
  void addMeasurements(CLI::App& command);  // --stats and --profile

  // Once all is read: names of presets become files.
  void finish();
};

// Of a graph and of another, which may be the same file under other settings.
struct OtherOptions : Options {
  std::string other;  // a path; empty: the same graph
  std::vector<graph::Setting> otherSets;
  std::vector<graph::Disable> otherDisables;
  std::vector<std::string> otherPresets;

  void addOther(CLI::App& command);
  bool hasOther() const {
    return !other.empty() || !otherSets.empty() || !otherDisables.empty() || !otherPresets.empty();
  }
  Options otherSide() const;
};

// As a shell takes a word.
std::string quoted(const std::string& word);

// A file or a folder on the command line; `type` is FILE or FOLDER.
CLI::Option* addPath(CLI::App& command, const std::string& name, std::string& path, const std::string& doc,
                     const char* type = "FILE");
CLI::Option* addPath(CLI::App& command, const std::string& name, std::vector<std::string>& paths,
                     const std::string& doc);  // repeatable
// One of some words.
CLI::Option* addChoice(CLI::App& command, const std::string& name, std::string& word, const std::string& doc,
                       const std::vector<std::string>& words);
// NAME=VALUE, repeatable; `name` is what messages call the option.
CLI::Option* addSets(CLI::App& command, const char* name, std::vector<graph::Setting>& sets,
                     const std::string& doc);
CLI::Option* addDisables(CLI::App& command, const char* name, std::vector<graph::Disable>& disables,
                         const std::string& doc);
// A number within `low` and `high`; what is no number (nan), has no end (inf) or is no double (1e999) is neither.
CLI::Validator numberFrom(double low, double high);
// An option that `take` reads.
CLI::Option* addTaken(CLI::App& command, const char* name,
                      const std::function<std::string(const std::string&)>& take, const char* type,
                      const std::string& doc);

// These read a text. They return "", or what is wrong with it.
std::string takeSize(const std::string& text, std::uint32_t& width, std::uint32_t& height);  // "640x360"
std::string takeCount(const std::string& text, std::uint32_t& count);                        // "7"
// "80,45" or "80,45,down": pixels of the picture from its lower left corner, and that the button is held there.
std::string takePointer(const std::string& text, imports::Pointer& pointer);
std::string checkSet(const std::string& text);  // "NAME=VALUE"

}  // namespace weft::app
