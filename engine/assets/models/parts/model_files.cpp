#include "engine/assets/models/parts/model_files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include "assets_sentences.h"
#include "engine/text/files/file.h"
#include "engine/text/json/report.h"

namespace weft::assets {

using text::Code;
using text::Place;

namespace {

// RFC 3986, 3.1; also "C:" of Windows.
bool hasScheme(const std::string& name) {
  const auto end = std::ranges::find_if_not(
      name, [](unsigned char c) { return std::isalnum(c) || c == '+' || c == '-' || c == '.'; });
  return end != name.end() && *end == ':' && std::isalpha(static_cast<unsigned char>(name[0]));
}

bool leadsOut(const std::filesystem::path& relative) {
  const std::filesystem::path plain = relative.lexically_normal();
  return plain.empty() || plain.is_absolute() || *plain.begin() == "..";
}

}  // namespace

std::optional<std::string> ModelFiles::readModel() {
  return readCounted(path_, {}, Code::unreadableModel, diagnostics_);
}

std::string ModelFiles::resolve(const std::string& name) const {
  if (files_.size() > text::raised(kMaxModelFiles) || name.empty() || name.find('\0') != std::string::npos ||
      name.find('\\') != std::string::npos || hasScheme(name) || leadsOut(name))
    return "";
  const std::filesystem::path folder = std::filesystem::path(path_).parent_path();
  const std::string target = (folder / name).lexically_normal().string();
  // A link in the folder may lead out as well. What reading is confined to is looked at by whoever opens the file, first.
  if (!text::mayRead(target)) return target;
  std::error_code ec;
  const auto realOf = [&](const std::filesystem::path& path) {
    const std::filesystem::path absolute = std::filesystem::absolute(path, ec);
    return ec ? absolute : std::filesystem::weakly_canonical(absolute, ec);
  };
  const std::filesystem::path real = realOf(target), top = realOf(folder.empty() ? "." : folder);
  return ec || leadsOut(real.lexically_relative(top)) ? "" : target;
}

std::optional<std::string> ModelFiles::readBeside(const std::string& uri, const Place& place, Code code,
                                                  bool escaped, text::Severity severity) {
  if (files_.size() > text::raised(kMaxModelFiles)) return {};  // W201
  const std::string name = escaped ? text::unescapeUri(uri) : uri;
  const std::string target = resolve(name);
  if (target.empty()) {
    std::string forward = name;
    std::ranges::replace(forward, '\\', '/');
    if (forward == name || resolve(forward).empty())
      diagnostics_.error(say::outsideModelFolder, place, name, uri);
    else
      diagnostics_.error(say::backslashesInPath, place, name, uri, forward);
    return {};
  }
  if (std::ranges::find(files_, target) == files_.end()) files_.push_back(target);
  if (files_.size() > text::raised(kMaxModelFiles)) {
    text::reportLimit(diagnostics_, place, "the model names too many files", kMaxModelFiles,
                      "files of one model");
    return {};
  }
  text::Diagnostics found;
  std::optional<std::string> bytes = readCounted(target, place, code, found);
  for (text::Diagnostic each : found.items()) {
    if (each.code == code) each.severity = severity;
    diagnostics_.add(std::move(each));
  }
  return bytes;
}

bool ModelFiles::hasBeside(const std::string& name) const {
  const std::string target = resolve(name);
  std::error_code ec;
  return !target.empty() && text::mayRead(target) && std::filesystem::is_regular_file(target, ec);
}

std::string ModelFiles::namedBeside(std::string path) const {
  std::ranges::replace(path, '\\', '/');
  return hasBeside(path) ? path : path.substr(path.rfind('/') + 1);
}

bool ModelFiles::isTextInLimit(std::string_view bytes) {
  if (bytes.size() <= text::raised(kMaxModelTextBytes)) return true;
  text::reportLimit(diagnostics_, place(), "the model's text is too large", kMaxModelTextBytes,
                    "bytes of one OBJ or text FBX file", bytes.size());
  return false;
}

bool ModelFiles::count(std::uint64_t bytes, const Place& place) {
  bytes_ += bytes;
  if (bytes_ <= text::raised(kMaxModelBytes)) return true;
  text::reportLimit(diagnostics_, place, "the model is too large", kMaxModelBytes,
                    "bytes of all files of one model, and of what is packed in them", bytes_);
  return false;
}

std::optional<std::string> ModelFiles::readCounted(const std::string& path, const Place& place, Code code,
                                                   text::Diagnostics& diagnostics) {
  const std::uint64_t left = text::raised(kMaxModelBytes) - std::min(bytes_, text::raised(kMaxModelBytes));
  std::uint64_t found = 0;
  std::optional<std::string> bytes = text::readWithin(path, left, found, diagnostics, code, place, stop_);
  if ((bytes || found > left) && !count(found, isKnown(place) ? place : this->place())) return {};
  return bytes;
}

std::optional<std::string> decodeDataUri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos || !uri.substr(0, comma).ends_with(";base64")) return {};
  static const std::array<std::int8_t, 256> kDigits = [] {
    std::array<std::int8_t, 256> digits{};
    digits.fill(-1);
    const std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < alphabet.size(); ++i)
      digits[static_cast<unsigned char>(alphabet[i])] = static_cast<std::int8_t>(i);
    return digits;
  }();
  std::string_view text = uri.substr(comma + 1);
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string out;
  out.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::int8_t digit = kDigits[static_cast<unsigned char>(c)];
    if (digit < 0) return {};
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count >= 8) {
      count -= 8;
      out.push_back(static_cast<char>(bits >> count & 0xff));
    }
  }
  return out;
}

}  // namespace weft::assets
