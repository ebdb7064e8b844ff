// Author mistakes as values: what is wrong, where, what was expected, what was found, and what would fix it.
// Functions that read what a person wrote take a Diagnostics&, report everything they find and return an empty
// optional (or false) when the result cannot be used. Nothing here throws, aborts or prints.
#pragma once

#include <fmt/core.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "engine/text/codes.h"

namespace weft::text {

// The path of a file as the person would write it, or none. Each path is kept once, as long as the program runs, so that
// names of files are copied and compared like numbers. Threads may make them at the same time.
class FileName {
 public:
  FileName() = default;
  FileName(const std::string& path);                           // NOLINT: a path names a file
  FileName(const char* path) : FileName(std::string(path)) {}  // NOLINT
  FileName(std::nullptr_t) = delete;                           // {} is no file
  explicit operator bool() const { return path_; }
  const std::string& operator*() const { return *path_; }
  const std::string* operator->() const { return path_; }
  friend bool operator==(FileName, FileName) = default;

 private:
  const std::string* path_ = nullptr;
};

// A place in a text file. Lines and columns count from 1, columns in bytes; 0 means unknown. There may be millions.
struct Place {
  FileName file;
  std::uint32_t line = 0;
  std::uint32_t column = 0;
  // So many bytes further on in its line; an unknown column stays unknown.
  Place after(std::size_t bytes) const {
    return {file, line, column > 0 ? column + static_cast<std::uint32_t>(bytes) : 0};
  }
  friend bool operator==(const Place&, const Place&) = default;
};

// Where a diagnostic or the value of a parameter stands: in a file, in an option of the command line, or nowhere. A Place
// becomes one by itself, but not the other way round, which would lose the option.
struct Where : private Place {
  using Place::column;
  using Place::file;
  using Place::line;
  std::optional<std::string> option;  // as it was written, "--set bloom=yes"; then there is no file

  Where() = default;
  Where(Place place) : Place(place) {}  // NOLINT: a place in a file says where
  Where(FileName path, std::uint32_t atLine = 0, std::uint32_t atColumn = 0)
      : Place{path, atLine, atColumn} {}

  const Place& inFile() const { return *this; }
};

// Whether it says anything: a file or an option.
bool isKnown(const Where& where);

// Messages print it as "command line: --set bloom=yes", and that of "" as "command line".
Where placeOfOption(std::string option);

enum class Severity : std::uint8_t { note, warning, error };
const char* nameOf(Severity severity);  // "note", "warning", "error"

struct Diagnostic {
  Severity severity = Severity::error;
  Code code{};
  std::string message;  // one sentence, no full stop, names the thing: "pass 'fxaa' reads unknown 'ldrr'"
  Where place{};
  // All may be empty.
  std::string expected{};  // "a number from 0 to 8"
  std::string found{};     // "\"high\""
  std::string hint{};      // the fix: "did you mean 'ldr'?"
  std::string resource{};  // the resource concerned
  std::string pass{};      // full instance name of the pass concerned
  std::string pointer{};   // JSON pointer of the value where its place does not say it: in a binary file
};

// What is said of one kind of mistake: a row of the sentences.json of a room, "texture '{0}' has the unknown format '{1}'". Each text is
// one of fmt, and has the same arguments.
struct Sentence {
  Code code{};
  const char *message = "", *expected = "", *found = "", *hint = "", *resource = "", *pass = "";
};
// A sentence that fits arguments of these types: the compiler checks it, as it checks those of fmt::format().
template <class... Args>
struct SentenceFor {
  const Sentence& sentence;
  consteval SentenceFor(const Sentence& row) : sentence(row) {  // NOLINT: as fmt::format_string
    for (const char* text : {row.message, row.expected, row.found, row.hint, row.resource, row.pass})
      static_cast<void>(fmt::format_string<Args...>(text));
  }
};
template <class... Args>
using Saying = SentenceFor<std::type_identity_t<Args>...>;
// Without a severity and a place.
Diagnostic diagnosticOf(const Sentence& sentence, fmt::format_args args);

// "file:line:column: error[W040]: message", followed by indented lines for pass, resource, expected, found and fix. Parts of
// the place that are unknown are left out.
std::string format(const Diagnostic& diagnostic);

// "W040"
std::string nameOf(Code code);

// An ordered collection. Warnings and notes do not make it fail.
class Diagnostics {
 public:
  // Adds and returns the stored diagnostic so that optional fields can be filled in.
  Diagnostic& add(Diagnostic diagnostic);
  template <class... Args>
  Diagnostic& add(Severity severity, Saying<Args...> what, Where place, Args&&... args) {
    return add(severity, diagnosticOf(what.sentence, fmt::make_format_args(args...)), std::move(place));
  }
  template <class... Args>
  Diagnostic& error(Saying<Args...> what, Where place, Args&&... args) {
    return add(Severity::error, diagnosticOf(what.sentence, fmt::make_format_args(args...)),
               std::move(place));
  }
  template <class... Args>
  Diagnostic& warning(Saying<Args...> what, Where place, Args&&... args) {
    return add(Severity::warning, diagnosticOf(what.sentence, fmt::make_format_args(args...)),
               std::move(place));
  }
  template <class... Args>
  Diagnostic& note(Saying<Args...> what, Where place, Args&&... args) {
    return add(Severity::note, diagnosticOf(what.sentence, fmt::make_format_args(args...)), std::move(place));
  }
  Diagnostic& add(Severity severity, Diagnostic said, Where place);
  void append(const Diagnostics& others);

  bool hasErrors() const { return errors_ > 0; }
  std::size_t errorCount() const { return errors_; }
  bool empty() const { return items_.empty(); }
  std::size_t size() const { return items_.size(); }
  const std::vector<Diagnostic>& items() const { return items_; }
  bool contains(Code code) const;
  void clear();

  // Orders by file, line, column; keeps the order of equal places; drops exact repeats.
  void sortByPlace();

  // All diagnostics formatted, one after another, each ending in a newline.
  std::string text() const;

 private:
  std::vector<Diagnostic> items_;
  std::size_t errors_ = 0;
};

}  // namespace weft::text
