#include "engine/convert/text/json_text.h"

#include <fmt/format.h>

#include "engine/base/json/edit.h"
#include "engine/base/json/layout.h"

namespace weft::convert {

JsonObjectText& JsonObjectText::add(std::string_view key, const std::string& json) {
  if (json.empty()) return *this;
  if (!members_.empty()) members_ += ", ";
  members_ += base::quoteJson(key) + ": " + json;
  return *this;
}

JsonObjectText& JsonObjectText::addText(std::string_view key, std::string_view text) {
  return add(key, base::quoteJson(text));
}

std::string numberText(double number, bool real) {
  std::string text = fmt::format("{}", number);
  if (real && text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string numbersText(std::span<const double> numbers, bool real) {
  if (numbers.size() == 1) return numberText(numbers[0], real);
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "[" : ", ") + numberText(number, real);
  return text + "]";
}

std::string graphText(const JsonObjectText& members) {
  return base::layoutJson(members.text() + "\n", {.packed = {"set"}, .starts = {"read", "write", "modify"}});
}

}  // namespace weft::convert
