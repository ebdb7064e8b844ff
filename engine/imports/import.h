// An import: something that graphs take from outside (`@environment`, `{ "import": "camera" }`). A plug-in says what a
// graph may write (reflect) and what is known before anything runs (facts), and makes the Provider that gives the import
// to passes frame after frame (provide). Plug-ins hold no state and are shared by devices; a provider belongs to one
// device. No code outside the folder of a plug-in knows its name. CONTRIBUTING.md says how to add one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/gl/objects/objects.h"
#include "engine/graph/registry.h"
#include "engine/imports/row_table.h"
#include "engine/imports/world.h"
#include "engine/scene/camera.h"
#include "engine/scene/scene.h"
#include "engine/text/diagnostic.h"

namespace weft::imports {

// What a pass looks from: `@lamps[element].face[face]`, in a picture of width x height pixels.
struct ViewPart {
  std::uint32_t width = 1, height = 1;
  std::uint16_t element = 0, face = 0;
};

// Gives what one request (a type and its arguments) stands for, on one device. Most types override one of texture(),
// buffer() and view(), as their ImportKind says; events have only a generation. Functions with a Frame are called within
// that frame.
class Provider {
 public:
  virtual ~Provider() = default;

  // The newest texture. Id 0: there is none.
  virtual gl::TextureRef texture(const Frame&, text::Diagnostics&) { return {}; }
  // `layout` is for types that reflect `columns`: how the reading shader lays a row out.
  virtual BufferRef buffer(const Frame&, const RowLayout&, text::Diagnostics&) { return {}; }
  // Of types that reflect `columns`: what one has in row part.element, for a picture of the part's size. False: no such row.
  virtual bool value(const Frame&, const ViewPart&, std::uint32_t /*column*/, Numbers&) { return false; }
  // Valid until the next call.
  virtual const scene::ViewData& view(const Frame& frame, const ViewPart& part);
  // Another number whenever the import has changed, and only then: then `on_change` passes run, and histories that it resets
  // begin again. Unless overridden, it changes in every frame, as for what moves all the time.
  virtual std::uint64_t generation(const Frame& frame) { return frame.number; }

  // Whether the import is the same in every frame of a world that nobody changes.
  virtual bool isStill(const World&) const { return false; }
  // Whether the import depends on the frames that ran before this one, and not only on World and FrameInput.
  virtual bool remembers(const World&) const { return false; }
  // Whether it is made of FrameInput::pointer: then a window has the mouse for the picture.
  virtual bool followsPointer() const { return false; }

  // For a texture that appears together with what a group of passes makes of it, and so later than it changes: what texture()
  // gave last, which the executor keeps alive until the group has made it of a newer one. Null: it appears at once.
  virtual std::shared_ptr<const gl::Texture> hold() const { return nullptr; }

  // Whether it is still being loaded: pictures of graphs that read it are black until it is there.
  virtual bool isPending(const World&) const { return false; }

  // Called before a graph is prepared, because files may have changed. `used`: some graph asked for the import since the
  // last call. False: the provider is not needed any more and is destroyed.
  virtual bool renew(bool used) { return used; }
};

// One of a table: `Made` has rows(frame), which are those of its generation(frame).
template <class Made, class Row>
class RowsProvider : public Provider {
 public:
  RowsProvider(std::string label, Columns<Row> columns) : table_(std::move(label), std::move(columns)) {}
  BufferRef buffer(const Frame& frame, const RowLayout& layout, text::Diagnostics& diagnostics) override {
    const auto rows = [&] { return static_cast<Made&>(*this).rows(frame); };
    return table_.get(layout, generation(frame), rows, diagnostics);
  }
  bool value(const Frame& frame, const ViewPart& part, std::uint32_t column, Numbers& out) override {
    generation(frame);
    const auto& rows = static_cast<Made&>(*this).rows(frame);
    return table_.read(rows, part.element, column, out);
  }

 private:
  RowTable<Row> table_;
};

// The providers of a device.
class Providers {
 public:
  virtual ~Providers() = default;
  virtual Provider& of(const graph::ImportRequest& request, std::uint64_t key) = 0;  // keyOf() the request
};

// What a request is made for: the view that it names, or the scene's camera as it is, in a picture of one pixel.
class NamedView {
 public:
  explicit NamedView(const graph::ImportRequest& request);
  const scene::ViewData& view(const Frame& frame) const;
  std::uint64_t generation(const Frame& frame) const;

 private:
  std::optional<std::pair<graph::ImportRequest, std::uint64_t>> view_;
};

class Import {
 public:
  virtual ~Import() = default;
  virtual graph::ImportType reflect() const = 0;
  // Called while graphs are expanded, without a device. Files must be read through `files`, so that each is watched and
  // read once. Unless overridden, the import exists, and nothing else is known of it.
  virtual graph::ImportFacts facts(const graph::ImportRequest&, const WorldFacts&, Files&) const {
    return {.exists = true};
  }
  // Must make no GL call, because the provider may never be used.
  virtual std::unique_ptr<Provider> provide(const graph::ImportRequest& request) const = 0;
};

// An import that its provider says all of, in functions without an object: reflect(), and facts(request, world, files), unless it
// exists always. Providers are made of their request, or of nothing.
template <class Made>
class ImportOf : public Import {
 public:
  graph::ImportType reflect() const override { return Made::reflect(); }
  graph::ImportFacts facts(const graph::ImportRequest& request, const WorldFacts& world,
                           Files& files) const override {
    if constexpr (requires { Made::facts(request, world, files); })
      return Made::facts(request, world, files);
    else
      return Import::facts(request, world, files);
  }
  std::unique_ptr<Provider> provide([[maybe_unused]] const graph::ImportRequest& request) const override {
    if constexpr (std::is_constructible_v<Made, const graph::ImportRequest&>)
      return std::make_unique<Made>(request);
    else
      return std::make_unique<Made>();
  }
};

// The imports an engine knows, by name. An embedder adds its own before reading graphs.
class ImportRegistry : public graph::PlugIns<Import> {
 public:
  static ImportRegistry builtin();
};

// For reflect().
inline graph::ImportArgument argument(std::string name, graph::Value initial, std::string doc,
                                      std::vector<std::string> choices = {}) {
  return {std::move(name), std::move(initial), std::move(choices), std::move(doc)};
}
inline graph::ImportArgument drawListArgument(scene::DrawList initial = scene::DrawList::spheres) {
  const std::string& name = scene::drawListNames()[static_cast<std::size_t>(initial)];
  return {"list", graph::Value::text(name), {}, "a draw list", true};
}
inline graph::ImportArgument viewArgument() {
  return {.name = "view",
          .initial = graph::Value::text(""),
          .choices = {},
          .doc = "where the eye is: a camera of the graph; empty for that of its passes",
          .view = true};
}
// What a request of a draw list of a graph's own says.
scene::Selection selectionOf(const graph::ImportRequest& list);
// The draw list that a request names: expansion lets known ones through only.
scene::Selection drawListOf(const graph::ImportRequest& request);

// For facts(): a table, which is there when it has rows.
inline graph::ImportFacts factsOfRows(auto count) {
  return {.exists = count > 0, .count = static_cast<double>(count)};
}

// For facts(): an argument that cannot be, without the place, which expansion knows.
inline text::Diagnostic badArgument(std::string message, std::string expected, std::string found,
                                    std::string hint = {}) {
  return {.code = text::Code::badImportArgument,
          .message = std::move(message),
          .expected = std::move(expected),
          .found = std::move(found),
          .hint = std::move(hint)};
}

}  // namespace weft::imports
