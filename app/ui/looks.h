// How each resource is shown, wherever its picture is: as a person chose it, at first over the range of what is there.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "engine/runtime/inspection/inspector.h"

namespace weft::app::ui {

struct Look {
  runtime::InspectView view;
  bool ranged = false;  // the range was fitted, or chosen
  bool moved = false;   // the zoom was chosen; else the whole is shown
  bool flip = false;    // the first row on top
};

class Looks {
 public:
  // `there`: the inspector has a copy of the resource, to which the range is fitted.
  Look& of(const graph::Plan& plan, std::uint32_t resource, const runtime::Inspector& inspector, bool there) {
    const auto [at, first] = looks_.try_emplace(plan.graph->resourceNames[resource]);
    Look& look = at->second;
    if (first) look.view = runtime::Inspector::viewOf(plan.graph->resources[resource]);
    if (!look.ranged && there) {
      const runtime::InspectView chosen = std::exchange(look.view, inspector.fittedView());
      look.view.colors = chosen.colors;
      look.view.channel = chosen.channel;
      look.ranged = true;
    }
    return look;
  }

  void choose(const std::string& resource, const Look& look) { looks_[resource] = look; }

 private:
  std::map<std::string, Look> looks_;  // by resource
};

}  // namespace weft::app::ui
