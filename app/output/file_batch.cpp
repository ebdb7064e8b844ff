#include "app/output/file_batch.h"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <memory>
#include <ranges>
#include <utility>

#include "app/output/output_files.h"
#include "engine/base/files/file.h"

namespace weft::app {

namespace fs = std::filesystem;

namespace {

// A name that no other file of the folder has, however long that of `path` is. An earlier process of the same number may have
// left files.
std::string nameBeside(const std::string& path) {
  static std::atomic<unsigned> made = 0;
  for (;;) {
    const fs::path name = fs::path(path).parent_path() / fmt::format(".weft.{}.{}", ::getpid(), ++made);
    std::error_code ignored;
    if (!fs::exists(fs::symlink_status(name, ignored))) return name.string();
  }
}

}  // namespace

FileBatch::~FileBatch() {
  std::error_code ignored;
  for (const Written& file : files_)
    if (!file.temporary.empty()) fs::remove(file.temporary, ignored);
  for (const std::string& folder : std::views::reverse(folders_))
    fs::remove(folder, ignored);  // an empty one
}

bool FileBatch::makeFolder(const std::string& path, base::Diagnostics& diagnostics) {
  std::vector<std::string> missing;
  std::error_code ignored;
  for (fs::path folder = fs::path(path).parent_path(); !folder.empty() && !fs::exists(folder, ignored);
       folder = folder.parent_path())
    missing.push_back(folder.string());
  if (!makeFolderOf(path, diagnostics)) return false;
  folders_.insert(folders_.end(), missing.rbegin(), missing.rend());
  return true;
}

bool FileBatch::write(const std::string& path, const Writer& writer, base::Diagnostics& diagnostics) {
  if (!makeFolder(path, diagnostics) || !checkMadeFiles({&path, 1}, {}, "", diagnostics)) return false;
  std::error_code ec;
  const fs::path behind = fs::canonical(path, ec);
  Written file{.path = path, .target = ec ? path : behind.string()};
  file.temporary = nameBeside(file.target);
  base::Diagnostics said;
  const bool written = writer(file.temporary, said);
  for (base::Diagnostic each : said.items()) {
    for (std::size_t at = each.message.find(file.temporary); at != std::string::npos;
         at = each.message.find(file.temporary, at + path.size()))
      each.message.replace(at, file.temporary.size(), path);
    if (each.place.file && *each.place.file == file.temporary)
      each.place.file = std::make_shared<const std::string>(path);
    diagnostics.add(std::move(each));
  }
  files_.push_back(std::move(file));
  return written;
}

bool FileBatch::writeText(const std::string& path, const std::string& text, base::Diagnostics& diagnostics) {
  return write(
      path,
      [&](const std::string& temporary, base::Diagnostics& said) {
        return base::writeFile(temporary, text, said);
      },
      diagnostics);
}

void FileBatch::remove(const std::string& path) {
  files_.push_back({.path = path, .target = path});
}

bool FileBatch::publish(base::Diagnostics& diagnostics) {
  for (const Written& file : files_) {
    std::error_code ec, none;
    const auto before = fs::status(file.target, none);
    if (file.temporary.empty() && fs::is_regular_file(before)) fs::remove(file.target, ec);
    if (!file.temporary.empty()) {
      if (fs::is_regular_file(before)) fs::permissions(file.temporary, before.permissions(), none);
      fs::rename(file.temporary, file.target, ec);
    }
    if (!ec) continue;
    diagnostics
        .error(base::Code::outputNotWritten, {std::make_shared<const std::string>(file.path), 0, 0},
               fmt::format("cannot {} '{}': {}", file.temporary.empty() ? "remove" : "write", file.path,
                           ec.message()))
        .hint = "name a folder that can be written to";
    return false;
  }
  files_.clear();
  folders_.clear();
  return true;
}

}  // namespace weft::app
