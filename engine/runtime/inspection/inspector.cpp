#include "engine/runtime/inspection/inspector.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/gl/context/state.h"
#include "engine/graph/subresource.h"
#include "engine/runtime/prepare/program_request.h"
#include "runtime_sentences.h"

namespace weft::runtime {

using graph::kNone;

namespace {

// The last step for which `is` holds; where no pass writes the resource, which is an import then or has version zero only, the first
// that uses it if `unwritten` may be. kNone: there is none.
template <class Is>
std::uint32_t lastStep(const graph::Plan& plan, std::uint32_t resource, bool unwritten, const Is& is) {
  std::uint32_t last = kNone;
  for (std::uint32_t step = 0; step < plan.steps.size(); ++step)
    if (is(step)) last = step;
  if (last != kNone || !unwritten || plan.firstStep[resource] == kNone) return last;
  return std::min(plan.firstStep[resource], static_cast<std::uint32_t>(plan.steps.size() - 1));
}

bool isWanted(std::string_view resource, std::span<const std::string> patterns) {
  return std::ranges::any_of(patterns, [&](const std::string& pattern) {
    const auto name = pattern.find('#') == std::string::npos ? graph::sharedName(resource) : resource;
    return graph::matchesPattern(pattern, name) || graph::matchesPattern("*." + pattern, name);
  });
}

// Whether the item has its content: its pass has results; or, where it names none, any pass that writes the resource.
bool isThere(const Execution& execution, const CaptureItem& item) {
  if (!item.target.pass.empty()) return execution.steps().hasResults(item.step);
  const graph::Plan& plan = execution.plan();
  bool written = false;
  for (std::uint32_t step = 0; step <= item.step; ++step) {
    bool writes = false;
    plan.forEachWrite(step, [&](const graph::FlatUse& use) {
      writes |= plan.graph->resourceNames[use.resource] == item.target.resource;
    });
    if (writes && execution.steps().hasResults(step)) return true;
    written |= writes;
  }
  return !written;
}

struct Rectangle {
  std::uint32_t x = 0, y = 0, width = 1, height = 1;
};

// The first `channels` numbers of each texel as they are stored, row 0 at the bottom.
std::vector<double> readNumbers(const gl::TextureRef& from, std::uint32_t mip, std::uint32_t layer,
                                const Rectangle& part, bool stencil, std::uint32_t channels) {
  gl::ClientFormat client = gl::clientFormatOf(from.desc.format);
  if (stencil && from.desc.format == GL_DEPTH32F_STENCIL8)
    client = {GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, 2};
  else if (stencil)
    client = {GL_DEPTH_STENCIL, GL_UNSIGNED_INT_24_8, 1};
  std::vector<std::uint32_t> words(std::size_t{part.width} * part.height * client.channels);
  glGetTextureSubImage(from.id, static_cast<GLint>(mip), static_cast<GLint>(part.x),
                       static_cast<GLint>(part.y), static_cast<GLint>(layer),
                       static_cast<GLsizei>(part.width), static_cast<GLsizei>(part.height), 1, client.format,
                       client.type, static_cast<GLsizei>(words.size() * 4), words.data());
  const auto numberOf = [&](std::uint32_t word) -> double {
    if (stencil) return word & 0xff;
    if (client.type == GL_FLOAT) return static_cast<double>(std::bit_cast<float>(word));
    return client.type == GL_INT ? std::bit_cast<std::int32_t>(word) : static_cast<double>(word);
  };
  std::vector<double> out;
  out.reserve(std::size_t{part.width} * part.height * channels);
  // Stencil comes last.
  for (std::size_t at = stencil ? client.channels - 1 : 0; at < words.size(); at += client.channels)
    for (std::uint32_t c = 0; c < channels; ++c) out.push_back(numberOf(words[at + c]));
  return out;
}

}  // namespace

std::vector<std::string> Inspector::writersOf(const graph::Plan& plan, std::uint32_t resource) {
  std::vector<std::string> names;
  for (std::size_t step = 0; step < plan.steps.size(); ++step)
    if (plan.writes(step, resource)) names.push_back(plan.graph->passNames[plan.steps[step].pass]);
  return names;
}

bool Inspector::watch(Execution& execution, const InspectTarget& target, StepWatch::Look also) {
  also_ = std::move(also);
  if (execution_ == &execution && execution.watched() && target == target_) return true;
  release(execution);
  const std::uint32_t step = aim(execution, target);
  if (step == kNone) return false;
  execution.watch({.after = [this, step](std::uint32_t each) {
    if (each == step) copy();
    if (also_) also_(each);
  }});
  return true;
}

bool Inspector::look(Execution& execution, const InspectTarget& target) {
  if (aim(execution, target) == kNone) return false;
  copy();
  return hasPicture_ || hasBuffer_;
}

std::uint32_t Inspector::aim(Execution& execution, const InspectTarget& target) {
  const graph::Plan& plan = execution.plan();
  const graph::FlatGraph& graph = *plan.graph;
  const auto named = std::ranges::find(graph.resourceNames, target.resource);
  if (named == graph.resourceNames.end() || plan.steps.empty()) return kNone;
  const auto resource = static_cast<std::uint32_t>(named - graph.resourceNames.begin());
  const graph::FlatResource& desc = graph.resources[resource];
  if (desc.kind == graph::ResourceKind::imported_buffer || plan.firstStep[resource] == kNone) return kNone;
  const std::uint32_t step = lastStep(plan, resource, target.pass.empty(), [&](std::uint32_t each) {
    return target.pass.empty() ? plan.writes(each, resource)
                               : graph.passNames[plan.steps[each].pass] == target.pass;
  });
  if (step == kNone) return kNone;
  execution_ = &execution;
  target_ = target;
  resource_ = resource;
  channels_ = std::max<std::uint32_t>(1, graph::infoOf(desc.format).channels);
  mip_ = std::min<std::uint32_t>(target.mip, desc.mips - 1u);
  layer_ = std::min(target.layer, graph::slicesOf(desc, mip_) - 1);
  history_ = std::min<std::uint32_t>(target.history, desc.history);
  stencil_ = target.stencil && graph::hasStencil(desc.format);
  hasPicture_ = hasBuffer_ = false;
  return step;
}

void Inspector::release(Execution& execution) {
  execution.watch({});
  execution_ = nullptr;
  hasPicture_ = hasBuffer_ = false;
}

bool Inspector::prepareTexture(const gl::TextureRef& from) {
  const gl::Extent extent = gl::extentOf(from.desc, mip_);
  const gl::TextureDesc wanted{.format = from.desc.format, .width = extent.width, .height = extent.height};
  text::Diagnostics ignored;
  const bool fits = picture_ && picture_.desc() == wanted;
  if (!fits && !gl::remake(picture_, wanted, "inspector", ignored)) return false;
  if (gl::classOf(wanted.format) == gl::FormatClass::depth_stencil)
    glTextureParameteri(picture_.id(), GL_DEPTH_STENCIL_TEXTURE_MODE,
                        stencil_ ? GL_STENCIL_INDEX : GL_DEPTH_COMPONENT);
  return true;
}

// Runs within the frame. What shaders stored must be visible to the copy, and the copy must be done before shaders store
// again. The plan knows nothing of this copy, so the inspector issues barriers of its own.
void Inspector::copy() {
  const graph::FlatResource& desc = execution_->plan().graph->resources[resource_];
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                  GL_BUFFER_UPDATE_BARRIER_BIT);
  if (desc.kind == graph::ResourceKind::buffer) {
    std::uint64_t offset = 0;
    const BufferRef from = execution_->buffer(resource_, offset, history_);
    text::Diagnostics ignored;
    hasBuffer_ = from.id != 0 && (buffer_.bytes() == from.bytes ||
                                  gl::remake(buffer_, from.bytes, GL_DYNAMIC_STORAGE_BIT | GL_MAP_READ_BIT,
                                             "inspector", ignored));
    if (hasBuffer_)
      glCopyNamedBufferSubData(from.id, buffer_.id(), static_cast<GLintptr>(offset), 0,
                               static_cast<GLsizeiptr>(from.bytes));
  } else {
    const gl::TextureRef from = execution_->texture(resource_, history_);
    hasPicture_ = from.id != 0 && mip_ < from.desc.mips && prepareTexture(from);
    if (hasPicture_ && desc.samples > 1)
      hasPicture_ = gl::resolveSamples(from, picture_.id());
    else if (hasPicture_)
      glCopyImageSubData(from.id, from.desc.target, static_cast<GLint>(mip_), 0, 0,
                         static_cast<GLint>(layer_), picture_.id(), GL_TEXTURE_2D, 0, 0, 0, 0,
                         static_cast<GLsizei>(picture_.desc().width),
                         static_cast<GLsizei>(picture_.desc().height), 1);
  }
  glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  copies_ += hasPicture_ || hasBuffer_;
}

GLuint Inspector::draw(const InspectView& view, std::uint32_t width, std::uint32_t height,
                       text::Diagnostics& diagnostics) {
  if (!hasPicture_ || width == 0 || height == 0) return 0;
  const gl::FormatClass kind = gl::classOf(picture_.desc().format);
  const bool depth = kind == gl::FormatClass::depth || kind == gl::FormatClass::depth_stencil;
  const int integer = stencil_ || kind == gl::FormatClass::unsigned_integer ? 1
                      : kind == gl::FormatClass::signed_integer             ? 2
                                                                            : 0;
  gl::ProgramRequest request;
  request.label = "inspector";
  request.stages = {{GL_VERTEX_SHADER, "inspector.vert.glsl", kFullscreenVertex},
                    {GL_FRAGMENT_SHADER, "inspect/inspect.frag.glsl", ""}};
  request.defines = {{"INTEGER", std::to_string(integer)}};
  request.outputs = {"result"};
  const auto variant = device_.programs.get(request, diagnostics);
  const gl::Block* block = variant ? variant->program.reflection().findUniformBlock("Parameters") : nullptr;
  if (!block) return 0;

  const gl::TextureDesc wanted{.format = GL_RGBA8, .width = width, .height = height};
  if (!canvas_ || !(canvas_.desc() == wanted)) {
    if (!gl::remake(canvas_, wanted, "inspector canvas", diagnostics)) return 0;
    const std::array to{gl::Attachment{.texture = canvas_.id()}};
    if (!gl::remake(canvasTarget_, to, "inspector canvas", diagnostics)) return 0;
  }
  std::vector<std::byte> bytes(block->bytes + 16);
  const auto set = [&](const char* name, const graph::Value& value) {
    const gl::BlockMember* member = block->find(name);
    const auto field = member ? fieldFor(*member, {.value = value}) : std::nullopt;
    if (field) writeValue(bytes.data(), *field, value);
  };
  const auto number = [](double x) { return graph::Value::number(x); };
  graph::Value origin{graph::Value::Type::list, 2, {view.x, view.y, 0, 0}, {}};
  set("origin", origin);
  set("texels_per_pixel", number(view.texelsPerPixel));
  // Depth, stencil and one-channel formats have one channel to show.
  const bool single = depth || channels_ == 1;
  set("channel", number(single ? 1 : static_cast<int>(view.channel)));
  set("low", number(view.low));
  set("high", number(view.high));
  set("ev", number(view.ev));
  const bool octahedral = view.colors == InspectColors::direction && channels_ == 2;
  set("false_color", number(octahedral ? 4 : static_cast<int>(view.colors)));
  set("encode", number(view.encode));
  set("highlight", number(view.highlight));
  set("near", number(view.depth && depth && !stencil_ ? view.nearPlane : 0));
  const bool fits = uniforms_ && uniforms_.bytes() >= bytes.size();
  if (!fits && !gl::remake(uniforms_, bytes.size(), GL_DYNAMIC_STORAGE_BIT, "inspector", diagnostics))
    return 0;
  gl::uploadBuffer(uniforms_.id(), 0, bytes);
  if (!vertices_) vertices_ = gl::VertexArray::create("inspector");

  gl::openMasks();
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glBindFramebuffer(GL_FRAMEBUFFER, canvasTarget_.id());
  glViewport(0, 0, static_cast<GLsizei>(width), static_cast<GLsizei>(height));
  glUseProgram(variant->program.id());
  glBindVertexArray(vertices_.id());
  const gl::OpaqueUniform* sampler = variant->program.reflection().findSampler("source");
  if (sampler) {
    glBindTextureUnit(sampler->unit, picture_.id());
    glBindSampler(sampler->unit, 0);
  }
  glBindBufferRange(GL_UNIFORM_BUFFER, block->binding, uniforms_.id(), 0, block->bytes);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  gl::releaseBindings();
  return canvas_.id();
}

std::string InspectTexel::text() const {
  std::string out;
  for (std::uint32_t c = 0; c < channels; ++c) {
    const double x = value[c];
    const bool whole = std::trunc(x) == x && std::abs(x) < 1e10;
    out += (c ? ", " : "") + (std::isnan(x) ? "nan"
                              : whole       ? fmt::format("{}", static_cast<std::int64_t>(x))
                                            : fmt::format("{}", static_cast<float>(x)));
  }
  return out;
}

InspectTexel readTexel(const gl::TextureRef& texture, std::uint32_t mip, std::uint32_t layer, std::uint32_t x,
                       std::uint32_t y, std::uint32_t channels) {
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
  InspectTexel out{.channels = std::clamp(channels, 1u, gl::clientFormatOf(texture.desc.format).channels)};
  std::ranges::copy(readNumbers(texture, mip, layer, {x, y, 1, 1}, false, out.channels), out.value.begin());
  return out;
}

std::uint32_t Inspector::numbers() const {
  return stencil_ ? 1 : std::min(channels_, gl::clientFormatOf(picture_.desc().format).channels);
}

std::vector<double> Inspector::read(std::uint32_t x, std::uint32_t y, std::uint32_t width,
                                    std::uint32_t height) const {
  return readNumbers(picture_.ref(), 0, 0, {x, y, width, height}, stencil_, numbers());
}

std::optional<InspectTexel> Inspector::texel(std::uint32_t x, std::uint32_t y) const {
  if (!hasPicture_ || x >= picture_.desc().width || y >= picture_.desc().height) return std::nullopt;
  InspectTexel out{.channels = numbers()};
  std::ranges::copy(read(x, y, 1, 1), out.value.begin());
  return out;
}

std::optional<InspectStatistics> Inspector::measure() const {
  if (!hasPicture_ || stencil_) return std::nullopt;
  const std::vector<double> texels = read(0, 0, picture_.desc().width, picture_.desc().height);
  const std::size_t channels = numbers();
  InspectStatistics out;
  out.low.fill(std::numeric_limits<double>::infinity());
  out.high.fill(-std::numeric_limits<double>::infinity());
  std::array<std::uint64_t, 4> finite{};
  for (std::size_t i = 0; i < texels.size(); i += channels) {
    bool nan = false, infinite = false;
    for (std::size_t c = 0; c < channels; ++c) {
      const double x = texels[i + c];
      nan |= std::isnan(x);
      infinite |= std::isinf(x);
      if (!std::isfinite(x)) continue;
      out.low[c] = std::min(out.low[c], x);
      out.high[c] = std::max(out.high[c], x);
      out.mean[c] += x;
      ++finite[c];
    }
    out.nan += nan;
    out.infinite += infinite;
    ++out.texels;
  }
  for (std::size_t c = 0; c < 4; ++c) {
    if (finite[c])
      out.mean[c] /= static_cast<double>(finite[c]);
    else
      out.low[c] = out.high[c] = 0;
  }
  return out;
}

InspectView Inspector::viewOf(const graph::FlatResource& resource) {
  // Values that are encoded already are not encoded again.
  return {.encode = graph::infoOf(resource.format).kind == graph::TexelKind::floating};
}

InspectView Inspector::fittedView() const {
  InspectView view = viewOf(execution_->plan().graph->resources[resource_]);
  const gl::FormatClass kind = gl::classOf(picture_.desc().format);
  if (!hasPicture_ || kind == gl::FormatClass::floating) return view;
  std::vector<double> finite = read(0, 0, picture_.desc().width, picture_.desc().height);
  std::erase_if(finite, [](double number) { return !std::isfinite(number); });
  if (finite.empty()) return view;
  const auto [low, high] = std::ranges::minmax(finite);
  view.low = static_cast<float>(low);
  view.high = static_cast<float>(high > low ? high : low + 1);
  return view;
}

std::optional<assets::Image8> Inspector::drawWhole(const InspectView& view, text::Diagnostics& diagnostics) {
  if (!hasPicture_) return std::nullopt;
  InspectView whole = view;
  whole.x = whole.y = 0;
  whole.texelsPerPixel = 1;
  if (draw(whole, picture_.desc().width, picture_.desc().height, diagnostics) == 0) return std::nullopt;
  const gl::TextureDesc& size = canvas_.desc();
  return assets::Image8{
      static_cast<int>(size.width), static_cast<int>(size.height), 4,
      gl::flipped<std::uint8_t>(gl::readTexture(canvas_.ref(), 0, 0, GL_RGBA, GL_UNSIGNED_BYTE),
                                std::size_t{size.width} * 4)};
}

std::optional<assets::ImageF> Inspector::values() const {
  if (!hasPicture_) return std::nullopt;
  const std::uint32_t width = picture_.desc().width, rows = picture_.desc().height;
  return assets::ImageF{static_cast<int>(width), static_cast<int>(rows), static_cast<int>(numbers()),
                        gl::flipped<float>(read(0, 0, width, rows), std::size_t{width} * numbers())};
}

std::vector<std::byte> Inspector::bytes(std::uint64_t offset, std::uint64_t count) const {
  if (!hasBuffer_ || offset >= buffer_.bytes()) return {};
  return gl::readBuffer(buffer_.id(), offset, std::min(count, buffer_.bytes() - offset));
}

// ---- captures ----

std::vector<CaptureItem> captureItems(const graph::Plan& plan, std::span<const std::string> patterns) {
  const graph::FlatGraph& graph = *plan.graph;
  std::vector<CaptureItem> items;
  for (std::uint32_t step = 0; step < plan.steps.size(); ++step) {
    const std::uint32_t p = plan.steps[step].pass;
    const auto begin = static_cast<std::ptrdiff_t>(items.size());
    plan.forEachWrite(step, [&](const graph::FlatUse& use) {
      if (!isWanted(graph.resourceNames[use.resource], patterns)) return;
      const graph::FlatResource& resource = graph.resources[use.resource];
      const bool buffer = resource.kind == graph::ResourceKind::buffer;
      const auto add = [&](std::uint32_t mip, std::uint32_t layer, bool stencil) {
        const CaptureItem item{step,
                               {.resource = graph.resourceNames[use.resource],
                                .pass = graph.passNames[p],
                                .mip = mip,
                                .layer = layer,
                                .stencil = stencil}};
        if (std::find(items.begin() + begin, items.end(), item) == items.end()) items.push_back(item);
      };
      if (buffer) return add(0, 0, false);
      const bool volume = resource.target == graph::Target::texture_3d;
      for (std::uint32_t mip = use.mip; mip < std::uint32_t{use.mip} + use.mips; ++mip) {
        const std::uint32_t first = volume ? 0 : use.layer,
                            count = volume ? graph::slicesOf(resource, mip) : use.layers;
        for (std::uint32_t layer = first; layer < first + count; ++layer) {
          if (!graph::hasStencil(resource.format) || (use.planes & 1)) add(mip, layer, false);
          if (graph::hasStencil(resource.format) && (use.planes & 2)) add(mip, layer, true);
        }
      }
    });
  }
  return items;
}

std::optional<CaptureItem> captureItemOf(const graph::Plan& plan, const graph::Pick& pick,
                                         text::Diagnostics& diagnostics) {
  const graph::FlatGraph& graph = *plan.graph;
  const auto found = graph::findPick(graph, pick, diagnostics);
  if (!found) return std::nullopt;
  const std::uint32_t last = lastStep(plan, found->resource, found->pass == kNone, [&](std::uint32_t step) {
    return plan.writes(step, found->resource) &&
           (found->pass == kNone || found->pass == plan.steps[step].pass);
  });
  const bool table = graph.resources[found->resource].kind == graph::ResourceKind::imported_buffer;
  if (last == kNone || table) {
    const text::Where at = text::placeOfOption(pick.option + " " + pick.text);
    const std::string& name = graph.resourceNames[found->resource];
    table ? diagnostics.error(say::isSceneTable, at, pick.name, name)
          : diagnostics.error(say::noPassTouches, at, pick.name, name);
    return std::nullopt;
  }
  return CaptureItem{last,
                     {.resource = graph.resourceNames[found->resource],
                      .pass = found->pass == kNone ? "" : graph.passNames[found->pass],
                      .mip = pick.mip,
                      .layer = pick.layer,
                      .history = pick.history,
                      .stencil = pick.stencil}};
}

void watchItems(Execution& execution, Inspector& inspector, std::vector<CaptureItem> items,
                std::function<void(std::size_t item)> visit) {
  execution.watch({.after = [&, items = std::move(items), visit = std::move(visit)](std::uint32_t step) {
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i].step == step && isThere(execution, items[i]) && inspector.look(execution, items[i].target))
        visit(i);
  }});
}

}  // namespace weft::runtime
