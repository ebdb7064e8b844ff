#include "engine/runtime/imports/imports.h"

#include <algorithm>

namespace weft::runtime {

void Imports::beginFrame(const World& world, const FrameInput& input) {
  world_ = &world;
  input_ = input;
  ++frames_;
  // What the last frame did not ask for goes: a focal length that is being turned makes a view per frame.
  std::erase_if(views_, [](const CachedView& view) { return view.stale; });
  for (CachedView& view : views_) view.stale = true;
}

void Imports::setEnvironmentFallback(gl::TextureRef texture, std::uint64_t generation) {
  fallback_ = texture;
  fallbackGeneration_ = generation;
}

void Imports::renewFiles() {
  std::erase_if(luts_, [](const Lut& lut) { return lut.stale; });
  for (Lut& lut : luts_) lut.stale = true;
}

gl::TextureRef Imports::lut(const std::string& file, base::Diagnostics& diagnostics) {
  if (file.empty()) return {};
  auto found = std::ranges::find(luts_, file, &Lut::file);
  if (found == luts_.end()) {
    luts_.push_back({.file = file, .table = nullptr, .texture = {}});
    found = luts_.end() - 1;
  }
  if (found->stale) {
    found->stale = false;
    const auto table = lutFiles_.get(file, diagnostics);
    auto texture = table && table != found->table ? makeLutTexture(*table, file, diagnostics) : std::nullopt;
    if (texture) {
      found->table = table;
      found->texture = std::move(*texture);
      found->generation = ++lutGenerations_;
    }
  }
  return found->texture ? found->texture.ref() : gl::TextureRef{};
}

gl::TextureRef Imports::texture(const graph::ImportSpec& import, base::Diagnostics& diagnostics) {
  if (import.request.type == "cube_lut") return lut(import.request.arguments[0].second.symbol, diagnostics);
  if (import.request.type != "environment") return {};
  if (!world_->environment()) return fallback_;
  environments_.use(world_->environment(), diagnostics);
  return environments_.current();
}

gl::TextureRef Imports::shown(const graph::ImportSpec& import, base::Diagnostics& diagnostics) {
  return hasBefore(import) ? environments_.shown() : texture(import, diagnostics);
}

gl::TextureRef Imports::before(const graph::ImportSpec& import, base::Diagnostics& diagnostics) {
  return hasBefore(import) ? environments_.before() : texture(import, diagnostics);
}

void Imports::publish(const graph::ImportSpec& import) {
  if (hasBefore(import)) environments_.publish();
}

const std::vector<scene::Instance>& Imports::instancesOf(scene::DrawList list) {
  CpuInstances& cpu = cpu_[static_cast<std::size_t>(list)];
  const std::uint64_t wanted = listGeneration(list);
  if (cpu.generation != wanted) {
    scene::fillInstances(world_->scene(), list, input_.time, input_.time - input_.deltaTime, cpu.rows);
    cpu.generation = wanted;
  }
  return cpu.rows;
}

const Imports::ListFacts& Imports::factsOf(scene::DrawList list) const {
  ListFacts& facts = lists_[static_cast<std::size_t>(list)];
  if (facts.scene != world_->sceneGeneration())
    facts = {.scene = world_->sceneGeneration(),
             .count = static_cast<std::uint32_t>(scene::countInstances(world_->scene(), list)),
             .moving = scene::isMoving(world_->scene(), list)};
  return facts;
}

std::uint64_t Imports::listGeneration(scene::DrawList list) const {
  const std::uint64_t still = world_->sceneGeneration() << 32;
  return factsOf(list).moving ? still + frames_ : still;
}

std::uint32_t Imports::countOf(scene::DrawList list) const {
  return factsOf(list).count;
}

BufferRef Imports::instances(scene::DrawList list, const InstanceLayout& layout,
                             base::Diagnostics& diagnostics) {
  Table* table = nullptr;
  for (auto& each : tables_)
    if (each->list == list && each->layout == layout) table = each.get();
  if (!table) {
    tables_.push_back(std::make_unique<Table>());
    table = tables_.back().get();
    table->list = list;
    table->layout = layout;
  }
  const std::uint64_t wanted = listGeneration(list);
  if (table->generation != wanted) {
    writeInstances(layout, instancesOf(list), bytes_);
    if (bytes_.empty()) bytes_.assign(std::max(layout.stride, 16u), std::byte{0});
    if (!table->buffer || table->buffer.bytes() != bytes_.size()) {
      auto buffer = gl::Buffer::create(bytes_.size(), GL_DYNAMIC_STORAGE_BIT,
                                       scene::drawListNames()[static_cast<std::size_t>(list)], diagnostics);
      if (!buffer) return {};
      table->buffer = std::move(*buffer);
    }
    gl::uploadBuffer(table->buffer.id(), 0, bytes_);
    table->generation = wanted;
  }
  return {table->buffer.id(), table->buffer.bytes()};
}

BufferRef Imports::order(scene::DrawList list, scene::SortMethod method, base::Diagnostics& diagnostics) {
  Order* order = nullptr;
  for (auto& each : orders_)
    if (each->list == list && each->method == method) order = each.get();
  if (!order) {
    orders_.push_back(std::make_unique<Order>());
    order = orders_.back().get();
    order->list = list;
    order->method = method;
  }
  if (order->generation != frames_) {
    scene::drawOrder(instancesOf(list), view(nullptr, 1, 1).view, method, elements_, scratch_);
    const std::uint64_t bytes = std::max<std::size_t>(elements_.size(), 1) * sizeof(scene::SortElement);
    if (!order->buffer || order->buffer.bytes() != bytes) {
      auto buffer = gl::Buffer::create(bytes, GL_DYNAMIC_STORAGE_BIT, "draw order", diagnostics);
      if (!buffer) return {};
      order->buffer = std::move(*buffer);
    }
    if (!elements_.empty()) gl::uploadBuffer(order->buffer.id(), 0, std::as_bytes(std::span(elements_)));
    order->generation = frames_;
  }
  return {order->buffer.id(), order->buffer.bytes()};
}

BufferRef Imports::buffer(const graph::ImportSpec& import, const InstanceLayout& layout,
                          base::Diagnostics& diagnostics) {
  if (import.request.type == "spheres") return instances(scene::DrawList::spheres, layout, diagnostics);
  if (import.request.type == "draw_order") {
    const auto list = scene::findDrawList(import.request.arguments[0].second.symbol);
    const auto method = scene::findSortMethod(import.request.arguments[2].second.symbol);
    if (list && method) return order(*list, *method, diagnostics);
  }
  return {};
}

const scene::ViewData& Imports::view(const graph::ImportSpec* import, std::uint32_t width,
                                     std::uint32_t height) {
  std::uint32_t jitter = 0;
  double focal = 0, sensor = 24;
  if (import)
    for (const auto& [name, value] : import->request.arguments) {
      if (name == "jitter") jitter = static_cast<std::uint32_t>(std::clamp(value.v[0], 0.0, 4294967295.0));
      if (name == "focal_length") focal = value.v[0];
      if (name == "sensor_height") sensor = std::clamp(value.v[0], 1e-3, 1e5);
    }
  const double fov = focal > 0 ? scene::fovOfLens(std::clamp(focal, 0.01 * sensor, 1e4 * sensor), sensor) : 0;
  CachedView* cached = nullptr;
  for (CachedView& each : views_)
    if (each.jitter == jitter && each.fovDegrees == fov && each.width == width && each.height == height)
      cached = &each;
  if (!cached) {
    views_.push_back({.jitter = jitter, .width = width, .height = height, .fovDegrees = fov, .data = {}});
    cached = &views_.back();
  }
  if (cached->stale) {
    const auto seen = [fov](scene::CameraPose pose) {
      if (fov > 0) pose.fovDegrees = fov;
      return pose;
    };
    cached->data = scene::makeView({.pose = seen(input_.pose),
                                    .previousPose = seen(input_.previousPose),
                                    .viewport = {width, height},
                                    .jitter = scene::jitterAt(input_.frame, jitter),
                                    .frame = input_.frame,
                                    .time = input_.time,
                                    .deltaTime = input_.deltaTime});
    cached->stale = false;
  }
  return cached->data;
}

std::uint64_t Imports::generation(const graph::ImportSpec& import) const {
  const std::string& type = import.request.type;
  if (type == "environment")
    return world_->environment() ? world_->environmentGeneration() : fallbackGeneration_ << 32;
  if (type == "spheres") return listGeneration(scene::DrawList::spheres);
  if (type == "cube_lut") {
    const auto found = std::ranges::find(luts_, import.request.arguments[0].second.symbol, &Lut::file);
    return found == luts_.end() ? 0 : found->generation;
  }
  if (type == "cut") return input_.cutGeneration;
  return frames_;
}

}  // namespace weft::runtime
