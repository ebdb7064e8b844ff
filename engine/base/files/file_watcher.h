// Says which of a set of files were written, replaced, made or removed since it was asked last, by inotify on
// their folders: editors replace files by renaming, so a watch on the file itself would look at the old one.
// Files, and folders on the way to them, need not exist yet. Asking costs one read() when nothing happened;
// no file is looked at. What inotify does not tell of (no instance or watch is left, or the file lies on a
// network mount, where other machines write) is in poller(): somebody has to let it look, about twice a
// second (app/live/live_graph.cpp does). Does not: say which of these it was, read files, start threads, or
// wait for a save to be complete.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "engine/base/diagnostic.h"
#include "engine/base/files/file_poller.h"

namespace weft::base {

class FileWatcher {
 public:
  enum class Means : std::uint8_t { inotify, looking };
  // `looking`: as if the system gave no inotify instance.
  explicit FileWatcher(Means means = Means::inotify);
  ~FileWatcher();
  FileWatcher(const FileWatcher&) = delete;
  FileWatcher& operator=(const FileWatcher&) = delete;

  // False when the system gives no inotify instance: everything is in poller().
  bool works() const { return descriptor_ >= 0; }
  FilePoller& poller() { return poller_; }
  // Readable while poll() has something to look at; -1 when it never has. Not to be read.
  int descriptor() const { return descriptor_; }

  // Replaces the set. Names that were watched before keep what has happened to them and was not asked for
  // yet.
  void watch(std::vector<std::string> files);

  // The names, as given to watch(), of the files that changed; each once, sorted. Never blocks.
  std::vector<std::string> poll();

  // What has to be looked at, and why (W205), as notes; each reason once in the life of this.
  Diagnostics takeNotices();

 private:
  // Why a file is looked at.
  enum class Reason : std::uint8_t { told, no_instance, no_watch, unreadable, network };
  void arm();
  Reason armFile(const std::string& absolute, const std::string& given);
  void tell(Reason reason, const std::vector<std::string>& files);
  void note(const std::string& path, bool created);

  int descriptor_ = -1;
  int error_ = 0;  // why there is no descriptor
  FilePoller poller_;
  std::set<Reason> toldReasons_;
  Diagnostics notices_;
  std::vector<std::string> files_;                // as given
  std::map<int, std::set<std::string>> folders_;  // by watch descriptor; more than one name through links
  std::map<std::string, std::set<std::string>> watched_;  // absolute path to the names given
  std::set<std::string> awaited_;                         // folders on the way that are not there yet
  std::set<std::string> changed_;
};

}  // namespace weft::base
