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

// A second name for a file; a copy, on a disk without hard links.
bool keep(const std::string& path, const std::string& kept, std::error_code& ec) {
  fs::create_hard_link(path, kept, ec);
  if (!ec) return true;
  ec.clear();
  fs::copy_file(path, kept, ec);
  std::error_code ignored;
  if (ec) fs::remove(kept, ignored);  // half of one
  return !ec;
}

}  // namespace

FileBatch::~FileBatch() {
  std::error_code ignored;
  for (const Written& file : files_)
    for (const std::string& each : {file.temporary, file.before})
      if (!each.empty()) fs::remove(each, ignored);
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

bool FileBatch::rename(Written& file, bool isLast, std::error_code& ec) const {
  std::error_code none;
  const auto before = fs::status(file.target, none);
  const bool replaces = fs::is_regular_file(before);
  if (file.temporary.empty()) {
    if (!replaces) return true;
    const std::string kept = nameBeside(file.target);
    fs::rename(file.target, kept, ec);
    if (!ec) file.before = kept;
    return !ec;
  }
  if (replaces) fs::permissions(file.temporary, before.permissions(), none);
  if (replaces && !isLast) {  // nothing comes behind the last one for which it would be undone
    const std::string kept = nameBeside(file.target);
    if (!keep(file.target, kept, ec)) return false;
    file.before = kept;
  }
  fs::rename(file.temporary, file.target, ec);
  return !ec;
}

void FileBatch::undo(Written& file, std::string& left) const {
  std::error_code ec;
  const bool replaced = !file.before.empty();
  if (replaced)
    fs::rename(file.before, file.target, ec);
  else if (!file.temporary.empty())
    fs::remove(file.target, ec);
  if (!ec) return;
  left += left.empty() ? "" : "; ";
  left += replaced
              ? fmt::format("'{}' cannot be put back, and what it was is in '{}'", file.path, file.before)
              : fmt::format("'{}' is written, and cannot be removed", file.path);
  file.before.clear();  // not to be removed
}

bool FileBatch::publish(base::Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < files_.size(); ++i) {
    std::error_code ec;
    if (rename(files_[i], i + 1 == files_.size(), ec)) continue;
    std::string left;
    for (std::size_t k = i; k-- > 0;) undo(files_[k], left);
    auto& d = diagnostics.error(
        base::Code::outputNotWritten, {std::make_shared<const std::string>(files_[i].path), 0, 0},
        fmt::format("cannot {} '{}': {}", files_[i].temporary.empty() ? "remove" : "write", files_[i].path,
                    ec.message()));
    d.found = left;
    d.hint = left.empty() ? "name a folder that can be written to"
                          : "put these files back by hand, and name a folder that can be written to";
    return false;
  }
  std::error_code ignored;
  for (const Written& file : files_)
    if (!file.before.empty()) fs::remove(file.before, ignored);
  files_.clear();
  folders_.clear();
  return true;
}

}  // namespace weft::app
