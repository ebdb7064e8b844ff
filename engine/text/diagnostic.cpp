#include "engine/text/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <tuple>
#include <unordered_set>

#include "engine/text/printable.h"

namespace weft::text {

namespace {

const std::string& textOf(FileName file) {
  static const std::string none;
  return file ? *file : none;
}

auto keyOf(const Diagnostic& d) {
  const Where& at = d.place;
  return std::tie(textOf(at.file), at.option, at.line, at.column);
}

// A text of any length fits on a screen, and is one line.
std::string printedText(const std::string& text) {
  return printable(shortened(text));
}

// Of one place with one fix: said of each pass that is like another, and of each include of one file.
bool sameMistake(const Diagnostic& a, const Diagnostic& b) {
  return a.code == b.code && a.severity == b.severity && keyOf(a) == keyOf(b) &&
         (a.message == b.message ||
          (a.place.line > 0 && !a.hint.empty() && a.hint == b.hint && a.found == b.found));
}

}  // namespace

FileName::FileName(const std::string& path) {
  static std::mutex mutex;
  static auto& paths =
      *new std::unordered_set<std::string>;  // never destroyed: whatever ends later may name files
  const std::lock_guard lock(mutex);
  path_ = &*paths.insert(path).first;
}

Where placeOfOption(std::string option) {
  Where where;
  where.option = std::move(option);
  return where;
}

bool isKnown(const Where& where) {
  return where.file || where.option;
}

std::string nameOf(Code code) {
  return fmt::format("W{:03}", static_cast<unsigned>(code));
}

const char* nameOf(Severity severity) {
  return severity == Severity::error ? "error" : severity == Severity::warning ? "warning" : "note";
}

std::string format(const Diagnostic& d) {
  std::string out;
  if (const auto& option = d.place.option) {
    out += "command line: ";
    if (!option->empty()) out += printedText(*option) + ": ";
  } else if (d.place.file && !d.place.file->empty()) {
    // A file without a line may be one that was named in an option, of any length.
    out += d.place.line > 0 ? printable(*d.place.file) : printedText(*d.place.file);
    if (d.place.line > 0) out += fmt::format(":{}", d.place.line);
    if (d.place.line > 0 && d.place.column > 0) out += fmt::format(":{}", d.place.column);
    out += ": ";
  }
  out += fmt::format("{}[{}]: {}", nameOf(d.severity), nameOf(d.code), printedText(d.message));
  const auto line = [&](const char* label, const std::string& text) {
    if (!text.empty()) out += fmt::format("\n    {}: {}", label, printedText(text));
  };
  line("pass", d.pass);
  line("resource", d.resource);
  line("expected", d.expected);
  line("found", d.found);
  line("fix", d.hint);
  return out;
}

Diagnostic diagnosticOf(const Sentence& sentence, fmt::format_args args) {
  const auto filled = [&](const char* text) { return fmt::vformat(text, args); };
  Diagnostic made;
  made.code = sentence.code;
  made.message = filled(sentence.message);
  made.expected = filled(sentence.expected);
  made.found = filled(sentence.found);
  made.hint = filled(sentence.hint);
  made.resource = filled(sentence.resource);
  made.pass = filled(sentence.pass);
  return made;
}

Diagnostic& Diagnostics::add(Diagnostic diagnostic) {
  if (diagnostic.severity == Severity::error) ++errors_;
  items_.push_back(std::move(diagnostic));
  return items_.back();
}

Diagnostic& Diagnostics::add(Severity severity, Diagnostic said, Where place) {
  said.severity = severity;
  said.place = std::move(place);
  return add(std::move(said));
}

void Diagnostics::append(const Diagnostics& others) {
  items_.insert(items_.end(), others.items_.begin(), others.items_.end());
  errors_ += others.errors_;
}

bool Diagnostics::contains(Code code) const {
  return std::any_of(items_.begin(), items_.end(), [&](const Diagnostic& d) { return d.code == code; });
}

void Diagnostics::clear() {
  items_.clear();
  errors_ = 0;
}

void Diagnostics::sortByPlace() {
  std::stable_sort(items_.begin(), items_.end(),
                   [](const Diagnostic& a, const Diagnostic& b) { return keyOf(a) < keyOf(b); });
  items_.erase(std::unique(items_.begin(), items_.end(), sameMistake), items_.end());
  errors_ = static_cast<std::size_t>(std::count_if(
      items_.begin(), items_.end(), [](const Diagnostic& d) { return d.severity == Severity::error; }));
}

std::string Diagnostics::text() const {
  std::string out;
  for (const Diagnostic& d : items_) out += format(d) + "\n";
  return out;
}

}  // namespace weft::text
