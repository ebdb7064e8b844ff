#include "engine/runtime/frame/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>
#include <type_traits>

#include "engine/gl/context/state.h"
#include "engine/graph/read/read.h"
#include "engine/passes/draw/geometry.h"
#include "engine/runtime/frame/device.h"
#include "engine/runtime/frame/execution.h"
#include "engine/text/files/file.h"

namespace weft::runtime {

namespace {

// Those that shaderRootsOf() looks at, whether or not they are there.
std::vector<std::string> shaderFoldersOf(std::span<const std::string> files, const std::string& dataFolder) {
  std::vector<std::string> folders;
  const auto add = [&](const std::filesystem::path& folder) {
    const std::string text = folder.lexically_normal().string();
    if (text::mayRead(text) && std::ranges::find(folders, text) == folders.end()) folders.push_back(text);
  };
  std::set<std::filesystem::path> seen;
  for (const std::string& file : files) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (!seen.insert(folder).second) continue;
    add(folder / "shaders");
    add(folder / ".." / "shaders");
  }
  add(std::filesystem::path(dataFolder) / "shaders");
  return folders;
}

}  // namespace

std::vector<std::string> shaderRootsOf(std::span<const std::string> files, const std::string& dataFolder) {
  std::vector<std::string> roots = shaderFoldersOf(files, dataFolder);
  std::erase_if(roots, [](const std::string& root) { return !text::isFolder(root); });
  return roots;
}

namespace {

// The registry of another world. The plug-ins cannot change, and many words say what they are.
void changeWorld(graph::Registry& registry, const PlugIns& plugIns, const imports::WorldFacts& facts,
                 imports::Files* files) {
  registry.drawLists = scene::drawListNames();
  registry.things.clear();
  std::map<std::uint8_t, std::uint64_t> unusual;  // by their lists
  const auto look = [&](const auto& row) {
    if (row.lists != 0 && row.lists != std::remove_cvref_t<decltype(row)>{}.lists) ++unusual[row.lists];
  };
  std::ranges::for_each(facts.scene->spheres.rows(), look);
  std::ranges::for_each(facts.scene->meshInstances.rows(), look);
  for (const auto& [mask, count] : unusual) {
    graph::Registry::Things& things = registry.things.emplace_back();
    things.count = count;
    for (std::size_t i = 0; i < registry.drawLists.size(); ++i)
      if ((mask >> i & 1u) != 0) things.lists.push_back(registry.drawLists[i]);
  }
  registry.factsOf = [imports = plugIns.imports, facts, files](const graph::ImportRequest& request) {
    imports::Files once;
    return imports->find(request.type)->facts(request, facts, files ? *files : once);
  };
}

}  // namespace

graph::Registry makeRegistry(const PlugIns& plugIns, const imports::WorldFacts& facts,
                             imports::Files* files) {
  graph::Registry registry;
  registry.passTypes = plugIns.passTypes->reflect();
  registry.imports = plugIns.imports->reflect();
  registry.geometries = passes::reflectGeometries();
  changeWorld(registry, plugIns, facts, files);
  return registry;
}

Renderer::Renderer(gl::Context& context, const std::string& graphPath, Options options)
    : graphPath_(graphPath),
      options_(std::move(options)),
      device_(std::make_unique<Device>(context, std::vector<std::string>{}, options_.cacheFolder,
                                       options_.trial, options_.plugIns)),
      registry_(makeRegistry(device_->plugIns, {})) {}

Renderer::~Renderer() = default;

bool Renderer::setParameter(std::string_view path, const graph::Value& value) {
  return execution_ && execution_->uniforms().set(path, value);
}

bool Renderer::load(const graph::Settings& settings, const World& world, text::Diagnostics& diagnostics) {
  text::Diagnostics said;
  const auto desc = graph::readGraph(graphPath_, said, {.presets = options_.presets});
  diagnostics.append(said);
  triedFiles_ = desc ? desc->files : std::vector<std::string>{graphPath_};
  refused_.clear();
  if (!desc) return false;
  // A folder that comes may hold what is to be found before other files.
  for (const std::string& folder : shaderFoldersOf(desc->files, options_.dataFolder))
    if (!text::isFolder(folder)) triedFiles_.push_back(folder);
  const std::vector<std::string> running = device_->sources.roots();
  device_->sources.setRoots(shaderRootsOf(desc->files, options_.dataFolder));
  if (!said.hasErrors() && switchTo(desc, ShaderFiles::read, settings, world, diagnostics)) return true;
  if (execution_) device_->sources.setRoots(running);
  const graph::Registry& registry = registryOf(world);
  if (said.hasErrors()) graph::expandGraph(*desc, registry, settings, diagnostics);  // for what else is wrong
  refused_ = graph::findRefused(*desc, registry, settings);
  return false;
}

bool Renderer::apply(const graph::Settings& settings, const World& world, text::Diagnostics& diagnostics) {
  if (!desc_) return load(settings, world, diagnostics);
  triedFiles_ = runningFiles_;
  return switchTo(desc_, ShaderFiles::keep, settings, world, diagnostics);
}

const graph::Registry& Renderer::registryOf(const World& world) {
  changeWorld(registry_, device_->plugIns, world.facts(), &device_->imports.files());
  return registry_;
}

std::vector<double> Renderer::output(std::string_view name) const {
  std::vector<double> numbers;
  if (const Output* found = execution_ ? execution_->readBack().find(name) : nullptr)
    for (std::size_t i = 0; i < found->count(); ++i) numbers.push_back(found->number(i));
  return numbers;
}

std::vector<std::string> Renderer::files() const {
  std::vector<std::string> files = runningFiles_;
  if (triedFiles_ != runningFiles_) files.insert(files.end(), triedFiles_.begin(), triedFiles_.end());
  return files;
}

bool Renderer::switchTo(std::shared_ptr<const graph::GraphDesc> desc, ShaderFiles files,
                        const graph::Settings& settings, const World& world, text::Diagnostics& all) {
  text::Diagnostics diagnostics;  // of this attempt alone
  device_->sources.forgetTouched();
  device_->programs.startTrials();
  imports::Files& imported = device_->imports.files();
  imported.forgetTouched();
  auto made = makeExecution(*desc, files, settings, world, diagnostics);
  all.append(diagnostics);
  const std::set<std::string>& shaders = device_->sources.touched();
  triedFiles_.insert(triedFiles_.end(), shaders.begin(), shaders.end());
  triedFiles_.insert(triedFiles_.end(), imported.touched().begin(), imported.touched().end());
  std::ranges::sort(triedFiles_);
  triedFiles_.erase(std::ranges::unique(triedFiles_).begin(), triedFiles_.end());
  if (!made) return false;
  execution_ = std::move(made);
  desc_ = std::move(desc);
  runningFiles_ = triedFiles_;
  presentTexture_ = 0;  // its name may be another texture's now
  return true;
}

std::unique_ptr<Execution> Renderer::makeExecution(const graph::GraphDesc& desc, ShaderFiles files,
                                                   const graph::Settings& settings, const World& world,
                                                   text::Diagnostics& diagnostics) {
  const graph::Registry& registry = registryOf(world);
  const auto flat = graph::expandGraph(desc, registry, settings, diagnostics);
  if (!flat || diagnostics.hasErrors()) return nullptr;
  device_->imports.prepare(*flat);
  auto plan = std::make_shared<const graph::Plan>(graph::compile(flat, options_.compile));
  if (!graph::checkMemory(*plan, diagnostics)) return nullptr;
  ++plansBuilt_;
  if (!prepareStandIns(*flat, world, diagnostics)) return nullptr;
  return Execution::create(*device_, std::move(plan), execution_.get(), files, diagnostics);
}

bool Renderer::prepareStandIns(const graph::FlatGraph& graph, const World& world,
                               text::Diagnostics& diagnostics) {
  for (std::uint32_t i = 0; i < graph.imports.size(); ++i) {
    const graph::ImportSpec& import = graph.imports[i];
    // No resource has this import when a list of alternatives has something else in its place.
    if (import.fallback.empty() ||
        std::ranges::find(graph.resources, i, &graph::FlatResource::import) == graph.resources.end())
      continue;
    std::unique_ptr<Renderer>& standIn = standIns_[std::string(import.fallback)];
    if (!standIn) {
      Options options = options_;
      options.presets.clear();
      options.compile = {};
      auto made = std::make_unique<Renderer>(
          device_->context, (std::filesystem::path(options_.dataFolder) / import.fallback).string(),
          std::move(options));
      const graph::Settings settings{.software = device_->context.device().software};
      if (!made->load(settings, world, diagnostics)) return false;
      made->frame(world, headlessFrame(world, 0, 60), diagnostics);
      // Its plan does not know the readers.
      glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_IMAGE_ACCESS_BARRIER_BIT |
                      GL_FRAMEBUFFER_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
      standIn = std::move(made);
    }
    const std::uint32_t shown = standIn->execution_->plan().graph->present.resource;
    device_->imports.setStandIn(
        import, shown == graph::kNone ? gl::TextureRef{} : standIn->execution_->texture(shown));
  }
  return true;
}

FrameReport Renderer::frame(const World& world, const FrameInput& input, text::Diagnostics& diagnostics) {
  if (!execution_) return {};
  if (device_->imports.isPending(*execution_->plan().graph, world)) {
    blackOut();
    return {};
  }
  return execution_->frame(world, input, diagnostics);
}

void Renderer::blackOut() {
  const graph::FlatGraph& graph = *execution_->plan().graph;
  const gl::TextureRef texture = execution_->presented();
  if (texture.id == 0 || graph.resources[graph.present.resource].import != graph::kNone) return;
  clearTexture(texture, graph.resources[graph.present.resource].format, 0, 0, 1,
               graph::Value{graph::Value::Type::list, 4, {0, 0, 0, 1}, {}});
}

std::optional<assets::ImageF> Renderer::readPresentedFloat() {
  const gl::TextureRef texture = execution_ ? execution_->presented() : gl::TextureRef{};
  if (texture.id == 0) return std::nullopt;
  const gl::Extent extent = gl::extentOf(texture.desc, 0);
  const std::size_t channels = gl::clientFormatOf(texture.desc.format).channels;
  return assets::ImageF{static_cast<int>(extent.width), static_cast<int>(extent.height),
                        static_cast<int>(channels),
                        gl::flipped<float>(gl::readFloats(texture), extent.width * channels)};
}

assets::Image8 toBytes(const assets::ImageF& picture) {
  assets::Image8 image{picture.width, picture.height, 4, {}};
  const auto channels = static_cast<std::size_t>(picture.channels);
  image.texels.resize(picture.texels.size() / channels * 4);
  for (std::size_t i = 0; i < image.texels.size(); ++i) {
    const std::size_t c = i % 4, pixel = i / 4 * channels;
    const float value = c < channels ? picture.texels[pixel + c] : c == 3 ? 1.0f : picture.texels[pixel];
    image.texels[i] = static_cast<std::uint8_t>(
        std::lround(std::clamp(std::isnan(value) ? 0.0f : value, 0.0f, 1.0f) * 255.0f));
  }
  return image;
}

std::optional<assets::Image8> Renderer::readPresented8() {
  const auto picture = readPresentedFloat();
  return picture ? std::optional(toBytes(*picture)) : std::nullopt;
}

void Renderer::present(std::uint32_t width, std::uint32_t height, std::uint32_t x, std::uint32_t y) {
  const gl::TextureRef texture = execution_ ? execution_->presented() : gl::TextureRef{};
  gl::openMasks();
  gl::releaseBindings();
  if (texture.id == 0) {
    const float black[4] = {0, 0, 0, 1};
    glClearNamedFramebufferfv(0, GL_COLOR, 0, black);
    return;
  }
  if (presentTexture_ != texture.id) {
    text::Diagnostics ignored;
    const std::array source{gl::Attachment{.texture = texture.id}};
    gl::remake(presentSource_, source, "present", ignored);
    presentTexture_ = texture.id;
  }
  const gl::Extent from = gl::extentOf(texture.desc, 0);
  const bool same = from.width == width && from.height == height;
  glBlitNamedFramebuffer(presentSource_.id(), 0, 0, 0, static_cast<GLint>(from.width),
                         static_cast<GLint>(from.height), static_cast<GLint>(x), static_cast<GLint>(y),
                         static_cast<GLint>(x + width), static_cast<GLint>(y + height), GL_COLOR_BUFFER_BIT,
                         same ? GL_NEAREST : GL_LINEAR);
}

}  // namespace weft::runtime
