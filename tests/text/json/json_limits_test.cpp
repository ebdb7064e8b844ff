// What a JSON text may hold: bytes, values, the length of a key; and how far limits can be raised.
#include <doctest/doctest.h>

#include <filesystem>

#include "engine/text/files/file.h"
#include "engine/text/json/dom.h"
#include "engine/text/limits.h"
#include "tests/temporary_folder.h"

using namespace weft::text;

namespace {

std::optional<JsonValue> parse(std::string_view text, Diagnostics& diagnostics) {
  return parseJson(text, "t.json", diagnostics);
}

void checkRefused(std::string_view text, const char* place, const char* name) {
  Diagnostics diagnostics;
  CHECK(!parse(text, diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == Code::limitExceeded);
  CHECK_MESSAGE(diagnostics.text().starts_with(place), diagnostics.text());
  CHECK_MESSAGE(diagnostics.items()[0].expected.find(name) != std::string::npos, diagnostics.text());
}

}  // namespace

TEST_CASE("a key is as long as it may be, and no longer") {
  Diagnostics diagnostics;
  CHECK(parse("{\n \"" + std::string(255, 'k') + "\": 1 }", diagnostics));
  CHECK(diagnostics.empty());
  checkRefused("{\n \"" + std::string(256, 'k') + "\": 1 }", "t.json:2:2: ", "at most 255 bytes");
}

TEST_CASE("values are counted, of every type and in every depth") {
  std::string text = "[{ \"a\": [true, null] }";  // 5 with the array around it
  for (std::uint64_t i = 5; i < kMaxValues; ++i) text += ",1";
  Diagnostics diagnostics;
  CHECK(parse(text + "]", diagnostics));
  CHECK(diagnostics.empty());
  checkRefused(text + ",\n{}]", "t.json:2:1: ", "at most 1500000 values");
}

TEST_CASE("a text beyond the limit is refused before it is parsed, a file before it is read") {
  checkRefused(std::string(kMaxTextBytes + 1, '!'), "t.json: ", "at most 33554432 bytes");
  const TemporaryFolder folder;
  const std::string path = folder.write("large.json", "{}");
  std::filesystem::resize_file(path, std::uintmax_t{1} << 40);  // a hole: nobody reads to its end
  Diagnostics diagnostics;
  CHECK(!readTextFile(path, diagnostics));
  REQUIRE(diagnostics.size() == 1);
  CHECK(diagnostics.items()[0].code == Code::limitExceeded);
  CHECK(diagnostics.items()[0].found == "1099511627776 bytes");
  CHECK(*diagnostics.items()[0].place.file == path);
}

TEST_CASE("limits are raised together, and so far that what is needed fits") {
  CHECK(hintToRaise(100) == "raise the limits with --limit 2, if that is meant");
  CHECK(hintToRaise(100, 501) == "raise the limits with --limit 6, if that is meant");
  CHECK(hintToRaise(100, 6401).empty());
  limitsRaised = 3;
  CHECK(raised(100) == 300);
  CHECK(hintToRaise(100) == "raise the limits with --limit 6, if that is meant");
  limitsRaised = 1;
}
