// Files that belong together and appear together: each is written beside its name first, and all are renamed once all are
// written. So a full disk leaves none of them, and no folder that was made for them. Where a rename fails, those before it are
// undone. Does not: say what a file may replace.
#pragma once

#include <functional>
#include <string>
#include <system_error>
#include <vector>

#include "engine/base/diagnostic.h"

namespace weft::app {

class FileBatch {
 public:
  FileBatch() = default;
  FileBatch(const FileBatch&) = delete;
  FileBatch& operator=(const FileBatch&) = delete;
  // Removes what was written and not published.
  ~FileBatch();

  // Makes the folder of `path`, and has `writer` write the file under the name that it is given. False after W180, in which
  // the file has its own name.
  using Writer = std::function<bool(const std::string& temporary, base::Diagnostics& diagnostics)>;
  bool write(const std::string& path, const Writer& writer, base::Diagnostics& diagnostics);
  bool writeText(const std::string& path, const std::string& text, base::Diagnostics& diagnostics);

  // Renames all of them. A file that is there keeps its permissions, and a link still leads to it. False after W180, which names
  // what could not be undone: files that were replaced on a disk without hard links.
  bool publish(base::Diagnostics& diagnostics);

 private:
  struct Written {
    std::string path, target, temporary;  // as named; behind links; where the bytes are
    std::string before;                   // what the target was, while that can be undone
    bool replaces = false;                // the target was there
  };
  bool rename(Written& file, std::error_code& ec) const;
  void undo(const Written& file, std::string& lost) const;
  bool makeFolder(const std::string& path, base::Diagnostics& diagnostics);

  std::vector<Written> files_;
  std::vector<std::string> folders_;  // that were made, outer ones first
};

}  // namespace weft::app
