// Files that belong together and appear together: each is written beside its name first, and all are renamed once all are
// written. So a full disk leaves none of them, and no folder that was made for them. Does not: say what a file may replace.
#pragma once

#include <functional>
#include <string>
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

  // The file, or the link to one, will be gone when the others have appeared; nothing happens where there is none.
  void remove(const std::string& path);

  // Renames all of them. A file that is there keeps its permissions, and a link still leads to it. False after W180.
  bool publish(base::Diagnostics& diagnostics);

 private:
  struct Written {
    std::string path, target;  // as named; behind links
    std::string temporary;     // where the bytes are; empty: the file is to be removed
  };
  bool makeFolder(const std::string& path, base::Diagnostics& diagnostics);

  std::vector<Written> files_;
  std::vector<std::string> folders_;  // that were made, outer ones first
};

}  // namespace weft::app
