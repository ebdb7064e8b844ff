// Whole files through importers: those of tests/convert become graphs that Weft reads, with the lines of the
// original; broken ones give the diagnostic that bad/manifest.json promises, at its place.
#include <algorithm>
#include <set>

#include "engine/text/codes.h"
#include "engine/text/json/dom.h"
#include "tests/convert/converted.h"

using namespace weft;
using namespace weft::importing;
using namespace weft::importing::test;

TEST_CASE("every file of tests/convert becomes a graph that Weft reads") {
  std::vector<std::filesystem::path> files = filesIn("isf", ".fs");
  for (const auto& file : filesIn("mpv", ".glsl")) files.push_back(file);
  for (const auto& file : files) {
    CAPTURE(file.string());
    text::Diagnostics diagnostics;
    const auto converted = convertFile(file.string(), {}, diagnostics);
    REQUIRE_MESSAGE(converted, diagnostics.text());
    CHECK_FALSE(diagnostics.hasErrors());
    std::string why;
    CHECK_MESSAGE(isSound(*converted, why), why);
    // The lines keep their numbers, and the comments their text.
    const bool isf = file.extension() == ".fs";
    const std::string original = textOf(file);
    const std::string own = partOf(*converted, isf ? ".fs.glsl" : ".hook.glsl");
    std::vector<std::string> before, after;
    for (const auto& [text, lines] : {std::pair{&original, &before}, std::pair{&own, &after}})
      for (std::size_t at = 0; at < text->size();) {
        const std::size_t end = std::min(text->find('\n', at), text->size());
        lines->push_back(text->substr(at, end - at));
        at = end + 1;
      }
    REQUIRE(after.size() >= before.size());
    CHECK(after.size() <= before.size() + 1);
    // Behind the header, which an ISF file has in a comment of its own.
    std::size_t first = 0, compared = 0;
    while (isf && first < before.size() && before[first].find("*/") == std::string::npos) ++first;
    for (std::size_t i = first + (isf ? 1 : 0); i < before.size(); ++i) {
      const std::size_t from = before[i].find_first_not_of(" \t"), comment = before[i].find("//");
      if (from == std::string::npos || before[i].find("uniform") == from) continue;
      if (!isf && after[i].empty()) continue;  // the value of a parameter
      CAPTURE(before[i]);
      CAPTURE(after[i]);
      ++compared;
      CHECK(after[i].find_first_not_of(" \t") == from);
      if (comment != std::string::npos) CHECK(after[i].ends_with(before[i].substr(comment)));
    }
    CHECK(compared >= 3);
  }
}

TEST_CASE("every broken file gives the diagnostic of its name, at its place, and says what would fix it") {
  text::Diagnostics said;
  const auto manifest = text::parseJson(textOf(kFolder / "bad/manifest.json"), {}, said);
  REQUIRE(manifest);
  std::set<std::string> listed;
  for (const text::JsonValue& entry : manifest->find("files")->items) {
    const std::string& name = entry.find("file")->text;
    CAPTURE(name);
    listed.insert(name);
    text::Diagnostics diagnostics;
    CHECK_FALSE(convertFile((kFolder / "bad" / name).string(), {}, diagnostics));
    REQUIRE(diagnostics.size() == 1);
    const text::Diagnostic& d = diagnostics.items()[0];
    CHECK(text::nameOf(d.code) == entry.find("code")->text);
    CHECK(d.place.line == static_cast<std::uint32_t>(entry.find("line")->number));
    CHECK(d.place.column == static_cast<std::uint32_t>(entry.find("column")->number));
    CHECK_FALSE(d.hint.empty());
  }
  for (const auto& file : std::filesystem::directory_iterator(kFolder / "bad"))
    if (file.path().filename() != "manifest.json") CHECK(listed.contains(file.path().filename().string()));
}

TEST_CASE("codes of imports have a broken file and a section in docs/errors.md") {
  const std::string errors = textOf(WEFT_SOURCE_DIR "/docs/errors.md");
  const std::string manifest = textOf(kFolder / "bad/manifest.json");
#define WEFT_TEST_CODE(number, name, title)                                 \
  if (text::numberOf(#number) >= 220 && text::numberOf(#number) <= 226) {   \
    CHECK(errors.find("## " #number ": " title "\n") != std::string::npos); \
    CHECK(manifest.find("\"" #number "\"") != std::string::npos);           \
  }
  WEFT_CODES(WEFT_TEST_CODE)
#undef WEFT_TEST_CODE
}
