// What imports read from files, by path: read again only when the file's time or size is another, and kept for both those
// who ask for facts and those who upload. Knows which paths were asked for, so that they can be watched.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <typeindex>
#include <utility>

#include "engine/text/diagnostic.h"

namespace weft::imports {

class Files {
 public:
  // What `read(path, diagnostics)` makes of the file, an optional<T>. Null after errors; the errors of a file that has not
  // changed are reported again.
  template <class T, class Read>
  std::shared_ptr<const T> get(const std::string& path, const Read& read, text::Diagnostics& diagnostics) {
    const auto readAny = [&](text::Diagnostics& said) -> std::shared_ptr<const void> {
      std::optional<T> made = read(path, said);
      return made ? std::make_shared<const T>(std::move(*made)) : nullptr;
    };
    return std::static_pointer_cast<const T>(getAny(path, typeid(T), readAny, diagnostics));
  }
  // Counts a file as asked for whose contents are not kept here.
  void touch(const std::string& path) { touched_.insert(path); }
  // The paths asked for since forgetTouched(), also of files that are not there.
  const std::set<std::string>& touched() const { return touched_; }
  void forgetTouched() { touched_.clear(); }

 private:
  using Stamp = std::pair<std::filesystem::file_time_type, std::uintmax_t>;  // time and size; of none, zeros
  struct Entry {
    Stamp stamp;
    std::shared_ptr<const void> made;
    text::Diagnostics said;
  };
  std::shared_ptr<const void> getAny(
      const std::string& path, std::type_index type,
      const std::function<std::shared_ptr<const void>(text::Diagnostics&)>& read,
      text::Diagnostics& diagnostics);
  std::map<std::pair<std::string, std::type_index>, Entry> entries_;
  std::set<std::string> touched_;
};

}  // namespace weft::imports
