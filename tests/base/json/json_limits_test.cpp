// What a JSON text may hold: bytes, values, the length of a key; and how far limits can be raised.
#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>

#include "engine/base/files/file_access.h"
#include "engine/base/files/text_file.h"
#include "engine/base/json/dom.h"
#include "engine/base/limits.h"
#include "tests/temporary_folder.h"

using namespace weft::base;

namespace {

// Sets a limit, and what it was again at the end.
class LimitOf {
 public:
  LimitOf(Limit limit, std::uint64_t value) : limit_(limit), before_(limitOf(limit)) { set(value); }
  ~LimitOf() { set(before_); }
  LimitOf(const LimitOf&) = delete;
  LimitOf& operator=(const LimitOf&) = delete;

 private:
  void set(std::uint64_t value) { REQUIRE(!setLimit(nameOf(limit_), std::to_string(value))); }
  Limit limit_;
  std::uint64_t before_;
};

std::optional<JsonValue> parse(std::string_view text, Diagnostics& diagnostics) {
  return parseJson(text, std::make_shared<const std::string>("t.json"), diagnostics);
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

TEST_CASE("a key is as long as the limit says, and no longer") {
  Diagnostics diagnostics;
  CHECK(parse("{\n \"" + std::string(255, 'k') + "\": 1 }", diagnostics));
  CHECK(diagnostics.empty());
  checkRefused("{\n \"" + std::string(256, 'k') + "\": 1 }", "t.json:2:2: ", "(limit name_bytes)");
}

TEST_CASE("values are counted, of every type and in every depth") {
  const LimitOf limit(Limit::json_values, 6);
  Diagnostics diagnostics;
  CHECK(parse("{ \"a\": [1, true], \"b\": { \"c\": null } }", diagnostics));
  CHECK(diagnostics.empty());
  checkRefused("{ \"a\": [1, true], \"b\": { \"c\": \"d\", \"e\": 1 } }",
               "t.json:1:41: ", "(limit json_values)");
  checkRefused("[1, 2, 3, 4, 5, {}]", "t.json:1:17: ", "(limit json_values)");
}

TEST_CASE("a text beyond the limit is refused before it is parsed, a file before it is read") {
  const LimitOf limit(Limit::json_bytes, 100'000);
  checkRefused(std::string(100'001, '!'), "t.json: ", "(limit json_bytes)");
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

TEST_CASE("Weft's own data has at least the defaults, unless the person named the file") {
  const LimitOf bytes(Limit::json_bytes, 10), values(Limit::json_values, 2), names(Limit::name_bytes, 3);
  const TemporaryFolder temporary;
  const std::filesystem::path& folder = temporary.path();
  std::filesystem::create_directories(folder / "own");
  allowFolder((folder / "own").string());
  const auto reads = [&](const std::string& name) {
    const std::string path = (folder / name).string();
    std::ofstream(path) << "{ \"long_name\": [1, 2, 3] }";
    Diagnostics diagnostics;
    const auto text = readTextFile(path, diagnostics);
    return text && parseJson(*text, std::make_shared<const std::string>(path), diagnostics);
  };
  CHECK(reads("own/a.json"));
  CHECK(reads("own/../own/b.json"));
  CHECK_FALSE(reads("own/../a.json"));
  chooseFile((folder / "own/c.json").string());
  CHECK_FALSE(reads("own/c.json"));
  resetFileAccess();
  CHECK_FALSE(reads("own/a.json"));
}

TEST_CASE("limits of what goes down the stack have a maximum") {
  const LimitOf limit(Limit::include_depth, 64);
  CHECK(hintToRaise(Limit::include_depth) == "raise it with --limit include_depth=128, if that is meant");
  CHECK(!setLimit("include_depth", "200"));
  CHECK(hintToRaise(Limit::include_depth) == "raise it with --limit include_depth=256, if that is meant");
  CHECK(setLimit("include_depth", "257") ==
        "expected at most 256, found 257: deeper walks would overflow the stack");
  CHECK(limitOf(Limit::include_depth) == 200);
  CHECK(!setLimit("include_depth", "256"));
  CHECK(hintToRaise(Limit::include_depth).starts_with("include_depth cannot be raised further"));
  CHECK(mostOf(Limit::frames) > std::uint64_t{1} << 60);
}
