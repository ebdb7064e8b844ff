// One texture or buffer of a running graph, at one place in the frame: copied there by a watch (StepWatch) into storage of
// the inspector's own, then shown and read at leisure. Sees what a pass wrote although its storage is used again later.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/assets/images/image.h"
#include "engine/gl/objects/objects.h"
#include "engine/graph/pick/pick.h"
#include "engine/runtime/frame/execution.h"

namespace weft::runtime {

// What to look at, by name, so that it outlives a change of the graph.
struct InspectTarget {
  std::string resource;     // FlatGraph::resourceNames: "hdr", "hdr#2"
  std::string pass;         // full instance name of the pass after which to look; "": the last that writes it
  std::uint32_t mip = 0;    // clamped to what there is, as layer and history are
  std::uint32_t layer = 0;  // array layer, cube * 6 + face, or slice of a 3D texture
  std::uint32_t history = 0;  // n of @-n
  bool stencil = false;       // of a depth-stencil texture, instead of its depth
  friend bool operator==(const InspectTarget&, const InspectTarget&) = default;
};

enum class InspectChannel : std::uint8_t { rgb, red, green, blue, alpha };
// scale: one channel (rgb: its luminance) as a color scale; direction: a vector, or two channels from 0 to 1 as octahedral, as red, green
// and blue; motion: two channels as hue and brightness.
enum class InspectColors : std::uint8_t { values, scale, direction, motion };

// How texels become pixels (shaders/inspect/inspect.frag.glsl).
struct InspectView {
  InspectChannel channel = InspectChannel::rgb;
  float low = 0, high = 1;  // values shown black and white
  float ev = 0;             // stops, before the range
  InspectColors colors = InspectColors::values;
  bool encode = true;     // sRGB curve, for linear light
  bool highlight = true;  // NaN magenta, infinities and what is outside the range marked
  bool depth = false;     // reversed depth d as near / d: distance in units of `near`
  float nearPlane = 0.1f;
  double x = 0, y = 0;  // texel at the canvas's lower left corner, from the texture's lower left
  double texelsPerPixel = 1;
};

// A texel's value as it is stored.
struct InspectTexel {
  std::uint32_t channels = 4;
  std::array<double, 4> value{};  // integers and floats exactly; missing channels 0
  std::string text() const;       // "0.5, 1, nan, 2"
};

struct InspectStatistics {
  std::array<double, 4> low{}, high{}, mean{};  // per channel, of what is finite
  std::uint64_t nan = 0, infinite = 0, texels = 0;
};

// Of one texel of a level and a layer of a texture without samples, which has so many channels; depth of one with stencil. What
// shaders stored before is seen. Waits for the GPU.
InspectTexel readTexel(const gl::TextureRef& texture, std::uint32_t mip, std::uint32_t layer, std::uint32_t x,
                       std::uint32_t y, std::uint32_t channels);

class Inspector {
 public:
  explicit Inspector(Device& device) : device_(device) {}

  // Before each frame of `execution`: watches it for `target`. False when the target is not there; nothing is watched then. `also` is
  // called after each step, as there is one watch at a time.
  bool watch(Execution& execution, const InspectTarget& target, StepWatch::Look also = {});
  // Within another watch of `execution`: copies `target`, as it is now, at once. False when it is not there.
  bool look(Execution& execution, const InspectTarget& target);
  void release(Execution& execution);
  // Passes that write a resource, in order of steps: where it may be looked at.
  static std::vector<std::string> writersOf(const graph::Plan& plan, std::uint32_t resource);

  // What the last frame left here: a single-level 2D texture, id 0 when there is none (or it is a buffer).
  gl::TextureRef picture() const { return hasPicture_ ? picture_.ref() : gl::TextureRef{}; }
  std::uint64_t bufferBytes() const { return hasBuffer_ ? buffer_.bytes() : 0; }
  std::uint64_t copies() const { return copies_; }  // made so far

  // Draws it into a texture of that size, rgba8, which stays this object's. 0 after an error or without a picture.
  GLuint draw(const InspectView& view, std::uint32_t width, std::uint32_t height,
              text::Diagnostics& diagnostics);
  // How `target` is shown at first: what holds linear light goes through the sRGB curve.
  static InspectView viewOf(const graph::FlatResource& resource);
  // The same, over the range of what is there where 0 to 1 says little: of depth and of whole numbers. Waits for the GPU.
  InspectView fittedView() const;
  // draw() of every texel, a pixel each, top row first; and the values as they are stored, of 1 to 4 channels (whole numbers
  // above 2^24 are rounded). Both wait for the GPU.
  std::optional<assets::Image8> drawWhole(const InspectView& view, text::Diagnostics& diagnostics);
  std::optional<assets::ImageF> values() const;
  // Waits for the GPU. Row 0 is the bottom one.
  std::optional<InspectTexel> texel(std::uint32_t x, std::uint32_t y) const;
  std::optional<InspectStatistics> measure() const;
  std::vector<std::byte> bytes(std::uint64_t offset, std::uint64_t count) const;

 private:
  // Takes `target` for what to look at; the step after which, or kNone when it is not there.
  std::uint32_t aim(Execution& execution, const InspectTarget& target);
  void copy();
  bool prepareTexture(const gl::TextureRef& from);
  // Numbers of a texel, and those of a part of the picture, as they are stored, row 0 at the bottom.
  std::uint32_t numbers() const;
  std::vector<double> read(std::uint32_t x, std::uint32_t y, std::uint32_t width, std::uint32_t height) const;

  Device& device_;
  Execution* execution_ = nullptr;  // that is watched; used while its watch runs, it may be gone else
  InspectTarget target_;
  StepWatch::Look also_;
  std::uint32_t resource_ = 0, mip_ = 0, layer_ = 0, history_ = 0;
  std::uint32_t channels_ = 4;  // of the resource's format
  bool stencil_ = false, hasPicture_ = false, hasBuffer_ = false;
  std::uint64_t copies_ = 0;
  gl::Texture picture_, canvas_;
  gl::Buffer buffer_, uniforms_;
  gl::Framebuffer canvasTarget_;
  gl::VertexArray vertices_;
};

// ---- what passes wrote, at the place in the frame where they wrote it, for commands that look at a graph without a person ----

// One level of one layer of a texture, or a buffer, right after a step.
struct CaptureItem {
  std::uint32_t step = 0;  // into Plan::steps
  InspectTarget target;
  friend bool operator==(const CaptureItem&, const CaptureItem&) = default;
};

// Everything that each step writes of the resources whose names match one of `patterns` (graph::matchesPattern), in the order of
// steps. A pattern may be any suffix of a dotted name; one without # means all versions.
std::vector<CaptureItem> captureItems(const graph::Plan& plan, std::span<const std::string> patterns);
// What a pick names. Nothing after an error: those of graph::findPick(); or presentsUnwritten, because no live pass touches it.
std::optional<CaptureItem> captureItemOf(const graph::Plan& plan, const graph::Pick& pick,
                                         text::Diagnostics& diagnostics);

// Within each frame from the next on, calls `visit` for each item, with its index, when `inspector` has the copy. Not for an item
// whose pass has not run (FrameCadence::hasResults). There is one watch of `execution`, which is this one until Inspector::release().
void watchItems(Execution& execution, Inspector& inspector, std::vector<CaptureItem> items,
                std::function<void(std::size_t item)> visit);

}  // namespace weft::runtime
