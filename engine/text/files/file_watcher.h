// Says which of a set of files were written, replaced, made or removed since it was asked last, by inotify on their folders: editors
// replace files by renaming, so a watch on the file itself would look at the old one. Files, and folders on the way to them, need
// not exist yet. Asking costs one read() when nothing happened; no file is looked at. Of what inotify does not tell (no instance or
// watch is left, or the folder may not be read) nothing is known, and a note says so once. It does not tell what other machines
// write to a network mount.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/text/diagnostic.h"

namespace weft::text {

class FileWatcher {
 public:
  FileWatcher();
  ~FileWatcher();
  FileWatcher(const FileWatcher&) = delete;
  FileWatcher& operator=(const FileWatcher&) = delete;

  // Readable when something happened since the last watch() or poll(); -1 when it never is. Ask poll() before waiting for it: watch()
  // keeps what happened before. Not to be read.
  int descriptor() const { return descriptor_; }

  // Replaces the set. Names that were watched before keep what has happened to them and was not asked for yet.
  void watch(std::vector<std::string> files);

  // The names, as given to watch(), of the files that changed; each once, sorted. Never blocks.
  std::vector<std::string> poll();

  // A file that is not watched, and why (W205), as a note; once in the life of this.
  Diagnostics takeNotices() { return std::exchange(notices_, {}); }

 private:
  void arm();
  void armFile(const std::string& absolute, const std::string& given);
  void tell(int error, const std::string& file);

  int descriptor_ = -1;
  int error_ = 0;  // why there is no descriptor
  bool told_ = false;
  Diagnostics notices_;
  std::vector<std::string> files_;                // as given
  std::map<int, std::set<std::string>> folders_;  // by watch descriptor; more than one name through links
  std::map<std::string, std::set<std::string>> watched_;  // absolute path to the names given
  std::set<std::string> awaited_;                         // folders on the way that are not there yet
  std::set<std::string> changed_;
};

}  // namespace weft::text
