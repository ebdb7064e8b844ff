// What was made of files: made again only when one of them has another time or size, or another unsaved text. Knows which paths
// were asked for, so that they can be watched.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "engine/text/diagnostic.h"
#include "engine/text/files/file.h"

namespace weft::text {

class FileCache {
 public:
  struct Entry {
    std::vector<FileStamp> stamps;  // from before reading: of the files, and of places looked at before
    std::shared_ptr<const void> made;
    Diagnostics said{};
  };
  // What `read(path, diagnostics)` makes of the file, an optional<T>. Null after errors, which are reported again each time.
  template <class T, class Read>
  std::shared_ptr<const T> get(const std::string& path, const Read& read, Diagnostics& diagnostics) {
    touch(path);
    const Entry* kept = find(path, typeid(T));
    if (!kept) {
      Entry entry{{stampOf(path)}, nullptr};
      if (std::optional<T> made = read(path, entry.said))
        entry.made = std::make_shared<const T>(std::move(*made));
      kept = &keep(path, typeid(T), std::move(entry));
    }
    diagnostics.append(kept->said);
    return std::static_pointer_cast<const T>(kept->made);
  }
  // What was kept under a name, and its files count as asked for; null when one of them is another now.
  const Entry* find(const std::string& name, std::type_index type) {
    const auto found = entries_.find({name, type});
    const auto isSame = [](const FileStamp& stamp) { return stampOf(stamp.path) == stamp; };
    if (found == entries_.end() || !std::ranges::all_of(found->second.stamps, isSame)) return nullptr;
    for (const FileStamp& stamp : found->second.stamps) touch(stamp.path);
    return &found->second;
  }
  const Entry& keep(const std::string& name, std::type_index type, Entry entry) {
    return entries_[{name, type}] = std::move(entry);
  }
  void clear() { entries_.clear(); }

  // Counts a file as asked for.
  void touch(const std::string& path) { touched_.insert(path); }
  // The paths asked for since forgetTouched(), also of files that are not there.
  const std::set<std::string>& touched() const { return touched_; }
  void forgetTouched() { touched_.clear(); }

 private:
  std::map<std::pair<std::string, std::type_index>, Entry> entries_;
  std::set<std::string> touched_;
};

}  // namespace weft::text
