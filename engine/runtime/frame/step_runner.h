// Runs one step of a plan: clears, the barrier after them, program, bindings, framebuffer, fixed-function state, and the
// pass type's execute(). Owns framebuffers. Allocates only when a framebuffer is used for the first time.
#pragma once

#include <vector>

#include "engine/graph/plan.h"
#include "engine/runtime/frame/device.h"
#include "engine/runtime/prepare/prepared_pass.h"
#include "engine/runtime/storage/caches.h"
#include "engine/runtime/storage/resource_pool.h"
#include "engine/runtime/uniforms/frame_uniforms.h"
#include "engine/text/diagnostic.h"

namespace weft::runtime {

class StepRunner {
 public:
  // All must outlive this.
  StepRunner(const graph::Plan& plan, Device& device, ResourcePool& pool, const FrameUniforms& uniforms)
      : plan_(plan), device_(device), pool_(pool), uniforms_(uniforms) {}

  // `clears`: whether the clears of the step run too; of a pass in slices they run with the first slice.
  void run(std::size_t step, PreparedPass& pass, bool clears, text::Diagnostics& diagnostics);
  FramebufferCache& framebuffers() { return framebuffers_; }

 private:
  void clear(const PreparedPass& pass, GLuint framebuffer, text::Diagnostics& diagnostics);
  void clearAttachment(GLuint framebuffer, GLenum point, const ClearCommand& clear);
  // False: a pass type without a shader lacks the texture of an import, which was reported.
  bool bind(PreparedPass& pass, text::Diagnostics& diagnostics);
  void gatherMeshes(PreparedPass& pass, text::Diagnostics& diagnostics);
  void bindBuffer(const BufferBinding& binding, PreparedPass& pass, text::Diagnostics& diagnostics);
  bool bindFixed(const FixedBinding& binding, PreparedPass& pass, text::Diagnostics& diagnostics);
  // The GL name of the texture that a binding of `pass` means now; of an import, of the part that the binding has.
  template <class Binding>
  GLuint textureOf(const Binding& binding, const PreparedPass& pass, text::Diagnostics& diagnostics);
  GLuint framebufferOf(const PreparedPass& pass, text::Diagnostics& diagnostics);

  const graph::Plan& plan_;
  Device& device_;
  std::set<GLuint> cleared_;  // framebuffers whose depth was cleared
  ResourcePool& pool_;
  const FrameUniforms& uniforms_;
  FramebufferCache framebuffers_;
  std::vector<gl::Attachment> scratch_;
};

}  // namespace weft::runtime
