#include "engine/base/json/pointer.h"

#include <fmt/format.h>

#include <algorithm>

namespace weft::base {

namespace {

constexpr std::size_t kLongest = 4000;

void appendEscaped(std::string_view key, std::string& out) {
  for (const char c : key) {
    if (c == '~')
      out += "~0";
    else if (c == '/')
      out += "~1";
    else
      out += c;
  }
}

}  // namespace

std::uint32_t JsonPointer::Container::add(std::string_view key) {
  keys_ += key;
  ends_.push_back(static_cast<std::uint32_t>(keys_.size()));
  return count_++;
}

std::string JsonPointer::text() const {
  std::vector<const JsonPointer*> way;  // from the value to the document
  for (const JsonPointer* at = this; at->container_; at = &at->container_->place_) way.push_back(at);
  std::string out;
  for (auto at = way.rbegin(); at != way.rend(); ++at) {
    const Container& container = *(*at)->container_;
    const std::uint32_t index = (*at)->index_;
    out += '/';
    if (!container.object_) {
      out += fmt::format_int(index).c_str();
    } else {
      const std::uint32_t begin = index == 0 ? 0 : container.ends_[index - 1];
      const std::string_view key =
          std::string_view(container.keys_).substr(begin, container.ends_[index] - begin);
      if (out.size() + key.size() > kLongest) return out + "…";
      appendEscaped(key, out);
    }
  }
  return out;
}

}  // namespace weft::base
