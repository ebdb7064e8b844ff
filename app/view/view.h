// The command `weft view`: a window that runs a graph and follows its files.
#pragma once

#include "app/session/command_line.h"

namespace weft::app {

struct ViewOptions : Options {
  std::uint32_t maxFrames = 0;      // stop after this many frames; 0: until closed
  std::vector<std::string> panels;  // shown or hidden at the start
  bool ui = true;                   // panels over the picture
  std::string screenshot;           // written at the end
  std::string record;               // pattern of a recording from the first frame on; empty: none
  bool waitForAssets = false;       // before the first frame
  bool events = false;              // says what happens, for scripts
  bool idle = false;
  double renderScale = 1;  // pixels of the scene per pixel of the window
  double uiScale = 0;      // 0: as the screen says
};

void addView(CommandLine& line);

}  // namespace weft::app
