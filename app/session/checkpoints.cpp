#include "app/session/checkpoints.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <fstream>
#include <functional>
#include <map>
#include <span>

#include "app/output/output_files.h"
#include "app_sentences.h"
#include "engine/runtime/storage/state_stream.h"
#include "engine/text/chars.h"
#include "engine/text/hash.h"
#include "engine/text/printable.h"

namespace weft::app {

namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t kMagic = 0x3174'706b'6374'6677;  // "wftckpt1"
// Of a file besides the contents of textures and buffers: more than the numbers of a graph within its limits take.
constexpr std::uint64_t kMostNumbers = 64u << 20;

// "studio_000050.checkpoint"
std::string nameOf(const std::string& graph, std::uint32_t frame) {
  return fmt::format("{}_{:06}{}", fs::path(graph).stem().string(), frame, kCheckpointEnding);
}

// The checkpoints of a graph in a folder, by their frames, the last first.
std::map<std::uint32_t, std::string, std::greater<>> checkpointsIn(const std::string& folder,
                                                                   const std::string& graph) {
  std::map<std::uint32_t, std::string, std::greater<>> found;
  std::error_code ec;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, ec), end; !ec && entry != end;
       entry.increment(ec)) {
    const std::string name = entry->path().filename().string();
    const std::size_t number = name.rfind('_') + 1;
    const auto frame = text::numberIn<std::uint32_t>(std::string_view(name).substr(
        number, name.size() - std::min(name.size(), number + kCheckpointEnding.size())));
    if (frame && name == nameOf(graph, *frame)) found[*frame] = entry->path().string();
  }
  return found;
}

}  // namespace

// The first bytes of a file. Behind the state, which follows, is a checksum of all before it.
struct Checkpoints::Header {
  std::uint64_t magic = kMagic, size = 0;
  std::uint32_t frame = 0;
  Key key;

  void carry(runtime::StateStream& stream) {
    for (std::uint64_t* each : {&magic, &size, &key.settings, &key.build, &key.driver}) stream.carry(*each);
    stream.carry(frame);
  }
  static constexpr std::size_t kBytes = 5 * 8 + 4, kAround = kBytes + 8;
};

void CheckpointOptions::add(CLI::App& command) {
  command.add_option("--checkpoint", every, "save what later frames depend on, after every so many frames")
      ->check(CLI::Range(1u, ~0u));
  addPath(
      command, "--checkpoints", where,
      "where they are saved and found (default: checkpoints, beside the output), or the one to begin with",
      "FOLDER");
}

CheckpointOptions CheckpointOptions::beside(const std::string& output) const {
  return {every, where.empty() ? (fs::path(output).parent_path() / "checkpoints").string() : where,
          !where.empty()};
}

// Why the file is no checkpoint for this run, or "". Most that do not fit say so in their first bytes.
std::string Checkpoints::problemOf(const std::string& path, std::string& bytes, Header& header) const {
  std::error_code ec;
  if (!fs::is_regular_file(path, ec)) return "cannot be read";
  const auto misfit = [&]() -> const char* {
    runtime::StateStream stream(bytes);
    header.carry(stream);
    return !stream.good() || header.magic != kMagic ? "is no checkpoint"
           : header.key.build != key_.build         ? "is of another build of Weft"
           : header.key.driver != key_.driver       ? "is of another driver"
           : header.key.settings != key_.settings   ? "is of other files or options"
                                                    : nullptr;
  };
  bytes.resize(Header::kBytes);
  std::ifstream(path, std::ios::binary).read(bytes.data(), Header::kBytes);
  if (const char* const problem = misfit()) return problem;
  const graph::Plan& plan = session_.renderer.execution()->plan();
  text::chooseFile(path);
  text::Diagnostics unread;
  std::uint64_t size = 0;
  auto read = text::readWithin(path, 2 * plan.bytesAllocated + kMostNumbers, size, unread,
                               text::Code::unreadableFile, {});
  if (!read) return unread.empty() ? "is larger than one of this graph" : "cannot be read";
  bytes = *std::move(read);
  if (const char* const problem = misfit()) return problem;  // another file by now
  if (bytes.size() < Header::kAround || header.size != bytes.size() - Header::kAround) return "is not whole";
  std::uint64_t checksum = 0;
  runtime::StateStream end(std::string_view(bytes).substr(bytes.size() - sizeof checksum));
  end.carry(checksum);
  return checksum == text::hashBytes(std::string_view(bytes).substr(0, bytes.size() - sizeof checksum))
             ? ""
             : "is damaged";
}

std::uint32_t Checkpoints::begin(std::uint32_t first, text::Diagnostics& diagnostics) {
  runtime::Execution& execution = *session_.renderer.execution();
  if (!execution.remembers(world_)) return first;
  saves_ = wish_.every > 0;
  if (saves_ && !execution.canSave(world_, diagnostics)) return first;
  auto found = checkpointsIn(folder_, options_.graph);
  if (named_) found = {{first, wish_.where}};
  if (std::error_code ec; wish_.chosen && !saves_ && !named_ && !fs::is_directory(folder_, ec))
    diagnostics.warning(say::noCheckpointFolder, {folder_}, folder_);
  if (!saves_ && found.empty()) return 0;
  std::string kept;  // they change the plan
  for (const graph::Pick& pick : options_.kept) kept += pick.text + "\n";
  key_ = {.settings = text::hashBytes(kept, hashOfSettings(options_, session_)),
          .build = hashOfProgram(),
          .driver = text::hashBytes(session_.context->device().driverKey)};
  std::uint32_t begin = 0;
  std::vector<std::string> unfit;
  for (auto each = found.lower_bound(first); each != found.end() && begin == 0; ++each) {
    const auto& [frame, path] = *each;
    std::string bytes;
    Header header;
    std::string problem = problemOf(path, bytes, header);
    if (problem.empty() && (header.frame == 0 || (named_ ? header.frame > first : header.frame != frame)))
      problem = fmt::format("is of frame {}", header.frame);
    if (!problem.empty()) {
      unfit.push_back(fmt::format("'{}' {}", path, problem));
      continue;
    }
    begin = header.frame;
    if (!execution.restore(std::string_view(bytes).substr(Header::kBytes, header.size), world_,
                           runtime::headlessFrame(world_, begin - 1, options_.fps, options_.pointer),
                           diagnostics))
      diagnostics.error(say::checkpointOfOtherState, {path}, path);
  }
  if (unfit.empty()) return begin;
  if (named_)
    diagnostics.error(say::checkpointUnfit, {wish_.where}, unfit[0]);
  else
    diagnostics.warning(say::checkpointsUnfit, {folder_}, text::counted(unfit.size(), "checkpoint"),
                        fmt::join(std::span(unfit).first(std::min<std::size_t>(unfit.size(), 3)), ", "),
                        unfit.size() > 3 ? ", …" : "", begin);
  return begin;
}

bool Checkpoints::save(std::uint32_t frame, text::Diagnostics& diagnostics) {
  const std::uint32_t next = frame + 1;
  if (!saves_ || next == 0 || next % wish_.every != 0) return true;
  const std::string path = (fs::path(folder_) / nameOf(options_.graph, next)).string();
  std::error_code ec;
  const fs::file_status there = fs::symlink_status(path, ec);
  if (fs::exists(there) && !fs::is_regular_file(there))
    return refuseOutput(diagnostics, say::checkpointNotPlain, path, path);
  const std::optional<std::string> state = session_.renderer.execution()->save(diagnostics);
  if (!state) return refuseOutput(diagnostics, say::importIsChanging, path, next);
  runtime::StateStream head, end;
  Header{.size = state->size(), .frame = next, .key = key_}.carry(head);
  std::string bytes = std::move(head).bytes() + *state;
  std::uint64_t checksum = text::hashBytes(bytes);
  end.carry(checksum);
  return makeFolderOf(path, diagnostics) &&
         text::writeFile(path, bytes + std::move(end).bytes(), diagnostics);
}

}  // namespace weft::app
