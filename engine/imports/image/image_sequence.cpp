#include "engine/imports/image/image_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <string_view>

#include "engine/text/chars.h"
#include "engine/text/files/file.h"

namespace weft::imports {

namespace {

constexpr std::size_t kMaxDigits = 9;  // of a number

// The number in `name`, which is `before`, digits, `after`.
std::optional<std::uint32_t> numberIn(std::string_view name, std::string_view before, std::string_view after,
                                      std::size_t digits) {
  if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
    return std::nullopt;
  const std::string_view text = name.substr(before.size(), name.size() - before.size() - after.size());
  // 00012 is no name of number 12 in four digits, and neither is 12.
  if (text.size() < digits || text.size() > kMaxDigits || (text.size() > digits && text[0] == '0') ||
      !std::ranges::all_of(text, text::isDigit))
    return std::nullopt;
  std::uint32_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

}  // namespace

std::string SequencePattern::nameOf(std::uint32_t number) const {
  return fmt::format("{}{:0{}}{}", before, number, digits, after);
}

std::optional<SequencePattern> sequencePatternOf(const std::string& file) {
  const std::size_t slash = file.rfind('/'), name = slash == std::string::npos ? 0 : slash + 1;
  const auto made = [&](std::size_t first, std::size_t end, std::size_t digits) {
    return SequencePattern{file, file.substr(0, first), file.substr(end),
                           std::clamp<std::size_t>(digits, 1, kMaxDigits)};
  };
  if (const std::size_t first = file.find("##", name); first != std::string::npos) {
    const std::size_t end = std::min(file.find_first_not_of('#', first), file.size());
    return made(first, end, end - first);
  }
  for (std::size_t first = file.find('%', name); first != std::string::npos;
       first = file.find('%', first + 1)) {
    std::size_t end = first + 1, width = 0;
    while (end < file.size() && text::isDigit(file[end]) && end - first <= 2)
      width = width * 10 + static_cast<std::size_t>(file[end++] - '0');
    if (end < file.size() && file[end] == 'd') return made(first, end + 1, width);
  }
  return std::nullopt;
}

std::vector<std::uint32_t> numbersOf(const SequencePattern& pattern, text::Diagnostics& diagnostics) {
  namespace fs = std::filesystem;
  const text::Place place{pattern.text};
  const std::size_t slash = pattern.before.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : pattern.before.substr(0, slash + 1);
  const std::string before = slash == std::string::npos ? pattern.before : pattern.before.substr(slash + 1);
  if (!text::mayRead(folder)) {
    text::reportOutside(folder, diagnostics, place);
    return {};
  }
  std::vector<std::uint32_t> numbers;
  std::error_code ec;
  for (fs::directory_iterator entry(folder, ec), end; !ec && entry != end; entry.increment(ec))
    if (const auto number =
            numberIn(entry->path().filename().string(), before, pattern.after, pattern.digits))
      numbers.push_back(*number);
  std::ranges::sort(numbers);
  if (numbers.empty()) {
    text::Diagnostic& d = diagnostics.error(text::Code::unreadableImage, place,
                                            fmt::format("the sequence '{}' has no pictures", pattern.text));
    d.expected = fmt::format("files such as {}", pattern.nameOf(1));
    d.found = ec ? fmt::format("a folder that cannot be listed: {}", ec.message()) : "none";
    d.hint = "write as many # as the numbers have digits, or %d for numbers without leading zeros";
  }
  return numbers;
}

}  // namespace weft::imports
