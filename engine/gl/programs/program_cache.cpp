#include "engine/gl/programs/program_cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <filesystem>

#include "engine/base/files/file.h"
#include "engine/base/hash.h"
#include "engine/gl/programs/binary_folder.h"
#include "engine/gl/programs/program_admission.h"

namespace weft::gl {

namespace {

using base::Diagnostics;

constexpr std::size_t kMostFailures = 256;
constexpr std::size_t kMostEvicted = 256;  // above it, those that nobody holds are forgotten
constexpr std::size_t kKeyLength = kBinaryKeyLength;

// What stands before the binary in its file. The checksum keeps damaged bytes away from the driver.
struct BinaryHeader {
  char magic[kBinaryMagic.size()] = {};
  char key[kKeyLength] = {};
  std::uint32_t format = 0;
  std::uint32_t compute = 0;
  std::uint64_t bytes = 0;
  std::uint64_t checksum = 0;
};

std::string makeKey(const std::vector<StageSource>& stages, const ProgramRequest& request,
                    const DeviceInfo& device) {
  std::string text = device.driverKey + nameOf(device.backend);
  const auto add = [&](std::string_view part) { text += fmt::format("\n{}:{}", part.size(), part); };
  for (const StageSource& stage : stages)
    text += fmt::format("\n{:x} {:016x} {}", stage.stage, stage.source->hash, stage.source->text.size());
  for (const glsl::Define& define : request.defines) {
    add(define.name);
    add(define.value);
  }
  text += "\noutputs";
  for (const std::string& output : request.outputs) add(output);
  const std::uint64_t first = base::hashBytes(text);
  return fmt::format("{:016x}{:016x}", first, base::hashBytes(text, base::hashCombine(first, text.size())));
}

void appendFor(const ProgramRequest& request, const Diagnostics& from, Diagnostics& to) {
  for (base::Diagnostic diagnostic : from.items()) {
    if (diagnostic.pass.empty()) diagnostic.pass = request.pass;
    to.add(std::move(diagnostic));
  }
}

}  // namespace

ProgramCache::ProgramCache(const DeviceInfo& device, glsl::SourceLoader& loader, Options options)
    : device_(device), loader_(loader), options_(std::move(options)) {
  assert(options_.capacity >= 1);
  trialTime_.all = options_.trialSeconds;
  if (!device_.hasProgramBinaries) options_.folder.clear();
  std::error_code ignored;  // a folder that cannot be made is a cache that always misses
  if (!options_.folder.empty()) std::filesystem::create_directories(options_.folder, ignored);
}

std::shared_ptr<const Variant> ProgramCache::get(const ProgramRequest& request, Diagnostics& diagnostics) {
  assert(!request.stages.empty());
  std::vector<StageSource> stages;
  Diagnostics found;
  for (const ProgramRequest::Stage& stage : request.stages) {
    auto source = stage.text.empty() ? loader_.load(stage.file, found, request.place)
                                     : loader_.loadText(stage.text, stage.file, found);
    if (source) stages.push_back({stage.stage, std::move(source)});
  }
  appendFor(request, found, diagnostics);
  if (stages.size() != request.stages.size()) return nullptr;

  const std::string key = makeKey(stages, request, device_);
  if (const auto known = index_.find(key); known != index_.end()) {
    ++stats_.hits;
    order_.splice(order_.begin(), order_, known->second);
    return order_.front().variant;
  }
  if (const auto failed = failures_.find(key); failed != failures_.end()) {
    ++stats_.hits;
    appendFor(request, failed->second, diagnostics);
    return nullptr;
  }
  ++stats_.misses;
  if (auto held = revive(key)) return remember(key, std::move(held));
  const bool compute = stages.front().stage == GL_COMPUTE_SHADER;
  Diagnostics refused;
  if (!checkProgramSize(stages, request.defines, refused)) {
    ++stats_.refusals;
    return refuse(key, request, std::move(refused), diagnostics);
  }
  std::optional<Program> program = loadBinary(key, compute, request.label);
  if (!program) {
    if (!options_.trial.empty() && isUnusual(stages, request.defines)) {
      ++stats_.trials;
      if (!survivesTrial(options_.trial, device_, stages, request.defines, request.outputs, trialTime_,
                         refused)) {
        ++stats_.refusals;
        return refuse(key, request, std::move(refused), diagnostics);
      }
    }
    ++stats_.compilations;
    Diagnostics log;
    program = Program::compile(stages, request.defines, request.outputs, request.label, log);
    if (!program) {
      ++stats_.failures;
      placeCircles(stages, request.defines, log);
      return refuse(key, request, std::move(log), diagnostics);
    }
    appendFor(request, log, diagnostics);
    storeBinary(key, compute, *program);
  }
  return remember(key, std::make_shared<const Variant>(
                           Variant{std::move(*program), std::move(stages), key, request.defines}));
}

void ProgramCache::touch(const std::shared_ptr<const Variant>& variant) {
  if (const auto known = index_.find(variant->key); known != index_.end()) {
    ++stats_.hits;
    order_.splice(order_.begin(), order_, known->second);
    return;
  }
  ++stats_.misses;
  revive(variant->key);
  remember(variant->key, variant);
}

// Tells what is wrong, now and when it is asked for again.
std::shared_ptr<const Variant> ProgramCache::refuse(std::string key, const ProgramRequest& request,
                                                    Diagnostics said, Diagnostics& diagnostics) {
  appendFor(request, said, diagnostics);
  if (failures_.size() >= kMostFailures) failures_.clear();
  failures_.emplace(std::move(key), std::move(said));
  return nullptr;
}

std::shared_ptr<const Variant> ProgramCache::remember(std::string key,
                                                      std::shared_ptr<const Variant> variant) {
  order_.push_front({key, variant});
  index_.emplace(std::move(key), order_.begin());
  while (order_.size() > options_.capacity) {
    ++stats_.evictions;
    if (evicted_.size() >= kMostEvicted)
      std::erase_if(evicted_, [](const auto& each) { return each.second.expired(); });
    evicted_.insert_or_assign(order_.back().key, order_.back().variant);
    index_.erase(order_.back().key);
    order_.pop_back();
  }
  return variant;
}

std::shared_ptr<const Variant> ProgramCache::revive(const std::string& key) {
  const auto found = evicted_.find(key);
  if (found == evicted_.end()) return nullptr;
  std::shared_ptr<const Variant> held = found->second.lock();
  evicted_.erase(found);
  stats_.revivals += held ? 1 : 0;
  return held;
}

void ProgramCache::clear() {
  index_.clear();
  order_.clear();
  evicted_.clear();
  failures_.clear();
}

std::string ProgramCache::pathOf(const std::string& key) const {
  return options_.folder + "/" + key + ".bin";
}

std::optional<Program> ProgramCache::loadBinary(const std::string& key, bool compute,
                                                std::string_view label) {
  if (options_.folder.empty()) return std::nullopt;
  std::error_code ec;
  if (!std::filesystem::is_regular_file(pathOf(key), ec)) return std::nullopt;
  Diagnostics unread;  // a binary that cannot be read is a miss
  const std::optional<std::string> bytes = base::readFile(pathOf(key), unread);
  const auto reject = [&]() -> std::optional<Program> {
    ++stats_.binaryRejects;
    return std::nullopt;
  };
  if (!bytes || bytes->size() < sizeof(BinaryHeader)) return reject();
  BinaryHeader header;
  std::memcpy(&header, bytes->data(), sizeof header);
  const std::string_view body = std::string_view(*bytes).substr(sizeof header);
  if (std::string_view(header.magic, sizeof header.magic) != kBinaryMagic ||
      std::string_view(header.key, kKeyLength) != key || header.bytes != body.size() ||
      header.checksum != base::hashBytes(body) || (header.compute != 0) != compute)
    return reject();
  ProgramBinary binary;
  binary.format = header.format;
  binary.bytes.resize(body.size());
  std::memcpy(binary.bytes.data(), body.data(), body.size());
  std::optional<Program> program = Program::load(binary, compute, label);
  if (!program) return reject();
  ++stats_.binaryLoads;
  touchBinary(pathOf(key));
  return program;
}

void ProgramCache::storeBinary(const std::string& key, bool compute, const Program& program) {
  if (options_.folder.empty()) return;
  const std::optional<ProgramBinary> binary = program.binary();
  if (!binary) return;
  BinaryHeader header;
  std::memcpy(header.magic, kBinaryMagic.data(), kBinaryMagic.size());
  std::memcpy(header.key, key.data(), kKeyLength);
  header.format = binary->format;
  header.compute = compute;
  header.bytes = binary->bytes.size();
  const std::string_view body(reinterpret_cast<const char*>(binary->bytes.data()), binary->bytes.size());
  header.checksum = base::hashBytes(body);
  std::string file(sizeof header, '\0');
  std::memcpy(file.data(), &header, sizeof header);
  file.append(body);
  // What is no file would be written to as it is, and a pipe waits for a reader.
  std::error_code ec;
  if (const auto there = std::filesystem::status(pathOf(key), ec); exists(there) && !is_regular_file(there))
    return;
  Diagnostics unwritten;  // a cache that cannot be written is slow, not wrong
  if (!base::writeFile(pathOf(key), file, unwritten)) return;
  ++stats_.binaryWrites;
  boundFolder(file.size());
}

// Looks at the folder with the first binary of this process, then when what it knows of and wrote itself is too much.
void ProgramCache::boundFolder(std::uint64_t written) {
  const std::uint64_t most = options_.folderBytes;
  if (folderBytes_) *folderBytes_ += written;
  if (folderBytes_.value_or(~0ull) <= most) return;
  const BinaryFolderUse use = pruneBinaries(options_.folder, most);
  folderBytes_ = use.bytes;
  stats_.binaryRemovals += use.removed;
}

}  // namespace weft::gl
