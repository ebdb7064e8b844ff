// The shaders of plans, compiled and held against their passes, each variant once: for `weft check`. Opens a context when
// the first plan comes to be compiled. Does not: run a frame.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "app/session/device_session.h"
#include "app/session/options.h"
#include "engine/glsl/source.h"
#include "engine/graph/desc.h"
#include "engine/graph/plan.h"

namespace weft::app {

class ShaderCheck {
 public:
  explicit ShaderCheck(const Options& options) : options_(options) {}

  // All variants of the live passes. `with`: how the plan differs from the graph as it is, for messages; or "". Nothing
  // more is compiled once a context could not be opened, which is reported.
  void check(const graph::Plan& plan, const std::string& with, base::Diagnostics& diagnostics);
  // The same without a context, and so without compiling them.
  void checkDeclared(const graph::Plan& plan, const std::string& with, base::Diagnostics& diagnostics);
  // A graph that cannot be compiled has no variants; its shader files are read all the same, so that a misspelt
  // path or include is reported together with the graph's own mistakes. Needs no OpenGL.
  void checkFiles(const graph::GraphDesc& desc, base::Diagnostics& diagnostics);

  std::size_t variants() const { return known_.size(); }
  // What checkDeclared() did not look at: shaders that are missing, or an include of theirs.
  const base::Diagnostics& unread() const { return unread_; }
  // Every file that was read or looked for.
  std::vector<std::string> files() const;

 private:
  void checkFiles(const graph::GraphDesc& desc, glsl::SourceLoader& sources, base::Diagnostics& diagnostics);
  void tell(const base::Diagnostics& said, const std::string& with, base::Diagnostics& diagnostics);

  const Options options_;
  std::unique_ptr<DeviceSession> session_;
  bool failed_ = false;
  std::unique_ptr<glsl::SourceLoader> sources_;  // for checkDeclared()
  std::map<std::string, std::shared_ptr<const glsl::ShaderSource>> loaded_;
  std::set<std::string> known_;        // variants, by what they are made of
  std::set<std::string> read_, told_;  // files, messages
  base::Diagnostics unread_;
};

}  // namespace weft::app
