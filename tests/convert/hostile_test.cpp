// Damaged and hostile files: no crash, no endless work, and a diagnostic with a place for each that is refused. What
// is taken is a graph that Weft reads.
#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "engine/text/limits.h"
#include "tests/convert/converted.h"

using namespace weft;
using namespace weft::importing;
using namespace weft::importing::test;

namespace {

void expectSane(const std::string& text, bool isf) {
  text::Diagnostics diagnostics;
  const auto converted = isf ? convertIsfText(text, diagnostics) : convertMpvText(text, diagnostics);
  if (converted) {
    std::string why;
    CHECK_MESSAGE(isSound(*converted, why, true), why << "\nof\n" << text);
    return;
  }
  CHECK(diagnostics.hasErrors());
  for (const text::Diagnostic& d : diagnostics.items()) {
    CHECK(d.place.file);
    CHECK(d.place.line > 0);
    CHECK_FALSE(d.message.empty());
  }
}

std::string damaged(std::string text, std::mt19937& random) {
  static const std::string kBytes = "{}[]()\"$/*,:.#!\n\\ 0a-\x80";
  for (int changes = 1 + static_cast<int>(random() % 3); changes > 0 && !text.empty(); --changes) {
    const std::size_t at = random() % text.size();
    const std::size_t count = std::min<std::size_t>(1 + random() % 12, text.size() - at);
    switch (random() % 4) {
      case 0:
        text.erase(at, count);
        break;
      case 1:
        text[at] = kBytes[random() % kBytes.size()];
        break;
      case 2:
        text.insert(at, text.substr(at, count));
        break;
      default:
        text.insert(at, std::to_string(static_cast<std::int64_t>(random()) * 7919));
    }
  }
  return text;
}

std::string repeated(std::string_view piece, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += piece;
  return text;
}

}  // namespace

TEST_CASE("files cut short anywhere") {
  for (const auto& [folder, extension] : {std::pair{"isf", ".fs"}, std::pair{"mpv", ".glsl"}})
    for (const auto& file : filesIn(folder, extension)) {
      const std::string text = textOf(file);
      for (std::size_t bytes = 0; bytes < text.size(); bytes += 7)
        expectSane(text.substr(0, bytes), extension[1] == 'f');
    }
}

TEST_CASE("files with bytes changed, taken out and doubled") {
  std::mt19937 random(20261122);
  for (const auto& [folder, extension] : {std::pair{"isf", ".fs"}, std::pair{"mpv", ".glsl"}})
    for (const auto& file : filesIn(folder, extension)) {
      const std::string text = textOf(file);
      for (int round = 0; round < 150; ++round) expectSane(damaged(text, random), extension[1] == 'f');
    }
}

TEST_CASE("headers that want too much are refused, each for its reason") {
  const auto said = [](const std::string& header) {
    text::Diagnostics diagnostics;
    CHECK_FALSE(convertIsfText("/*" + header + "*/\nvoid main() {}\n", diagnostics));
    return codesOf(diagnostics);
  };
  CHECK(said(repeated("{\"INPUTS\":[", 100)) == "W007 ");
  CHECK(said("{\"INPUTS\": [{\"NAME\": \"" + repeated("n", 65) + "\", \"TYPE\": \"bool\"}]}") == "W012 ");
  const auto sized = [](const std::string& size) {
    return "{\"PASSES\": [{\"TARGET\": \"t\", \"WIDTH\": \"" + size + "\"}]}";
  };
  CHECK(said(sized(repeated("(", 200) + "1" + repeated(")", 199))) == "W222 ");
  CHECK(said(sized(repeated("1+", 300) + "1")) == "W222 ");
  CHECK(said("{\"INPUTS\": [{\"NAME\": \"a\", \"TYPE\": \"long\", \"DEFAULT\": 1e12}]}") == "W013 ");
  CHECK(said("{\"INPUTS\": [{\"NAME\": \"a\", \"TYPE\": \"float\", \"DEFAULT\": 1e300}]}") == "W003 ");
}

TEST_CASE("user shaders that want too much are refused, each for its reason") {
  const auto said = [](const std::string& text) {
    text::Diagnostics diagnostics;
    CHECK_FALSE(convertMpvText(text, diagnostics));
    return codesOf(diagnostics);
  };
  const std::string hook = "//!HOOK MAIN\n//!BIND HOOKED\n",
                    body = "vec4 hook() { return HOOKED_texOff(0); }\n";
  CHECK(said(hook + "//!WIDTH " + repeated("1 ", 33) + "\n" + body) == "W225 ");
  CHECK(said(hook + "//!WIDTH 1 1\n" + body) == "W225 ");
  CHECK(said(hook + "//!COMPUTE 1024 1024\nvoid hook() {}\n") == "W225 ");
  // As many texels as 64 bits can say, and not a byte of them.
  CHECK(said("//!TEXTURE T\n//!SIZE 16384 16384 16384\n//!FORMAT rgba32f\n00\n" + hook + body) == "W225 ");
  CHECK(said("//!TEXTURE T\n//!SIZE 100000\n//!FORMAT r8\n00\n" + hook + body) == "W225 ");
}

TEST_CASE("conditions that each pass takes over from two before it are each written once") {
  // 2^60 ways lead to the last.
  std::string text =
      "//!PARAM p\n//!TYPE float\n1\n"
      "//!HOOK MAIN\n//!BIND HOOKED\n//!SAVE X0\n//!WHEN p 1 =\nvec4 hook() { return HOOKED_texOff(0); }\n"
      "//!HOOK MAIN\n//!BIND HOOKED\n//!SAVE Y0\n//!WHEN p 2 =\nvec4 hook() { return HOOKED_texOff(0); }\n";
  for (int i = 1; i < 60; ++i)
    for (const char* save : {"X", "Y"})
      text += fmt::format(
          "//!HOOK MAIN\n//!BIND HOOKED\n//!BIND X{0}\n//!BIND Y{0}\n//!SAVE {1}{2}\n{3}"
          "vec4 hook() {{ return HOOKED_texOff(0) + X{0}_texOff(0) + Y{0}_texOff(0); }}\n",
          i - 1, save, i, i % 2 ? "//!WHEN p 3 <\n" : "");
  text::Diagnostics diagnostics;
  const auto converted = convertMpvText(text, diagnostics);
  REQUIRE_MESSAGE(converted, diagnostics.text());
  std::string why;
  CHECK_MESSAGE(isSound(*converted, why, true), why);
}
