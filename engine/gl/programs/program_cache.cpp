#include "engine/gl/programs/program_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <filesystem>

#include "engine/glsl/interface.h"
#include "engine/text/files/file.h"
#include "engine/text/hash.h"

namespace weft::gl {

namespace {

using text::Diagnostics;

constexpr std::size_t kBinaryKeyLength = 32;

bool hasBinaryName(const std::string& name) {
  return name.size() == kBinaryKeyLength + 4 && name.ends_with(".bin") &&
         name.find_first_not_of("0123456789abcdef") == kBinaryKeyLength;
}

// What stands before the binary in its file. The checksum keeps damaged bytes, and formats that the driver has not, away from it.
struct BinaryHeader {
  std::uint64_t format = 0, checksum = 0;
};

std::uint64_t checksumOf(const std::string& key, std::uint64_t format, std::string_view bytes) {
  return text::hashBytes(bytes, text::hashCombine(text::hashBytes(key), format));
}

std::string makeKey(const std::vector<StageSource>& stages, const ProgramRequest& request,
                    const DeviceInfo& device) {
  std::string text = device.driverKey + nameOf(device.backend);
  const auto add = [&](std::string_view part) { text += fmt::format("\n{}:{}", part.size(), part); };
  for (const StageSource& stage : stages)
    text += fmt::format("\n{:x} {:016x} {}{}", stage.stage, stage.source->hash, stage.source->text.size(),
                        stage.clamped ? " clamped" : "");
  for (const glsl::Define& define : request.defines) {
    add(define.name);
    add(define.value);
  }
  text += "\noutputs";
  for (const std::string& output : request.outputs) add(output);
  const std::uint64_t first = text::hashBytes(text);
  return fmt::format("{:016x}{:016x}", first, text::hashBytes(text, text::hashCombine(first, text.size())));
}

void appendFor(const ProgramRequest& request, const Diagnostics& from, Diagnostics& to) {
  for (text::Diagnostic diagnostic : from.items()) {
    if (diagnostic.pass.empty()) diagnostic.pass = request.pass;
    to.add(std::move(diagnostic));
  }
}

}  // namespace

ProgramCache::ProgramCache(const DeviceInfo& device, glsl::SourceLoader& loader, Options options)
    : device_(device), loader_(loader), options_(std::move(options)) {
  trials_ = {.command = options_.trial, .seconds = options_.trialSeconds};
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
    const bool clamped = device_.software && stage.stage == GL_COMPUTE_SHADER;
    if (source) stages.push_back({stage.stage, std::move(source), clamped});
  }
  appendFor(request, found, diagnostics);
  if (stages.size() != request.stages.size()) return nullptr;

  const std::string key = makeKey(stages, request, device_);
  if (const auto known = known_.find(key); known != known_.end()) {
    ++stats_.hits;
    appendFor(request, known->second.said, diagnostics);
    return known->second.variant;
  }
  ++stats_.misses;
  if (known_.size() >= options_.capacity)
    std::erase_if(known_, [](const auto& each) { return each.second.variant.use_count() <= 1; });
  const Entry& made = known_[key] = make(std::move(stages), key, request);
  appendFor(request, made.said, diagnostics);
  return made.variant;
}

ProgramCache::Entry ProgramCache::make(std::vector<StageSource> stages, const std::string& key,
                                       const ProgramRequest& request) {
  Entry made;
  bool good = true, unusual = false;
  for (const StageSource& stage : stages) {
    const glsl::Interface& interface = stage.source->interfaceWith(request.defines);
    good &= glsl::checkShaderSize(interface.size, *stage.source, made.said);
    unusual |= glsl::isUnusual(interface);
  }
  const bool compute = stages.front().stage == GL_COMPUTE_SHADER;
  std::optional<Program> program;
  if (good) program = loadBinary(key, compute, request.label);
  if (good && !program && unusual && !trials_.command.empty()) {
    ++stats_.trials;
    good = survivesTrial(trials_, device_, stages, request.defines, request.outputs, made.said);
  }
  if (!good) {
    ++stats_.refusals;
    return made;
  }
  if (!program) {
    ++stats_.compilations;
    program = Program::compile(stages, request.defines, request.outputs, request.label, made.said);
    if (!program) {
      ++stats_.failures;
      return made;
    }
    storeBinary(key, *program);
  }
  made.variant =
      std::make_shared<const Variant>(Variant{std::move(*program), std::move(stages), key, request.defines});
  return made;
}

std::optional<Program> ProgramCache::loadBinary(const std::string& key, bool compute,
                                                std::string_view label) {
  if (options_.folder.empty()) return std::nullopt;
  std::error_code ec;
  if (!std::filesystem::is_regular_file(pathOf(key), ec)) return std::nullopt;
  Diagnostics unread;  // a binary that cannot be read is a miss
  const std::optional<std::string> bytes = text::readFile(pathOf(key), unread);
  const auto reject = [&]() -> std::optional<Program> {
    ++stats_.binaryRejects;
    return std::nullopt;
  };
  if (!bytes || bytes->size() < sizeof(BinaryHeader)) return reject();
  BinaryHeader header;
  std::memcpy(&header, bytes->data(), sizeof header);
  const std::string body = bytes->substr(sizeof header);
  if (header.checksum != checksumOf(key, header.format, body)) return reject();
  std::optional<Program> program = Program::load({static_cast<GLenum>(header.format), body}, compute, label);
  if (!program) return reject();
  ++stats_.binaryLoads;
  ::utimensat(AT_FDCWD, pathOf(key).c_str(), nullptr, 0);  // it was used now
  return program;
}

void ProgramCache::storeBinary(const std::string& key, const Program& program) {
  if (options_.folder.empty()) return;
  const std::optional<ProgramBinary> binary = program.binary();
  if (!binary) return;
  const BinaryHeader header{binary->format, checksumOf(key, binary->format, binary->bytes)};
  const std::string file = std::string(reinterpret_cast<const char*>(&header), sizeof header) + binary->bytes;
  // What is no file would be written to as it is, and a pipe waits for a reader.
  std::error_code ec;
  if (const auto there = std::filesystem::status(pathOf(key), ec); exists(there) && !is_regular_file(there))
    return;
  Diagnostics unwritten;  // a cache that cannot be written is slow, not wrong
  if (!text::writeFile(pathOf(key), file, unwritten)) return;
  if (stats_.binaryWrites++ == 0) pruneBinaries(options_.folder, options_.folderBytes);
}

std::size_t pruneBinaries(const std::string& folder, std::uint64_t most) {
  struct Binary {
    std::filesystem::file_time_type used;
    std::filesystem::path path;
    std::uint64_t bytes = 0;
  };
  std::vector<Binary> all;
  std::uint64_t bytes = 0;
  std::error_code ec;
  for (std::filesystem::directory_iterator it(folder, ec), end; !ec && it != end; it.increment(ec)) {
    std::error_code gone;  // others may remove it meanwhile
    if (!hasBinaryName(it->path().filename().string()) || it->is_symlink(gone) || !it->is_regular_file(gone))
      continue;
    const Binary binary{it->last_write_time(gone), it->path(), it->file_size(gone)};
    if (gone) continue;
    bytes += binary.bytes;
    all.push_back(binary);
  }
  if (bytes <= most) return 0;
  std::ranges::sort(all, {}, [](const Binary& binary) { return std::tie(binary.used, binary.path); });
  std::size_t removed = 0;
  for (const Binary& binary : all) {
    if (bytes <= most - most / 8) break;
    removed += std::filesystem::remove(binary.path, ec);
    if (!ec) bytes -= binary.bytes;  // else it may not be removed
  }
  return removed;
}

}  // namespace weft::gl
